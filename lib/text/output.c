#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for O_TMPFILE, which is Linux's */
#include "text/output.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

#include "base/arena.h"

/* Bytes that a pipe takes at once. */
enum { PIECE_SIZE = 64 * 1024 };

struct output {
    int fd;
    gzFile gzip;            /* NULL for plain output */
    char *name;             /* as it was given, for messages */
    char *path, *temporary; /* temporary is NULL if the path is written directly */
    bool unnamed;           /* the file has no name at all yet, not even the temporary one */
    struct text held;       /* text that is not written yet */
    bool failed; /* something that was written is lost: the file must not take its name */
};

static char *temporary_name(const char *path)
{
    size_t size = strlen(path) + 32;
    char *name = memory_get(size);
    snprintf(name, size, "%s.tmp.%ld", path, (long)getpid());
    return name;
}

static char *copy(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(memory_get(size), text, size);
}

/* The path to write: for a symbolic link that of its target, so that the link is not replaced. */
static char *target(const char *path)
{
    char *resolved = strcmp(path, "-") != 0 ? realpath(path, NULL) : NULL;
    return resolved != NULL ? resolved : copy(path);
}

static bool is_special(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

static void discard(struct output *output)
{
    free(output->name);
    free(output->path);
    free(output->temporary);
    text_free(&output->held);
    free(output);
}

static int cannot_create(const char *name, struct diag *diag)
{
    return diag_fail(diag, DIAG_CANNOT_CREATE, "%s: %s", name, strerror(errno));
}

/* Opens a new file without a name in the path's folder; -1 where the file system has none. It gets
 * its name through /proc later. */
static int open_unnamed(const char *path)
{
    int fd = -1;
#ifdef O_TMPFILE
    char *folder = copy(path), *slash = strrchr(folder, '/');
    if (slash != NULL)
        slash[slash == folder] = '\0';
    if (access("/proc/self/fd", X_OK) == 0)
        fd = open(slash != NULL ? folder : ".", O_TMPFILE | O_WRONLY, 0666);
    free(folder);
#endif
    return fd;
}

static int open_file(struct output *output)
{
    struct stat status;
    bool replaces = stat(output->path, &status) == 0;
    if (replaces && S_ISDIR(status.st_mode)) {
        errno = EISDIR;
        return -1;
    }
    if (is_special(output->path))
        return open(output->path, O_WRONLY | O_TRUNC);
    output->temporary = temporary_name(output->path);
    int fd = open_unnamed(output->path);
    output->unnamed = fd >= 0;
    if (fd < 0)
        fd = open(output->temporary, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd >= 0 && replaces)
        fchmod(fd, status.st_mode & 07777);
    return fd;
}

struct output *output_open(const char *path, struct diag *diag)
{
    struct output *output = memory_get(sizeof *output);
    *output = (struct output){.fd = STDOUT_FILENO};
    output->name = copy(path);
    output->path = target(path);
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0)
        return output;
    output->fd = open_file(output);
    if (output->fd < 0) {
        cannot_create(output->name, diag);
        discard(output);
        return NULL;
    }
    size_t length = strlen(output->path);
    if (length > 3 && strcmp(output->path + length - 3, ".gz") == 0) {
        /* Level 1: at 116 MB/s it keeps up with the chain. A copy of the descriptor, because
         * gzclose closes it before the file can be synced. */
        output->gzip = gzdopen(dup(output->fd), "wb1");
        if (output->gzip == NULL)
            memory_get((size_t)-1);
    }
    return output;
}

/* Waits where there is no room, also if whoever opened the file asked not to. */
static int write_all(int fd, const char *bytes, size_t length)
{
    struct pollfd file = {.fd = fd, .events = POLLOUT};
    while (length > 0) {
        ssize_t written = write(fd, bytes, length);
        if (written < 0 && errno != EINTR && !(errno == EAGAIN && poll(&file, 1, -1) > 0))
            return -1;
        if (written > 0) {
            bytes += written;
            length -= (size_t)written;
        }
    }
    return 0;
}

static const char *shown_name(const struct output *output)
{
    return strcmp(output->name, "-") == 0 ? "stdout" : output->name;
}

static int cannot_write(struct output *output, struct diag *diag)
{
    output->failed = true;
    /* zlib allocates with its first write. */
    return diag_fail(diag, errno == ENOMEM ? DIAG_MEMORY : DIAG_IO, "%s: %s", shown_name(output),
                     strerror(errno));
}

/* Writes the first bytes that are held; the others move up. */
static int send_first(struct output *output, size_t length, struct diag *diag)
{
    struct text *held = &output->held;
    errno = 0;
    bool good = length == 0 ||
                (output->gzip != NULL ? gzwrite(output->gzip, held->bytes, (unsigned)length) > 0
                                      : write_all(output->fd, held->bytes, length) == 0);
    held->length -= length;
    if (held->length > 0)
        memmove(held->bytes, held->bytes + length, held->length);
    return good ? 0 : cannot_write(output, diag);
}

struct text *output_text(struct output *output)
{
    return &output->held;
}

int output_send(struct output *output, struct diag *diag)
{
    size_t whole = output->held.length / PIECE_SIZE * PIECE_SIZE;
    return whole == 0 ? 0 : send_first(output, whole, diag);
}

int output_flush(struct output *output, struct diag *diag)
{
    bool awaited = output->temporary == NULL && output->gzip == NULL;
    return awaited ? send_first(output, output->held.length, diag) : 0;
}

int output_write(struct output *output, const char *bytes, size_t length, struct diag *diag)
{
    while (length > 0) {
        size_t taken = length < PIECE_SIZE ? length : PIECE_SIZE;
        text_add(&output->held, bytes, taken);
        if (output_send(output, diag) != 0)
            return -1;
        bytes += taken;
        length -= taken;
    }
    return 0;
}

int output_finish(struct output *output, struct diag *diag)
{
    send_first(output, output->held.length, diag);
    if (output->gzip != NULL && gzclose(output->gzip) != Z_OK)
        cannot_write(output, diag);
    output->gzip = NULL;
    if (output->temporary != NULL && !output->failed && fsync(output->fd) != 0)
        cannot_write(output, diag);
    return output->failed ? -1 : 0;
}

/* Gives an unnamed file the temporary name, after removing a file of that name that a killed run
 * with the same PID left. */
static int name_file(const struct output *output)
{
    char file[64];
    snprintf(file, sizeof file, "/proc/self/fd/%d", output->fd);
    unlink(output->temporary);
    return linkat(AT_FDCWD, file, AT_FDCWD, output->temporary, AT_SYMLINK_FOLLOW);
}

static int take_name(const struct output *output, struct diag *diag)
{
    if ((!output->unnamed || name_file(output) == 0) &&
        rename(output->temporary, output->path) == 0)
        return 0;
    return cannot_create(output->name, diag);
}

int output_close(struct output *output, bool whole, struct diag *diag)
{
    int result = output_finish(output, diag);
    whole = whole && result == 0;
    if (output->temporary != NULL && whole)
        result = take_name(output, diag);
    if (output->temporary != NULL && (result != 0 || !whole))
        unlink(output->temporary);
    if (close(output->fd) != 0 && result == 0)
        result = cannot_write(output, diag);
    discard(output);
    return result;
}
