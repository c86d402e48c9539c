#include "recorded/recording_notes.h"

#include <stdarg.h>
#include <stdio.h>

#include "recorded/recording.h"

/* Adds a sentence behind those before. */
static void note(const struct recording *recording, struct diag *diag, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void note(const struct recording *recording, struct diag *diag, const char *format, ...)
{
    size_t used = strlen(diag->text);
    used += (size_t)snprintf(diag->text + used, sizeof diag->text - used,
                             "%s%.200s: ", used > 0 ? "; " : "", recording->source);
    if (used >= sizeof diag->text)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(diag->text + used, sizeof diag->text - used, format, arguments);
    va_end(arguments);
}

static void note_jumps(const struct recording *recording, struct diag *diag)
{
    const struct recorded_jump_counts *jumps = &recording->steps.jumps;
    if (jumps->lanes + jumps->angles > 0)
        note(recording, diag,
             "%zu jumps to another lane are spread over %d s, and %zu of the angle over the way "
             "that the body needs to turn; sumo --lanechange.duration 3 or --lateral-resolution "
             "0.8 avoids jumps to another lane",
             jumps->lanes, RECORDED_JUMP_S, jumps->angles);
}

static void note_denied(const struct recording *recording, struct diag *diag)
{
    const struct recorded_plausibility *ways = &recording->steps.plausibility;
    if (ways->standing + ways->driving + ways->fast > 0)
        note(
            recording, diag,
            "a body leaves and comes back as a new visit where it moves by metres though it stands "
            "by its speed (%zu times), farther than its speed allows (%zu) or, without a stated "
            "speed, faster than %d m/s (%zu); first in %s %zu",
            ways->standing, ways->driving, RECORDED_FASTEST_MPS, ways->fast,
            recording->steps.reader.format->place, ways->first);
}

static void note_levels(const struct recording *recording, struct diag *diag)
{
    if (recording->apart_frames > 0)
        note(recording, diag,
             "%zu bodies are left out of %zu frames, because they are more than %d m above or "
             "below the road of the ego",
             recording->apart.list.count, recording->apart_frames, RECORDED_LEVELS_MOST_M);
}

/* Tells the first ego whose scenes are fragments, and how many more there are. */
static void note_fragments(const struct recording *recording, struct diag *diag)
{
    const struct recorded_ego *first = NULL;
    size_t count = 0;
    for (size_t i = 0; i < recording->egos.count; i++) {
        const struct recorded_ego *ego = &recording->egos.items[i];
        if (ego->visits < 2)
            continue;
        first = count++ == 0 ? ego : first;
    }
    if (first == NULL)
        return;
    char missed[64] = "", jumps[64] = "", more[64] = "";
    if (first->missed > 0)
        snprintf(missed, sizeof missed, " is missing from %zu steps in between", first->missed);
    if (first->jumps > 0)
        snprintf(jumps, sizeof jumps, " jumps %zu times", first->jumps);
    if (count > 1)
        snprintf(more, sizeof more, "; %zu more egos have several scenes", count - 1);
    note(recording, diag, "ego %.200s: %lld scenes, as it%s%s%s%s", first->id,
         (long long)first->visits, missed, first->missed > 0 && first->jumps > 0 ? " and" : "",
         jumps, more);
}

/* Tells that nothing moves, or else the first ego that was asked for by its id and does not. */
static void note_standing(const struct recording *recording, struct diag *diag)
{
    if (!recording->moves) {
        note(recording, diag, "nothing moves");
        return;
    }
    if (recording->all)
        return;
    for (size_t i = 0; i < recording->egos.count; i++) {
        const struct recorded_ego *ego = &recording->egos.items[i];
        if (ego->moves)
            continue;
        note(recording, diag, "ego %.200s does not move", ego->id);
        return;
    }
}

void recording_notes(const struct recording *recording, struct diag *diag)
{
    note_jumps(recording, diag);
    note_denied(recording, diag);
    note_levels(recording, diag);
    note_fragments(recording, diag);
    note_standing(recording, diag);
}
