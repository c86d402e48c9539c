#include "view/view_data.h"

#include <assert.h>

#include "base/sort.h"
#include "score/target_score.h"

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

static void put_real(struct view_data *data, enum view_column column, double value)
{
    float real = (float)value;
    memcpy(list_add(&data->columns.list[column], data->arena), &real, sizeof real);
}

static void put_count(struct view_data *data, enum view_column column, uint32_t value)
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

static void put_name(struct view_data *data, enum view_column column, const char *word)
{
    put_count(data, column, optional_name(data, word));
}

/* The number of the object of an echo. What is of no object has a number of its own, even if an
 * object has its name: the 0 at the end of the word is part of it then. */
static uint32_t owner_of(struct view_data *data, const struct echo_id *echo)
{
    size_t length = strlen(echo->object) + (frame_has_object(echo->path) ? 0 : 1);
    return intern_number(&data->names, echo->object, length, data->arena);
}

void view_data_begin(struct view_data *data, struct arena *arena)
{
    *data = (struct view_data){.arena = arena, .models = {.arena = arena}};
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
    const uint64_t key[] = {name_of(data, frame->scene), frame->seed};
    uint32_t number = intern_number(&data->scene_keys, key, sizeof key, data->arena);
    if (number == data->scenes.count) {
        struct vec2 ego = view_frame_ego(frame, 0).position_m;
        bool has_sensors = (frame->present & PART_SENSORS) != 0;
        *list_add(&data->scenes, data->arena) = (struct view_scene){
            .name = (int64_t)key[0],
            .seed = frame->seed,
            .ego = name_of(data, frame->ego),
            .suite = name_of(data, has_sensors ? frame->sensors.suite : ""),
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
#define add_real put_real
#define add_count(data, column, value) put_count(data, column, (uint32_t)(value))
#define add_word(data, column, value) put_count(data, column, name_of(data, value))

static void add_object(struct view_data *data, const struct object *object, struct vec2 shift)
{
    struct box box = view_frame_box(object, view_frame_vehicle(&data->models, object->class, NULL));
    put_real(data, COLUMN_OBJECT_X, object->x_m + shift.x);
    put_real(data, COLUMN_OBJECT_Y, object->y_m + shift.y);
    put_real(data, COLUMN_OBJECT_YAW, remainder(object->yaw_rad, 2 * acos(-1)));
    put_real(data, COLUMN_OBJECT_LENGTH, box.length_m);
    put_real(data, COLUMN_OBJECT_WIDTH, box.width_m);
#define OBJECT(name, key, how, member) add_##how(data, COLUMN_##name, object->member);
#include "view/view_columns.def"
}

static void add_contributor(struct view_data *data, const struct contributor *from)
{
#define CONTRIBUTOR(name, key, how, member) add_##how(data, COLUMN_##name, from->member);
#include "view/view_columns.def"
    put_count(data, COLUMN_CONTRIBUTOR_OBJECT, owner_of(data, &from->id));
    put_count(data, COLUMN_CONTRIBUTOR_MIRROR, optional_name(data, from->id.mirror));
}

/* Adds a row with the elevation, if the sensor measures it. */
static void add_elevation(struct view_data *data, const struct target *target)
{
    bool measured = (target->present & VALUE_ELEVATION) != 0;
    put_count(data, COLUMN_TARGET_ELEVATIONS, measured);
    if (!measured)
        return;
    put_real(data, COLUMN_ELEVATION_REPORTED, target->elevation_rad);
    put_real(data, COLUMN_ELEVATION_CELL, target->cell_elevation_rad);
}

/* Adds a row with every member of the quality, in the order of its table, if the target has one. */
static void add_quality(struct view_data *data, const struct quality *quality)
{
    put_count(data, COLUMN_TARGET_QUALITY, quality->present != 0);
    enum view_column column = COLUMN_QUALITY_SNR_DB;
    for (const struct field *field = quality_record.fields; field->name != NULL;
         field++, column++) {
        if (quality->present == 0)
            continue;
        bool known = (quality->present & field->group) != 0;
        put_real(data, column, known ? field_number(field, quality) : (double)NAN);
    }
}

static void add_target(struct view_data *data, const struct target *target)
{
#define TARGET(name, key, how, member) add_##how(data, COLUMN_##name, target->member);
#include "view/view_columns.def"
    put_count(
        data, COLUMN_TARGET_EFFECTS,
        intern_number(&data->effect_sets, &target->effects, sizeof target->effects, data->arena));
    for (size_t i = 0; i < target->contributors.count; i++)
        add_contributor(data, &target->contributors.items[i]);
    add_elevation(data, target);
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
    put_real(data, COLUMN_DETAIL_SHORTFALL, echo->shortfall_db);
    put_real(data, COLUMN_DETAIL_RANGE, echo->range_m);
    put_real(data, COLUMN_DETAIL_AZIMUTH, echo->azimuth_rad);
    for (int i = LOST_OBJECT; i <= LOST_NUMBER; i++)
        put_count(data, (enum view_column)(COLUMN_DETAIL_OBJECT + i), row->of[i]);
    put_count(data, COLUMN_DETAIL_BY, optional_name(data, echo->by));
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
        put_real(data, COLUMN_SPOT_X, place.x);
        put_real(data, COLUMN_SPOT_Y, place.y);
        put_count(data, COLUMN_SPOT_SCENE, scene);
        put_count(data, COLUMN_SPOT_OBJECT, row->of[LOST_OBJECT]);
        put_count(data, COLUMN_SPOT_REFLECTOR, row->of[LOST_REFLECTOR]);
    }
    return data->spots.items[number];
}

/* True if the lost echo was within 5 cm of its reflector, as only direct echoes are, or if its
 * place is not known. */
static bool is_at_spot(struct view_data *data, const struct loss_scan *scan,
                       const struct loss_row *row, const struct lost_echo *echo)
{
    const struct object *object = frame_object_of(scan->frame, &echo->id);
    if (echo->range_m == 0)
        return true;
    if (object == NULL || echo->id.path != PATH_DIRECT)
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
    uint32_t details = 0;
    uint32_t stage = name_of(data, group->stage);
    uint32_t reason = reason_of(data, group, scan->frame->arena);
    for (size_t i = 0; i < group->echoes.count; i++) {
        const struct lost_echo *echo = &group->echoes.items[i];
        struct loss_row *row = list_add(&scan->rows, scan->frame->arena);
        row->of[LOST_OBJECT] = owner_of(data, &echo->id);
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

/* Adds the fate of an object, of which all these rows are. */
static void add_fate(struct view_data *data, const struct loss_row *rows, size_t count,
                     struct arena *scratch)
{
    enum { ITEM = LOST_NUMBERS - LOST_REFLECTOR };
    assert(count > 0);
    uint32_t *items = arena_get(scratch, count * ITEM * sizeof *items);
    for (size_t i = 0; i < count; i++)
        memcpy(items + i * ITEM, rows[i].of + LOST_REFLECTOR, ITEM * sizeof *items);
    put_count(data, COLUMN_FATE_OBJECT, rows->of[LOST_OBJECT]);
    size_t known = data->patterns.list.count;
    uint32_t pattern =
        intern_number(&data->patterns, items, count * ITEM * sizeof *items, data->arena);
    put_count(data, COLUMN_FATE_PATTERN, pattern);
    if (pattern < known)
        return;
    put_count(data, COLUMN_PATTERN_ITEMS, (uint32_t)count);
    for (size_t i = 0; i < count * ITEM; i++)
        put_count(data, (enum view_column)(COLUMN_ITEM_REFLECTOR + i % ITEM), items[i]);
}

static void add_losses(struct view_data *data, struct loss_scan *scan, const char *sensor)
{
    const struct frame *frame = scan->frame;
    uint32_t details = 0;
    uint32_t fates = 0;
    for (size_t i = 0; i < frame->lost.count; i++)
        if (strcmp(frame->lost.items[i].sensor, sensor) == 0)
            details += collect_losses(data, &frame->lost.items[i], scan);
    sort_list(&scan->rows, compare_rows, frame->arena);
    const struct loss_row *rows = scan->rows.items;
    size_t begin = 0;
    for (size_t i = 1; i <= scan->rows.count; i++) {
        if (i < scan->rows.count && rows[i].of[LOST_OBJECT] == rows[begin].of[LOST_OBJECT])
            continue;
        add_fate(data, rows + begin, i - begin, frame->arena);
        fates++;
        begin = i;
    }
    put_count(data, COLUMN_SCAN_FATES, fates);
    put_count(data, COLUMN_SCAN_DETAILS, details);
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
    put_count(data, COLUMN_SCAN_SIGHTINGS, count);
}

static void add_scan(struct view_data *data, const struct frame *frame, uint32_t scene,
                     const struct sensor_view *sensor, struct vec2 shift)
{
    struct view_scan scan = view_frame_scan(frame, sensor);
    put_real(data, COLUMN_SCAN_X, scan.pose.position_m.x + shift.x);
    put_real(data, COLUMN_SCAN_Y, scan.pose.position_m.y + shift.y);
    put_real(data, COLUMN_SCAN_YAW, remainder(scan.pose.yaw_rad, 2 * acos(-1)));
    put_real(data, COLUMN_SCAN_VX, scan.pose.velocity_mps.x);
    put_real(data, COLUMN_SCAN_VY, scan.pose.velocity_mps.y);
    put_real(data, COLUMN_SCAN_AGE, scan.age_s);
    put_count(data, COLUMN_SCAN_SENSOR, sensor_of(data, sensor));
    put_count(data, COLUMN_SCAN_MEASURED, sensor->measured);
    put_count(data, COLUMN_SCAN_TARGETS, add_targets(data, frame, sensor->name));
    add_losses(data, &(struct loss_scan){.frame = frame, .scan = scan, .scene = scene},
               sensor->name);
    add_sightings(data, frame, sensor->name);
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

static uint32_t add_truths(struct view_data *data, const struct frame *frame,
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
        put_real(data, COLUMN_TRUTH_RANGE, truth->range_m);
        put_real(data, COLUMN_TRUTH_AZIMUTH, truth->azimuth_rad);
        put_real(data, COLUMN_TRUTH_RATE, truth->range_rate_mps);
        put_real(data, COLUMN_TRUTH_AMPLITUDE, truth->amplitude_db);
        put_count(data, COLUMN_TRUTH_OBJECT, 1 + owner_of(data, &truth->contributors.items[0].id));
        put_count(data, COLUMN_TRUTH_LISTED, listed != NULL ? number_in_list(frame, listed) : 0);
    }
    return count;
}

static int compare_targets(struct view_data *data, const struct frame *frame, struct diag *diag)
{
    const struct frame *truth;
    int found = reference_stream_frame(data->truth, frame, &truth, diag);
    if (found < 0)
        return -1;
    put_count(data, COLUMN_FRAME_COMPARED, (uint32_t)found);
    if (found > 0)
        data->scenes.items[scene_of(data, frame)].compared = true;
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        struct target_pairs pairs = {0};
        const struct sensor_view *view = found > 0 ? &truth->sensors.list.items[i] : NULL;
        if (found > 0 && target_score_is_compared(view->name, truth, frame)) {
            struct target_cell cell = target_score_cell(view, 0);
            pairs = target_score_pairs(view->name, truth, frame, &cell, frame->arena);
        }
        put_count(data, COLUMN_SCAN_TRUE, view != NULL && view->measured);
        put_count(data, COLUMN_SCAN_TRUTHS, add_truths(data, frame, &pairs));
    }
    return 0;
}

static void add_track(struct view_data *data, const struct frame *frame,
                      const struct track_pair *pair, const char *before)
{
    static const struct track missed = {0};
    const struct track *track = pair->track != NULL ? pair->track : &missed;
    struct vec2 shift = shift_of(data, frame);
    put_real(data, COLUMN_TRACK_X, track->x_m + shift.x);
    put_real(data, COLUMN_TRACK_Y, track->y_m + shift.y);
    put_real(data, COLUMN_TRACK_VX, track->vx_mps);
    put_real(data, COLUMN_TRACK_VY, track->vy_mps);
    put_real(data, COLUMN_TRACK_APART, pair->apart_m);
    put_name(data, COLUMN_TRACK_ID, track->id);
    put_name(data, COLUMN_TRACK_OBJECT, pair->object != NULL ? pair->object->id : NULL);
    put_name(data, COLUMN_TRACK_BEFORE, before);
    put_count(data, COLUMN_TRACK_EXCUSED, pair->excused);
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
        add_track(data, frame, pair, before);
    }
    if (frame->last)
        track_score_forget(&data->memory, frame->scene);
    put_count(data, COLUMN_FRAME_TRACKED, found > 0);
    put_count(data, COLUMN_FRAME_TRACKS, (uint32_t)pairs.list.count);
    return 0;
}

int view_data_add(struct view_data *data, const struct frame *frame, struct diag *diag)
{
    assert(frame->arena != NULL);
    uint32_t number = scene_of(data, frame);
    const struct view_scene *scene = &data->scenes.items[number];
    struct vec2 shift = shift_of(data, frame);
    put_real(data, COLUMN_FRAME_TIME, frame->time_s - scene->start_s);
    put_count(data, COLUMN_FRAME_SCENE, number);
    put_count(data, COLUMN_FRAME_NUMBER, (uint32_t)(frame->frame - scene->first_frame));
    put_count(data, COLUMN_FRAME_ACCOUNT, frame_carries(frame, CARRY_ACCOUNT));
    put_count(data, COLUMN_FRAME_OBJECTS, (uint32_t)frame->objects.count);
    put_count(data, COLUMN_FRAME_SCANS, (uint32_t)frame->sensors.list.count);
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
        const char *name = intern_text(&data->names, (uint32_t)scene->name);
        if (data->truth != NULL && !scene->compared)
            return reference_stream_lacks(data->truth, name, diag);
        if (data->tracks != NULL && !scene->tracked)
            return reference_stream_lacks(data->tracks, name, diag);
    }
    return 0;
}
