/* The pipeline that frames need: what changes no list leaves. glint-plan prints it.
 *
 * Effects that alone change no list are idle, and so is a stage if a simpler one gives the same
 * lists. The pipeline without all of them runs over all frames, as effects may stand in for each
 * other. While a list differs, they are put back one by one. Beside it runs the chain with all
 * effects in all scans, which shows what the choice of "auto" saves. */
#pragma once

#include "run/cost_table.h"

enum { PLAN_TIMED_FRAMES = 32, PLAN_STAGES = 2 }; /* sensor and noise, which others may replace */

struct plan {
    struct runner *runner; /* of the tool */
    struct trial_bench bench;
    struct frame_sample sample;             /* all frames */
    struct effect_log log[TRIAL_POSITIONS]; /* of the whole chain, once over all frames */
    struct trial stand_ins[PLAN_STAGES];
    struct trial everywhere;    /* all effects in all scans; effects are NULL without "auto" */
    bool replaced[PLAN_STAGES]; /* in the pipeline */
    uint64_t idle, left_out;    /* EFFECT_BITs: alone, and all together in the pipeline */
    struct trial pipeline;
    struct cost_table table;
};

/* Prepares the chain for a suite and among the effects that are asked for. 0, or -1 after a
 * message. */
int plan_begin(struct plan *plan, const struct trial_options *options, struct runner *runner);

/* Tries all effects and stand-ins on a frame, of which only the objects and, if they are there, the
 * reflectors are used. The frame is kept. */
int plan_try(struct plan *plan, const struct frame *frame);

/* After the last frame: proves the pipeline, and measures times. */
int plan_end(struct plan *plan);

/* Writes a script for bash and for glint: the table as comments, with all also the documents'
 * reason for each effect, and the pipeline, which reads frames of any source; nothing without
 * frames. */
void plan_write(const struct plan *plan, bool all, struct text *text);

void plan_free(struct plan *plan);
