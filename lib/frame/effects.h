/* Effects: their names, and which of them a run simulates.
 *
 * An effect is a part of the physics that can be on or off. It has a home, the stage that simulates
 * it, and a cause, the member of a document that describes it: without its cause there is no
 * effect. The member `effects` of a suite, or the option --effects of glint-ideal, selects effects:
 *
 *     auto                 (default) leave out what provably changes no bit of targets and lost
 *     all                  simulate every effect that a document describes
 *     none                 none of them
 *     occlusion,merging    these and no others
 *     all,-occlusion       a word, then changes to it; -occlusion alone changes auto
 *
 * A stage obeys the selection where it simulates an effect, and tests whether a scene calls for the
 * effect only under auto:
 *
 *     bool merge = effects_forced(selection, EFFECT_MERGING) ||
 *                  (effects_enabled(selection, EFFECT_MERGING) && some_echoes_are_close);
 *     effects_note(selection, EFFECT_MERGING, merge); */
#pragma once

#include "text/field.h"

/* In the order of the chain. */
enum effect_id {
#define EFFECT(id, name) EFFECT_##id,
#include "frame/effects.def"
    EFFECT_COUNT,
    EFFECT_NONE = EFFECT_COUNT,
};

_Static_assert(EFFECT_COUNT < 64, "a set of effects is a uint64_t with a bit for each");

/* The set of one effect. */
#define EFFECT_BIT(effect) (UINT64_C(1) << (effect))

extern const char *const effects_names[]; /* NULL-terminated */

/* What --explain and glint-plan report: in how many scans of a sensor each effect was simulated or
 * left out, and the time that it took. */
struct effect_log {
    int64_t scans;
    uint64_t simulated, left_out; /* sets of effects: in the scan at hand, so far */
    int64_t scans_simulated[EFFECT_COUNT], scans_left_out[EFFECT_COUNT];
    int64_t spent_ns[EFFECT_COUNT];
    int64_t (*clock_ns)(void);
};

struct selection {
    uint64_t allowed;       /* the set of effects that may be simulated */
    bool automatic;         /* auto: may effects be left out where they change nothing? */
    struct effect_log *log; /* NULL: none is kept */
};

/* Reads the text of --effects. An unknown word is refused with what is known. The log stays NULL.
 */
int effects_read(const char *text, struct selection *selection, struct diag *diag);

/* May the effect be simulated? */
static inline bool effects_enabled(const struct selection *selection, enum effect_id effect)
{
    return (selection->allowed & EFFECT_BIT(effect)) != 0;
}

/* Must the effect be simulated wherever it is described? */
static inline bool effects_forced(const struct selection *selection, enum effect_id effect)
{
    return effects_enabled(selection, effect) && !selection->automatic;
}

/* Notes in the log that the effect was simulated or left out in a part of the scan at hand. An
 * effect that is not enabled counts as left out. */
static inline void effects_note(const struct selection *selection, enum effect_id effect,
                                bool simulated)
{
    simulated = simulated && effects_enabled(selection, effect);
    if (selection->log != NULL)
        *(simulated ? &selection->log->simulated : &selection->log->left_out) |= EFFECT_BIT(effect);
}

/* The log's clock, 0 without a log: read before an effect is simulated. */
static inline int64_t effects_clock_ns(const struct selection *selection)
{
    return selection->log != NULL ? selection->log->clock_ns() : 0;
}

/* Adds the time since start_ns to the log's time of the effect. */
static inline void effects_count_time(const struct selection *selection, enum effect_id effect,
                                      int64_t start_ns)
{
    if (selection->log != NULL)
        selection->log->spent_ns[effect] += selection->log->clock_ns() - start_ns;
}

/* Ends a scan in the log. An effect that was simulated for one object and left out for another
 * counts as simulated in the scan. */
void effects_count_scan(const struct selection *selection);
