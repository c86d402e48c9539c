#include "ideal/look.h"

#include <stdlib.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/units.h"
#include "frame/frame_order.h"
#include "geometry/kinematics.h"
#include "geometry/obstruction.h"
#include "geometry/predicates.h"
#include "propagation/reflection.h"
#include "radar/radar_equation.h"

/* The longest leg of an echo, in units of the sensor's range: a ghost may come straight back from a
 * reflector that is twice that far away by way of the mirror. */
#define LONGEST_LEG 2

/* If a reflector is at least LEVEL times as far away as it is above or below the sensor, the sine
 * of the measured azimuth is at least 1 / LIFTED of the sine in the plane (kinematics.h). */
#define LEVEL 5
#define LIFTED 1.02

/* So many of the bodies that block alike stand for all of them: one more than the bodies that a
 * line may ignore, so that one is left. */
#define ENOUGH_TWINS 5

/* Slack of bounds, in metres and on sines; far more than their rounding. */
#define SLACK 1e-6

static struct box box_at(const struct object *object, double age_s)
{
    struct motion motion = frame_motion(object, age_s);
    return (struct box){motion, vec2_heading(motion.yaw_rad), object->length_m, object->width_m};
}

static int compare_id(const void *id, const void *body)
{
    return frame_order_names(id, &((const struct look_body *)body)->object->id);
}

static bool has_moved(const struct object *object, const struct motion *motion)
{
    return object->x_m != motion->position_m.x || object->y_m != motion->position_m.y ||
           object->yaw_rad != motion->yaw_rad;
}

static void place_body(const struct look *look, const struct object *object, double age_s,
                       struct look_body *body)
{
    *body = (struct look_body){.object = object, .box = box_at(object, age_s)};
    body->moved = age_s != 0 && has_moved(object, &body->box.motion);
    body->radius_m = 0.5 * vec2_length((struct vec2){object->length_m, object->width_m});
    body->sensor_m = vec2_turn_back(vec2_sub(look->pose.position_m, body->box.motion.position_m),
                                    body->box.heading);
    motion_box_outline(&body->box, body->corner);
}

static void place_bodies(struct look *look, double age_s)
{
    const struct frame *frame = look->frame;
    struct object *const *objects = frame_order_objects(look->frame);
    look->bodies = arena_room(frame->arena, frame->objects.count * sizeof *look->bodies);
    for (size_t i = 0; i < frame->objects.count; i++)
        if (!frame_same_name(objects[i]->id, frame->ego))
            place_body(look, objects[i], age_s, &look->bodies[look->body_count++]);
}

static int attach_reflectors(struct look *look, struct diag *diag)
{
    const struct frame *frame = look->frame;
    look->sets = arena_get(frame->arena, frame->reflectors.count * sizeof *look->sets);
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        const struct reflector_set *set = &frame->reflectors.items[i];
        look->sees_under |= look->sees_over && set->clearance_m > 0;
        look->sets[i] = (struct look_set){
            .reflectors = set,
            .shape = reflectors_shape(set, frame->arena),
            .bodies = arena_get(frame->arena, set->objects.count * sizeof(struct look_body *)),
        };
        for (size_t j = 0; j < set->objects.count; j++) {
            struct look_body *body = bsearch(&set->objects.items[j], look->bodies, look->body_count,
                                             sizeof *body, compare_id);
            if (body == NULL)
                return diag_fail(
                    diag, DIAG_DATA,
                    "reflectors[%zu].objects[%zu]: \"%s\" is not among the objects, or "
                    "is the ego",
                    i, j, set->objects.items[j]);
            body->set = &look->sets[i];
            body->blocks = set->blocks;
            body->raised = set->raised;
            look->sets[i].bodies[j] = body;
        }
    }
    return 0;
}

/* Extent of the body's box, scaled by share and then enlarged by beyond_m to every side. */
static struct look_extent extent_around(const struct look_body *body, double share, double beyond_m)
{
    struct vec2 half_m = {0.5 * share * body->box.length_m + beyond_m,
                          0.5 * share * body->box.width_m + beyond_m};
    struct silhouette silhouette = silhouette_of(half_m, body->box.heading, body->sensor_m);
    return (struct look_extent){silhouette, silhouette_span_of(&silhouette)};
}

/* Two bodies block alike if their boxes, heights and sets are the same. */
static bool is_twin(const void *bodies, uint32_t number, const void *wanted)
{
    const struct look_body *a = (const struct look_body *)bodies + number, *b = wanted;
    return vec2_same(a->box.motion.position_m, b->box.motion.position_m) &&
           vec2_same(a->box.heading, b->box.heading) && a->box.length_m == b->box.length_m &&
           a->box.width_m == b->box.width_m && a->object->height_m == b->object->height_m &&
           a->set == b->set;
}

/* Finds the bodies that other bodies stand for, so that many bodies at one place cost no more than
 * many apart. */
static void find_spare_bodies(struct look *look)
{
    struct hash_table places = hash_table_begin(look->body_count, look->frame->arena);
    for (size_t i = 0; i < look->body_count; i++) {
        struct look_body *body = &look->bodies[i];
        const struct vec2 *place_m = &body->box.motion.position_m;
        uint32_t *first =
            hash_table_slot(&places, hash_table_hash(0, (const char *)place_m, sizeof *place_m),
                            is_twin, look->bodies, body);
        if (*first == 0)
            *first = (uint32_t)i + 1;
        else
            body->spare = ++look->bodies[*first - 1].twins >= ENOUGH_TWINS;
    }
}

static void index_blockers(struct look *look)
{
    struct arena *arena = look->frame->arena;
    look->indexed = arena_room(arena, look->body_count * sizeof(*look->indexed));
    find_spare_bodies(look);
    for (size_t i = 0; i < look->body_count; i++) {
        struct look_body *body = &look->bodies[i];
        body->shadow = extent_around(body, 1, look->rim_m);
        /* With diffraction a wave loses power at each edge, so no body stands for another. */
        if (body->blocks && (!body->spare || look->wavelength_m > 0))
            look->indexed[look->indexed_count++] = body;
    }
    look->blocker_index = silhouette_index_begin(look->indexed_count, arena);
    for (size_t i = 0; i < look->indexed_count; i++)
        silhouette_index_enter(&look->blocker_index, i, look->indexed[i]->shadow.span);
}

static void set_view_borders(struct look *look)
{
    double border_rad = antenna_border_rad(look->sensor->field_of_view_rad),
           lifted = look->height_m > 0 ? LIFTED : 1;
    double sine = border_rad < PI / 2 ? lifted * elementary_sin(border_rad) + SLACK : 1;
    if (!(sine < 1))
        return;
    struct vec2 edge = {sqrt((1 - sine) * (1 + sine)), sine};
    look->view_right = vec2_turn_back(look->pose.boresight, edge);
    look->view_left = vec2_turn(look->pose.boresight, edge);
}

int look_begin(struct look *look, struct frame *frame, const struct sensor *sensor,
               const struct selection *selection, double time_s, struct diag *diag)
{
    double age_s = frame->time_s - time_s;
    const struct object *carrier = frame_object(frame, frame->ego);
    struct motion ego = frame_motion(carrier, age_s);
    *look =
        (struct look){.frame = frame, .sensor = sensor, .selection = selection, .time_s = time_s};
    look->ego_moved = age_s != 0 && has_moved(carrier, &ego);
    look->pose =
        kinematics_sensor_pose(&ego, sensor->mount_x_m, sensor->mount_y_m, sensor->mount_yaw_rad);
    look->height_m = sensor->mount_z_m;
    look->sees_over = look->height_m > 0 && effects_enabled(selection, EFFECT_HEIGHT);
    if (sensor->diffraction && effects_enabled(selection, EFFECT_DIFFRACTION))
        look->wavelength_m = units_wavelength_m(sensor->carrier_hz);
    look->rim_m = obstruction_edge_reach_m(LONGEST_LEG * sensor->range_max_m, look->wavelength_m);
    set_view_borders(look);
    place_bodies(look, age_s);
    if (attach_reflectors(look, diag) != 0)
        return -1;
    index_blockers(look);
    return 0;
}

struct look_extent look_reflectors_extent(const struct look *look, const struct look_body *body,
                                          const struct look_set *set)
{
    const struct reflectors_shape *shape = set->shape;
    bool within_shadow = shape->share == 1 && shape->inset_m <= look->rim_m;
    return within_shadow ? body->shadow : extent_around(body, shape->share, shape->inset_m);
}

struct kinematics look_kinematics(const struct look *look, struct vec2 place, struct vec2 velocity)
{
    return kinematics_of(look->pose.position_m, look->pose.velocity_mps, look->pose.boresight,
                         place, velocity);
}

double look_within_range_m(const struct look *look, const struct kinematics *read)
{
    double most_m = suite_range_max_m(look->sensor, read->azimuth_rad);
    return elementary_min(read->range_m - look->sensor->range_min_m, most_m - read->range_m);
}

double look_within_view_rad(const struct look *look, double azimuth_rad)
{
    return antenna_border_rad(look->sensor->field_of_view_rad) - fabs(azimuth_rad);
}

struct margins look_sight_margins(const struct look *look, double margin_m)
{
    struct margins margins = {0};
    if (frame_carries(look->frame, CARRY_MARGINS))
        margins_note(&margins, MARGIN_SIGHT, margin_m);
    return margins;
}

bool look_out_of_range(const struct look *look, const struct silhouette *silhouette)
{
    return silhouette->nearest_m > look->sensor->range_max_m + SLACK;
}

bool look_out_of_view(const struct look *look, const struct silhouette *silhouette)
{
    return silhouette_outside(silhouette, look->view_right, look->view_left);
}

double look_rise_m(const struct look *look, const struct look_body *body,
                   const struct look_set *set)
{
    const struct reflectors_shape *shape = set->shape;
    double lowest_m = look_reflector_height_m(look, body, shape->lowest_z) - look->height_m;
    double highest_m = look_reflector_height_m(look, body, shape->highest_z) - look->height_m;
    return elementary_max(fabs(lowest_m), fabs(highest_m));
}

/* Nearer than this, what is outside the borders of view may be in view. */
static double steep_m(const struct look *look, double rise_m)
{
    return look->height_m > 0 ? LEVEL * rise_m : 0;
}

bool look_disc_out_of_view(const struct look *look, double rise_m, struct vec2 centre,
                           double radius_m)
{
    struct vec2 sight = vec2_sub(centre, look->pose.position_m);
    double reach_m = radius_m + SLACK;
    return vec2_length(sight) - reach_m > steep_m(look, rise_m) &&
           (vec2_cross(look->view_right, sight) < -reach_m ||
            vec2_cross(sight, look->view_left) < -reach_m);
}

bool look_out_of_reach(const struct look *look, double rise_m, const struct silhouette *silhouette)
{
    return look_out_of_range(look, silhouette) ||
           (silhouette->nearest_m > steep_m(look, rise_m) && look_out_of_view(look, silhouette));
}

/* Keeps what lies to the left of a border through the sensor, or less than aside_m to its right. */
static void keep_left(struct look_stretch *stretch, struct vec2 border, struct vec2 from,
                      struct vec2 heading, double aside_m)
{
    double rise = vec2_cross(border, heading);
    double least = -vec2_cross(border, from) - aside_m * fabs(vec2_dot(border, heading)) - SLACK;
    if (rise > 0)
        stretch->first_m = elementary_max(stretch->first_m, least / rise);
    else if (rise < 0)
        stretch->end_m = elementary_min(stretch->end_m, least / rise);
    else if (least > 0)
        stretch->end_m = -(double)INFINITY;
}

struct look_stretch look_stretch_in_reach(const struct look *look, struct vec2 from,
                                          struct vec2 heading, double half_width_m, double rise_m)
{
    struct vec2 start = vec2_sub(from, look->pose.position_m), still = {0, 0};
    double foot_m = -vec2_dot(start, heading), range_m = look->sensor->range_max_m + SLACK;
    double aside_m = elementary_max(fabs(vec2_cross(heading, start)) - half_width_m, 0);
    double chord_m = sqrt(elementary_max((range_m - aside_m) * (range_m + aside_m), 0));
    double steep = steep_m(look, rise_m);
    struct look_stretch stretch = {foot_m - chord_m, foot_m + chord_m};
    if (aside_m > range_m)
        stretch.end_m = -(double)INFINITY;
    if (vec2_same(look->view_right, still))
        return stretch;
    keep_left(&stretch, look->view_right, start, heading, half_width_m);
    keep_left(&stretch, vec2_scale(-1, look->view_left), start, heading, half_width_m);
    if (aside_m <= steep) {
        stretch.first_m = elementary_min(stretch.first_m, foot_m - steep);
        stretch.end_m = elementary_max(stretch.end_m, foot_m + steep);
    }
    return stretch;
}

struct obstruction_heights look_heights(const struct look *look, const struct look_body *body)
{
    double height_m = body->object->height_m;
    bool seen_under = look->sees_under && body->set != NULL;
    return (struct obstruction_heights){
        .bottom_m = seen_under ? body->set->reflectors->clearance_m : 0,
        .top_m = look->sees_over && height_m > 0 ? height_m : (double)INFINITY,
    };
}

double look_reflector_height_m(const struct look *look, const struct look_body *body, double z)
{
    return z > 0 ? z * body->object->height_m : look->height_m;
}

uint64_t look_latency_effect(const struct look *look, const struct look_body *body)
{
    return look->ego_moved || body->moved ? EFFECT_BIT(EFFECT_LATENCY) : 0;
}

struct kinematics look_slant(const struct look *look, double reflector_m, struct kinematics plane,
                             double *gain, uint64_t *effects)
{
    const struct selection *selection = look->selection;
    double height_m = reflector_m - look->height_m;
    *gain = 1;
    bool tilted = look->height_m > 0 && effects_enabled(selection, EFFECT_ELEVATION) &&
                  (effects_forced(selection, EFFECT_ELEVATION) || height_m != 0);
    effects_note(selection, EFFECT_ELEVATION, tilted);
    if (!tilted)
        return plane;
    struct slant slant = kinematics_slant(plane.range_m, height_m);
    struct kinematics read = {
        .range_m = slant.range_m,
        .azimuth_rad = kinematics_slant_azimuth_rad(slant, plane.azimuth_rad),
        .range_rate_mps = slant.cosine * plane.range_rate_mps,
    };
    double half_width_rad = look->sensor->elevation_half_width_rad;
    const struct receiver_curve *curve = &look->sensor->elevation_levels;
    if (half_width_rad > 0)
        *gain = kinematics_slant_amplitude_factor(slant, half_width_rad);
    else if (curve->rows != NULL)
        *gain = receiver_curve_gain(curve, elementary_atan2(slant.sine, slant.cosine));
    if (read.range_m != plane.range_m || read.azimuth_rad != plane.azimuth_rad ||
        read.range_rate_mps != plane.range_rate_mps || *gain != 1)
        *effects |= EFFECT_BIT(EFFECT_ELEVATION);
    return read;
}

void look_set_elevation(const struct look *look, struct vec2 place, double height_m,
                        struct echo *echo)
{
    if (look->sensor->elevation_view_rad == 0)
        return;
    double distance_m = vec2_length(vec2_sub(place, look->pose.position_m));
    echo->elevation_rad = elementary_atan2(height_m - look->height_m, distance_m);
    echo->present |= VALUE_ELEVATION;
}

double look_plane_ercs(const struct look *look, const struct plane_reflector *plane, double range_m,
                       uint64_t *effects)
{
    bool curved = look->sensor->curved_sides && plane->profile_radius_m > 0 &&
                  effects_enabled(look->selection, EFFECT_CURVATURE);
    effects_note(look->selection, EFFECT_CURVATURE, curved);
    if (!curved)
        return plane->ercs;
    double radius_m = plane->radius_m > 0 ? plane->radius_m : (double)INFINITY;
    double ercs =
        radar_ercs(reflection_curved_cross_section_m2(plane->profile_radius_m, radius_m, range_m));
    if (ercs != plane->ercs)
        *effects |= EFFECT_BIT(EFFECT_CURVATURE);
    return ercs;
}

double look_visibility(const struct look *look, const struct look_body *body,
                       const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                       struct vec2 viewer)
{
    const struct box *box = &body->box;
    if (!effects_enabled(look->selection, EFFECT_VISIBILITY))
        return 1;
    double visible = reflectors_visibility(box, point, facing, place, viewer);
    if (point->lobe.depth_db == 0 || visible == 0)
        return visible;
    bool tilted = look->height_m > 0 && effects_enabled(look->selection, EFFECT_ELEVATION);
    double range_m =
        vec2_length(vec2_sub(viewer, place)) + vec2_length(vec2_sub(look->pose.position_m, viewer));
    double rise_m = tilted ? look->height_m - look_reflector_height_m(look, body, point->z) : 0;
    return visible * reflectors_lobe(box, point, place, viewer, elementary_atan2(range_m, rise_m));
}

struct point_reflector look_post(const struct post_row *row)
{
    return (struct point_reflector){
        .z = row->z,
        .extent = row->extent,
        .facing_rad = row->facing_rad,
        .full_rad = row->full_rad,
        .zero_rad = row->zero_rad,
        .shape = row->shape,
        .ercs = row->ercs,
    };
}
