#include "frame_order.h"

#include <string.h>

#include "sort.h"

static const char *text_of(const char *name)
{
    return name != NULL ? name : "";
}

int frame_order_subjects(struct subject a, struct subject b)
{
    int order = strcmp(a.object, b.object);
    if (order == 0)
        order = strcmp(a.reflector, b.reflector);
    if (order == 0)
        order = (a.path > b.path) - (a.path < b.path);
    if (order == 0)
        order = strcmp(text_of(a.mirror), text_of(b.mirror));
    return order != 0 ? order : (a.number > b.number) - (a.number < b.number);
}

static int compare_contributors(const void *left, const void *right)
{
    const struct contributor *a = left, *b = right;
    return frame_order_subjects(SUBJECT_OF(a), SUBJECT_OF(b));
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
    return order != 0 ? order : frame_order_subjects(SUBJECT_OF(a), SUBJECT_OF(b));
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
    return frame_order_subjects(SUBJECT_OF(a), SUBJECT_OF(b));
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

static int compare_paths(const void *left, const void *right)
{
    const struct path_count *a = left, *b = right;
    return (a->path > b->path) - (a->path < b->path);
}

/* A stable sort leaves targets in the order of their sensor's list. */
static int compare_targets(const void *left, const void *right)
{
    return strcmp(((const struct target *)left)->sensor, ((const struct target *)right)->sensor);
}

void frame_order(struct frame *frame)
{
    struct arena *arena = frame->arena;
    sort_list(&frame->reflectors, compare_sets, arena);
    for (size_t i = 0; i < frame->reflectors.count; i++)
        sort_list(&frame->reflectors.items[i].worn_by, frame_order_names, arena);
    sort_list(&frame->sensors.list, compare_views, arena);
    sort_list(&frame->echoes, frame_order_echoes, arena);
    for (size_t i = 0; i < frame->cells.count; i++) {
        struct cell *cell = &frame->cells.items[i];
        if (cell->members.count > 2)
            sort_items(cell->members.items + 1, cell->members.count - 1,
                       sizeof *cell->members.items, compare_contributors, arena);
    }
    sort_list(&frame->cells, frame_order_cells, arena);
    sort_list(&frame->targets, compare_targets, arena);
    sort_list(&frame->lost, compare_lost_groups, arena);
    for (size_t i = 0; i < frame->lost.count; i++)
        sort_list(&frame->lost.items[i].echoes, compare_lost_echoes, arena);
    sort_list(&frame->counts, compare_counts, arena);
    for (size_t i = 0; i < frame->counts.count; i++)
        sort_list(&frame->counts.items[i].paths, compare_paths, arena);
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
