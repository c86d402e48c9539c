#include "text/output.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <zlib.h>

#include "base/arena.h"
#include "text/path.h"
#include "text/whole_file.h"

enum { PIECE_SIZE = 64 * 1024 }; /* bytes that a pipe takes at once */

struct output {
    int fd;
    gzFile gzip;             /* NULL for plain output */
    char *name;              /* as it was given, for messages */
    struct whole_file *file; /* NULL if the path is written directly */
    struct text held;        /* text that is not written yet */
    bool failed; /* something that was written is lost: the file must not take its name */
};

static char *copy(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(memory_get(size), text, size);
}

static void discard(struct output *output)
{
    free(output->name);
    text_free(&output->held);
    free(output);
}

static int cannot_create(const char *name, struct diag *diag)
{
    int why = errno;
    bool kept = (why == EACCES || why == EPERM || why == EBUSY) && access(name, W_OK) == 0;
    errno = why;
    return diag_fail(diag, diag_code_by_errno(DIAG_CANNOT_CREATE), "%s: %s%s", name, strerror(why),
                     kept ? "; no new file can take the place of this one: name another one, or "
                            "let the shell write into it (>)"
                          : "");
}

static const char *shown_name(const struct output *output)
{
    return strcmp(output->name, "-") == 0 ? "stdout" : output->name;
}

static int cannot_write(struct output *output, struct diag *diag)
{
    output->failed = true;
    /* zlib allocates with its first write. */
    return diag_fail(diag, diag_code_by_errno(DIAG_IO), "%s: %s", shown_name(output),
                     strerror(errno));
}

/* Standard output itself, or a copy of another descriptor. Refuses one that is not open for
 * writing.
 */
static int open_descriptor(struct output *output, int number, struct diag *diag)
{
    int flags = fcntl(number, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) != O_RDONLY)
        output->fd =
            number == STDOUT_FILENO ? number : fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    else
        errno = EBADF;
    return output->fd < 0 ? cannot_write(output, diag) : 0;
}

static int open_path(struct output *output, const char *path, struct diag *diag)
{
    int number = path_descriptor(path);
    if (number >= 0)
        return open_descriptor(output, number, diag);
    if (path_is_special(path))
        output->fd = open(path, O_WRONLY | O_TRUNC | O_CLOEXEC);
    else if ((output->file = whole_file_make(path)) != NULL)
        output->fd = whole_file_descriptor(output->file);
    return output->fd < 0 ? cannot_create(output->name, diag) : 0;
}

/* Level 1: at 116 MB/s it keeps up with the chain. A copy of the descriptor, because gzclose closes
 * it before the file can be synced. */
static int pack(struct output *output, struct diag *diag)
{
    int copied = dup(output->fd);
    if (copied < 0)
        return cannot_create(output->name, diag);
    output->gzip = gzdopen(copied, "wb1");
    if (output->gzip == NULL)
        memory_get((size_t)-1);
    return 0;
}

struct output *output_open(const char *path, struct diag *diag)
{
    struct output *output = memory_get(sizeof *output);
    *output = (struct output){.fd = -1, .name = copy(path)};
    char *target = path_target(path);
    int result = open_path(output, target, diag);
    size_t length = strlen(target);
    if (result == 0 && length > 3 && strcmp(target + length - 3, ".gz") == 0)
        result = pack(output, diag);
    free(target);
    if (result == 0)
        return output;
    if (output->file != NULL)
        whole_file_close(output->file);
    discard(output);
    return NULL;
}

int output_write_all(int fd, const char *bytes, size_t length)
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

/* Writes the first bytes that are held; the others move up. */
static int send_first(struct output *output, size_t length, struct diag *diag)
{
    struct text *held = &output->held;
    errno = 0;
    bool good = length == 0 ||
                (output->gzip != NULL ? gzwrite(output->gzip, held->bytes, (unsigned)length) > 0
                                      : output_write_all(output->fd, held->bytes, length) == 0);
    held->length -= length;
    if (held->length > 0)
        memmove(held->bytes, held->bytes + length, held->length);
    return good ? 0 : cannot_write(output, diag);
}

struct text *output_text(struct output *output)
{
    return &output->held;
}

bool output_prints(const struct output *output)
{
    return output->held.length > 0 && isatty(output->fd);
}

int output_send(struct output *output, struct diag *diag)
{
    size_t whole = output->held.length / PIECE_SIZE * PIECE_SIZE;
    return whole == 0 ? 0 : send_first(output, whole, diag);
}

int output_flush(struct output *output, struct diag *diag)
{
    bool awaited = output->file == NULL && output->gzip == NULL;
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
    if (output->file != NULL && !output->failed && fsync(output->fd) != 0)
        cannot_write(output, diag);
    return output->failed ? -1 : 0;
}

int output_close(struct output *output, bool whole, struct diag *diag)
{
    int result = output_finish(output, diag);
    if (output->file != NULL && whole && result == 0 && whole_file_take_name(output->file) != 0)
        result = cannot_create(output->name, diag);
    int closed = output->file != NULL ? whole_file_close(output->file) : close(output->fd);
    if (closed != 0 && result == 0)
        result = cannot_write(output, diag);
    discard(output);
    return result;
}

int output_print(const char *bytes, size_t length, struct diag *diag)
{
    struct output *output = output_open("-", diag);
    if (output == NULL)
        return -1;
    output_write(output, bytes, length, diag);
    return output_close(output, true, diag);
}
