/* A summary for people: what the sensors reported, and what became of the other reflectors; of
 * traffic that no sensor has seen, its objects. */
#include <inttypes.h>

#include "base/intern.h"
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

/* A scene whose last frame is still to come, and the ids of its objects so far. */
struct open_scene {
    const char *name;
    uint64_t seed;
    struct intern objects;
    struct arena arena;
};

struct summary {
    const char *copy; /* a file that gets the frames, too; NULL: none does */
    bool traffic;     /* no frame was seen by sensors */
    LIST_OF(struct open_scene) open;
    struct tallies objects; /* by class */
    int64_t appearances;    /* of objects in frames */
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

static struct open_scene *open_scene(struct summary *summary, const struct frame *frame,
                                     struct arena *arena)
{
    for (size_t i = 0; i < summary->open.count; i++)
        if (summary->open.items[i].seed == frame->seed &&
            strcmp(summary->open.items[i].name, frame->scene) == 0)
            return &summary->open.items[i];
    struct open_scene *scene = list_add(&summary->open, arena);
    *scene = (struct open_scene){.seed = frame->seed};
    scene->name = arena_text(&scene->arena, frame->scene, strlen(frame->scene));
    return scene;
}

/* Counts each object of a scene once. */
static void count_objects(struct summary *summary, const struct frame *frame, struct arena *arena)
{
    struct open_scene *scene = open_scene(summary, frame, arena);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        size_t known = scene->objects.list.count;
        bool is_new = intern_word(&scene->objects, object->id, &scene->arena) == known;
        count(&summary->objects, object->class, is_new, arena);
    }
    summary->appearances += (int64_t)frame->objects.count;
    if (frame->last) {
        arena_free(&scene->arena);
        *scene = summary->open.items[--summary->open.count];
    }
}

/* Counts a frame, which is traffic or has targets. */
static int count_frame(struct summary *summary, const struct frame *frame, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    unsigned seen = frame->present & (SECTION_SENSORS | SECTION_TARGETS);
    if (seen == SECTION_SENSORS)
        return diag_fail(runner_diag(runner), DIAG_DATA,
                         "targets: missing; expected glint-noise, or a stage in its place, before "
                         "this one");
    summary->traffic = seen == 0 && (summary->traffic || summary->frames == 0);
    if (summary->traffic)
        count_objects(summary, frame, arena);
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
    return 0;
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

static void print_traffic(struct summary *summary, struct text *text, struct arena *arena)
{
    text_format(text, "%" PRId64 " objects, %.2f in a frame; no sensor has looked at them yet\n",
                summary->objects.sum, share(summary->appearances, summary->frames));
    print_tallies("objects by class, each counted once in its scene, egos too", &summary->objects,
                  summary->objects.sum, text, arena);
}

static void print_targets(struct summary *summary, struct text *text, struct arena *arena)
{
    int64_t targets = summary->sensors.sum;
    text_format(text,
                "%" PRId64 " targets, %.2f a scan, the farthest at %.1f m; %" PRId64
                " (%.1f %%) of them merged from several objects\n",
                targets, share(targets, summary->scans), summary->farthest_m, summary->merged,
                100 * share(summary->merged, targets));
    print_tallies("targets by sensor", &summary->sensors, targets, text, arena);
    print_tallies("targets by class of the object that made the most of them", &summary->classes,
                  targets, text, arena);
    print_tallies("targets that show no object at their place", &summary->others, targets, text,
                  arena);
    print_tallies("reflectors that a sensor looked for, by what became of them", &summary->outcomes,
                  summary->outcomes.sum, text, arena);
}

static int print(struct summary *summary, struct runner *runner)
{
    struct text text = {0};
    text_format(&text, "%" PRId64 " frames, %.2f s; scenes that reached their end: %" PRId64 "\n",
                summary->frames, summary->seconds, summary->scenes);
    (summary->traffic ? print_traffic : print_targets)(summary, &text, runner_arena(runner));
    return runner_write_text(runner, &text);
}

static int write_copy(struct output *copy, const struct frame *frame, struct diag *diag)
{
    if (copy == NULL)
        return 0;
    return frame_text_write(frame, output_text(copy), diag) == 0 ? output_send(copy, diag) : -1;
}

static int count_stream(struct summary *summary, struct output *copy, struct runner *runner)
{
    struct frame *frame;
    int more;
    while ((more = runner_frame(runner, &frame)) > 0)
        if (count_frame(summary, frame, runner) != 0 ||
            write_copy(copy, frame, runner_diag(runner)) != 0)
            return -1;
    return more;
}

static int summary_run(void *state, struct runner *runner)
{
    struct summary *summary = state;
    struct output *copy = NULL;
    if (runner_output(runner) == NULL)
        return -1;
    if (summary->copy != NULL && (copy = runner_output_beside(runner, summary->copy)) == NULL)
        return diag_prefix(runner_diag(runner), "--copy: ");
    int result = count_stream(summary, copy, runner);
    for (size_t i = 0; i < summary->open.count; i++)
        arena_free(&summary->open.items[i].arena);
    return result == 0 ? print(summary, runner) : -1;
}

static const struct field summary_options[] = {
    {OPTIONAL_NAME(struct summary, copy,
                   "also write the frames to this file, as -o of a stage does"),
     .word = "FILE"},
    {0},
};

const struct stage stage_summary = {
    .name = "summary",
    .summary = "Count targets by sensor and class, or the objects of traffic.",
    .details =
        "A target counts for its strongest contributor: for the class of the object, or, apart\n"
        "from classes, as ghost, clutter or false alarm. Shares are of all targets.\n"
        "With --sections account given to glint-ideal it also prints what became of every\n"
        "reflector that a sensor looked for: how many are in a target, and how many are lost for\n"
        "which reason.\n"
        "Frames of glint-traffic or glint-extract, which no sensor has looked at, are counted by\n"
        "their objects: each once in its scene, by class.\n"
        "Prints at the end of the stream. With --copy it counts what a pipeline writes on the way\n"
        "to a file, without another reading.",
    .options = STAGE_OPTIONS(struct summary, summary_options),
    .reads = SECTION_OBJECTS,
    .run = summary_run,
};
