#include "export/stream_counts.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/sort.h"
#include "text/text_table.h"

static struct name_count *count(struct name_counts *names, const char *name, int64_t times,
                                struct arena *arena)
{
    uint32_t number = intern_word(&names->names, name, arena);
    if (number == names->list.count)
        list_add(&names->list, arena)->name = intern_text(&names->names, number);
    struct name_count *item = &names->list.items[number];
    item->count += times;
    names->sum += times;
    return item;
}

/* What a target without an object of the frame is counted as. */
static const char *kind_of(enum path path)
{
    if (path == PATH_CLUTTER)
        return "clutter";
    if (path == PATH_FALSE_ALARM)
        return "false alarm";
    return "ghost";
}

static void count_kind(struct stream_counts *counts, const struct frame *frame,
                       const struct contributor *strongest, struct arena *arena)
{
    const struct object *object = frame_object_of(frame, &strongest->id);
    enum path path = strongest->id.path;
    if (frame_shows_object(path))
        count(&counts->classes, object != NULL ? object->class : strongest->id.object, 1, arena);
    else
        count(&counts->others, kind_of(path), 1, arena);
}

static void count_target(struct stream_counts *counts, const struct frame *frame,
                         const struct target *target, struct arena *arena)
{
    const struct contributor *strongest = frame_strongest(target);
    bool merged = false;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *from = &target->contributors.items[i];
        merged = merged || !frame_same_object(&from->id, &target->contributors.items[0].id);
        if (frame_carries(frame, CARRY_ACCOUNT) && from->id.path != PATH_FALSE_ALARM)
            count(&counts->outcomes, "in a target", 1, arena);
    }
    if (strongest != NULL)
        count_kind(counts, frame, strongest, arena);
    counts->merged += merged;
    if (target->range_m > counts->farthest_m)
        counts->farthest_m = target->range_m;
    count(&counts->sensors, target->sensor, 1, arena);
}

/* Counts each object of a scene once. Once no scene is open, the names of all are forgotten. */
static void count_objects(struct stream_counts *counts, const struct frame *frame)
{
    struct text key = {0};
    size_t known = counts->open_scenes.list.count;
    text_format(&key, "%" PRIu64 " %s", frame->seed, frame->scene);
    uint32_t scene =
        intern_number(&counts->open_scenes, key.bytes, key.length, &counts->open_names);
    counts->open += scene == known;
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        key.length = 0;
        text_format(&key, "%" PRIu32 " %s", scene, object->id);
        known = counts->open_objects.list.count;
        bool is_new = intern_number(&counts->open_objects, key.bytes, key.length,
                                    &counts->open_names) == known;
        count(&counts->objects, object->class, is_new, counts->arena);
    }
    text_free(&key);
    counts->appearances += (int64_t)frame->objects.count;
    counts->open -= frame->last;
    if (counts->open > 0)
        return;
    arena_free(&counts->open_names);
    counts->open_scenes = counts->open_objects = (struct intern){0};
}

int stream_counts_add(struct stream_counts *counts, const struct frame *frame, struct diag *diag)
{
    struct arena *arena = counts->arena;
    unsigned seen = frame->present & (PART_SENSORS | PART_TARGETS);
    if (seen == PART_SENSORS)
        return diag_fail(diag, DIAG_DATA,
                         "targets: missing; expected glint-noise, or a stage in its place, before "
                         "this one");
    counts->traffic = seen == 0 && (counts->traffic || counts->frames == 0);
    if (counts->traffic)
        count_objects(counts, frame);
    counts->frames++;
    counts->scenes += frame->last;
    counts->seconds += frame->interval_s;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured) {
            count(&counts->sensors, frame->sensors.list.items[i].name, 0, arena)->scans++;
            counts->scans++;
        }
    for (size_t i = 0; i < frame->targets.count; i++)
        count_target(counts, frame, &frame->targets.items[i], arena);
    for (size_t i = 0; i < frame->lost.count; i++)
        count(&counts->outcomes, frame_loss_words(&frame->lost.items[i], frame->arena),
              (int64_t)frame->lost.items[i].echoes.count, arena);
    return 0;
}

static int most_first(const void *left, const void *right)
{
    const struct name_count *a = left, *b = right;
    if (a->count != b->count)
        return a->count < b->count ? 1 : -1;
    return strcmp(a->name, b->name);
}

static double share(int64_t part, int64_t whole)
{
    return whole > 0 ? (double)part / (double)whole : 0;
}

enum { PERCENT_SIZE = 8 };

/* A share in per cent, with one decimal, or with as many more as it takes to differ from none and
 * all.
 */
static const char *percent(int64_t part, int64_t whole, char text[PERCENT_SIZE])
{
    double exact = 100 * share(part, whole), half_step = 0.05;
    for (int decimals = 1; decimals <= 3; decimals++, half_step /= 10) {
        bool reads_as_none = part > 0 && exact < half_step;
        bool reads_as_all = part < whole && exact >= 100 - half_step;
        snprintf(text, PERCENT_SIZE, "%.*f", decimals, exact);
        if (!reads_as_none && !reads_as_all)
            return text;
    }
    return exact < 50 ? "<0.001" : ">99.999";
}

/* Counts, and their shares in per cent of the whole. */
static void write_counts(const char *title, struct name_counts *names, int64_t whole,
                         struct text *text, struct arena *arena)
{
    if (names->list.count == 0)
        return;
    sort_list(&names->list, most_first, arena);
    text_format(text, "\n%s\n", title);
    struct text rows = {0};
    for (size_t i = 0; i < names->list.count; i++) {
        const struct name_count *item = &names->list.items[i];
        text_format(&rows, "%" PRId64 "\t%s %%\t%s", item->count,
                    percent(item->count, whole, (char[PERCENT_SIZE]){0}), item->name);
        if (item->scans > 0)
            text_format(&rows, ": %.2f in each of %" PRId64 " scans",
                        share(item->count, item->scans), item->scans);
        text_add_word(&rows, "\n");
    }
    text_table_write(&rows, (int[]){9, 7, -1, 0}, "  ", text);
}

static void write_traffic(struct stream_counts *counts, struct text *text)
{
    text_format(text, "%" PRId64 " objects, %.2f in a frame; no sensor has looked at them yet\n",
                counts->objects.sum, share(counts->appearances, counts->frames));
    write_counts("objects by class, each counted once in its scene, egos too", &counts->objects,
                 counts->objects.sum, text, counts->arena);
}

static void write_targets(struct stream_counts *counts, struct text *text)
{
    int64_t targets = counts->sensors.sum;
    text_format(text,
                "%" PRId64 " targets, %.2f a scan, the farthest at %.1f m; %" PRId64
                " (%s %%) of them merged from several objects\n",
                targets, share(targets, counts->scans), counts->farthest_m, counts->merged,
                percent(counts->merged, targets, (char[PERCENT_SIZE]){0}));
    write_counts("targets by sensor", &counts->sensors, targets, text, counts->arena);
    write_counts("targets by class of the object that made the most of them", &counts->classes,
                 targets, text, counts->arena);
    write_counts("targets that show no object at their place", &counts->others, targets, text,
                 counts->arena);
    write_counts("reflectors that a sensor looked for, by what became of them", &counts->outcomes,
                 counts->outcomes.sum, text, counts->arena);
}

void stream_counts_write(struct stream_counts *counts, struct text *text)
{
    text_format(text, "%" PRId64 " frames, %.2f s; scenes that reached their end: %" PRId64 "\n",
                counts->frames, counts->seconds, counts->scenes);
    if (counts->traffic)
        write_traffic(counts, text);
    else
        write_targets(counts, text);
}
