#include "score/track_score.h"

#include "base/sort.h"
#include "documents/vehicle.h"
#include "frame/frame_order.h"
#include "geometry/kinematics.h"
#include "score/gospa.h"

const char *const track_score_truths[] = {[TRACK_TRUTH_IN_VIEW] = "in_view",
                                          [TRACK_TRUTH_DETECTED] = "detected",
                                          [TRACK_TRUTH_ALL] = "all",
                                          NULL};

/* The least variance is (10 um)^2, so that squares of normalised distances are finite. */
#define VARIANCE(member, help)                                                                     \
    OPTIONAL_REAL(struct track, member, 1e-10, 1e14, help "; the matrix is positive definite"),    \
        .group = TRACK_COVARIANCE

static const struct field track_fields[] = {
    {FIELD_NAME_OF(struct track, id,
                   "unique in the line; constant for an object; a number is its digits"),
     .or_number = true},
    {FIELD_REAL_IN(struct track, x_m, -1e7, 1e7,
                   "centre of the object's box, in the frame's coordinates")},
    {FIELD_REAL_IN(struct track, y_m, -1e7, 1e7,
                   "centre of the object's box, in the frame's coordinates")},
    {FIELD_REAL_IN(struct track, vx_mps, -1e4, 1e4, "velocity over ground")},
    {FIELD_REAL_IN(struct track, vy_mps, -1e4, 1e4, "velocity over ground")},
    {VARIANCE(variance_x_m2, "variance of x_m")},
    {OPTIONAL_REAL(struct track, covariance_xy_m2, -1e14, 1e14,
                   "covariance of x_m and y_m (absent: 0); the matrix is positive definite")},
    {VARIANCE(variance_y_m2, "variance of y_m")},
    {FIELD_RAW_OF(struct track, extra, "any value, for your own use; not read")},
    {0},
};

static const struct record track_record = {
    FIELD_TABLE(struct track, track_fields, "track",
                "A track of an object, with or without the covariance of its place."),
    .present_offset = offsetof(struct track, present)};

static const struct field list_fields[] = {
    {FIELD_NAME_OF(struct track_list, scene, "scene of the frame")},
    {FIELD_INTEGER_IN(struct track_list, frame, 0, 0x1p53, "number of the frame in its scene")},
    {OPTIONAL_REAL(struct track_list, time_s, -1e10, 1e10, "time of the frame; compared if given"),
     .group = TRACK_TIME},
    {FIELD_LIST_OF(struct track_list, tracks, &track_record,
                   "the tracks, in any order; may be empty")},
    {FIELD_RAW_OF(struct track_list, extra, "any value, for your own use; not read")},
    {0},
};

const struct record track_list_record = {
    FIELD_TABLE(struct track_list, list_fields, "tracks",
                "A tracker's tracks in one frame: a line for glint-score-tracks."),
    .present_offset = offsetof(struct track_list, present)};

_Static_assert(offsetof(struct track, id) == 0, "frame_order_names compares it");

/* Correlation of x_m and y_m, in [-1, 1] for a covariance. */
static double correlation(const struct track *track)
{
    return track->covariance_xy_m2 / sqrt(track->variance_x_m2) / sqrt(track->variance_y_m2);
}

/* NEES: the squared distance of the centres over the covariance of the track. */
static double normalised_square(const struct track *track, const struct object *object)
{
    double x = (track->x_m - object->x_m) / sqrt(track->variance_x_m2);
    double y = (track->y_m - object->y_m) / sqrt(track->variance_y_m2), r = correlation(track);
    return (x * x - 2 * r * x * y + y * y) / (1 - r * r);
}

static int check_covariance(const struct track *track, size_t number, struct diag *diag)
{
    bool has_variances = (track->present & TRACK_COVARIANCE) != 0;
    if (!has_variances && track->covariance_xy_m2 != 0)
        return diag_fail(diag, DIAG_DATA,
                         "tracks[%zu]: variance_x_m2: missing; covariance_xy_m2 needs it", number);
    if (!has_variances || fabs(correlation(track)) < 1)
        return 0;
    return diag_fail(diag, DIAG_DATA,
                     "tracks[%zu]: variance_x_m2 %g, covariance_xy_m2 %g and variance_y_m2 %g are "
                     "not positive definite",
                     number, track->variance_x_m2, track->covariance_xy_m2, track->variance_y_m2);
}

int track_score_order(struct track_list *list, struct arena *arena, struct diag *diag)
{
    for (size_t i = 0; i < list->tracks.count; i++)
        if (check_covariance(&list->tracks.items[i], i, diag) != 0)
            return -1;
    sort_list(&list->tracks, frame_order_names, arena);
    for (size_t i = 1; i < list->tracks.count; i++)
        if (frame_order_names(&list->tracks.items[i - 1], &list->tracks.items[i]) == 0)
            return diag_fail(diag, DIAG_DATA, "tracks: the id \"%s\" stands twice",
                             list->tracks.items[i].id);
    return 0;
}

struct object_list {
    LIST_OF(const struct object *) list;
};

/* The part of the frame that tells which objects are to be tracked; 0: none is needed. */
static unsigned part_of_truth(enum track_truth truth)
{
    if (truth == TRACK_TRUTH_IN_VIEW)
        return PART_SENSORS;
    return truth == TRACK_TRUTH_DETECTED ? PART_TARGETS : 0;
}

int track_score_check(const struct frame *frame, enum track_truth truth, struct diag *diag)
{
    unsigned needed = part_of_truth(truth);
    if ((needed & ~frame->present) == 0)
        return 0;
    return diag_fail(diag, DIAG_DATA, "%s: missing; --objects=%s needs it", frame_part_name(needed),
                     track_score_truths[truth]);
}

static bool is_named(const char *names, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = names;; at++) {
        size_t word = strcspn(at, ",");
        if (word == length && memcmp(at, name, length) == 0)
            return true;
        at += word;
        if (*at == '\0')
            return false;
    }
}

static bool sees(const struct sensor_view *view, const struct object *ego,
                 const struct object *object)
{
    struct motion motion = frame_motion(ego, 0);
    struct sensor_pose pose =
        kinematics_sensor_pose(&motion, view->mount_x_m, view->mount_y_m, view->mount_yaw_rad);
    struct kinematics seen = kinematics_of(pose.position_m, pose.velocity_mps, pose.boresight,
                                           (struct vec2){object->x_m, object->y_m},
                                           (struct vec2){object->vx_mps, object->vy_mps});
    return seen.range_m <= view->range_max_m &&
           fabs(seen.azimuth_rad) <= view->field_of_view_rad / 2;
}

static bool in_view(const struct frame *frame, const struct object *object)
{
    const struct object *ego = frame_object(frame, frame->ego);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (sees(&frame->sensors.list.items[i], ego, object))
            return true;
    return false;
}

static bool is_of_class(const struct object *object, const char *classes)
{
    if (classes == NULL)
        return !is_named(TRACK_SCORE_STRUCTURES, object->class);
    return is_named(classes, object->class);
}

bool track_score_counts(const struct frame *frame, const struct object *object,
                        enum track_truth truth, const char *classes)
{
    return strcmp(object->id, frame->ego) != 0 && is_of_class(object, classes) &&
           (truth == TRACK_TRUTH_ALL || (truth == TRACK_TRUTH_IN_VIEW && in_view(frame, object)) ||
            (truth == TRACK_TRUTH_DETECTED && frame_detects(frame, object->id)));
}

const char *track_score_replaced(struct track_memory *memory, const char *scene, const char *object,
                                 const char *track, struct arena *arena)
{
    for (size_t i = 0; i < memory->pairings.count; i++) {
        struct track_pairing *last = &memory->pairings.items[i];
        if (strcmp(last->object, object) != 0 || strcmp(last->scene, scene) != 0)
            continue;
        const char *before = last->track;
        if (strcmp(before, track) == 0)
            return NULL;
        last->track = arena_text(arena, track, strlen(track));
        return before;
    }
    *list_add(&memory->pairings, arena) = (struct track_pairing){
        arena_text(arena, scene, strlen(scene)), arena_text(arena, object, strlen(object)),
        arena_text(arena, track, strlen(track))};
    return NULL;
}

void track_score_forget(struct track_memory *memory, const char *scene)
{
    size_t kept = 0;
    for (size_t i = 0; i < memory->pairings.count; i++)
        if (strcmp(memory->pairings.items[i].scene, scene) != 0)
            memory->pairings.items[kept++] = memory->pairings.items[i];
    memory->pairings.count = kept;
}

static int compare(const void *left, const void *right)
{
    return strcmp((*(const struct object *const *)left)->id,
                  (*(const struct object *const *)right)->id);
}

static struct object_list true_objects(const struct frame *frame, enum track_truth truth,
                                       const char *classes)
{
    struct object_list objects = {0};
    for (size_t i = 0; i < frame->objects.count; i++)
        if (track_score_counts(frame, &frame->objects.items[i], truth, classes))
            *list_add(&objects.list, frame->arena) = &frame->objects.items[i];
    sort_list(&objects.list, compare, frame->arena);
    return objects;
}

/* Distance of the track from the box of the object, 0 inside. */
static double beside_m(const struct track *track, const struct object *object)
{
    struct vec2 offset = {track->x_m - object->x_m, track->y_m - object->y_m};
    struct vec2 heading = vec2_heading(object->yaw_rad);
    double along = fabs(vec2_dot(offset, heading)) - object->length_m / 2;
    double across = fabs(vec2_cross(heading, offset)) - object->width_m / 2;
    return elementary_hypot(along > 0 ? along : 0, across > 0 ? across : 0);
}

/* True if the track is of an object that is not expected. */
static bool excused(const struct frame *frame, const struct track *track, enum track_truth truth,
                    const char *classes)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (strcmp(object->id, frame->ego) != 0 &&
            beside_m(track, object) <= TRACK_SCORE_BESIDE_M &&
            !track_score_counts(frame, object, truth, classes))
            return true;
    }
    return false;
}

struct track_pairs track_score_pairs(const struct frame *frame, const struct track_list *list,
                                     enum track_truth truth, const char *classes)
{
    struct object_list objects = true_objects(frame, truth, classes);
    size_t rows = objects.list.count, columns = list->tracks.count;
    double *distance = arena_get(frame->arena, rows * columns * sizeof *distance);
    size_t *track_of = arena_get(frame->arena, rows * sizeof *track_of);
    bool *paired = arena_get(frame->arena, columns * sizeof *paired);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            distance[i * columns + j] =
                elementary_hypot(objects.list.items[i]->x_m - list->tracks.items[j].x_m,
                                 objects.list.items[i]->y_m - list->tracks.items[j].y_m);
    gospa_pair(distance, rows, columns, TRACK_SCORE_CUTOFF_M, track_of, frame->arena);
    struct track_pairs pairs = {0};
    for (size_t i = 0; i < rows; i++) {
        struct track_pair *pair = list_add(&pairs.list, frame->arena);
        pair->object = objects.list.items[i];
        if (track_of[i] == GOSPA_NONE)
            continue;
        pair->track = &list->tracks.items[track_of[i]];
        pair->apart_m = distance[i * columns + track_of[i]];
        paired[track_of[i]] = true;
    }
    for (size_t j = 0; j < columns; j++) {
        if (paired[j])
            continue;
        struct track_pair *alone = list_add(&pairs.list, frame->arena);
        alone->track = &list->tracks.items[j];
        alone->excused = excused(frame, alone->track, truth, classes);
    }
    return pairs;
}

int64_t track_score_frame(struct score_tally *tally, const struct frame *frame,
                          const struct track_list *list, enum track_truth truth,
                          const char *classes, struct track_memory *memory, struct arena *lasting)
{
    if (truth == TRACK_TRUTH_DETECTED && !frame_measured(frame)) {
        tally->listed_scans++;
        return 0;
    }
    struct track_pairs found = track_score_pairs(frame, list, truth, classes);
    struct score_values *errors = tally->values[SCORE_ERROR];
    double squares = 0;
    int64_t switches = 0;
    size_t objects = 0, listed = 0, pairs = 0;
    for (size_t i = 0; i < found.list.count; i++) {
        const struct track_pair *pair = &found.list.items[i];
        const struct object *object = pair->object;
        const struct track *track = pair->track;
        objects += object != NULL;
        listed += track != NULL && !pair->excused;
        if (object == NULL || track == NULL)
            continue;
        pairs++;
        squares += pair->apart_m * pair->apart_m;
        *list_add(&errors[SCORE_POSITION].list, frame->arena) = pair->apart_m;
        if ((track->present & TRACK_COVARIANCE) != 0)
            *list_add(&errors[SCORE_NEES].list, frame->arena) = normalised_square(track, object);
        *list_add(&errors[SCORE_VELOCITY].list, frame->arena) =
            elementary_hypot(object->vx_mps - track->vx_mps, object->vy_mps - track->vy_mps);
        switches +=
            track_score_replaced(memory, frame->scene, object->id, track->id, lasting) != NULL;
    }
    score_add_scan(tally, squares, pairs, objects, listed, TRACK_SCORE_CUTOFF_M);
    return switches;
}

void track_score_note_classes(struct intern *seen, const struct frame *frame, struct arena *arena)
{
    for (size_t i = 0; i < frame->objects.count; i++)
        if (!frame_same_name(frame->objects.items[i].id, frame->ego))
            intern_word(seen, frame->objects.items[i].class, arena);
}

int track_score_check_classes(struct intern *seen, const char *classes, struct arena *arena,
                              struct diag *diag)
{
    size_t count = seen->list.count;
    for (const char *at = classes; at != NULL;) {
        size_t length = strcspn(at, ",");
        const char *class = arena_text(arena, at, length);
        struct diag unused = {0};
        if (intern_word(seen, class, arena) >= count &&
            vehicle_load(class, NULL, arena, &unused) == NULL)
            return diag_fail(diag, DIAG_DATA,
                             "--classes: no object of the stream is of the class \"%s\", and no "
                             "vehicle document describes it",
                             class);
        at = at[length] == ',' ? at + length + 1 : NULL;
    }
    return 0;
}
