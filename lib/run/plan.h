/* Stages and effects that a stream of frames needs. glint-plan prints them with their reasons, and
 * the pipeline without the others.
 *
 * The chain has positions: a stage that models each, and for some a simpler stage that may stand in
 * for it. An effect is needed if it was simulated in any scan. A stage is needed unless its
 * stand-in, given the same frames, wrote the same bytes. */
#pragma once

#include "base/text.h"
#include "run/suite_choice.h"

struct plan_position {
    const char *program;            /* "glint-sensor" */
    const char *stand_in;           /* "glint-sensor-perfect"; NULL: nothing can stand in for it */
    unsigned section;               /* enum section: the one that both write */
    struct effect_log log;          /* which effects the stage simulated */
    bool differs;                   /* the stand-in wrote other bytes in some frame */
    const char *scene;              /* of the first such frame */
    int64_t frame;                  /* its number */
    struct runner *tried, *simpler; /* the stage and its stand-in */
};

enum { PLAN_IDEAL, PLAN_SENSOR, PLAN_NOISE, PLAN_POSITIONS };

struct plan {
    const char *sensors; /* the suite's name or path, for glint-ideal */
    const char *request; /* the effects that were asked for; "auto" if all may be simulated */
    uint64_t allowed;    /* their EFFECT_BITs */
    int64_t frames;      /* how many were tried */
    struct plan_position positions[PLAN_POSITIONS];
    struct runner *runner, *extract; /* the tool, and the stage before the first position */
};

/* The --effects that decide as auto does among those that are allowed: "auto,-rows". */
const char *plan_request(uint64_t allowed, struct arena *arena);

/* Prepares the stages of the chain, and their stand-ins, for a suite and among the effects that are
 * asked for. 0, or -1 after a message. */
int plan_begin(struct plan *plan, const struct suite_choice *choice, struct runner *runner);

/* Tries the stages on a frame, of which only the objects and, if they are there, the reflectors are
 * used. 0, or -1 after a message. */
int plan_try(struct plan *plan, struct frame *frame);

/* Compares the frame that the stage wrote with the one that its stand-in wrote from the same input,
 * and notes the first that differ. */
void plan_compare(struct plan_position *position, const struct frame *made,
                  const struct frame *stand_in_made, struct arena *arena);

/* EFFECT_BITs of the effects that the pipeline must ask for: those that a stage simulated which is
 * needed. */
uint64_t plan_effects(const struct plan *plan);

/* The effects by their names, as --effects takes them; the text lies in the arena. */
const char *plan_names(uint64_t effects, struct arena *arena);

/* Writes a script for bash and for glint: a comment line for each effect that is on, the number of
 * the others or, with all, a line for each of them too, a line for each stage, and the pipeline,
 * which reads frames of any source. Writes nothing if there were no frames. */
void plan_write(const struct plan *plan, bool all, struct arena *arena, struct text *text);

/* Writes the pipeline alone: extract, ideal with these effects, and the other programs, which get
 * a suite that is a path as well. */
void plan_write_pipeline(const char *sensors, const char *effects, const char *const *programs,
                         size_t count, struct text *text);
