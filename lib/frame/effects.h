/* Effects: their names, and which of them a run simulates.
 *
 * An effect is a part of the physics that can be on or off. One stage simulates it, its home. One
 * or more members of documents describe it, its cause: without the cause there is no effect. The
 * member `effects` of a suite, or the option --effects of glint-ideal, selects effects:
 *
 *     auto                 (default) leave out effects that change no bit of targets and lost
 *     all                  simulate every effect that a document describes
 *     none                 simulate no effect
 *     occlusion,merging    these and no others
 *     all,-occlusion       a word, then changes to it; -occlusion alone changes auto
 *
 * Only under auto a stage tests whether a scene calls for an effect:
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

/* Numbers of scans in which each effect was simulated and left out, for glint-plan. */
struct effect_log {
    int64_t scans;
    uint64_t simulated, left_out; /* sets of effects, of the scan that is not yet counted */
    int64_t scans_simulated[EFFECT_COUNT], scans_left_out[EFFECT_COUNT];
};

struct selection {
    uint64_t allowed;       /* the set of effects that may be simulated */
    bool automatic;         /* effects may be left out where they change nothing */
    struct effect_log *log; /* or NULL */
};

/* Reads the text of --effects. Refuses an unknown word (DIAG_CONFIG). The log is NULL. */
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

/* Notes in the log that the effect was simulated or left out in a part of the scan. An effect that
 * is not enabled counts as left out. */
static inline void effects_note(const struct selection *selection, enum effect_id effect,
                                bool simulated)
{
    if (selection->log == NULL)
        return;
    if (simulated && effects_enabled(selection, effect))
        selection->log->simulated |= EFFECT_BIT(effect);
    else
        selection->log->left_out |= EFFECT_BIT(effect);
}

/* Counts the scan in the log. An effect that was simulated in a part of the scan counts as
 * simulated. */
void effects_count_scan(const struct selection *selection);
