/* A summary for people: what the sensors reported, and what became of the other reflectors. */
#include <inttypes.h>
#include <string.h>

#include "base/sort.h"
#include "base/text.h"
#include "run/stage.h"

/* A name, and how often it was counted. */
struct tally {
    const char *name;
    int64_t count;
};

struct tallies {
    LIST_OF(struct tally) list;
};

struct summary {
    int64_t frames, scenes, targets, merged;
    double seconds, farthest_m;
    struct tallies scans, detections, classes, outcomes;
};

static void count(struct tallies *tallies, const char *name, int64_t times, struct arena *arena)
{
    struct tally *tally = NULL;
    for (size_t i = 0; i < tallies->list.count && tally == NULL; i++)
        if (strcmp(tallies->list.items[i].name, name) == 0)
            tally = &tallies->list.items[i];
    if (tally == NULL) {
        tally = list_add(&tallies->list, arena);
        tally->name = arena_text(arena, name, strlen(name));
    }
    tally->count += times;
}

static void count_target(struct summary *summary, const struct frame *frame,
                         const struct target *target, struct arena *arena)
{
    bool merged = false;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *from = &target->contributors.items[i];
        const struct object *object = frame_object(frame, from->id.object);
        merged = merged || strcmp(from->id.object, target->contributors.items[0].id.object) != 0;
        if (i == 0)
            count(&summary->classes, object != NULL ? object->class : from->id.object, 1, arena);
    }
    summary->targets++;
    summary->merged += merged;
    if (target->range_m > summary->farthest_m)
        summary->farthest_m = target->range_m;
    count(&summary->detections, target->sensor, 1, arena);
    if (frame->account)
        count(&summary->outcomes, "in a target", (int64_t)target->contributors.count, arena);
}

static int summary_step(void *state, struct frame *frame, struct runner *runner)
{
    struct summary *summary = state;
    struct arena *arena = runner_arena(runner);
    summary->frames++;
    summary->scenes += frame->last;
    summary->seconds += frame->interval_s;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured)
            count(&summary->scans, frame->sensors.list.items[i].name, 1, arena);
    for (size_t i = 0; i < frame->targets.count; i++)
        count_target(summary, frame, &frame->targets.items[i], arena);
    for (size_t i = 0; i < frame->lost.count; i++)
        count(&summary->outcomes, frame_loss_name(frame->lost.items[i].reason),
              (int64_t)frame->lost.items[i].echoes.count, arena);
    return 0;
}

static int most_first(const void *left, const void *right)
{
    const struct tally *a = left, *b = right;
    return a->count != b->count ? (a->count < b->count ? 1 : -1) : strcmp(a->name, b->name);
}

static void print_tallies(const char *title, struct tallies *tallies, struct text *text,
                          struct arena *arena)
{
    if (tallies->list.count == 0)
        return;
    sort_list(&tallies->list, most_first, arena);
    text_format(text, "\n%s\n", title);
    for (size_t i = 0; i < tallies->list.count; i++)
        text_format(text, "  %9" PRId64 "  %s\n", tallies->list.items[i].count,
                    tallies->list.items[i].name);
}

static int summary_stop(void *state, struct runner *runner)
{
    struct summary *summary = state;
    struct arena *arena = runner_arena(runner);
    struct text text = {0};
    text_format(&text, "%" PRId64 " frames, %.2f s; scenes that reached their end: %" PRId64 "\n",
                summary->frames, summary->seconds, summary->scenes);
    text_format(&text,
                "%" PRId64 " targets, the farthest at %.1f m, %" PRId64
                " of them merged from several objects\n",
                summary->targets, summary->farthest_m, summary->merged);
    print_tallies("scans by sensor", &summary->scans, &text, arena);
    print_tallies("targets by sensor", &summary->detections, &text, arena);
    print_tallies("targets by class of their strongest contributor", &summary->classes, &text,
                  arena);
    print_tallies("reflectors that a sensor looked for, by what became of them", &summary->outcomes,
                  &text, arena);
    int result = runner_write(runner, text.bytes, text.length);
    text_free(&text);
    return result;
}

static const struct record summary_record = {
    .name = "stage", .size = sizeof(struct summary), .fields = field_none};

const struct stage stage_summary = {
    .name = "summary",
    .summary = "Print how many targets the sensors reported, of which classes, and how far.",
    .details =
        "With --account given to glint-ideal it also prints what became of every reflector that\n"
        "a sensor looked for: how many are in a target, and how many are lost for which reason.\n"
        "Prints at the end of the stream.",
    .options = &summary_record,
    .sink = true,
    .reads = SECTION_OBJECTS | SECTION_SENSORS | SECTION_TARGETS,
    .step = summary_step,
    .stop = summary_stop,
};
