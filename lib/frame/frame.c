#include "frame/frame.h"

#include <assert.h>
#include <complex.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "frame/frame_order.h"

const char *const frame_paths[] = {
    [PATH_DIRECT] = "direct",
    [PATH_WALL_OBJECT] = "wall_object",
    [PATH_OBJECT_WALL] = "object_wall",
    [PATH_WALL_OBJECT_WALL] = "wall_object_wall",
    [PATH_WHEEL] = "wheel",
    [PATH_LIMB] = "limb",
    [PATH_CLUTTER] = "clutter",
    [PATH_FALSE_ALARM] = "false_alarm",
    NULL,
};

const char *const frame_losses[] = {
#define LOSS(id, name, effect) name,
#include "frame/losses.def"
    NULL,
};

static const enum effect_id losing_effects[] = {
#define LOSS(id, name, effect) EFFECT_##effect,
#include "frame/losses.def"
};

void frame_clear(struct frame *frame)
{
    const struct frame before = *frame;
    arena_clear(before.arena);
    field_clear(&frame_record, frame);
    frame->arena = before.arena;
    frame->list_cache = before.list_cache;
}

const char *frame_part_name(enum frame_part part)
{
    for (const struct field *field = frame_record.fields; field->name != NULL; field++)
        if (field->group == part)
            return field->name;
    return "?";
}

const char *frame_loss_words(const struct lost_group *group, struct arena *arena)
{
    if (frame_loss_of(group->reason) != LOSS_OWN)
        return group->reason;
    return arena_format(arena, "%s: %s", group->stage, group->reason);
}

bool frame_shows_object(enum path path)
{
    return path == PATH_DIRECT || path == PATH_WHEEL || path == PATH_LIMB;
}

bool frame_has_object(enum path path)
{
    return path != PATH_CLUTTER && path != PATH_FALSE_ALARM;
}

struct object *frame_object_of(const struct frame *frame, const struct echo_id *echo)
{
    return frame_has_object(echo->path) ? frame_object(frame, echo->object) : NULL;
}

bool frame_same_object(const struct echo_id *a, const struct echo_id *b)
{
    return frame_has_object(a->path) == frame_has_object(b->path) &&
           frame_same_name(a->object, b->object);
}

struct vec2 frame_target_place(const struct target *target)
{
    struct vec2 place_m = vec2_scale(target->range_m, vec2_heading(target->azimuth_rad));
    if ((target->present & VALUE_ELEVATION) == 0)
        return place_m;
    double up_m = target->range_m * elementary_sin(target->elevation_rad);
    double ahead_m = sqrt(elementary_max(place_m.x * place_m.x - up_m * up_m, 0));
    return (struct vec2){copysign(ahead_m, place_m.x), place_m.y};
}

const struct contributor *frame_strongest(const struct target *target)
{
    const struct contributor *strongest = NULL;
    for (size_t i = 0; i < target->contributors.count; i++)
        if (strongest == NULL || target->contributors.items[i].weight > strongest->weight)
            strongest = &target->contributors.items[i];
    return strongest;
}

void frame_drop(struct frame *frame, unsigned parts)
{
    for (const struct field *field = frame_record.fields; field->name != NULL; field++) {
        if ((field->group & parts) == 0)
            continue;
        size_t size =
            field->kind == FIELD_RECORD ? field->record->size : sizeof(LIST_OF(struct object));
        memset((char *)frame + field->offset, 0, size);
    }
    frame->ordered.lost *= frame->lost.count > 0;
    frame->ordered.counts *= frame->counts.count > 0;
    frame->present &= ~parts;
    frame_alter(frame, parts);
}

static int has_id(const void *id, const void *object)
{
    return strcmp(id, (*(struct object *const *)object)->id);
}

struct object *frame_object(const struct frame *frame, const char *id)
{
    assert((frame->line.unread & PART_OBJECTS) == 0);
    size_t count = frame->objects.count;
    if (count > 0 && frame->by_id.count == count) {
        struct object **found = bsearch(id, frame->by_id.items, count, sizeof *found, has_id);
        return found != NULL ? *found : NULL;
    }
    for (size_t i = 0; i < count; i++)
        if (frame_same_name(frame->objects.items[i].id, id))
            return &frame->objects.items[i];
    return NULL;
}

bool frame_measured(const struct frame *frame)
{
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured)
            return true;
    return false;
}

bool frame_detects(const struct frame *frame, const char *object)
{
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        for (size_t j = 0; j < target->contributors.count; j++) {
            const struct echo_id *echo = &target->contributors.items[j].id;
            if (frame_has_object(echo->path) && frame_same_name(echo->object, object))
                return true;
        }
    }
    return false;
}

struct motion frame_motion(const struct object *object, double age_s)
{
    struct motion now = {
        .position_m = {object->x_m, object->y_m},
        .velocity_mps = {object->vx_mps, object->vy_mps},
        .yaw_rad = object->yaw_rad,
        .yaw_rate_radps = object->yaw_rate_radps,
    };
    return age_s == 0 ? now : motion_after(now, -age_s);
}

struct object frame_object_in(struct object object, struct motion motion)
{
    object.x_m = motion.position_m.x;
    object.y_m = motion.position_m.y;
    object.yaw_rad = motion.yaw_rad;
    object.vx_mps = motion.velocity_mps.x;
    object.vy_mps = motion.velocity_mps.y;
    object.yaw_rate_radps = motion.yaw_rate_radps;
    return object;
}

/* One of the items in canonical order that begin with this name, or NULL. */
static void *find_named(const void *items, size_t count, size_t size, const char *name)
{
    return count == 0 ? NULL : bsearch(&name, items, count, size, frame_order_names);
}

#define FIND_NAMED(list, name)                                                                     \
    find_named((list)->items, (list)->count, sizeof *(list)->items, (name))

/* All items in canonical order that begin with this name: the first of them, or NULL, and their
 * number. */
static const void *run_named(const void *items, size_t count, size_t size, const char *name,
                             size_t *run)
{
    const char *first = find_named(items, count, size, name), *begin = items;
    const char *end = first;
    *run = 0;
    if (first == NULL)
        return NULL;
    while (first > begin &&
           frame_same_name(*(const char *const *)(const void *)(first - size), name))
        first -= size;
    while (end < begin + count * size &&
           frame_same_name(*(const char *const *)(const void *)end, name))
        end += size;
    *run = (size_t)(end - first) / size;
    return first;
}

#define RUN_NAMED(list, name, run)                                                                 \
    run_named((list)->items, (list)->count, sizeof *(list)->items, (name), (run))

struct document_span frame_documents_of(const struct frame *frame, const char *class)
{
    size_t count;
    const struct class_document *first = RUN_NAMED(&frame->vehicles, class, &count);
    return (struct document_span){first, count};
}

double frame_rear_axle_x_m(const struct frame *frame, const struct object *object)
{
    struct document_span documents = frame_documents_of(frame, object->class);
    for (size_t i = 0; i < documents.count; i++)
        if (documents.items[i].rear_axle_x_m != 0)
            return documents.items[i].rear_axle_x_m;
    return -1.25 / 4.5 * object->length_m;
}

const struct sensor_view *frame_view(const struct frame *frame, const char *sensor)
{
    return FIND_NAMED(&frame->sensors.list, sensor);
}

struct echo_span frame_echoes_of(const struct frame *frame, const char *sensor)
{
    size_t count;
    const struct echo *first = RUN_NAMED(&frame->echoes, sensor, &count);
    return (struct echo_span){first, count};
}

struct cell_span frame_cells_of(const struct frame *frame, const char *sensor)
{
    size_t count;
    const struct cell *first = RUN_NAMED(&frame->cells, sensor, &count);
    return (struct cell_span){first, count};
}

struct contributor frame_contributor(const struct echo *echo)
{
    return (struct contributor){
        .id = echo->id,
        .range_m = echo->range_m,
        .azimuth_rad = echo->azimuth_rad,
        .elevation_rad = echo->elevation_rad,
        .range_rate_mps = echo->range_rate_mps,
        .ercs = echo->ercs,
        .time_s = echo->time_s,
        .present = echo->present,
    };
}

/* The group of a sensor, stage and reason, or NULL: one of the new groups of that sensor, which are
 * the last ones, or one of the groups in canonical order. */
static struct lost_group *find_group(const struct frame *frame, const struct lost_group *wanted)
{
    struct lost_group *groups = frame->lost.items;
    size_t ordered = frame->ordered.lost, at = frame->lost.count;
    while (at > ordered && frame_same_name(groups[at - 1].sensor, wanted->sensor))
        if (frame_same_name(groups[--at].reason, wanted->reason) &&
            frame_same_name(groups[at].stage, wanted->stage))
            return &groups[at];
    return ordered == 0 ? NULL
                        : bsearch(wanted, groups, ordered, sizeof *groups, frame_order_lost_groups);
}

static void lose(struct frame *frame, struct lost_group kind, const struct lost_echo *echo)
{
    if (!frame_carries(frame, CARRY_ACCOUNT))
        return;
    struct lost_group *group = find_group(frame, &kind);
    if (group == NULL) {
        group = list_add(&frame->lost, frame->arena);
        *group = kind;
        frame->present |= PART_LOST;
    }
    struct lost_echo *added = list_add(&group->echoes, frame->arena);
    *added = *echo;
    added->range_m = round(echo->range_m * 1e3) / 1e3;
    added->azimuth_rad = round(echo->azimuth_rad * 1e5) / 1e5;
}

void frame_lose(struct frame *frame, const char *stage, const char *sensor, enum loss reason,
                const struct lost_echo *echo)
{
    struct lost_group kind = {sensor, stage, frame_losses[reason], losing_effects[reason], {0}};
    lose(frame, kind, echo);
}

void frame_lose_own(struct frame *frame, const char *stage, const char *sensor, const char *reason,
                    const struct lost_echo *echo)
{
    lose(frame, (struct lost_group){sensor, stage, reason, EFFECT_NONE, {0}}, echo);
}

struct lost_echo frame_lost_echo(const struct contributor *echo, const struct margins *margins)
{
    return (struct lost_echo){.id = echo->id,
                              .range_m = echo->range_m,
                              .azimuth_rad = echo->azimuth_rad,
                              .margins = *margins};
}

void frame_lose_cell(struct frame *frame, const char *stage, const struct cell *cell,
                     enum loss reason, double shortfall_db, const struct margins *margins)
{
    for (size_t i = 0; i < cell->members.count; i++) {
        struct lost_echo lost = frame_lost_echo(&cell->members.items[i], margins);
        lost.shortfall_db = shortfall_db;
        frame_lose(frame, stage, cell->sensor, reason, &lost);
    }
}

static struct count *count_of(struct frame *frame, const char *sensor)
{
    struct count *items = frame->counts.items;
    size_t known = frame->counts.count;
    if (known > 0 && frame_same_name(items[known - 1].sensor, sensor))
        return &items[known - 1];
    struct count *count = find_named(items, frame->ordered.counts, sizeof *items, sensor);
    if (count == NULL)
        count = list_add(&frame->counts, frame->arena);
    count->sensor = sensor;
    return count;
}

void frame_count_echoes(struct frame *frame, const char *sensor, enum path path, int64_t echoes)
{
    struct count *count = count_of(frame, sensor);
    for (size_t i = 0; i < count->paths.count; i++)
        if (count->paths.items[i].path == path) {
            count->paths.items[i].echoes += echoes;
            return;
        }
    *list_add(&count->paths, frame->arena) = (struct path_count){path, echoes};
}

void frame_count_pairs(struct frame *frame, const char *sensor, int64_t pairs)
{
    count_of(frame, sensor)->pairs += pairs;
}

int64_t frame_counted_echoes(const struct count *count, enum path path)
{
    int64_t echoes = 0;
    for (size_t i = 0; i < count->paths.count; i++)
        echoes += count->paths.items[i].path == path ? count->paths.items[i].echoes : 0;
    return echoes;
}

struct target *frame_add_target(struct frame *frame, const struct cell *cell, double amplitude_db)
{
    struct target *target = list_add(&frame->targets, frame->arena);
    *target = (struct target){
        .sensor = cell->sensor,
        .range_m = cell->range_m,
        .azimuth_rad = cell->azimuth_rad,
        .elevation_rad = cell->elevation_rad,
        .range_rate_mps = cell->range_rate_mps,
        .amplitude_db = amplitude_db,
        .sign_undecided = cell->sign_undecided,
        .cell_range_m = cell->range_m,
        .cell_azimuth_rad = cell->azimuth_rad,
        .cell_elevation_rad = cell->elevation_rad,
        .cell_range_rate_mps = cell->range_rate_mps,
        .cell_amplitude = cell->amplitude,
        .cell_sum = elementary_hypot(cell->sum_re, cell->sum_im),
        .effects = cell->effects,
        .margins = cell->margins,
        .present = cell->present,
    };
    target->contributors.items = cell->members.items;
    target->contributors.count = cell->members.count;
    return target;
}

struct antenna_pointers frame_cell_pointers(const struct cell *cell)
{
    const double _Complex i = (double _Complex)I;
    return (struct antenna_pointers){
        .sum = cell->sum_re + i * cell->sum_im,
        .delta = cell->delta_re + i * cell->delta_im,
    };
}

static uint64_t hash_echo_id(struct echo_id id)
{
    uint64_t hash = hash_text(hash_text(HASH_START, id.object), id.reflector);
    hash = hash_bytes(hash, &(char){(char)id.path}, 1);
    if (id.mirror != NULL)
        hash = hash_text(hash, id.mirror);
    for (uint64_t rest = (uint64_t)id.number; rest > 0; rest >>= 8)
        hash = hash_bytes(hash, &(char){(char)rest}, 1);
    return hash;
}

struct random_address frame_draw_address_of_scene(const struct frame *frame)
{
    return (struct random_address){.seed = frame->seed,
                                   .scene = hash_text(HASH_START, frame->scene)};
}

struct random_address frame_draw_address_of_scan(const struct frame *frame, const char *sensor)
{
    struct random_address address = frame_draw_address_of_scene(frame);
    address.frame = (uint64_t)frame->frame;
    address.sensor = hash_text(HASH_START, sensor);
    return address;
}

struct random_address frame_draw_address_in(struct random_address scan, struct echo_id id)
{
    scan.item = hash_echo_id(id);
    return scan;
}

struct random_address frame_draw_address_of(const struct frame *frame, const char *sensor,
                                            struct echo_id id)
{
    return frame_draw_address_in(frame_draw_address_of_scan(frame, sensor), id);
}
