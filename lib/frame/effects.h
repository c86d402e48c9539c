/* Effects: the parts of the physics that can be on or off, and who decides.
 *
 * Every effect has a home, the stage that simulates it, and a cause, the member of a document that
 * describes it: a document that names no cause does not have the effect. Which ones may be
 * simulated is the suite's `effects`, or the option --effects of glint-ideal:
 *
 *     auto                 (default) leave out what provably changes no bit of targets and lost
 *     all                  simulate every effect that a document describes
 *     none                 none of them
 *     occlusion,merging    these and no others
 *     all,-occlusion       a word, then changes to it; -occlusion alone changes auto
 *
 * A selection is what a stage works by. Effects are asked about where they are simulated:
 *
 *     bool merge = effects_forced(selection, EFFECT_MERGING) ||
 *                  (effects_enabled(selection, EFFECT_MERGING) && some_echoes_are_close);
 *     effects_note(selection, EFFECT_MERGING, merge);
 *
 * so that the test for being called for is only made where it can spare something. */
#ifndef EFFECTS_H
#define EFFECTS_H

#include "text/field.h"

/* In the order of the chain. */
enum effect_id {
#define EFFECT(id, name) EFFECT_##id,
#include "frame/effects.def"
    EFFECT_COUNT,
    EFFECT_NONE = EFFECT_COUNT,
};

/* Sets of effects, as in a target's label. */
#define EFFECT_BIT(effect) (UINT64_C(1) << (effect))

extern const char *const effects_names[]; /* NULL-terminated */

/* What --explain tells: how often each effect was simulated or left out, in frames (scans of one
 * sensor) and in single decisions, and the time it took. */
struct effect_log {
    int64_t scans;
    uint64_t simulated, left_out; /* sets, in this scan */
    int64_t scans_simulated[EFFECT_COUNT], scans_left_out[EFFECT_COUNT];
    int64_t spent_ns[EFFECT_COUNT];
    int64_t (*clock_ns)(void);
};

struct selection {
    uint64_t allowed;
    bool automatic;
    struct effect_log *log; /* NULL unless somebody asks */
};

/* Reads the text of --effects; refuses unknown words with what is known. The caller adds the log.
 */
int effects_read(const char *text, struct selection *selection, struct diag *diag);

static inline bool effects_enabled(const struct selection *selection, enum effect_id effect)
{
    return (selection->allowed & EFFECT_BIT(effect)) != 0;
}

static inline bool effects_forced(const struct selection *selection, enum effect_id effect)
{
    return effects_enabled(selection, effect) && !selection->automatic;
}

static inline void effects_note(const struct selection *selection, enum effect_id effect,
                                bool simulated)
{
    simulated = simulated && effects_enabled(selection, effect);
    if (selection->log != NULL)
        *(simulated ? &selection->log->simulated : &selection->log->left_out) |= EFFECT_BIT(effect);
}

/* The time an effect takes: spent = effects_begin(), then effects_end(spent). */
static inline int64_t effects_begin(const struct selection *selection)
{
    return selection->log != NULL ? selection->log->clock_ns() : 0;
}

static inline void effects_end(const struct selection *selection, enum effect_id effect,
                               int64_t begin)
{
    if (selection->log != NULL)
        selection->log->spent_ns[effect] += selection->log->clock_ns() - begin;
}

/* Closes a scan in the log. An effect that was simulated for one object and left out for another
 * counts as simulated. */
void effects_count_scan(const struct selection *selection);

#endif
