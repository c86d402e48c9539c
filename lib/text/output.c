#include "text/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

#include "base/arena.h"

/* What a pipe takes at once. */
enum { PIECE_SIZE = 64 * 1024 };

struct output {
    int fd;
    gzFile gzip;            /* NULL for plain output */
    char *name;             /* as it was given, for messages */
    char *path, *temporary; /* temporary is NULL if the path is written directly */
    struct text held;       /* not written yet */
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

/* What a symbolic link stands for is written, not the link replaced. */
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

struct output *output_open(const char *path, struct diag *diag)
{
    struct output *output = memory_get(sizeof *output);
    *output = (struct output){.fd = STDOUT_FILENO};
    output->name = copy(path);
    output->path = target(path);
    if (strcmp(path, "-") == 0)
        return output;
    path = output->path;
    if (!is_special(path))
        output->temporary = temporary_name(path);
    const char *name = output->temporary != NULL ? output->temporary : path;
    output->fd = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    struct stat status;
    if (output->fd >= 0 && stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        close(output->fd);
        unlink(name);
        errno = EISDIR;
        output->fd = -1;
    }
    if (output->fd < 0) {
        cannot_create(output->name, diag);
        discard(output);
        return NULL;
    }
    size_t length = strlen(path);
    if (length > 3 && strcmp(path + length - 3, ".gz") == 0) {
        /* Level 1: at 116 MB/s it keeps up with the chain. A copy of the descriptor, because
         * gzclose closes it before the file can be synced. */
        output->gzip = gzdopen(dup(output->fd), "wb1");
        if (output->gzip == NULL)
            memory_get((size_t)-1);
    }
    return output;
}

static int write_all(int fd, const char *bytes, size_t length)
{
    while (length > 0) {
        ssize_t written = write(fd, bytes, length);
        if (written < 0 && errno != EINTR)
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

/* The first bytes of those that are held; the rest moves up. */
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
    if (good)
        return 0;
    output->failed = true;
    return diag_fail(diag, DIAG_IO, "%s: %s", shown_name(output), strerror(errno));
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

int output_close(struct output *output, int whole, struct diag *diag)
{
    int result = send_first(output, output->held.length, diag) == 0 && !output->failed ? 0 : -1;
    if (output->gzip != NULL && gzclose(output->gzip) != Z_OK)
        result = diag_fail(diag, DIAG_IO, "%s: %s", shown_name(output), strerror(errno));
    if (output->temporary != NULL && result == 0 && whole && fsync(output->fd) != 0)
        result = diag_fail(diag, DIAG_IO, "%s: %s", shown_name(output), strerror(errno));
    if (close(output->fd) != 0 && result == 0)
        result = diag_fail(diag, DIAG_IO, "%s: %s", shown_name(output), strerror(errno));
    if (output->temporary != NULL && (result != 0 || !whole))
        unlink(output->temporary);
    else if (output->temporary != NULL && rename(output->temporary, output->path) != 0)
        result = cannot_create(output->name, diag);
    discard(output);
    return result;
}
