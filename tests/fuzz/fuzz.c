#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for memfd_create, which is Linux's */
#include "fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "frame/frame_text.h"
#include "run/frame_stream.h"
#include "run/stage.h"

void fuzz_must(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

void fuzz_judge(const struct diag *diag)
{
    fuzz_must(diag->code != DIAG_INTERNAL, diag->text);
}

void fuzz_open(struct fuzz_file *file, const void *bytes, size_t size)
{
    file->descriptor = memfd_create("fuzz", 0);
    fuzz_must(file->descriptor >= 0 && write(file->descriptor, bytes, size) == (ssize_t)size,
              "no file in memory");
    snprintf(file->path, sizeof file->path, "/proc/self/fd/%d", file->descriptor);
}

void fuzz_close(struct fuzz_file *file)
{
    close(file->descriptor);
}

static const struct stage *stage_of(const char *name)
{
    size_t i = 0;
    while (strcmp(stages[i]->name, name) != 0)
        i++;
    return stages[i];
}

int fuzz_begin(struct runner *runner, const char *stage, size_t count, const char *const *words)
{
    bool good = runner_prepare(runner, stage_of(stage), count, words) == 0;
    good = good && runner_start(runner) == 0;
    fuzz_judge(&runner->diag);
    return good ? 0 : -1;
}

void fuzz_scene(struct frame *frame, int number, const char *class)
{
    static const char still[] = "\"vx_mps\":0,\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":0,"
                                "\"width_m\":0,\"height_m\":0,\"travelled_m\":0";
    struct text line = {0};
    struct diag diag = {0};
    text_format(&line,
                "{\"version\":1,\"scene\":\"s\",\"frame\":%d,\"time_s\":%d,\"interval_s\":1,"
                "\"seed\":\"1\",\"ego\":\"ego\",\"objects\":["
                "{\"id\":\"ego\",\"class\":\"car\",\"x_m\":0,\"y_m\":0,\"yaw_rad\":0,%s},"
                "{\"id\":\"other\",\"class\":\"%s\",\"x_m\":12,\"y_m\":1,\"yaw_rad\":0.3,%s}]}",
                number, number, still, class, still);
    fuzz_must(frame_stream_parse(line.bytes, line.length, frame, &diag) == 0, diag.text);
    text_free(&line);
}

static bool step(struct runner *runner, const char *stage, struct frame *frame, size_t count,
                 const char *const *words)
{
    bool good = fuzz_begin(runner, stage, count, words) == 0 && runner_step(runner, frame) == 0;
    fuzz_judge(&runner->diag);
    return good;
}

void fuzz_chain(struct frame *frame, const char *suite)
{
    static const char *const extracts[] = {"extract", "extract-3gpp", "extract-contour"};
    const char *steps[] = {extracts[frame->frame % 3], "ideal", "sensor", "noise"};
    const char *const words[] = {"--sensors", suite, "--sections", "account,margins"};
    static const size_t word_counts[] = {0, 4, 2, 2};
    enum { STEPS = sizeof steps / sizeof steps[0] };
    struct runner runners[STEPS];
    size_t first = (frame->present & PART_REFLECTORS) != 0, after = first;
    bool good = true;
    for (; good && after < STEPS; after++)
        good = step(&runners[after], steps[after], frame, word_counts[after], words);
    if (good)
        fuzz_round_trip(frame);
    while (after > first)
        runner_free(&runners[--after]); /* the frame has names that belong to them */
}

void fuzz_play(const char *stage, const char *const *words)
{
    enum { FRAMES = 50 };
    struct runner runner;
    struct arena arena = {0};
    size_t count = 0;
    while (words[count] != NULL)
        count++;
    bool good = fuzz_begin(&runner, stage, count, words) == 0;
    for (int i = 0; good && i < FRAMES; i++) {
        struct frame frame = {.arena = &arena};
        arena_clear(&arena);
        good = runner_next(&runner, &frame) == 1;
        if (good)
            fuzz_round_trip(&frame);
        if (good && i < 3)
            fuzz_chain(&frame, "corner77-every-frame");
    }
    fuzz_judge(&runner.diag);
    runner_free(&runner);
    arena_free(&arena);
}

static void write_again(const struct text *line, struct text *again)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    struct diag diag = {0};
    fuzz_must(frame_stream_parse(line->bytes, line->length - 1, &frame, &diag) == 0, diag.text);
    fuzz_must(frame_text_write(&frame, again, &diag) == 0, diag.text);
    arena_free(&arena);
}

static void check_again(const struct frame *frame, const struct text *plain, const char *fault)
{
    struct text line = {0}, again = {0};
    struct diag diag = {0};
    fuzz_must(frame_text_write(frame, &line, &diag) == 0, diag.text);
    write_again(&line, &again);
    fuzz_must(plain->length == again.length && memcmp(plain->bytes, again.bytes, again.length) == 0,
              fault);
    text_free(&line);
    text_free(&again);
}

/* Without the line that it was read from, a frame is written in glint's own spelling. */
void fuzz_round_trip(const struct frame *frame)
{
    struct frame plain = *frame;
    plain.line = (struct field_line){0};
    struct text once = {0};
    struct diag diag = {0};
    if (frame_text_write(&plain, &once, &diag) == 0) {
        check_again(&plain, &once, "a frame that was written reads back as another");
        check_again(frame, &once, "what passes word for word has other values");
    }
    text_free(&once);
}
