#include "view/view_data.h"

#include <assert.h>

#include "score/target_score.h"

void view_data_begin(struct view_data *data, struct arena *arena)
{
    *data =
        (struct view_data){.arena = arena, .models = {.arena = arena}, .columns = {.arena = arena}};
}

/* Adds what the frame has of lines on the ground, relative to the place of its ego. */
static void add_ground(struct view_data *data, struct view_scene *scene, const struct frame *frame,
                       struct vec2 ego)
{
    for (size_t i = 0; i < frame->roadside.count; i++) {
        const struct roadside_strip *strip = &frame->roadside.items[i];
        *list_add(&scene->ground, data->arena) = (struct view_ground){
            .kind = roadside_kinds[strip->kind],
            .from_x_m = strip->from_x_m - ego.x,
            .from_y_m = strip->from_y_m - ego.y,
            .to_x_m = strip->to_x_m - ego.x,
            .to_y_m = strip->to_y_m - ego.y,
            .width_m = strip->width_m,
        };
    }
}

static uint32_t scene_of(struct view_data *data, const struct frame *frame)
{
    const uint64_t key[] = {view_columns_name(&data->columns, frame->scene), frame->seed};
    uint32_t number = intern_number(&data->scene_keys, key, sizeof key, data->arena);
    if (number == data->scenes.count) {
        struct vec2 ego = view_frame_ego(frame, 0).position_m;
        bool has_sensors = (frame->present & PART_SENSORS) != 0;
        *list_add(&data->scenes, data->arena) = (struct view_scene){
            .name = (int64_t)key[0],
            .seed = frame->seed,
            .ego = view_columns_name(&data->columns, frame->ego),
            .suite = view_columns_name(&data->columns, has_sensors ? frame->sensors.suite : ""),
            .first_frame = frame->frame,
            .start_s = frame->time_s,
            .anchor_x_m = frame->origin_x_m + ego.x,
            .anchor_y_m = frame->origin_y_m + ego.y,
        };
        add_ground(data, &data->scenes.items[number], frame, ego);
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
           a->cell_range_rate_mps == b->cell_range_rate_mps &&
           a->resolution_range_m == b->resolution_range_m &&
           a->resolution_range_rate_mps == b->resolution_range_rate_mps;
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
#define add_real view_columns_real
#define add_count(columns, column, value) view_columns_count(columns, column, (uint32_t)(value))
#define add_word(columns, column, value)                                                           \
    view_columns_count(columns, column, view_columns_name(columns, value))
#define add_optional_word(columns, column, value)                                                  \
    view_columns_count(columns, column, view_columns_optional_name(columns, value))

static void add_object(struct view_data *data, const struct object *object, struct vec2 shift)
{
    struct view_columns *columns = &data->columns;
    struct box box = view_frame_box(object, view_frame_vehicle(&data->models, object->class, NULL));
    view_columns_real(columns, COLUMN_OBJECT_X, object->x_m + shift.x);
    view_columns_real(columns, COLUMN_OBJECT_Y, object->y_m + shift.y);
    view_columns_real(columns, COLUMN_OBJECT_YAW, remainder(object->yaw_rad, 2 * acos(-1)));
    view_columns_real(columns, COLUMN_OBJECT_LENGTH, box.length_m);
    view_columns_real(columns, COLUMN_OBJECT_WIDTH, box.width_m);
#define OBJECT(name, key, how, member) add_##how(columns, COLUMN_##name, object->member);
#include "view/view_columns.def"
}

static void add_contributor(struct view_columns *columns, const struct contributor *from)
{
#define CONTRIBUTOR(name, key, how, member) add_##how(columns, COLUMN_##name, from->member);
#include "view/view_columns.def"
    view_columns_count(columns, COLUMN_CONTRIBUTOR_OBJECT, view_columns_object(columns, &from->id));
    add_optional_word(columns, COLUMN_CONTRIBUTOR_MIRROR, from->id.mirror);
}

/* Adds a row with the elevation, if the sensor measures it. */
static void add_elevation(struct view_columns *columns, const struct target *target)
{
    bool measured = (target->present & VALUE_ELEVATION) != 0;
    view_columns_count(columns, COLUMN_TARGET_ELEVATIONS, measured);
    if (!measured)
        return;
    view_columns_real(columns, COLUMN_ELEVATION_REPORTED, target->elevation_rad);
    view_columns_real(columns, COLUMN_ELEVATION_CELL, target->cell_elevation_rad);
}

/* Adds a row with every member of the quality, in the order of its table, if the target has one. */
static void add_quality(struct view_columns *columns, const struct quality *quality)
{
    view_columns_count(columns, COLUMN_TARGET_QUALITY, quality->present != 0);
    enum view_column column = COLUMN_QUALITY_SNR_DB;
    for (const struct field *field = quality_record.fields; field->name != NULL;
         field++, column++) {
        if (quality->present == 0)
            continue;
        bool known = (quality->present & field->group) != 0;
        view_columns_real(columns, column, known ? field_number(field, quality) : (double)NAN);
    }
}

static void add_target(struct view_data *data, const struct target *target)
{
    struct view_columns *columns = &data->columns;
#define TARGET(name, key, how, member) add_##how(columns, COLUMN_##name, target->member);
#include "view/view_columns.def"
    uint32_t effects =
        intern_number(&data->effect_sets, &target->effects, sizeof target->effects, data->arena);
    view_columns_count(columns, COLUMN_TARGET_EFFECTS, effects);
    for (size_t i = 0; i < target->contributors.count; i++)
        add_contributor(columns, &target->contributors.items[i]);
    add_elevation(columns, target);
    add_quality(columns, &target->quality);
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

static void add_sightings(struct view_columns *columns, const struct frame *frame,
                          const char *sensor)
{
    uint32_t count = 0;
    for (size_t i = 0; i < frame->visibility.count; i++) {
        const struct sighting *sighting = &frame->visibility.items[i];
        if (strcmp(sighting->sensor, sensor) != 0)
            continue;
        count++;
#define SIGHTING(name, key, how, member) add_##how(columns, COLUMN_##name, sighting->member);
#include "view/view_columns.def"
    }
    view_columns_count(columns, COLUMN_SCAN_SIGHTINGS, count);
}

static void add_scan(struct view_data *data, const struct frame *frame, uint32_t scene,
                     const struct sensor_view *sensor, struct vec2 shift)
{
    struct view_columns *columns = &data->columns;
    struct view_scan scan = view_frame_scan(frame, sensor);
    view_columns_real(columns, COLUMN_SCAN_X, scan.pose.position_m.x + shift.x);
    view_columns_real(columns, COLUMN_SCAN_Y, scan.pose.position_m.y + shift.y);
    view_columns_real(columns, COLUMN_SCAN_YAW, remainder(scan.pose.yaw_rad, 2 * acos(-1)));
    view_columns_real(columns, COLUMN_SCAN_VX, scan.pose.velocity_mps.x);
    view_columns_real(columns, COLUMN_SCAN_VY, scan.pose.velocity_mps.y);
    view_columns_real(columns, COLUMN_SCAN_AGE, scan.age_s);
    view_columns_count(columns, COLUMN_SCAN_SENSOR, sensor_of(data, sensor));
    view_columns_count(columns, COLUMN_SCAN_MEASURED, sensor->measured);
    view_columns_count(columns, COLUMN_SCAN_TARGETS, add_targets(data, frame, sensor->name));
    view_losses_add(&data->losses, columns, frame, &scan, scene, sensor->name);
    add_sightings(columns, frame, sensor->name);
}

/* From the frame's coordinates to those of its scene in the columns. */
static struct vec2 shift_of(struct view_data *data, const struct frame *frame)
{
    const struct view_scene *scene = &data->scenes.items[scene_of(data, frame)];
    return (struct vec2){frame->origin_x_m - scene->anchor_x_m,
                         frame->origin_y_m - scene->anchor_y_m};
}

/* The number of a target in its sensor's list, from 1. */
static uint32_t number_in_list(const struct frame *frame, const struct target *target)
{
    uint32_t number = 0;
    for (const struct target *one = frame->targets.items; one <= target; one++)
        number += strcmp(one->sensor, target->sensor) == 0;
    return number;
}

static uint32_t add_truths(struct view_columns *columns, const struct frame *frame,
                           const struct target_pairs *pairs)
{
    uint32_t count = 0;
    for (size_t i = 0; i < pairs->list.count; i++) {
        const struct target *truth = pairs->list.items[i].truth;
        if (truth == NULL) /* false targets come last */
            break;
        assert(truth->contributors.count > 0);
        count++;
        const struct target *listed = pairs->list.items[i].listed;
        view_columns_real(columns, COLUMN_TRUTH_RANGE, truth->range_m);
        view_columns_real(columns, COLUMN_TRUTH_AZIMUTH, truth->azimuth_rad);
        view_columns_real(columns, COLUMN_TRUTH_RATE, truth->range_rate_mps);
        view_columns_real(columns, COLUMN_TRUTH_AMPLITUDE, truth->amplitude_db);
        view_columns_count(columns, COLUMN_TRUTH_OBJECT,
                           1 + view_columns_object(columns, &truth->contributors.items[0].id));
        view_columns_count(columns, COLUMN_TRUTH_LISTED,
                           listed != NULL ? number_in_list(frame, listed) : 0);
    }
    return count;
}

static int compare_targets(struct view_data *data, const struct frame *frame, struct diag *diag)
{
    struct view_columns *columns = &data->columns;
    const struct frame *truth;
    int found = reference_stream_frame(data->truth, frame, &truth, diag);
    if (found < 0)
        return -1;
    view_columns_count(columns, COLUMN_FRAME_COMPARED, (uint32_t)found);
    if (found > 0)
        data->scenes.items[scene_of(data, frame)].compared = true;
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        struct target_pairs pairs = {0};
        const struct sensor_view *view = found > 0 ? &truth->sensors.list.items[i] : NULL;
        if (found > 0 && target_score_is_compared(view->name, truth, frame)) {
            struct target_cell cell = target_score_cell(view, 0);
            pairs = target_score_pairs(view->name, truth, frame, &cell, frame->arena);
        }
        view_columns_count(columns, COLUMN_SCAN_TRUE, view != NULL && view->measured);
        view_columns_count(columns, COLUMN_SCAN_TRUTHS, add_truths(columns, frame, &pairs));
    }
    return 0;
}

static void add_track(struct view_columns *columns, struct vec2 shift,
                      const struct track_pair *pair, const char *before)
{
    static const struct track missed = {0};
    const struct track *track = pair->track != NULL ? pair->track : &missed;
    view_columns_real(columns, COLUMN_TRACK_X, track->x_m + shift.x);
    view_columns_real(columns, COLUMN_TRACK_Y, track->y_m + shift.y);
    view_columns_real(columns, COLUMN_TRACK_VX, track->vx_mps);
    view_columns_real(columns, COLUMN_TRACK_VY, track->vy_mps);
    view_columns_real(columns, COLUMN_TRACK_APART, pair->apart_m);
    add_optional_word(columns, COLUMN_TRACK_ID, track->id);
    add_optional_word(columns, COLUMN_TRACK_OBJECT, pair->object != NULL ? pair->object->id : NULL);
    add_optional_word(columns, COLUMN_TRACK_BEFORE, before);
    view_columns_count(columns, COLUMN_TRACK_EXCUSED, pair->excused);
}

static int compare_tracks(struct view_data *data, const struct frame *frame, struct diag *diag)
{
    struct track_list tracks = {0};
    struct track_pairs pairs = {0};
    if (track_score_check(frame, TRACK_TRUTH_IN_VIEW, diag) != 0)
        return -1;
    int found = reference_stream_tracks(data->tracks, frame, &tracks, diag);
    if (found < 0)
        return -1;
    if (found > 0) {
        data->scenes.items[scene_of(data, frame)].tracked = true;
        pairs = track_score_pairs(frame, &tracks, TRACK_TRUTH_IN_VIEW, NULL);
    }
    for (size_t i = 0; i < pairs.list.count; i++) {
        const struct track_pair *pair = &pairs.list.items[i];
        const char *before = NULL;
        if (pair->object != NULL && pair->track != NULL)
            before = track_score_replaced(&data->memory, frame->scene, pair->object->id,
                                          pair->track->id, data->arena);
        add_track(&data->columns, shift_of(data, frame), pair, before);
    }
    if (frame->last)
        track_score_forget(&data->memory, frame->scene);
    view_columns_count(&data->columns, COLUMN_FRAME_TRACKED, found > 0);
    view_columns_count(&data->columns, COLUMN_FRAME_TRACKS, (uint32_t)pairs.list.count);
    return 0;
}

int view_data_add(struct view_data *data, const struct frame *frame, struct diag *diag)
{
    struct view_columns *columns = &data->columns;
    assert(frame->arena != NULL);
    uint32_t number = scene_of(data, frame);
    const struct view_scene *scene = &data->scenes.items[number];
    struct vec2 shift = shift_of(data, frame);
    view_columns_real(columns, COLUMN_FRAME_TIME, frame->time_s - scene->start_s);
    view_columns_count(columns, COLUMN_FRAME_SCENE, number);
    view_columns_count(columns, COLUMN_FRAME_NUMBER, (uint32_t)(frame->frame - scene->first_frame));
    view_columns_count(columns, COLUMN_FRAME_ACCOUNT, frame_carries(frame, CARRY_ACCOUNT));
    view_columns_count(columns, COLUMN_FRAME_OBJECTS, (uint32_t)frame->objects.count);
    view_columns_count(columns, COLUMN_FRAME_SCANS, (uint32_t)frame->sensors.list.count);
    for (size_t i = 0; i < frame->objects.count; i++)
        add_object(data, &frame->objects.items[i], shift);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        add_scan(data, frame, number, &frame->sensors.list.items[i], shift);
    if (data->truth != NULL && compare_targets(data, frame, diag) != 0)
        return -1;
    return data->tracks != NULL ? compare_tracks(data, frame, diag) : 0;
}

int view_data_finish(struct view_data *data, struct diag *diag)
{
    if ((data->truth != NULL && reference_stream_finish(data->truth, diag) != 0) ||
        (data->tracks != NULL && reference_stream_finish(data->tracks, diag) != 0))
        return -1;
    for (size_t i = 0; i < data->scenes.count; i++) {
        const struct view_scene *scene = &data->scenes.items[i];
        const char *name = intern_text(&data->columns.names, (uint32_t)scene->name);
        if (data->truth != NULL && !scene->compared)
            return reference_stream_lacks(data->truth, name, diag);
        if (data->tracks != NULL && !scene->tracked)
            return reference_stream_lacks(data->tracks, name, diag);
    }
    return 0;
}
