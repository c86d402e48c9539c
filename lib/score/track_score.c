#include "score/track_score.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "geometry/kinematics.h"
#include "geometry/sensor_pose.h"
#include "score/assignment.h"

const char *const track_score_truths[] = {[TRACK_TRUTH_IN_VIEW] = "in_view",
                                          [TRACK_TRUTH_DETECTED] = "detected",
                                          [TRACK_TRUTH_ALL] = "all",
                                          NULL};

struct object_list {
    LIST_OF(const struct object *) list;
};

int track_score_check(const struct frame *frame, enum track_truth truth, struct diag *diag)
{
    unsigned needed = truth == TRACK_TRUTH_IN_VIEW    ? SECTION_SENSORS
                      : truth == TRACK_TRUTH_DETECTED ? SECTION_TARGETS
                                                      : 0;
    if ((needed & ~frame->present) == 0)
        return 0;
    return diag_fail(diag, DIAG_DATA, "%s: missing; --objects=%s needs it",
                     frame_section_name(needed), track_score_truths[truth]);
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
        sensor_pose_on(&motion, view->mount_x_m, view->mount_y_m, view->mount_yaw_rad);
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

bool track_score_counts(const struct frame *frame, const struct object *object,
                        enum track_truth truth, const char *classes)
{
    return strcmp(object->id, frame->ego) != 0 &&
           (classes == NULL || is_named(classes, object->class)) &&
           (truth == TRACK_TRUTH_ALL || (truth == TRACK_TRUTH_IN_VIEW && in_view(frame, object)) ||
            (truth == TRACK_TRUTH_DETECTED && frame_detects(frame, object->id)));
}

bool track_score_switches(struct track_memory *memory, const char *scene, const char *object,
                          const char *track, struct arena *arena)
{
    for (size_t i = 0; i < memory->pairings.count; i++) {
        struct track_pairing *last = &memory->pairings.items[i];
        if (strcmp(last->object, object) != 0 || strcmp(last->scene, scene) != 0)
            continue;
        if (strcmp(last->track, track) == 0)
            return false;
        last->track = arena_text(arena, track, strlen(track));
        return true;
    }
    *list_add(&memory->pairings, arena) = (struct track_pairing){
        arena_text(arena, scene, strlen(scene)), arena_text(arena, object, strlen(object)),
        arena_text(arena, track, strlen(track))};
    return false;
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

int64_t track_score_frame(struct score_tally *tally, const struct frame *frame,
                          const struct track_list *list, enum track_truth truth,
                          const char *classes, double cutoff_m, struct track_memory *memory,
                          struct arena *lasting)
{
    struct object_list objects = true_objects(frame, truth, classes);
    size_t rows = objects.list.count, columns = list->tracks.count;
    double *distance = arena_get(frame->arena, rows * columns * sizeof *distance);
    size_t *track_of = arena_get(frame->arena, rows * sizeof *track_of);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            distance[i * columns + j] =
                elementary_hypot(objects.list.items[i]->x_m - list->tracks.items[j].x_m,
                                 objects.list.items[i]->y_m - list->tracks.items[j].y_m);
    size_t pairs = gospa_pair(distance, rows, columns, cutoff_m, track_of, frame->arena);
    double squares = 0;
    int64_t switches = 0;
    for (size_t i = 0; i < rows; i++) {
        if (track_of[i] == ASSIGNMENT_NONE)
            continue;
        const struct object *object = objects.list.items[i];
        const struct track *track = &list->tracks.items[track_of[i]];
        double apart_m = distance[i * columns + track_of[i]];
        squares += apart_m * apart_m;
        score_add_value(&tally->values[SCORE_ERROR][SCORE_POSITION], apart_m, frame->arena);
        score_add_value(
            &tally->values[SCORE_ERROR][SCORE_VELOCITY],
            elementary_hypot(object->vx_mps - track->vx_mps, object->vy_mps - track->vy_mps),
            frame->arena);
        switches += track_score_switches(memory, frame->scene, object->id, track->id, lasting);
    }
    score_add_scan(tally, squares, pairs, rows, columns, cutoff_m);
    return switches;
}
