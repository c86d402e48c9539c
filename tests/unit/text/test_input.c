/* For F_SETPIPE_SZ. */
#define _GNU_SOURCE
#include "scratch.h"

#include <fcntl.h>
#include <sys/wait.h>

#include <zlib.h>

#include "sample.h"
#include "text/input.h"
#include "text/packing.h"

static struct input *open_bytes(const struct scratch *scratch, const char *bytes, size_t length)
{
    FILE *file = fopen(scratch->path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    struct diag diag = {0};
    struct input *input = input_open(scratch->path, &diag);
    assert_non_null(input);
    return input;
}

/* Reads a file of these bytes: 0 and its text, or -1. */
static int read_bytes(const struct scratch *scratch, const char *bytes, size_t length,
                      struct text *text, struct diag *diag)
{
    struct input *input = open_bytes(scratch, bytes, length);
    *diag = (struct diag){0};
    int result = input_all(input, SIZE_MAX, text, diag);
    input_close(input);
    return result;
}

/* Appends one gzip member. Its header is the 10 bytes without a name. */
static void add_member(const char *bytes, size_t length, struct text *text)
{
    z_stream stream = {0};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY),
                     Z_OK);
    size_t bound = deflateBound(&stream, length);
    stream.next_in = (unsigned char *)(uintptr_t)bytes;
    stream.avail_in = (unsigned)length;
    stream.next_out = (unsigned char *)text_room(text, bound);
    stream.avail_out = (unsigned)bound;
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    text->length += stream.total_out;
    deflateEnd(&stream);
}

static struct text *repeatable_bytes(size_t length, uint64_t seed)
{
    struct text *text = check_text();
    for (size_t i = 0; i < length; i++)
        text_add(text, &"0123456789,\n{}ab"[sample_bits(&seed) % 16], 1);
    return text;
}

FIXTURE(make_scratch, remove_scratch);

TEST_OF(scratch, plain_and_gzip_and_several_members_read_the_same)
{
    static const size_t lengths[] = {0, 1, 2, 3, 65535, 65536, 65537, 131072, 300000};
    for (size_t i = 0; i < COUNT(lengths); i++) {
        struct text *bytes = repeatable_bytes(lengths[i], i), *packed = check_text(),
                    *members = check_text();
        const char *start = bytes->bytes != NULL ? bytes->bytes : "";
        add_member(start, bytes->length, packed);
        for (size_t part = 0; part < 5; part++)
            add_member(start + bytes->length * part / 5,
                       bytes->length * (part + 1) / 5 - bytes->length * part / 5, members);
        const struct text forms[] = {
            {(char *)(uintptr_t)start, bytes->length, 0}, *packed, *members};
        for (size_t form = 0; form < COUNT(forms); form++) {
            struct text *text = check_text();
            struct diag diag;
            if (read_bytes(scratch, forms[form].bytes, forms[form].length, text, &diag) != 0)
                fail_msg("%zu bytes, form %zu: %s", lengths[i], form, diag.text);
            assert_int_equal(text->length, bytes->length);
            if (text->length > 0)
                assert_memory_equal(text->bytes, bytes->bytes, text->length);
        }
    }
}

TEST_OF(scratch, gzip_that_expands_a_thousandfold_is_read_whole)
{
    enum { LENGTH = 5000000 };
    char *zeros = calloc(1, LENGTH);
    struct text *packed = check_text(), *text = check_text();
    add_member(zeros, LENGTH, packed);
    assert_true(packed->length < LENGTH / 900);
    assert_done(read_bytes, scratch, packed->bytes, packed->length, text);
    assert_int_equal(text->length, LENGTH);
    assert_memory_equal(text->bytes, zeros, LENGTH);
    free(zeros);
}

TEST_OF(scratch, gzip_cut_anywhere_is_refused)
{
    struct text *bytes = repeatable_bytes(1500, 1), *packed = check_text();
    add_member(bytes->bytes, bytes->length, packed);
    size_t first = packed->length;
    add_member(bytes->bytes, bytes->length, packed);
    for (size_t length = 2; length < packed->length; length++) {
        struct text *text = check_text();
        struct diag diag;
        int result = read_bytes(scratch, packed->bytes, length, text, &diag);
        /* Cut between the members it is a complete file. */
        assert_int_equal(result, length == first ? 0 : -1);
        if (length != first) {
            assert_string_equal(diag.text, "the gzip data ends early");
            assert_int_equal(diag.code, DIAG_DATA);
        }
    }
}

TEST_OF(scratch, a_flipped_bit_in_gzip_is_refused_or_changes_nothing)
{
    struct text *bytes = repeatable_bytes(400, 2), *packed = check_text();
    add_member(bytes->bytes, bytes->length, packed);
    for (size_t i = 0; i < 8 * packed->length; i++) {
        /* gzip does not protect the time, the extra flags and the system in its header, nor the
         * flag that says the content is text. */
        bool unprotected = (i / 8 >= 4 && i / 8 < 10) || i == 8 * 3;
        struct text *text = check_text();
        struct diag diag;
        packed->bytes[i / 8] = (char)(packed->bytes[i / 8] ^ 1 << i % 8);
        int result = read_bytes(scratch, packed->bytes, packed->length, text, &diag);
        packed->bytes[i / 8] = (char)(packed->bytes[i / 8] ^ 1 << i % 8);
        if (i / 8 < 2) {
            /* Not gzip any more by its first bytes, so plain text, and not JSON. */
            assert_int_equal(result, 0);
            assert_int_equal(text->length, packed->length);
        } else {
            if (result != (unprotected ? 0 : -1))
                fail_msg("bit %zu of byte %zu: %d", i % 8, i / 8, result);
            if (unprotected)
                assert_memory_equal(text->bytes, bytes->bytes, bytes->length);
            else
                assert_int_equal(diag.code, DIAG_DATA);
        }
    }
}

/* Two frames of these bytes. */
static void two_frames(const struct text *bytes, struct text *packed, size_t *first)
{
    struct diag diag = {0};
    if (packing_check(PACKING_ZSTD, &diag) != 0)
        skip_because(diag.text);
    for (int i = 0; i < 2; i++) {
        struct packer *packer = packing_pack_begin(PACKING_ZSTD);
        packing_pack_add(packer, bytes->bytes, bytes->length, false, packed);
        packing_pack_add(packer, NULL, 0, true, packed);
        packing_pack_end(packer);
        *first = i == 0 ? packed->length : *first;
    }
}

TEST_OF(scratch, frames_of_zstd_are_read_whole_and_cut_anywhere_they_are_refused)
{
    struct text *bytes = repeatable_bytes(200000, 3), *packed = check_text();
    size_t first;
    two_frames(bytes, packed, &first);
    for (size_t length = 4; length <= packed->length; length += length < 20 ? 1 : 997) {
        struct text *text = check_text();
        struct diag diag;
        int result = read_bytes(scratch, packed->bytes, length, text, &diag);
        assert_int_equal(result, length == first || length == packed->length ? 0 : -1);
        assert_string_equal(diag.text, result == 0 ? "" : "the zstd data ends early");
    }
    struct text *whole = check_text();
    assert_done(read_bytes, scratch, packed->bytes, packed->length, whole);
    assert_int_equal(whole->length, 2 * bytes->length);
    assert_memory_equal(whole->bytes + bytes->length, bytes->bytes, bytes->length);
}

TEST_OF(scratch, a_flipped_bit_in_zstd_is_refused_or_changes_nothing)
{
    struct text *bytes = repeatable_bytes(300, 4), *packed = check_text();
    size_t first;
    two_frames(bytes, packed, &first);
    for (size_t i = 8 * 4; i < 8 * packed->length; i++) {
        struct text *text = check_text();
        struct diag diag;
        packed->bytes[i / 8] = (char)(packed->bytes[i / 8] ^ 1 << i % 8);
        int result = read_bytes(scratch, packed->bytes, packed->length, text, &diag);
        packed->bytes[i / 8] = (char)(packed->bytes[i / 8] ^ 1 << i % 8);
        if (result != 0)
            continue;
        /* zstd does not protect the size of its window, nor a bit that means nothing. */
        assert_int_equal(text->length, 2 * bytes->length);
        assert_memory_equal(text->bytes, bytes->bytes, bytes->length);
        assert_memory_equal(text->bytes + bytes->length, bytes->bytes, bytes->length);
    }
}

TEST_OF(scratch, anything_after_the_last_member_is_refused)
{
    static const struct {
        const char *bytes;
        size_t length;
    } tails[] = {{"x", 1},    {"\n", 1},       {"{}\n", 3},        {"\0", 1},
                 {"\x1f", 1}, {"\x1f\x8b", 2}, {"\x1f\x8b\x08", 3}};
    for (size_t i = 0; i < COUNT(tails); i++) {
        struct text *packed = check_text();
        struct diag diag;
        add_member("abc\n", 4, packed);
        text_add(packed, tails[i].bytes, tails[i].length);
        assert_int_equal(read_bytes(scratch, packed->bytes, packed->length, check_text(), &diag),
                         -1);
        assert_int_equal(diag.code, DIAG_DATA);
    }
}

static void assert_lines(struct input *input, const char *const *lines, size_t count)
{
    struct diag diag = {0};
    const char *line;
    size_t length;
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(input_line(input, 100, &line, &length, &diag), 1);
        assert_int_equal(length, strlen(lines[i]));
        assert_memory_equal(line, lines[i], length);
    }
    for (int i = 0; i < 3; i++)
        assert_done(input_line, input, 100, &line, &length);
    input_close(input);
}

TEST_OF(scratch, lines_end_at_newlines_and_at_the_end)
{
    static const char *const lines[] = {"a", "", "bc\r", "", "d"};
    assert_lines(open_bytes(scratch, "a\n\nbc\r\n\nd\n", 10), lines, 5);
    assert_lines(open_bytes(scratch, "a\n\nbc\r\n\nd", 9), lines, 5);
    assert_lines(open_bytes(scratch, "a\n\nbc\r\n\n", 8), lines, 4);
    assert_lines(open_bytes(scratch, "\n", 1), lines + 1, 1);
    assert_lines(open_bytes(scratch, "", 0), lines, 0);
}

TEST_OF(scratch, lines_across_buffer_borders_are_whole)
{
    struct text *bytes = check_text(), *packed = check_text();
    uint64_t random = 4;
    static const size_t long_lines[] = {65534, 65535, 65536, 65537, 131071, 131072, 200000, 0, 1};
    size_t count = 0;
    for (; bytes->length < 1500000; count++) {
        size_t length = count < COUNT(long_lines) ? long_lines[count] : sample_bits(&random) % 300;
        for (size_t i = 0; i < length; i++)
            text_add(bytes, &"abcdefghij"[(count + i) % 10], 1);
        text_add(bytes, "\n", 1);
    }
    add_member(bytes->bytes, bytes->length, packed);
    const struct text forms[] = {*bytes, *packed};
    for (size_t form = 0; form < 2; form++) {
        struct input *input = open_bytes(scratch, forms[form].bytes, forms[form].length);
        const char *at = bytes->bytes, *line;
        size_t length, lines = 0;
        struct diag diag = {0};
        for (; input_line(input, 200000, &line, &length, &diag) == 1; lines++, at += length + 1) {
            assert_int_equal(length, strcspn(at, "\n"));
            assert_memory_equal(line, at, length);
        }
        assert_int_equal(diag.code, DIAG_OK);
        assert_int_equal(lines, count);
        input_close(input);
    }
}

TEST_OF(scratch, a_line_may_be_as_long_as_the_limit)
{
    static const size_t limits[] = {1, 10, 65535, 65536, 65537, 200000};
    for (size_t i = 0; i < COUNT(limits); i++)
        for (size_t extra = 0; extra < 2; extra++)
            for (size_t newline = 0; newline < 2; newline++) {
                size_t full = limits[i] + extra;
                char *bytes = malloc(full + 1);
                memset(bytes, 'x', full);
                bytes[full] = '\n';
                struct input *input = open_bytes(scratch, bytes, full + newline);
                const char *line;
                size_t length;
                struct diag diag = {0};
                assert_int_equal(input_line(input, limits[i], &line, &length, &diag),
                                 extra == 0 ? 1 : -1);
                assert_int_equal(diag.code, extra == 0 ? DIAG_OK : DIAG_DATA);
                if (extra == 0)
                    assert_int_equal(length, full);
                input_close(input);
                free(bytes);
            }
}

TEST_OF(scratch, the_message_says_why_a_file_cannot_be_read)
{
    struct diag diag = {0};
    assert_null(input_open("/nonexistent/file", &diag));
    assert_string_equal(diag.text, "No such file or directory");
    assert_int_equal(diag.code, DIAG_NO_INPUT);
    diag = (struct diag){0};
    struct input *input = input_open(scratch->directory, &diag);
    assert_non_null(input);
    assert_string_equal(input_name(input), scratch->directory);
    struct text *text = check_text();
    assert_refused(DIAG_NO_INPUT, "Is a directory", input_all, input, SIZE_MAX, text);
    input_close(input);
}

/* A pipe gives what it has; the least is one byte at a time. */
static void check_slow_pipe(int flags)
{
    struct text *packed = check_text(), *text = check_text();
    struct diag diag = {0};
    add_member("one\ntwo\n", 8, packed);
    int ends[2], standard = dup(STDIN_FILENO);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(fcntl(ends[0], F_SETFL, flags), 0);
    pid_t child = fork();
    if (child == 0) {
        for (size_t i = 0; i < packed->length; i++) {
            if (write(ends[1], packed->bytes + i, 1) != 1)
                _exit(1);
            for (volatile int wait = 0; wait < 20000; wait++)
                continue;
        }
        _exit(0);
    }
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    struct input *input = input_open("-", &diag);
    assert_string_equal(input_name(input), "stdin");
    assert_done(input_all, input, SIZE_MAX, text);
    assert_int_equal(text->length, 8);
    assert_memory_equal(text->bytes, "one\ntwo\n", 8);
    input_close(input);
    assert_int_equal(waitpid(child, NULL, 0), child);
    dup2(standard, STDIN_FILENO);
    close(standard);
}

TEST(a_pipe_that_gives_one_byte_at_a_time_is_read_whole)
{
    check_slow_pipe(0);
    check_slow_pipe(O_NONBLOCK);
}

/* Whoever writes the next line when its reader would wait for it, and not before. */
struct answering_writer {
    int fd;
    size_t lines; /* written so far */
    bool packed;
    z_stream stream; /* of all lines, made whole after each, as a live sender makes them */
};

/* The lengths of lines, newlines included; 0: the end. They fill room for 64 KiB exactly, and not.
 */
static const size_t answers[] = {8, 65536, 65537, 131072, 3, 400000, 0};

static void answer(void *with)
{
    struct answering_writer *writer = with;
    unsigned char packed[4096];
    assert_true(writer->lines < COUNT(answers));
    size_t length = answers[writer->lines++];
    struct text *line = check_text();
    memset(text_room(line, length + 1), 'a', length + 1);
    line->bytes[length > 0 ? length - 1 : 0] = '\n';
    writer->stream.next_in = (unsigned char *)line->bytes;
    writer->stream.avail_in = (unsigned)length;
    writer->stream.next_out = packed;
    writer->stream.avail_out = sizeof packed;
    int flush = length > 0 ? Z_SYNC_FLUSH : Z_FINISH;
    assert_true(!writer->packed || deflate(&writer->stream, flush) >= Z_OK);
    const void *bytes = writer->packed ? (const void *)packed : line->bytes;
    size_t count = writer->packed ? sizeof packed - writer->stream.avail_out : length;
    assert_int_equal(write(writer->fd, bytes, count), (ssize_t)count);
    if (length == 0)
        assert_int_equal(close(writer->fd), 0);
}

/* A wait that came too early, with a whole line there to be read, would make the writer write
 * again. */
static void check_answers(bool packed)
{
    int ends[2];
    struct diag diag = {0};
    assert_int_equal(pipe(ends), 0);
    assert_true(fcntl(ends[1], F_SETPIPE_SZ, 1 << 20) >= 1 << 20);
    struct answering_writer writer = {.fd = ends[1], .packed = packed};
    assert_int_equal(deflateInit2(&writer.stream, 1, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_FIXED), Z_OK);
    int standard = dup(STDIN_FILENO);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    struct input *input = input_open("-", &diag);
    input_before_waiting(input, (struct input_pause){answer, &writer});
    const char *line;
    size_t length, at = 0;
    for (; input_line(input, SIZE_MAX, &line, &length, &diag) > 0; at++) {
        assert_int_equal(length, answers[at] - 1);
        assert_int_equal(writer.lines, at + 1);
    }
    assert_int_equal(diag.code, DIAG_OK);
    assert_int_equal(at, COUNT(answers) - 1);
    input_close(input);
    deflateEnd(&writer.stream);
    dup2(standard, STDIN_FILENO);
    close(standard);
}

TEST(a_read_pauses_before_it_waits_and_only_then)
{
    check_answers(false);
    check_answers(true);
}

/* The bytes that end a frame of zstd, written when its reader would wait for them. */
struct late_end {
    int fd;
    const char *bytes;
};

enum { LATE = 4 };

static void write_end(void *with)
{
    struct late_end *late = with;
    assert_int_equal(write(late->fd, late->bytes, LATE), LATE);
    assert_int_equal(close(late->fd), 0);
    late->bytes = NULL;
}

TEST(bytes_of_zstd_are_given_out_before_the_end_of_their_frame)
{
    enum { LENGTH = 100000, ROOM = 65536 };
    struct text *bytes = check_text(), *packed = check_text(), *text = check_text();
    struct diag diag = {0};
    size_t first;
    int ends[2];
    char name[32];
    memset(text_room(bytes, LENGTH), 'a', LENGTH);
    bytes->length = LENGTH;
    two_frames(bytes, packed, &first);
    assert_int_equal(pipe(ends), 0);
    struct late_end late = {ends[1], packed->bytes + first - LATE};
    assert_int_equal(write(ends[1], packed->bytes, first - LATE), (ssize_t)(first - LATE));
    snprintf(name, sizeof name, "/dev/fd/%d", ends[0]);
    struct input *input = input_open(name, &diag);
    close(ends[0]);
    input_before_waiting(input, (struct input_pause){write_end, &late});
    while (text->length < LENGTH && diag.code == DIAG_OK)
        text->length += (size_t)input_read(input, text_room(text, ROOM), ROOM, &diag);
    assert_int_equal(text->length, LENGTH);
    assert_non_null(late.bytes);
    assert_done(input_all, input, SIZE_MAX, text);
    assert_null(late.bytes);
    input_close(input);
}

static void count_pause(void *with)
{
    ++*(size_t *)with;
}

TEST_OF(scratch, a_file_is_read_without_a_pause)
{
    struct text *bytes = repeatable_bytes(300000, 1), *text = check_text();
    size_t pauses = 0;
    struct input *input = open_bytes(scratch, bytes->bytes, bytes->length);
    input_before_waiting(input, (struct input_pause){count_pause, &pauses});
    assert_done(input_all, input, SIZE_MAX, text);
    assert_int_equal(text->length, bytes->length);
    assert_int_equal(pauses, 0);
    input_close(input);
}
