/* A plan: which stages and which effects some frames call for, as glint-plan prints it.
 *
 * The plan knows the chain by its positions: the stage that models each, the effects that are at
 * home there, and the simpler stage that may stand in for it. An effect is needed if it was
 * simulated in any scan; a stage is needed unless its stand-in, given the same frames, wrote the
 * same bytes. */
#ifndef PLAN_H
#define PLAN_H

#include "base/text.h"
#include "frame/frame.h"

struct plan_position {
    const char *stage;     /* "sensor" */
    const char *stand_in;  /* "sensor-perfect"; NULL: nothing can stand in for this one */
    unsigned section;      /* enum section: what both write */
    struct effect_log log; /* of the stage */
    bool differs;          /* the stand-in wrote other bytes, first in this frame: */
    const char *scene;
    int64_t frame;
};

enum { PLAN_IDEAL, PLAN_SENSOR, PLAN_NOISE, PLAN_POSITIONS };

struct plan {
    const char *sensors; /* the suite, as it is to be given to glint-ideal */
    uint64_t allowed;    /* effects that were asked for */
    int64_t frames;
    struct plan_position positions[PLAN_POSITIONS];
};

/* The request that decides as auto does among the effects that are allowed: "auto,-rows". */
const char *plan_request(uint64_t allowed, struct arena *arena);

/* Compares what the stage made of a frame with what its stand-in made of the same one. The first
 * difference is kept: later calls need not be made. */
void plan_compare(struct plan_position *position, const struct frame *made,
                  const struct frame *stand_in_made, struct arena *arena);

/* Has a stand-in written the same bytes, so that it may take the stage's place? */
bool plan_stands_in(const struct plan_position *position);

/* The effects to ask for: simulated somewhere, at home in a stage that stays. */
uint64_t plan_effects(const struct plan *plan);

/* Comment lines, one for each effect and each stage, and the pipeline in words of bash and of
 * `glint FILE`. It reads frames of any source. Nothing if there were no frames. */
void plan_write(const struct plan *plan, struct text *text);

#endif
