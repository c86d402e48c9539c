#include "frame_order.h"

#include <stdlib.h>
#include <string.h>

static int compare_echo_names(const char *object_a, const char *reflector_a, enum path path_a,
                              const char *object_b, const char *reflector_b, enum path path_b)
{
    int order = strcmp(object_a, object_b);
    if (order == 0)
        order = strcmp(reflector_a, reflector_b);
    return order != 0 ? order : (path_a > path_b) - (path_a < path_b);
}

static int compare_contributors(const void *left, const void *right)
{
    const struct contributor *a = left, *b = right;
    return compare_echo_names(a->object, a->reflector, a->path, b->object, b->reflector, b->path);
}

int frame_order_names(const void *left, const void *right)
{
    return strcmp(*(const char *const *)left, *(const char *const *)right);
}

static int compare_sets(const void *left, const void *right)
{
    return strcmp(((const struct reflector_set *)left)->model,
                  ((const struct reflector_set *)right)->model);
}

static int compare_views(const void *left, const void *right)
{
    return strcmp(((const struct sensor_view *)left)->name,
                  ((const struct sensor_view *)right)->name);
}

int frame_order_echoes(const void *left, const void *right)
{
    const struct echo *a = left, *b = right;
    int order = strcmp(a->sensor, b->sensor);
    return order != 0 ? order
                      : compare_echo_names(a->object, a->reflector, a->path, b->object,
                                           b->reflector, b->path);
}

int frame_order_cells(const void *left, const void *right)
{
    const struct cell *a = left, *b = right;
    int order = strcmp(a->sensor, b->sensor);
    return order != 0 || a->members.count == 0 || b->members.count == 0
               ? order
               : compare_contributors(a->members.items, b->members.items);
}

static int compare_lost_echoes(const void *left, const void *right)
{
    const struct lost_echo *a = left, *b = right;
    return compare_echo_names(a->object, a->reflector, a->path, b->object, b->reflector, b->path);
}

static int compare_lost_groups(const void *left, const void *right)
{
    const struct lost_group *a = left, *b = right;
    int order = strcmp(a->sensor, b->sensor);
    if (order == 0)
        order = strcmp(a->stage, b->stage);
    return order != 0 ? order : (a->reason > b->reason) - (a->reason < b->reason);
}

static int compare_counts(const void *left, const void *right)
{
    return strcmp(((const struct count *)left)->sensor, ((const struct count *)right)->sensor);
}

#define SORT(list, compare)                                                                        \
    do {                                                                                           \
        if ((list).count > 1)                                                                      \
            qsort((list).items, (list).count, sizeof *(list).items, (compare));                    \
    } while (0)

/* Targets keep the order of their list: sorted by sensor through their places. */
static int compare_targets(const void *left, const void *right)
{
    const struct target *const *a = left, *const *b = right;
    int order = strcmp((*a)->sensor, (*b)->sensor);
    return order != 0 ? order : (*a > *b) - (*a < *b);
}

static bool targets_are_grouped(const struct frame *frame)
{
    for (size_t i = 1; i < frame->targets.count; i++)
        if (strcmp(frame->targets.items[i - 1].sensor, frame->targets.items[i].sensor) > 0)
            return false;
    return true;
}

static void group_targets(struct frame *frame)
{
    if (targets_are_grouped(frame))
        return;
    size_t count = frame->targets.count;
    const struct target **places = arena_get(frame->arena, count * sizeof(*places));
    struct target *grouped = arena_get(frame->arena, count * sizeof *grouped);
    for (size_t i = 0; i < count; i++)
        places[i] = &frame->targets.items[i];
    qsort(places, count, sizeof(*places), compare_targets);
    for (size_t i = 0; i < count; i++)
        grouped[i] = *places[i];
    frame->targets.items = grouped;
    frame->targets.room = count;
}

void frame_order(struct frame *frame)
{
    SORT(frame->reflectors, compare_sets);
    for (size_t i = 0; i < frame->reflectors.count; i++)
        SORT(frame->reflectors.items[i].worn_by, frame_order_names);
    SORT(frame->sensors.list, compare_views);
    SORT(frame->echoes, frame_order_echoes);
    for (size_t i = 0; i < frame->cells.count; i++) {
        struct cell *cell = &frame->cells.items[i];
        if (cell->members.count > 2)
            qsort(cell->members.items + 1, cell->members.count - 1, sizeof *cell->members.items,
                  compare_contributors);
    }
    SORT(frame->cells, frame_order_cells);
    group_targets(frame);
    SORT(frame->lost, compare_lost_groups);
    for (size_t i = 0; i < frame->lost.count; i++)
        SORT(frame->lost.items[i].echoes, compare_lost_echoes);
    SORT(frame->counts, compare_counts);
}

int frame_order_tied(const struct contributor *a, const struct contributor *b)
{
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    if (a->range_rate_mps != b->range_rate_mps)
        return a->range_rate_mps < b->range_rate_mps ? -1 : 1;
    if (a->azimuth_rad != b->azimuth_rad)
        return a->azimuth_rad < b->azimuth_rad ? -1 : 1;
    return compare_contributors(a, b);
}
