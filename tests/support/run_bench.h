/* Stages of the build with a runner of their own, and frames of random traffic, for the tests of
 * lib/run. */
#pragma once

#include "check.h"
#include "run/frame_sample.h"
#include "run/runner.h"
#include "run/stage.h"

/* A stage that is prepared with the words of its command line, NULL after the last, and started. */
static inline void begin_stage(struct runner *runner, const char *name, const char *const *words)
{
    size_t count = 0;
    while (words[count] != NULL)
        count++;
    if (runner_prepare(runner, stage_by_name(name), count, words) != 0 || runner_start(runner) != 0)
        fail_msg("%s: %s", name, runner->diag.text);
}

#define WORDS(...) ((const char *[]){__VA_ARGS__, NULL})
#define NO_WORDS ((const char *[]){NULL})

/* A tool that tries stages. */
static inline void begin_tool(struct runner *runner, const char *suite)
{
    assert_int_equal(
        runner_prepare(runner, stage_by_name("plan"), 2, (const char *[]){"--sensors", suite}), 0);
}

/* So many snapshots of dense traffic. The sample's arena is the caller's. */
static inline struct frame_sample sample_of_traffic(const char *frames, struct arena *arena)
{
    struct frame_sample sample = {.arena = arena, .most = 1000};
    struct arena scratch = {0};
    struct frame frame = {.arena = &scratch};
    struct runner source;
    struct diag diag = {0};
    begin_stage(&source, "traffic-random", WORDS("--density", "dense", "--frames", frames));
    while (runner_next(&source, &frame) == 1)
        assert_int_equal(frame_sample_add(&sample, &frame, &diag), 0);
    runner_free(&source);
    arena_free(&scratch);
    return sample;
}
