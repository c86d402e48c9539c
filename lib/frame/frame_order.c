#include "frame/frame_order.h"

#include "base/sort.h"

/* As strcmp, which is called only if neither the pointers nor the first bytes decide; NULL is the
 * first name. */
static inline int compare_names(const char *a, const char *b)
{
    if (a == b)
        return 0;
    if (a == NULL || b == NULL)
        return a == NULL ? -1 : 1;
    return *a == *b ? strcmp(a, b) : (unsigned char)*a - (unsigned char)*b;
}

static inline int compare_echo_ids(struct echo_id a, struct echo_id b)
{
    int order = compare_names(a.object, b.object);
    if (order == 0)
        order = compare_names(a.reflector, b.reflector);
    if (order == 0)
        order = (a.path > b.path) - (a.path < b.path);
    if (order == 0)
        order = compare_names(a.mirror, b.mirror);
    return order != 0 ? order : (a.number > b.number) - (a.number < b.number);
}

int frame_order_echo_ids(const void *left, const void *right)
{
    const struct echo_id *a = left, *b = right;
    return compare_echo_ids(*a, *b);
}

_Static_assert(offsetof(struct class_document, class) == 0 &&
                   offsetof(struct reflector_set, model) == 0 &&
                   offsetof(struct sensor_view, name) == 0 &&
                   offsetof(struct target, sensor) == 0 && offsetof(struct count, sensor) == 0 &&
                   offsetof(struct contributor, id) == 0 && offsetof(struct lost_echo, id) == 0,
               "structs that are sorted by a name or an echo id begin with it");

int frame_order_names(const void *left, const void *right)
{
    return compare_names(*(const char *const *)left, *(const char *const *)right);
}

int frame_order_echoes(const void *left, const void *right)
{
    const struct echo *a = left, *b = right;
    int order = compare_names(a->sensor, b->sensor);
    return order != 0 ? order : compare_echo_ids(a->id, b->id);
}

int frame_order_cells(const void *left, const void *right)
{
    const struct cell *a = left, *b = right;
    int order = compare_names(a->sensor, b->sensor);
    return order != 0 || a->members.count == 0 || b->members.count == 0
               ? order
               : frame_order_echo_ids(a->members.items, b->members.items);
}

int frame_order_lost_groups(const void *left, const void *right)
{
    const struct lost_group *a = left, *b = right;
    int order = compare_names(a->sensor, b->sensor);
    if (order == 0)
        order = compare_names(a->stage, b->stage);
    if (order == 0)
        order = (int)frame_loss_of(a->reason) - (int)frame_loss_of(b->reason);
    return order != 0 ? order : compare_names(a->reason, b->reason);
}

int frame_order_sightings(const void *left, const void *right)
{
    const struct sighting *a = left, *b = right;
    int order = compare_names(a->sensor, b->sensor);
    return order != 0 ? order : compare_names(a->object, b->object);
}

static int compare_paths(const void *left, const void *right)
{
    const struct path_count *a = left, *b = right;
    return (a->path > b->path) - (a->path < b->path);
}

static int compare_objects(const void *left, const void *right)
{
    return compare_names((*(const struct object *const *)left)->id,
                         (*(const struct object *const *)right)->id);
}

struct object *const *frame_order_objects(struct frame *frame)
{
    size_t count = frame->objects.count;
    if (frame->by_id.count == count)
        return frame->by_id.items;
    frame->by_id.items = arena_room(frame->arena, count * sizeof *frame->by_id.items);
    frame->by_id.count = frame->by_id.room = count;
    for (size_t i = 0; i < count; i++)
        frame->by_id.items[i] = &frame->objects.items[i];
    sort_list(&frame->by_id, compare_objects, frame->arena);
    return frame->by_id.items;
}

static void order_sets(struct frame *frame)
{
    sort_list(&frame->reflectors, frame_order_names, frame->arena);
    for (size_t i = 0; i < frame->reflectors.count; i++)
        sort_list(&frame->reflectors.items[i].objects, frame_order_names, frame->arena);
}

static void order_cells(struct frame *frame)
{
    for (size_t i = 0; i < frame->cells.count; i++) {
        struct cell *cell = &frame->cells.items[i];
        if (cell->members.count > 2)
            sort_items(cell->members.items + 1, cell->members.count - 1,
                       sizeof *cell->members.items, frame_order_echo_ids, frame->arena);
    }
    sort_list(&frame->cells, frame_order_cells, frame->arena);
}

static void order_lost(struct frame *frame, const char *stage)
{
    sort_list(&frame->lost, frame_order_lost_groups, frame->arena);
    for (size_t i = 0; i < frame->lost.count; i++) {
        struct lost_group *group = &frame->lost.items[i];
        if (stage == NULL || frame_same_name(group->stage, stage))
            sort_list(&group->echoes, frame_order_echo_ids, frame->arena);
    }
    frame->ordered.lost = frame->lost.count;
}

static void order_counts(struct frame *frame)
{
    sort_list(&frame->counts, frame_order_names, frame->arena);
    for (size_t i = 0; i < frame->counts.count; i++)
        sort_list(&frame->counts.items[i].paths, compare_paths, frame->arena);
    frame->ordered.counts = frame->counts.count;
}

void frame_order_parts(struct frame *frame, struct frame_parts written)
{
    if ((written.parts & PART_OBJECTS) != 0)
        frame->by_id.count = 0;
    if ((written.parts & PART_VEHICLES) != 0)
        sort_list(&frame->vehicles, frame_order_names, frame->arena);
    if ((written.parts & PART_REFLECTORS) != 0)
        order_sets(frame);
    if ((written.parts & PART_SENSORS) != 0)
        sort_list(&frame->sensors.list, frame_order_names, frame->arena);
    if ((written.parts & PART_ECHOES) != 0)
        sort_list(&frame->echoes, frame_order_echoes, frame->arena);
    if ((written.parts & PART_CELLS) != 0)
        order_cells(frame);
    if ((written.parts & PART_TARGETS) != 0)
        sort_list(&frame->targets, frame_order_names, frame->arena); /* stable: lists stay */
    if ((written.parts & PART_LOST) != 0)
        order_lost(frame, written.stage);
    if ((written.parts & PART_COUNTS) != 0)
        order_counts(frame);
    if ((written.parts & PART_VISIBILITY) != 0)
        sort_list(&frame->visibility, frame_order_sightings, frame->arena);
}

void frame_order(struct frame *frame)
{
    frame_order_parts(frame, (struct frame_parts){.parts = ~0U});
}

int frame_order_tied(const struct contributor *a, const struct contributor *b)
{
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    if (a->range_rate_mps != b->range_rate_mps)
        return a->range_rate_mps < b->range_rate_mps ? -1 : 1;
    if (a->azimuth_rad != b->azimuth_rad)
        return a->azimuth_rad < b->azimuth_rad ? -1 : 1;
    return compare_echo_ids(a->id, b->id);
}
