#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

#include "memory.h"

enum { BUFFER_SIZE = 64 * 1024 };

struct output {
    int fd;
    gzFile gzip;            /* NULL for plain output */
    char *name;             /* as it was given, for messages */
    char *path, *temporary; /* temporary is NULL if the path is written directly */
    size_t used;
    bool failed; /* something that was written is lost: the file must not take its name */
    char buffer[BUFFER_SIZE];
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
    free(output);
}

static int cannot_create(const char *name, struct diag *diag)
{
    return diag_fail(diag, DIAG_CANNOT_CREATE, "%s: %s", name, strerror(errno));
}

struct output *output_open(const char *path, struct diag *diag)
{
    struct output *output = memory_get(sizeof *output);
    memset(output, 0, offsetof(struct output, buffer));
    output->fd = STDOUT_FILENO;
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

static int flush(struct output *output, struct diag *diag)
{
    size_t length = output->used;
    output->used = 0;
    errno = 0;
    bool good = length == 0 ||
                (output->gzip != NULL ? gzwrite(output->gzip, output->buffer, (unsigned)length) > 0
                                      : write_all(output->fd, output->buffer, length) == 0);
    if (good)
        return 0;
    output->failed = true;
    return diag_fail(diag, DIAG_IO, "%s: %s", shown_name(output), strerror(errno));
}

int output_write(struct output *output, const char *bytes, size_t length, struct diag *diag)
{
    while (length > 0) {
        if (output->used == BUFFER_SIZE && flush(output, diag) != 0)
            return -1;
        size_t room = BUFFER_SIZE - output->used;
        size_t taken = length < room ? length : room;
        memcpy(output->buffer + output->used, bytes, taken);
        output->used += taken;
        bytes += taken;
        length -= taken;
    }
    return 0;
}

int output_close(struct output *output, int whole, struct diag *diag)
{
    int result = flush(output, diag) == 0 && !output->failed ? 0 : -1;
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
