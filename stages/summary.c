/* A summary for people: what the sensors reported, and what became of the other reflectors. */
#include <inttypes.h>

#include "base/sort.h"
#include "base/text.h"
#include "frame/frame_text.h"
#include "run/tool.h"
#include "text/output.h"

/* A name, and how often it was counted; of a sensor also its scans. */
struct tally {
    const char *name;
    int64_t count, scans;
};

struct tallies {
    LIST_OF(struct tally) list;
    int64_t sum; /* of all counts */
};

struct summary {
    const char *copy; /* a file that gets the frames, too; NULL: none does */
    int64_t frames, scenes, scans, merged;
    double seconds, farthest_m;
    struct tallies sensors, classes, others, outcomes;
};

static struct tally *count(struct tallies *tallies, const char *name, int64_t times,
                           struct arena *arena)
{
    struct tally *tally = NULL;
    for (size_t i = 0; i < tallies->list.count && tally == NULL; i++)
        if (strcmp(tallies->list.items[i].name, name) == 0)
            tally = &tallies->list.items[i];
    if (tally == NULL) {
        tally = list_add(&tallies->list, arena);
        *tally = (struct tally){.name = arena_text(arena, name, strlen(name))};
    }
    tally->count += times;
    tallies->sum += times;
    return tally;
}

static void count_kind(struct summary *summary, const struct frame *frame,
                       const struct contributor *strongest, struct arena *arena)
{
    const struct object *object = frame_object(frame, strongest->id.object);
    enum path path = strongest->id.path;
    if (frame_shows_object(path))
        count(&summary->classes, object != NULL ? object->class : strongest->id.object, 1, arena);
    else
        count(&summary->others,
              path == PATH_CLUTTER       ? "clutter"
              : path == PATH_FALSE_ALARM ? "false alarm"
                                         : "ghost",
              1, arena);
}

static void count_target(struct summary *summary, const struct frame *frame,
                         const struct target *target, struct arena *arena)
{
    const struct contributor *strongest = frame_strongest(target);
    bool merged = false;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *from = &target->contributors.items[i];
        merged = merged || strcmp(from->id.object, target->contributors.items[0].id.object) != 0;
        if (frame_carries(frame, CARRY_ACCOUNT) && from->id.path != PATH_FALSE_ALARM)
            count(&summary->outcomes, "in a target", 1, arena);
    }
    if (strongest != NULL)
        count_kind(summary, frame, strongest, arena);
    summary->merged += merged;
    if (target->range_m > summary->farthest_m)
        summary->farthest_m = target->range_m;
    count(&summary->sensors, target->sensor, 1, arena);
}

static void count_frame(struct summary *summary, const struct frame *frame, struct arena *arena)
{
    summary->frames++;
    summary->scenes += frame->last;
    summary->seconds += frame->interval_s;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured) {
            count(&summary->sensors, frame->sensors.list.items[i].name, 0, arena)->scans++;
            summary->scans++;
        }
    for (size_t i = 0; i < frame->targets.count; i++)
        count_target(summary, frame, &frame->targets.items[i], arena);
    for (size_t i = 0; i < frame->lost.count; i++)
        count(&summary->outcomes, frame_loss_words(&frame->lost.items[i], frame->arena),
              (int64_t)frame->lost.items[i].echoes.count, arena);
}

static int most_first(const void *left, const void *right)
{
    const struct tally *a = left, *b = right;
    return a->count != b->count ? (a->count < b->count ? 1 : -1) : strcmp(a->name, b->name);
}

static double share(int64_t part, int64_t whole)
{
    return whole > 0 ? (double)part / (double)whole : 0;
}

/* Counts, and their shares in per cent of the whole. */
static void print_tallies(const char *title, struct tallies *tallies, int64_t whole,
                          struct text *text, struct arena *arena)
{
    if (tallies->list.count == 0)
        return;
    sort_list(&tallies->list, most_first, arena);
    text_format(text, "\n%s\n", title);
    for (size_t i = 0; i < tallies->list.count; i++) {
        const struct tally *tally = &tallies->list.items[i];
        text_format(text, "  %9" PRId64 "  %5.1f %%  %s", tally->count,
                    100 * share(tally->count, whole), tally->name);
        if (tally->scans > 0)
            text_format(text, ": %.2f in each of %" PRId64 " scans",
                        share(tally->count, tally->scans), tally->scans);
        text_add_word(text, "\n");
    }
}

static int print(struct summary *summary, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    struct text text = {0};
    int64_t targets = summary->sensors.sum;
    text_format(&text, "%" PRId64 " frames, %.2f s; scenes that reached their end: %" PRId64 "\n",
                summary->frames, summary->seconds, summary->scenes);
    text_format(&text,
                "%" PRId64 " targets, %.2f a scan, the farthest at %.1f m; %" PRId64
                " (%.1f %%) of them merged from several objects\n",
                targets, share(targets, summary->scans), summary->farthest_m, summary->merged,
                100 * share(summary->merged, targets));
    print_tallies("targets by sensor", &summary->sensors, targets, &text, arena);
    print_tallies("targets by class of the object that made the most of them", &summary->classes,
                  targets, &text, arena);
    print_tallies("targets that show no object at their place", &summary->others, targets, &text,
                  arena);
    print_tallies("reflectors that a sensor looked for, by what became of them", &summary->outcomes,
                  summary->outcomes.sum, &text, arena);
    return runner_write_text(runner, &text);
}

static int write_copy(struct output *copy, const struct frame *frame, struct diag *diag)
{
    if (copy == NULL)
        return 0;
    return frame_text_write(frame, output_text(copy), diag) == 0 ? output_send(copy, diag) : -1;
}

static int summary_run(void *state, struct runner *runner)
{
    struct summary *summary = state;
    struct output *copy = NULL;
    struct frame *frame;
    if (runner_output(runner) == NULL)
        return -1;
    if (summary->copy != NULL && (copy = runner_output_beside(runner, summary->copy)) == NULL)
        return diag_prefix(runner_diag(runner), "--copy: ");
    int more;
    while ((more = runner_frame(runner, &frame)) > 0) {
        count_frame(summary, frame, runner_arena(runner));
        if (write_copy(copy, frame, runner_diag(runner)) != 0)
            return -1;
    }
    return more == 0 ? print(summary, runner) : -1;
}

static const struct field summary_options[] = {
    {OPTIONAL_NAME(struct summary, copy,
                   "also write the frames to this file, as -o of a stage does"),
     .word = "FILE"},
    {0},
};

const struct tool tool_summary = {
    .name = "summary",
    .summary = "Print how many targets the sensors reported, of which classes, and how far.",
    .details =
        "A target counts for its strongest contributor: for the class of the object, or, apart\n"
        "from classes, as ghost, clutter or false alarm. Shares are of all targets.\n"
        "With --sections account given to glint-ideal it also prints what became of every\n"
        "reflector that a sensor looked for: how many are in a target, and how many are lost for\n"
        "which reason.\n"
        "Prints at the end of the stream. With --copy it counts what a pipeline writes on the way\n"
        "to a file, without another reading.",
    .options = STAGE_OPTIONS(struct summary, summary_options),
    .reads = SECTION_OBJECTS | SECTION_SENSORS | SECTION_TARGETS,
    .run = summary_run,
};
