#include "text/input.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "text/packing.h"

enum { RAW_SIZE = 64 * 1024, LINE_STEP = 64 * 1024, HEAD_SIZE = 4096 };

struct input {
    int fd;
    const char *name;
    struct input_pause pause;
    size_t raw_at, raw_end;
    bool sniffed;
    enum packing packing;
    struct unpacker *unpacker; /* NULL for plain bytes */
    bool full;                 /* the unpacker had no room left, and may have more bytes */
    struct text line;          /* bytes that were read; bytes from line_at on are not used yet */
    size_t line_at;
    size_t head_length;
    char head[HEAD_SIZE];
    unsigned char raw[RAW_SIZE];
};

void input_guard_descriptors(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

struct input *input_open(const char *path, struct diag *diag)
{
    bool standard = strcmp(path, "-") == 0;
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY);
    if (fd < 0) {
        diag_fail(diag, diag_code_by_errno(DIAG_NO_INPUT), "%s", strerror(errno));
        return NULL;
    }
    struct input *input = memory_get(sizeof *input);
    memset(input, 0, offsetof(struct input, head));
    input->fd = fd;
    input->name = standard ? "stdin" : path;
    return input;
}

void input_close(struct input *input)
{
    if (input == NULL)
        return;
    packing_unpack_end(input->unpacker);
    if (input->fd != STDIN_FILENO)
        close(input->fd);
    text_free(&input->line);
    free(input);
}

const char *input_name(const struct input *input)
{
    return input->name;
}

double input_share(const struct input *input)
{
    struct stat file;
    if (fstat(input->fd, &file) != 0 || !S_ISREG(file.st_mode) || file.st_size == 0)
        return 0;
    return (double)lseek(input->fd, 0, SEEK_CUR) / (double)file.st_size;
}

void input_before_waiting(struct input *input, struct input_pause pause)
{
    input->pause = pause;
}

/* Reads the bytes that are ready, or waits for some, also if the file was opened non-blocking. */
static long read_file(struct input *input, void *bytes, size_t size, struct diag *diag)
{
    struct pollfd file = {.fd = input->fd, .events = POLLIN};
    if (input->pause.act != NULL && poll(&file, 1, 0) == 0)
        input->pause.act(input->pause.with);
    ssize_t got;
    do
        got = read(input->fd, bytes, size);
    while (got < 0 && (errno == EINTR || (errno == EAGAIN && poll(&file, 1, -1) > 0)));
    if (got < 0)
        return diag_fail(diag, errno == EISDIR ? DIAG_NO_INPUT : DIAG_IO, "%s", strerror(errno));
    return got;
}

/* Reads raw bytes if there are none: 1, 0 at the end of the file, -1 after a message. */
static int fill(struct input *input, struct diag *diag)
{
    if (input->raw_at < input->raw_end)
        return 1;
    long got = read_file(input, input->raw, RAW_SIZE, diag);
    if (got < 0)
        return -1;
    input->raw_at = 0;
    input->raw_end = (size_t)got;
    return got > 0;
}

/* An empty file is an empty stream; but the ending of a packed name promises bytes, a header. */
static int check_empty(const struct input *input, struct diag *diag)
{
    enum packing promised = packing_of_name(input->name);
    if (promised == PACKING_NONE)
        return 0;
    return diag_fail(diag, DIAG_DATA, "0 bytes; expected %s data", packing_name(promised));
}

static int sniff(struct input *input, struct diag *diag)
{
    input->sniffed = true;
    int more = fill(input, diag);
    if (more <= 0)
        return more < 0 ? -1 : check_empty(input, diag);
    while (more > 0 && packing_may_begin(input->raw, input->raw_end)) {
        long got = read_file(input, input->raw + input->raw_end, RAW_SIZE - input->raw_end, diag);
        if (got < 0)
            return -1;
        input->raw_end += (size_t)got;
        more = got > 0;
    }
    input->packing = packing_of_bytes(input->raw, input->raw_end);
    if (input->packing == PACKING_NONE)
        return 0;
    if (packing_check(input->packing, diag) != 0)
        return -1;
    input->unpacker = packing_unpack_begin(input->packing);
    return 0;
}

static long read_plain(struct input *input, char *bytes, size_t size, struct diag *diag)
{
    size_t ready = input->raw_end - input->raw_at;
    if (ready == 0)
        return read_file(input, bytes, size, diag);
    size_t taken = ready < size ? ready : size;
    memcpy(bytes, input->raw + input->raw_at, taken);
    input->raw_at += taken;
    return (long)taken;
}

static int refuse_damage(const struct input *input, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA, "damaged %s data: %s", packing_name(input->packing),
                     packing_unpack_damage(input->unpacker));
}

/* What was unpacked before damage is given out first; the next call refuses the damage. */
static long read_packed(struct input *input, char *bytes, size_t size, struct diag *diag)
{
    size_t made = 0;
    while (made == 0) {
        if (packing_unpack_damage(input->unpacker) != NULL)
            return refuse_damage(input, diag);
        int more = input->full && packing_unpack_is_inside(input->unpacker) ? 1 : fill(input, diag);
        if (more < 0)
            return -1;
        if (more == 0 && !packing_unpack_is_inside(input->unpacker))
            return 0;
        const unsigned char *from = input->raw + input->raw_at;
        size_t given = input->raw_end - input->raw_at;
        made = packing_unpack_take(input->unpacker, &from, &given, bytes, size);
        input->raw_at = input->raw_end - given;
        input->full = made == size;
        if (more == 0 && made == 0 && packing_unpack_is_inside(input->unpacker))
            return diag_fail(diag, DIAG_DATA, "the %s data ends early",
                             packing_name(input->packing));
    }
    return (long)made;
}

long input_read(struct input *input, char *bytes, size_t size, struct diag *diag)
{
    if (!input->sniffed && sniff(input, diag) != 0)
        return -1;
    long got = input->unpacker != NULL ? read_packed(input, bytes, size, diag)
                                       : read_plain(input, bytes, size, diag);
    size_t room = HEAD_SIZE - input->head_length;
    if (got > 0 && room > 0) {
        size_t kept = (size_t)got < room ? (size_t)got : room;
        memcpy(input->head + input->head_length, bytes, kept);
        input->head_length += kept;
    }
    return got;
}

const char *input_head(const struct input *input, size_t *length)
{
    *length = input->head_length;
    return input->head;
}

int input_line(struct input *input, size_t limit, const char **line, size_t *length,
               struct diag *diag)
{
    struct text *held = &input->line;
    size_t searched = input->line_at;
    for (;;) {
        const char *newline = held->length > searched
                                  ? memchr(held->bytes + searched, '\n', held->length - searched)
                                  : NULL;
        size_t begin = input->line_at;
        size_t end = newline != NULL ? (size_t)(newline - held->bytes) : held->length;
        if (end - begin > limit)
            return diag_fail(diag, DIAG_DATA, "a line of more than %zu bytes", limit);
        if (newline == NULL) {
            if (begin > 0)
                memmove(held->bytes, held->bytes + begin, held->length - begin);
            held->length -= begin;
            input->line_at = 0;
            searched = held->length;
            long got = input_read(input, text_room(held, LINE_STEP), LINE_STEP, diag);
            if (got < 0)
                return -1;
            held->length += (size_t)got;
            if (got > 0)
                continue;
            if (held->length == 0)
                return 0;
            begin = 0;
            end = held->length;
            held->bytes[end] = '\0'; /* fits: the last read had asked for more bytes and got none */
        }
        *line = held->bytes + begin;
        *length = end - begin;
        input->line_at = newline != NULL ? end + 1 : end;
        return 1;
    }
}

int input_all(struct input *input, size_t limit, struct text *text, struct diag *diag)
{
    for (;;) {
        if (text->length > limit)
            return diag_fail(diag, DIAG_DATA, "more than %zu bytes; expected no more", limit);
        long got = input_read(input, text_room(text, LINE_STEP), LINE_STEP, diag);
        if (got <= 0)
            return (int)got;
        text->length += (size_t)got;
    }
}
