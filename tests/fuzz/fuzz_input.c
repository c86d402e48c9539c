/* Bytes of a file, plain or gzip: line by line, in pieces and at once they are the same, or
 * refused. */
#include <string.h>

#include "fuzz/fuzz.h"
#include "text/input.h"

enum { LIMIT = 1 << 22 };

/* All bytes of the file by their lines; false if the file was refused. */
static bool read_lines(const char *path, struct text *text)
{
    struct diag diag = {0};
    struct input *input = input_open(path, &diag);
    const char *line;
    size_t length;
    int more = input == NULL ? -1 : 1;
    while (more == 1 && (more = input_line(input, LIMIT, &line, &length, &diag)) == 1) {
        text_add(text, line, length);
        text_add_word(text, "\n");
    }
    input_close(input);
    return more == 0;
}

static bool read_pieces(const char *path, size_t size, struct text *text)
{
    struct diag diag = {0};
    struct input *input = input_open(path, &diag);
    char piece[64];
    long count = input == NULL ? -1 : 1;
    while (count > 0 && text->length <= LIMIT &&
           (count = input_read(input, piece, 1 + size % sizeof piece, &diag)) > 0)
        text_add(text, piece, (size_t)count);
    input_close(input);
    return count == 0;
}

static bool read_all(const char *path, struct text *text)
{
    struct diag diag = {0};
    struct input *input = input_open(path, &diag);
    int result = input == NULL ? -1 : input_all(input, LIMIT, text, &diag);
    input_close(input);
    return result == 0;
}

static bool same(const struct text *a, const struct text *b)
{
    return a->length == b->length && (a->length == 0 || memcmp(a->bytes, b->bytes, a->length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    struct text lines = {0}, pieces = {0}, all = {0};
    fuzz_open(&file, bytes, size);
    bool good = read_all(file.path, &all);
    if (all.length < LIMIT / 2) {
        fuzz_must(read_pieces(file.path, size, &pieces) == good, "pieces are judged otherwise");
        fuzz_must(read_lines(file.path, &lines) == good, "lines are judged otherwise");
    }
    if (good && all.length < LIMIT / 2) {
        if (lines.length == all.length + 1)
            lines.length--; /* the last line lacked its newline */
        fuzz_must(same(&all, &pieces) && same(&all, &lines), "bytes differ by how they are read");
    }
    text_free(&lines);
    text_free(&pieces);
    text_free(&all);
    fuzz_close(&file);
    return 0;
}
