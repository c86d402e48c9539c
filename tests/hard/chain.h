/* The stages from random traffic to targets, one by one in this process, and a frame for them to
 * work on. */
#pragma once

#include "hard.h"
#include "support/run_bench.h"

#include "frame/frame_text.h"

enum { CHAIN_STAGES = 5 };

struct hard_chain {
    struct runner runners[CHAIN_STAGES];
    struct arena arena;
    struct frame frame;
};

/* The frames of adversarial scenes, which have ties, from first to first + frames - 1. */
static inline void hard_chain_start(struct hard_chain *chain, int first, int frames)
{
    static const char suite[] = "srr24-pair-every-frame";
    char first_word[32], frames_word[32];
    snprintf(first_word, sizeof first_word, "%d", first);
    snprintf(frames_word, sizeof frames_word, "%d", frames);
    *chain = (struct hard_chain){.frame = {.arena = NULL}};
    chain->frame.arena = &chain->arena;
    begin_stage(&chain->runners[0], "traffic-adversarial",
                WORDS("--sensors", suite, "--first", first_word, "--frames", frames_word));
    begin_stage(&chain->runners[1], "extract", NO_WORDS);
    begin_stage(&chain->runners[2], "ideal", WORDS("--sensors", suite));
    begin_stage(&chain->runners[3], "sensor", NO_WORDS);
    begin_stage(&chain->runners[4], "noise", NO_WORDS);
}

static inline void hard_chain_stop(struct hard_chain *chain)
{
    for (size_t i = 0; i < CHAIN_STAGES; i++)
        runner_free(&chain->runners[i]);
    arena_free(&chain->arena);
}

static inline void hard_chain_next(struct hard_chain *chain)
{
    if (runner_next(&chain->runners[0], &chain->frame) != 1)
        fail_msg("%s", chain->runners[0].diag.text);
}

/* Passes the frame through the stages from the first given to the last. */
static inline void hard_chain_step(struct hard_chain *chain, size_t from, size_t to)
{
    for (size_t i = from; i <= to; i++)
        if (runner_step(&chain->runners[i], &chain->frame) != 0)
            fail_msg("%s", chain->runners[i].diag.text);
}

/* Appends the frame's line to a text. */
static inline void hard_chain_write(const struct hard_chain *chain, struct text *text)
{
    assert_done(frame_text_write, &chain->frame, text);
}
