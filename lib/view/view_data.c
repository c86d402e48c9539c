#include "view/view_data.h"

#include "base/sort.h"

/* The numbers that tell what a lost echo is and why it is lost. The columns DETAIL_OBJECT to
 * DETAIL_NUMBER have the first of them, the columns ITEM_REFLECTOR to ITEM_EFFECT all but the
 * object, in this order. */
enum {
    LOST_OBJECT,
    LOST_REFLECTOR,
    LOST_PATH,
    LOST_MIRROR,
    LOST_NUMBER,
    LOST_STAGE,
    LOST_REASON,
    LOST_EFFECT,
    LOST_NUMBERS,
};

/* A lost echo, before it is added to its object's pattern. */
struct loss_row {
    uint32_t of[LOST_NUMBERS];
};

void view_data_real(struct view_data *data, enum view_column column, double value)
{
    float real = (float)value;
    memcpy(list_add(&data->columns.list[column], data->arena), &real, sizeof real);
}

void view_data_count(struct view_data *data, enum view_column column, uint32_t value)
{
    *list_add(&data->columns.list[column], data->arena) = value;
}

static uint32_t name_of(struct view_data *data, const char *word)
{
    return intern_word(&data->names, word, data->arena);
}

/* The number of a name plus 1; 0 for no name. */
static uint32_t optional_name(struct view_data *data, const char *word)
{
    return word != NULL ? 1 + name_of(data, word) : 0;
}

void view_data_begin(struct view_data *data, struct arena *arena)
{
    *data = (struct view_data){.arena = arena, .models = {.arena = arena}};
}

static uint32_t scene_of(struct view_data *data, const struct frame *frame)
{
    const uint64_t key[] = {name_of(data, frame->scene), frame->seed};
    uint32_t number = intern_number(&data->scene_keys, key, sizeof key, data->arena);
    if (number == data->scenes.count) {
        const struct object *ego = frame_object(frame, frame->ego);
        bool has_sensors = (frame->present & SECTION_SENSORS) != 0;
        *list_add(&data->scenes, data->arena) = (struct view_scene){
            .name = (int64_t)key[0],
            .seed = frame->seed,
            .ego = name_of(data, frame->ego),
            .suite = name_of(data, has_sensors ? frame->sensors.suite : ""),
            .first_frame = frame->frame,
            .start_s = frame->time_s,
            .anchor_x_m = frame->origin_x_m + ego->x_m,
            .anchor_y_m = frame->origin_y_m + ego->y_m,
        };
    }
    if (frame->last)
        data->scenes.items[number].ended = true;
    return number;
}

static bool same_sensor(const struct sensor_view *a, const struct sensor_view *b)
{
    return strcmp(a->name, b->name) == 0 && a->mount_x_m == b->mount_x_m &&
           a->mount_y_m == b->mount_y_m && a->mount_yaw_rad == b->mount_yaw_rad &&
           a->field_of_view_rad == b->field_of_view_rad && a->range_max_m == b->range_max_m &&
           a->cell_range_m == b->cell_range_m && a->carrier_hz == b->carrier_hz &&
           a->cell_range_rate_mps == b->cell_range_rate_mps;
}

static uint32_t sensor_of(struct view_data *data, const struct sensor_view *sensor)
{
    for (size_t i = 0; i < data->sensors.count; i++)
        if (same_sensor(&data->sensors.items[i], sensor))
            return (uint32_t)i;
    struct sensor_view *copy = list_add(&data->sensors, data->arena);
    *copy = *sensor;
    copy->name = arena_text(data->arena, sensor->name, strlen(sensor->name));
    return (uint32_t)data->sensors.count - 1;
}

/* What the rows of view_columns.def that have a member call, by their word. */
#define add_real view_data_real
#define add_count(data, column, value) view_data_count(data, column, (uint32_t)(value))
#define add_word(data, column, value) view_data_count(data, column, name_of(data, value))

static void add_object(struct view_data *data, const struct object *object, struct vec2 shift)
{
    struct box box = view_frame_box(object, view_frame_vehicle(&data->models, object->class));
    view_data_real(data, COLUMN_OBJECT_X, object->x_m + shift.x);
    view_data_real(data, COLUMN_OBJECT_Y, object->y_m + shift.y);
    view_data_real(data, COLUMN_OBJECT_YAW, remainder(object->yaw_rad, 2 * acos(-1)));
    view_data_real(data, COLUMN_OBJECT_LENGTH, box.length_m);
    view_data_real(data, COLUMN_OBJECT_WIDTH, box.width_m);
#define OBJECT(name, key, how, member) add_##how(data, COLUMN_##name, object->member);
#include "view/view_columns.def"
}

static void add_contributor(struct view_data *data, const struct contributor *from)
{
#define CONTRIBUTOR(name, key, how, member) add_##how(data, COLUMN_##name, from->member);
#include "view/view_columns.def"
    view_data_count(data, COLUMN_CONTRIBUTOR_MIRROR, optional_name(data, from->id.mirror));
}

/* Adds a row with every member of the quality, in the order of its table, if the target has one. */
static void add_quality(struct view_data *data, const struct quality *quality)
{
    view_data_count(data, COLUMN_TARGET_QUALITY, quality->present != 0);
    enum view_column column = COLUMN_QUALITY_SNR_DB;
    for (const struct field *field = quality_record.fields; field->name != NULL;
         field++, column++) {
        if (quality->present == 0)
            continue;
        double value = field->kind == FIELD_REAL      ? FIELD_LOAD(double, field, quality)
                       : field->kind == FIELD_INTEGER ? (double)FIELD_LOAD(int64_t, field, quality)
                                                      : FIELD_LOAD(bool, field, quality);
        view_data_real(data, column,
                       (quality->present & field->section) != 0 ? value : (double)NAN);
    }
}

static void add_target(struct view_data *data, const struct target *target)
{
#define TARGET(name, key, how, member) add_##how(data, COLUMN_##name, target->member);
#include "view/view_columns.def"
    view_data_count(
        data, COLUMN_TARGET_EFFECTS,
        intern_number(&data->effect_sets, &target->effects, sizeof target->effects, data->arena));
    for (size_t i = 0; i < target->contributors.count; i++)
        add_contributor(data, &target->contributors.items[i]);
    add_quality(data, &target->quality);
}

static uint32_t add_targets(struct view_data *data, const struct frame *frame, const char *sensor)
{
    uint32_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++)
        if (strcmp(frame->targets.items[i].sensor, sensor) == 0) {
            add_target(data, &frame->targets.items[i]);
            count++;
        }
    return count;
}

static void add_detail(struct view_data *data, const struct loss_row *row,
                       const struct lost_echo *echo)
{
    view_data_real(data, COLUMN_DETAIL_SHORTFALL, echo->shortfall_db);
    view_data_real(data, COLUMN_DETAIL_RANGE, echo->range_m);
    view_data_real(data, COLUMN_DETAIL_AZIMUTH, echo->azimuth_rad);
    for (int i = LOST_OBJECT; i <= LOST_NUMBER; i++)
        view_data_count(data, COLUMN_DETAIL_OBJECT + i, row->of[i]);
    view_data_count(data, COLUMN_DETAIL_BY, optional_name(data, echo->by));
}

/* Orders by object; within one, in any order that is the same for the same losses. */
static int compare_rows(const void *left, const void *right)
{
    const struct loss_row *a = left, *b = right;
    for (int i = LOST_OBJECT; i <= LOST_REASON; i++)
        if (a->of[i] != b->of[i])
            return a->of[i] < b->of[i] ? -1 : 1;
    return 0;
}

/* A scan whose losses are packed. */
struct loss_scan {
    const struct frame *frame;
    struct view_scan scan;
    uint32_t scene;
    LIST_OF(struct loss_row) rows;
};

/* The spot of a reflector. The first loss that needs no other detail says where it is. */
static struct vec2 spot_of(struct view_data *data, uint32_t scene, const struct loss_row *row,
                           struct vec2 place)
{
    const uint32_t key[] = {scene, row->of[LOST_OBJECT], row->of[LOST_REFLECTOR]};
    uint32_t number = intern_number(&data->spot_keys, key, sizeof key, data->arena);
    if (number == data->spots.count) {
        *list_add(&data->spots, data->arena) = place;
        view_data_real(data, COLUMN_SPOT_X, place.x);
        view_data_real(data, COLUMN_SPOT_Y, place.y);
        view_data_count(data, COLUMN_SPOT_SCENE, scene);
        view_data_count(data, COLUMN_SPOT_OBJECT, row->of[LOST_OBJECT]);
        view_data_count(data, COLUMN_SPOT_REFLECTOR, row->of[LOST_REFLECTOR]);
    }
    return data->spots.items[number];
}

/* True if the loss was within 5 cm of its reflector's spot, or if its place is not known. */
static bool is_at_spot(struct view_data *data, const struct loss_scan *scan,
                       const struct loss_row *row, const struct lost_echo *echo)
{
    const struct object *object = frame_object(scan->frame, echo->id.object);
    if (echo->range_m == 0)
        return true;
    if (object == NULL)
        return false;
    struct motion body = frame_motion(object, scan->scan.age_s);
    struct vec2 place = vec2_turn_back(
        vec2_sub(view_frame_place(&scan->scan, echo->range_m, echo->azimuth_rad), body.position_m),
        vec2_heading(body.yaw_rad));
    struct vec2 spot = spot_of(data, scan->scene, row, place);
    return vec2_length(vec2_sub(place, spot)) <= 0.05;
}

static uint32_t reason_of(struct view_data *data, const struct lost_group *group,
                          struct arena *scratch)
{
    enum loss loss = frame_loss_of(group->reason);
    if (loss != LOSS_OWN)
        return loss;
    return LOSS_OWN +
           intern_word(&data->own_reasons, frame_loss_words(group, scratch), data->arena);
}

static uint32_t collect_losses(struct view_data *data, const struct lost_group *group,
                               struct loss_scan *scan)
{
    uint32_t stage = name_of(data, group->stage), details = 0;
    uint32_t reason = reason_of(data, group, scan->frame->arena);
    for (size_t i = 0; i < group->echoes.count; i++) {
        const struct lost_echo *echo = &group->echoes.items[i];
        struct loss_row *row = list_add(&scan->rows, scan->frame->arena);
        row->of[LOST_OBJECT] = name_of(data, echo->id.object);
        row->of[LOST_REFLECTOR] = name_of(data, echo->id.reflector);
        row->of[LOST_PATH] = echo->id.path;
        row->of[LOST_MIRROR] = optional_name(data, echo->id.mirror);
        row->of[LOST_NUMBER] = (uint32_t)echo->id.number;
        row->of[LOST_STAGE] = stage;
        row->of[LOST_REASON] = reason;
        row->of[LOST_EFFECT] = group->effect;
        if (echo->by != NULL || echo->shortfall_db != 0 || !is_at_spot(data, scan, row, echo)) {
            add_detail(data, row, echo);
            details++;
        }
    }
    return details;
}

static void add_fate(struct view_data *data, const struct loss_row *rows, size_t count,
                     struct arena *scratch)
{
    enum { ITEM = LOST_NUMBERS - LOST_REFLECTOR };
    uint32_t *items = arena_get(scratch, count * ITEM * sizeof *items);
    for (size_t i = 0; i < count; i++)
        memcpy(items + i * ITEM, rows[i].of + LOST_REFLECTOR, ITEM * sizeof *items);
    view_data_count(data, COLUMN_FATE_OBJECT, rows->of[LOST_OBJECT]);
    size_t known = data->patterns.list.count, size = count * ITEM * sizeof *items;
    uint32_t pattern = intern_number(&data->patterns, items, size, data->arena);
    view_data_count(data, COLUMN_FATE_PATTERN, pattern);
    if (pattern < known)
        return;
    view_data_count(data, COLUMN_PATTERN_ITEMS, (uint32_t)count);
    for (size_t i = 0; i < count * ITEM; i++)
        view_data_count(data, COLUMN_ITEM_REFLECTOR + i % ITEM, items[i]);
}

static void add_losses(struct view_data *data, struct loss_scan *scan, const char *sensor)
{
    const struct frame *frame = scan->frame;
    uint32_t details = 0, fates = 0;
    for (size_t i = 0; i < frame->lost.count; i++)
        if (strcmp(frame->lost.items[i].sensor, sensor) == 0)
            details += collect_losses(data, &frame->lost.items[i], scan);
    sort_list(&scan->rows, compare_rows, frame->arena);
    const struct loss_row *rows = scan->rows.items;
    for (size_t begin = 0, end; begin < scan->rows.count; begin = end, fates++) {
        for (end = begin; end < scan->rows.count; end++)
            if (rows[end].of[LOST_OBJECT] != rows[begin].of[LOST_OBJECT])
                break;
        add_fate(data, rows + begin, end - begin, frame->arena);
    }
    view_data_count(data, COLUMN_SCAN_FATES, fates);
    view_data_count(data, COLUMN_SCAN_DETAILS, details);
}

static void add_sightings(struct view_data *data, const struct frame *frame, const char *sensor)
{
    uint32_t count = 0;
    for (size_t i = 0; i < frame->visibility.count; i++) {
        const struct sighting *sighting = &frame->visibility.items[i];
        if (strcmp(sighting->sensor, sensor) != 0)
            continue;
        count++;
#define SIGHTING(name, key, how, member) add_##how(data, COLUMN_##name, sighting->member);
#include "view/view_columns.def"
    }
    view_data_count(data, COLUMN_SCAN_SIGHTINGS, count);
}

static void add_scan(struct view_data *data, const struct frame *frame, uint32_t scene,
                     const struct sensor_view *sensor, struct vec2 shift)
{
    struct view_scan scan = view_frame_scan(frame, sensor);
    view_data_real(data, COLUMN_SCAN_X, scan.pose.position_m.x + shift.x);
    view_data_real(data, COLUMN_SCAN_Y, scan.pose.position_m.y + shift.y);
    view_data_real(data, COLUMN_SCAN_YAW, remainder(scan.pose.yaw_rad, 2 * acos(-1)));
    view_data_real(data, COLUMN_SCAN_VX, scan.pose.velocity_mps.x);
    view_data_real(data, COLUMN_SCAN_VY, scan.pose.velocity_mps.y);
    view_data_real(data, COLUMN_SCAN_AGE, scan.age_s);
    view_data_count(data, COLUMN_SCAN_SENSOR, sensor_of(data, sensor));
    view_data_count(data, COLUMN_SCAN_MEASURED, sensor->measured);
    view_data_count(data, COLUMN_SCAN_TARGETS, add_targets(data, frame, sensor->name));
    add_losses(data, &(struct loss_scan){.frame = frame, .scan = scan, .scene = scene},
               sensor->name);
    add_sightings(data, frame, sensor->name);
}

void view_data_name(struct view_data *data, enum view_column column, const char *word)
{
    view_data_count(data, column, optional_name(data, word));
}

struct vec2 view_data_shift(struct view_data *data, const struct frame *frame)
{
    const struct view_scene *scene = &data->scenes.items[scene_of(data, frame)];
    return (struct vec2){frame->origin_x_m - scene->anchor_x_m,
                         frame->origin_y_m - scene->anchor_y_m};
}

void view_data_add(struct view_data *data, const struct frame *frame)
{
    uint32_t number = scene_of(data, frame);
    const struct view_scene *scene = &data->scenes.items[number];
    struct vec2 shift = view_data_shift(data, frame);
    view_data_real(data, COLUMN_FRAME_TIME, frame->time_s - scene->start_s);
    view_data_count(data, COLUMN_FRAME_SCENE, number);
    view_data_count(data, COLUMN_FRAME_NUMBER, (uint32_t)(frame->frame - scene->first_frame));
    view_data_count(data, COLUMN_FRAME_ACCOUNT, frame_carries(frame, CARRY_ACCOUNT));
    view_data_count(data, COLUMN_FRAME_OBJECTS, (uint32_t)frame->objects.count);
    view_data_count(data, COLUMN_FRAME_SCANS, (uint32_t)frame->sensors.list.count);
    for (size_t i = 0; i < frame->objects.count; i++)
        add_object(data, &frame->objects.items[i], shift);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        add_scan(data, frame, number, &frame->sensors.list.items[i], shift);
}
