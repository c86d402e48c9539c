#include "view_data.h"

#include <inttypes.h>
#include <string.h>

#include "number.h"
#include "sort.h"

/* Real columns first. */
enum column {
    FRAME_TIME,
    OBJECT_X,
    OBJECT_Y,
    OBJECT_YAW,
    OBJECT_VX,
    OBJECT_VY,
    OBJECT_LENGTH,
    OBJECT_WIDTH,
    SCAN_X,
    SCAN_Y,
    SCAN_YAW,
    SCAN_VX,
    SCAN_VY,
    SCAN_AGE,
    TARGET_RANGE,
    TARGET_AZIMUTH,
    TARGET_RATE,
    TARGET_AMPLITUDE,
    TARGET_CELL_RANGE,
    TARGET_CELL_AZIMUTH,
    TARGET_CELL_RATE,
    TARGET_CELL_AMPLITUDE,
    CONTRIBUTOR_RANGE,
    CONTRIBUTOR_AZIMUTH,
    CONTRIBUTOR_RATE,
    CONTRIBUTOR_ERCS,
    CONTRIBUTOR_WEIGHT,
    DETAIL_SHORTFALL,
    FIRST_COUNT,
    FRAME_SCENE = FIRST_COUNT,
    FRAME_NUMBER,
    FRAME_OBJECTS,
    FRAME_SCANS,
    OBJECT_ID,
    OBJECT_CLASS,
    SCAN_SENSOR,
    SCAN_MEASURED,
    SCAN_TARGETS,
    SCAN_FATES,
    SCAN_DETAILS,
    TARGET_UNDECIDED,
    TARGET_EFFECTS,
    TARGET_CONTRIBUTORS,
    CONTRIBUTOR_OBJECT,
    CONTRIBUTOR_REFLECTOR,
    CONTRIBUTOR_PATH,
    CONTRIBUTOR_MIRROR,
    CONTRIBUTOR_NUMBER,
    FATE_OBJECT,
    FATE_PATTERN,
    DETAIL_OBJECT,
    DETAIL_REFLECTOR,
    DETAIL_PATH,
    DETAIL_MIRROR,
    DETAIL_NUMBER,
    DETAIL_BY,
    PATTERN_ITEMS,
    ITEM_REFLECTOR,
    ITEM_PATH,
    ITEM_MIRROR,
    ITEM_NUMBER,
    ITEM_STAGE,
    ITEM_REASON,
    ITEM_EFFECT,
    COLUMNS
};

static const char *const column_names[COLUMNS] = {
    [FRAME_TIME] = "frame_time_s",
    [OBJECT_X] = "object_x_m",
    [OBJECT_Y] = "object_y_m",
    [OBJECT_YAW] = "object_yaw_rad",
    [OBJECT_VX] = "object_vx_mps",
    [OBJECT_VY] = "object_vy_mps",
    [OBJECT_LENGTH] = "object_length_m",
    [OBJECT_WIDTH] = "object_width_m",
    [SCAN_X] = "scan_x_m",
    [SCAN_Y] = "scan_y_m",
    [SCAN_YAW] = "scan_yaw_rad",
    [SCAN_VX] = "scan_vx_mps",
    [SCAN_VY] = "scan_vy_mps",
    [SCAN_AGE] = "scan_age_s",
    [TARGET_RANGE] = "target_range_m",
    [TARGET_AZIMUTH] = "target_azimuth_rad",
    [TARGET_RATE] = "target_range_rate_mps",
    [TARGET_AMPLITUDE] = "target_amplitude_db",
    [TARGET_CELL_RANGE] = "target_cell_range_m",
    [TARGET_CELL_AZIMUTH] = "target_cell_azimuth_rad",
    [TARGET_CELL_RATE] = "target_cell_range_rate_mps",
    [TARGET_CELL_AMPLITUDE] = "target_cell_amplitude",
    [CONTRIBUTOR_RANGE] = "contributor_range_m",
    [CONTRIBUTOR_AZIMUTH] = "contributor_azimuth_rad",
    [CONTRIBUTOR_RATE] = "contributor_range_rate_mps",
    [CONTRIBUTOR_ERCS] = "contributor_ercs",
    [CONTRIBUTOR_WEIGHT] = "contributor_weight",
    [DETAIL_SHORTFALL] = "detail_shortfall_db",
    [FRAME_SCENE] = "frame_scene",
    [FRAME_NUMBER] = "frame_number",
    [FRAME_OBJECTS] = "frame_objects",
    [FRAME_SCANS] = "frame_scans",
    [OBJECT_ID] = "object_id",
    [OBJECT_CLASS] = "object_class",
    [SCAN_SENSOR] = "scan_sensor",
    [SCAN_MEASURED] = "scan_measured",
    [SCAN_TARGETS] = "scan_targets",
    [SCAN_FATES] = "scan_fates",
    [SCAN_DETAILS] = "scan_details",
    [TARGET_UNDECIDED] = "target_sign_undecided",
    [TARGET_EFFECTS] = "target_effects",
    [TARGET_CONTRIBUTORS] = "target_contributors",
    [CONTRIBUTOR_OBJECT] = "contributor_object",
    [CONTRIBUTOR_REFLECTOR] = "contributor_reflector",
    [CONTRIBUTOR_PATH] = "contributor_path",
    [CONTRIBUTOR_MIRROR] = "contributor_mirror",
    [CONTRIBUTOR_NUMBER] = "contributor_number",
    [FATE_OBJECT] = "fate_object",
    [FATE_PATTERN] = "fate_pattern",
    [DETAIL_OBJECT] = "detail_object",
    [DETAIL_REFLECTOR] = "detail_reflector",
    [DETAIL_PATH] = "detail_path",
    [DETAIL_MIRROR] = "detail_mirror",
    [DETAIL_NUMBER] = "detail_number",
    [DETAIL_BY] = "detail_by",
    [PATTERN_ITEMS] = "pattern_items",
    [ITEM_REFLECTOR] = "item_reflector",
    [ITEM_PATH] = "item_path",
    [ITEM_MIRROR] = "item_mirror",
    [ITEM_NUMBER] = "item_number",
    [ITEM_STAGE] = "item_stage",
    [ITEM_REASON] = "item_reason",
    [ITEM_EFFECT] = "item_effect",
};

/* A lost reflector as patterns hold it. */
struct item {
    uint32_t reflector, path, mirror, number, stage, reason, effect;
};

/* A lost echo on its way into its object's pattern. */
struct loss_row {
    uint32_t object;
    struct item item;
};

static void add_real(struct view_data *data, enum column column, double value)
{
    *list_add(&data->columns[column].reals, data->arena) = (float)value;
}

static void add_count(struct view_data *data, enum column column, uint32_t value)
{
    *list_add(&data->columns[column].counts, data->arena) = value;
}

static uint32_t name_of(struct view_data *data, const char *word)
{
    return view_pool_word(&data->names, word, data->arena);
}

/* 0 stands for no name. */
static uint32_t optional_name(struct view_data *data, const char *word)
{
    return word != NULL ? 1 + name_of(data, word) : 0;
}

void view_data_begin(struct view_data *data, struct arena *arena)
{
    _Static_assert((int)COLUMNS <= (int)VIEW_COLUMN_LIMIT, "view_data.h has room for the columns");
    *data = (struct view_data){.arena = arena, .models = {.arena = arena}};
}

static uint32_t scene_of(struct view_data *data, const struct frame *frame)
{
    uint32_t number = view_pool_word(&data->scene_names, frame->scene, data->arena);
    if (number == data->scenes.count) {
        const struct object *ego = frame_object(frame, frame->ego);
        bool seen = (frame->present & SECTION_SENSORS) != 0;
        *list_add(&data->scenes, data->arena) = (struct view_scene){
            .name = name_of(data, frame->scene),
            .ego = name_of(data, frame->ego),
            .suite = name_of(data, seen ? frame->sensors.suite : ""),
            .first_frame = frame->frame,
            .start_s = frame->time_s,
            .anchor_x_m = frame->origin_x_m + ego->x_m,
            .anchor_y_m = frame->origin_y_m + ego->y_m,
            .account = frame->account,
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
           a->cell_range_m == b->cell_range_m && a->cell_range_rate_mps == b->cell_range_rate_mps;
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

static void add_object(struct view_data *data, const struct object *object, struct vec2 shift)
{
    struct box box = view_frame_box(object, view_frame_vehicle(&data->models, object->class));
    add_real(data, OBJECT_X, object->x_m + shift.x);
    add_real(data, OBJECT_Y, object->y_m + shift.y);
    add_real(data, OBJECT_YAW, remainder(object->yaw_rad, 2 * acos(-1)));
    add_real(data, OBJECT_VX, object->vx_mps);
    add_real(data, OBJECT_VY, object->vy_mps);
    add_real(data, OBJECT_LENGTH, box.length_m);
    add_real(data, OBJECT_WIDTH, box.width_m);
    add_count(data, OBJECT_ID, name_of(data, object->id));
    add_count(data, OBJECT_CLASS, name_of(data, object->class));
}

static void add_contributor(struct view_data *data, const struct contributor *from)
{
    add_real(data, CONTRIBUTOR_RANGE, from->range_m);
    add_real(data, CONTRIBUTOR_AZIMUTH, from->azimuth_rad);
    add_real(data, CONTRIBUTOR_RATE, from->range_rate_mps);
    add_real(data, CONTRIBUTOR_ERCS, from->ercs);
    add_real(data, CONTRIBUTOR_WEIGHT, from->weight);
    add_count(data, CONTRIBUTOR_OBJECT, name_of(data, from->object));
    add_count(data, CONTRIBUTOR_REFLECTOR, name_of(data, from->reflector));
    add_count(data, CONTRIBUTOR_PATH, from->path);
    add_count(data, CONTRIBUTOR_MIRROR, optional_name(data, from->mirror));
    add_count(data, CONTRIBUTOR_NUMBER, (uint32_t)from->number);
}

static void add_target(struct view_data *data, const struct target *target)
{
    add_real(data, TARGET_RANGE, target->range_m);
    add_real(data, TARGET_AZIMUTH, target->azimuth_rad);
    add_real(data, TARGET_RATE, target->range_rate_mps);
    add_real(data, TARGET_AMPLITUDE, target->amplitude_db);
    add_real(data, TARGET_CELL_RANGE, target->cell_range_m);
    add_real(data, TARGET_CELL_AZIMUTH, target->cell_azimuth_rad);
    add_real(data, TARGET_CELL_RATE, target->cell_range_rate_mps);
    add_real(data, TARGET_CELL_AMPLITUDE, target->cell_amplitude);
    add_count(data, TARGET_UNDECIDED, target->sign_undecided);
    add_count(data, TARGET_EFFECTS,
              view_pool_number(&data->effect_sets, &target->effects, sizeof target->effects,
                               data->arena));
    add_count(data, TARGET_CONTRIBUTORS, (uint32_t)target->contributors.count);
    for (size_t i = 0; i < target->contributors.count; i++)
        add_contributor(data, &target->contributors.items[i]);
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
    add_real(data, DETAIL_SHORTFALL, echo->shortfall_db);
    add_count(data, DETAIL_OBJECT, row->object);
    add_count(data, DETAIL_REFLECTOR, row->item.reflector);
    add_count(data, DETAIL_PATH, row->item.path);
    add_count(data, DETAIL_MIRROR, row->item.mirror);
    add_count(data, DETAIL_NUMBER, row->item.number);
    add_count(data, DETAIL_BY, optional_name(data, echo->by));
}

/* By object; within one, in any order that is the same for the same losses. */
static int compare_rows(const void *left, const void *right)
{
    const struct loss_row *a = left, *b = right;
    uint32_t keys[][2] = {
        {a->object, b->object},           {a->item.reflector, b->item.reflector},
        {a->item.path, b->item.path},     {a->item.mirror, b->item.mirror},
        {a->item.number, b->item.number}, {a->item.stage, b->item.stage},
        {a->item.reason, b->item.reason},
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i][0] != keys[i][1])
            return keys[i][0] < keys[i][1] ? -1 : 1;
    return 0;
}

struct loss_rows {
    LIST_OF(struct loss_row) list;
};

static uint32_t collect_losses(struct view_data *data, const struct lost_group *group,
                               struct loss_rows *rows, struct arena *scratch)
{
    uint32_t stage = name_of(data, group->stage), details = 0;
    for (size_t i = 0; i < group->echoes.count; i++) {
        const struct lost_echo *echo = &group->echoes.items[i];
        struct loss_row *row = list_add(&rows->list, scratch);
        row->object = name_of(data, echo->object);
        row->item = (struct item){
            .reflector = name_of(data, echo->reflector),
            .path = echo->path,
            .mirror = optional_name(data, echo->mirror),
            .number = (uint32_t)echo->number,
            .stage = stage,
            .reason = group->reason,
            .effect = group->effect,
        };
        if (echo->by != NULL || echo->shortfall_db != 0) {
            add_detail(data, row, echo);
            details++;
        }
    }
    return details;
}

static void add_fate(struct view_data *data, const struct loss_row *rows, size_t count,
                     struct arena *scratch)
{
    struct item *items = arena_get(scratch, count * sizeof *items);
    for (size_t i = 0; i < count; i++)
        items[i] = rows[i].item;
    add_count(data, FATE_OBJECT, rows->object);
    size_t known = data->patterns.pieces.count;
    uint32_t pattern = view_pool_number(&data->patterns, items, count * sizeof *items, data->arena);
    add_count(data, FATE_PATTERN, pattern);
    if (pattern < known)
        return;
    add_count(data, PATTERN_ITEMS, (uint32_t)count);
    for (size_t i = 0; i < count; i++) {
        add_count(data, ITEM_REFLECTOR, items[i].reflector);
        add_count(data, ITEM_PATH, items[i].path);
        add_count(data, ITEM_MIRROR, items[i].mirror);
        add_count(data, ITEM_NUMBER, items[i].number);
        add_count(data, ITEM_STAGE, items[i].stage);
        add_count(data, ITEM_REASON, items[i].reason);
        add_count(data, ITEM_EFFECT, items[i].effect);
    }
}

static void add_losses(struct view_data *data, const struct frame *frame, const char *sensor)
{
    struct loss_rows rows = {0};
    uint32_t details = 0, fates = 0;
    for (size_t i = 0; i < frame->lost.count; i++)
        if (strcmp(frame->lost.items[i].sensor, sensor) == 0)
            details += collect_losses(data, &frame->lost.items[i], &rows, frame->arena);
    sort_list(&rows.list, compare_rows, frame->arena);
    for (size_t begin = 0, end; begin < rows.list.count; begin = end, fates++) {
        for (end = begin; end < rows.list.count; end++)
            if (rows.list.items[end].object != rows.list.items[begin].object)
                break;
        add_fate(data, rows.list.items + begin, end - begin, frame->arena);
    }
    add_count(data, SCAN_FATES, fates);
    add_count(data, SCAN_DETAILS, details);
}

static void add_scan(struct view_data *data, const struct frame *frame,
                     const struct sensor_view *sensor, struct vec2 shift)
{
    struct view_scan scan = view_frame_scan(frame, sensor);
    add_real(data, SCAN_X, scan.position_m.x + shift.x);
    add_real(data, SCAN_Y, scan.position_m.y + shift.y);
    add_real(data, SCAN_YAW, remainder(scan.yaw_rad, 2 * acos(-1)));
    add_real(data, SCAN_VX, scan.velocity_mps.x);
    add_real(data, SCAN_VY, scan.velocity_mps.y);
    add_real(data, SCAN_AGE, scan.age_s);
    add_count(data, SCAN_SENSOR, sensor_of(data, sensor));
    add_count(data, SCAN_MEASURED, sensor->measured);
    add_count(data, SCAN_TARGETS, add_targets(data, frame, sensor->name));
    add_losses(data, frame, sensor->name);
}

void view_data_add(struct view_data *data, const struct frame *frame)
{
    uint32_t number = scene_of(data, frame);
    const struct view_scene *scene = &data->scenes.items[number];
    struct vec2 shift = {frame->origin_x_m - scene->anchor_x_m,
                         frame->origin_y_m - scene->anchor_y_m};
    add_real(data, FRAME_TIME, frame->time_s - scene->start_s);
    add_count(data, FRAME_SCENE, number);
    add_count(data, FRAME_NUMBER, (uint32_t)(frame->frame - scene->first_frame));
    add_count(data, FRAME_OBJECTS, (uint32_t)frame->objects.count);
    add_count(data, FRAME_SCANS, (uint32_t)frame->sensors.list.count);
    for (size_t i = 0; i < frame->objects.count; i++)
        add_object(data, &frame->objects.items[i], shift);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        add_scan(data, frame, &frame->sensors.list.items[i], shift);
}

static void write_word(struct text *text, const char *word)
{
    size_t begin = text->length;
    text_add_json(text, word, strlen(word));
    struct text plain = {0};
    text_add(&plain, text->bytes + begin, text->length - begin);
    text->length = begin;
    for (size_t i = 0; i < plain.length; i++)
        if (plain.bytes[i] == '<')
            text_add_word(text, "\\u003c");
        else
            text_add(text, plain.bytes + i, 1);
    text_free(&plain);
}

static void write_number(struct text *text, double value)
{
    text->length += number_write(value, text_room(text, NUMBER_SIZE));
}

/* "key": before a value; a comma too, unless the object has just begun. */
static void write_key(struct text *text, const char *key)
{
    char before = text->bytes[text->length - 1];
    text_format(text, "%s\"%s\":", before == '{' ? "" : ",", key);
}

static void write_named_number(struct text *text, const char *key, double value)
{
    write_key(text, key);
    write_number(text, value);
}

static void write_named_word(struct text *text, const char *key, const char *word)
{
    write_key(text, key);
    write_word(text, word);
}

static void write_named_flag(struct text *text, const char *key, bool flag)
{
    write_key(text, key);
    text_add_word(text, flag ? "true" : "false");
}

static void write_separator(struct text *text, size_t index)
{
    if (index > 0)
        text_add_word(text, ",\n");
}

static void write_names(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"names\":[");
    for (size_t i = 0; i < data->names.pieces.count; i++) {
        write_separator(text, i);
        write_word(text, data->names.pieces.items[i].bytes);
    }
    text_add_word(text, "],\n\"reasons\":[");
    for (enum loss loss = 0; frame_loss_name(loss) != NULL; loss++) {
        write_separator(text, loss);
        text_add_word(text, "{");
        write_named_word(text, "name", frame_loss_name(loss));
        write_named_flag(text, "near", view_frame_loss_is_near(loss));
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n\"paths\":[");
    for (enum path path = 0; frame_path_name(path) != NULL; path++) {
        write_separator(text, path);
        write_word(text, frame_path_name(path));
    }
    text_add_word(text, "],\n");
}

/* The effects by name, and the sets that labels hold as lists of their numbers. */
static void write_effects(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"effects\":[");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        write_separator(text, (size_t)i);
        write_word(text, effects_names[i]);
    }
    text_add_word(text, "],\n\"effect_sets\":[");
    for (size_t i = 0; i < data->effect_sets.pieces.count; i++) {
        uint64_t set;
        memcpy(&set, data->effect_sets.pieces.items[i].bytes, sizeof set);
        write_separator(text, i);
        const char *separator = "[";
        for (int effect = 0; effect < EFFECT_COUNT; effect++)
            if ((set & EFFECT_BIT(effect)) != 0) {
                text_format(text, "%s%d", separator, effect);
                separator = ",";
            }
        text_add_word(text, set == 0 ? "[]" : "]");
    }
    text_add_word(text, "],\n");
}

static void write_scenes(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"scenes\":[");
    for (size_t i = 0; i < data->scenes.count; i++) {
        const struct view_scene *scene = &data->scenes.items[i];
        write_separator(text, i);
        text_format(text, "{\"name\":%" PRIu32 ",\"ego\":%" PRIu32 ",\"suite\":%" PRIu32,
                    scene->name, scene->ego, scene->suite);
        write_named_number(text, "first_frame", (double)scene->first_frame);
        write_named_number(text, "start_s", scene->start_s);
        write_named_number(text, "anchor_x_m", scene->anchor_x_m);
        write_named_number(text, "anchor_y_m", scene->anchor_y_m);
        write_named_flag(text, "account", scene->account);
        write_named_flag(text, "ended", scene->ended);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

static void write_sensors(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"sensors\":[");
    for (size_t i = 0; i < data->sensors.count; i++) {
        const struct sensor_view *sensor = &data->sensors.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", sensor->name);
        write_named_number(text, "field_of_view_rad", sensor->field_of_view_rad);
        write_named_number(text, "range_max_m", sensor->range_max_m);
        write_named_number(text, "cell_range_m", sensor->cell_range_m);
        write_named_number(text, "cell_range_rate_mps", sensor->cell_range_rate_mps);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

static void write_points(const struct reflector_set *set, struct text *text)
{
    write_key(text, "points");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", point->name);
        write_named_number(text, "x", point->x);
        write_named_number(text, "y", point->y);
        write_named_number(text, "inset_m", point->inset_m);
        write_named_number(text, "facing_rad", point->facing_rad);
        text_add_word(text, "}");
    }
    text_add_word(text, "]");
}

static void write_line(struct text *text, const char *name, const double ends[4], double spacing_m)
{
    text_add_word(text, "{");
    write_named_word(text, "name", name);
    write_named_number(text, "from_x", ends[0]);
    write_named_number(text, "from_y", ends[1]);
    write_named_number(text, "to_x", ends[2]);
    write_named_number(text, "to_y", ends[3]);
    if (spacing_m > 0)
        write_named_number(text, "spacing_m", spacing_m);
    text_add_word(text, "}");
}

static void write_lines(const struct reflector_set *set, struct text *text)
{
    write_key(text, "planes");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->planes.count; i++) {
        const struct plane_reflector *plane = &set->planes.items[i];
        double ends[] = {plane->from_x, plane->from_y, plane->to_x, plane->to_y};
        write_separator(text, i);
        write_line(text, plane->name, ends, 0);
    }
    text_add_word(text, "]");
    write_key(text, "rows");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->rows.count; i++) {
        const struct post_row *row = &set->rows.items[i];
        double ends[] = {row->from_x, row->from_y, row->to_x, row->to_y};
        write_separator(text, i);
        write_line(text, row->name, ends, row->spacing_m);
    }
    text_add_word(text, "]");
}

static void write_classes(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"classes\":[");
    for (size_t i = 0; i < data->models.list.count; i++) {
        const struct view_model *model = &data->models.list.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", model->class);
        write_named_flag(text, "known", model->vehicle != NULL);
        const struct reflector_set none = {0};
        const struct reflector_set *set =
            model->vehicle != NULL ? &model->vehicle->reflectors : &none;
        write_points(set, text);
        write_lines(set, text);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

static size_t column_count(const struct view_data *data, enum column column)
{
    const struct view_column *found = &data->columns[column];
    return column < FIRST_COUNT ? found->reals.count : found->counts.count;
}

/* Bytes that each number of a column takes. */
static size_t column_width(const struct view_data *data, enum column column)
{
    if (column < FIRST_COUNT)
        return 4;
    const struct view_column *found = &data->columns[column];
    uint32_t most = 0;
    for (size_t i = 0; i < found->counts.count; i++)
        most = found->counts.items[i] > most ? found->counts.items[i] : most;
    return most < 1 << 8 ? 1 : most < 1 << 16 ? 2 : 4;
}

/* Bytes up to the next multiple of 12: whole groups of base64, and aligned for any number. */
static size_t column_size(const struct view_data *data, enum column column)
{
    return (column_count(data, column) * column_width(data, column) + 11) / 12 * 12;
}

static void write_places(const struct view_data *data, struct text *text)
{
    size_t begin = 0;
    text_add_word(text, "\"columns\":{\n");
    for (enum column column = 0; column < COLUMNS; column++) {
        write_separator(text, column);
        text_format(text, "\"%s\":{\"type\":\"%c%zu\",\"count\":%zu,\"begin\":%zu}",
                    column_names[column], column < FIRST_COUNT ? 'f' : 'u',
                    column_width(data, column), column_count(data, column), begin);
        begin += column_size(data, column) / 3 * 4;
    }
    text_add_word(text, "}");
}

void view_data_write_head(const struct view_data *data, int64_t open_frame, struct text *text)
{
    text_format(text, "{\"open_frame\":%" PRId64 ",\n", open_frame);
    write_names(data, text);
    write_effects(data, text);
    write_scenes(data, text);
    write_sensors(data, text);
    write_classes(data, text);
    write_places(data, text);
    text_add_word(text, "}\n");
}

/* Little-endian, as every machine that runs a browser has it. */
static void put_number(unsigned char *byte, uint32_t number, size_t width)
{
    for (size_t i = 0; i < width; i++)
        byte[i] = (unsigned char)(number >> 8 * i);
}

static uint32_t column_number(const struct view_data *data, enum column column, size_t index)
{
    if (column >= FIRST_COUNT)
        return data->columns[column].counts.items[index];
    uint32_t bits;
    memcpy(&bits, &data->columns[column].reals.items[index], sizeof bits);
    return bits;
}

static void write_base64(struct text *text, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *out = text_room(text, size / 3 * 4);
    for (size_t i = 0; i < size; i += 3) {
        unsigned group = (unsigned)bytes[i] << 16 | (unsigned)bytes[i + 1] << 8 | bytes[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6)
            *out++ = digits[group >> shift & 63];
    }
    text->length += size / 3 * 4;
}

void view_data_write_columns(const struct view_data *data, struct text *text)
{
    enum { CHUNK = 12 * 1024 };
    unsigned char bytes[CHUNK];
    for (enum column column = 0; column < COLUMNS; column++) {
        size_t count = column_count(data, column), width = column_width(data, column);
        for (size_t index = 0; index < count;) {
            size_t used = 0;
            for (; index < count && used < CHUNK; index++, used += width)
                put_number(bytes + used, column_number(data, column, index), width);
            size_t padded = (used + 11) / 12 * 12;
            memset(bytes + used, 0, padded - used);
            write_base64(text, bytes, padded);
        }
    }
}
