#include "look.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clearance.h"
#include "elementary.h"
#include "elevation.h"
#include "knife_edge.h"
#include "occlusion.h"
#include "orientation.h"
#include "reflection.h"
#include "sight.h"
#include "sort.h"
#include "specular.h"
#include "units.h"

/* The border of a field of view is outside, and this wide: the foot on a wall that is parallel to
 * boresight lies at 90 degrees but for its rounding. */
#define BORDER_RAD 1e-9

/* Losses name the stage whose work this is. */
static const char stage_name[] = "ideal";

double look_border_rad(const struct sensor *sensor)
{
    return sensor->field_of_view_rad / 2 - BORDER_RAD;
}

static struct box box_at(const struct object *object, double age_s)
{
    struct motion then = frame_motion(object, age_s);
    return (struct box){then, vec2_heading(then.yaw_rad), object->length_m, object->width_m};
}

static int compare_bodies(const void *left, const void *right)
{
    return strcmp(((const struct look_body *)left)->object->id,
                  ((const struct look_body *)right)->object->id);
}

static struct look_body *body_of(const struct look *look, const char *id)
{
    const struct object wanted = {.id = id};
    const struct look_body key = {.object = &wanted};
    return bsearch(&key, look->bodies, look->body_count, sizeof key, compare_bodies);
}

static bool moves(const struct object *object, const struct motion *then)
{
    return object->x_m != then->position_m.x || object->y_m != then->position_m.y ||
           object->yaw_rad != then->yaw_rad;
}

static void place_bodies(struct look *look, double age_s)
{
    const struct frame *frame = look->frame;
    look->bodies = arena_get(frame->arena, frame->objects.count * sizeof *look->bodies);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (strcmp(object->id, frame->ego) == 0)
            continue;
        struct look_body *body = &look->bodies[look->body_count++];
        body->object = object;
        body->box = box_at(object, age_s);
        body->moved = age_s != 0 && moves(object, &body->box.motion);
        body->sector =
            sector_of(vec2_sub(body->box.motion.position_m, look->position_m),
                      0.5 * vec2_length((struct vec2){object->length_m, object->width_m}));
        reflectors_outline(&body->box, body->corner);
    }
    sort_items(look->bodies, look->body_count, sizeof *look->bodies, compare_bodies, frame->arena);
}

static int mark_blockers(struct look *look, struct diag *diag)
{
    const struct frame *frame = look->frame;
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        const struct reflector_set *set = &frame->reflectors.items[i];
        for (size_t j = 0; j < set->worn_by.count; j++) {
            struct look_body *body = body_of(look, set->worn_by.items[j]);
            if (body == NULL)
                return diag_fail(
                    diag, DIAG_DATA,
                    "reflectors[%zu].worn_by[%zu]: \"%s\" is not among the objects, or "
                    "is the ego",
                    i, j, set->worn_by.items[j]);
            body->set = set;
            body->blocks = set->blocks;
            body->raised = set->raised;
        }
    }
    return 0;
}

int look_begin(struct look *look, struct frame *frame, const struct sensor *sensor,
               const struct selection *selection, double time_s, struct diag *diag)
{
    double age_s = frame->time_s - time_s;
    const struct object *carrier = frame_object(frame, frame->ego);
    struct box ego = box_at(carrier, age_s);
    struct vec2 mount = {sensor->mount_x_m, sensor->mount_y_m};
    *look =
        (struct look){.frame = frame, .sensor = sensor, .selection = selection, .time_s = time_s};
    look->moved = age_s != 0 && moves(carrier, &ego.motion);
    look->position_m = vec2_add(ego.motion.position_m, vec2_turn(mount, ego.heading));
    look->velocity_mps = motion_velocity_at(&ego.motion, look->position_m);
    look->boresight = vec2_turn(vec2_heading(sensor->mount_yaw_rad), ego.heading);
    look->height_m = sensor->mount_z_m;
    look->over = look->height_m > 0 && effects_may(selection, EFFECT_HEIGHT);
    if (sensor->diffraction && effects_may(selection, EFFECT_DIFFRACTION))
        look->wavelength_m = units_wavelength_m(sensor->carrier_hz);
    place_bodies(look, age_s);
    return mark_blockers(look, diag);
}

/* Both ends of a line beyond the same side of a body. */
static bool passes_beside(double from_m, double to_m, double reach_m)
{
    return fmin(from_m, to_m) > reach_m || fmax(from_m, to_m) < -reach_m;
}

/* A sight line that stays clear of the circle around a body, or has both ends beyond one of its
 * sides, cannot touch its outline. The slack covers the rounding of this test, so the exact one is
 * only spared where it would say no. */
static bool passes_clear(const struct look_body *body, struct vec2 from, struct vec2 to,
                         double wavelength_m)
{
    struct vec2 line = vec2_sub(to, from), centre = vec2_sub(body->box.motion.position_m, from);
    double length_m = vec2_length(line), along = vec2_dot(line, centre);
    double slack_m = 1e-6 + knife_edge_reach_m(length_m, wavelength_m);
    double reach = (body->sector.radius_m + slack_m) * (1 + 1e-9) * length_m;
    if (fabs(vec2_cross(line, centre)) > reach || along < -reach ||
        along > vec2_dot(line, line) + reach)
        return true;
    struct vec2 ahead = body->box.heading, rest = vec2_sub(centre, line);
    slack_m += 1e-9 * (length_m + body->sector.radius_m);
    return passes_beside(vec2_cross(ahead, centre), vec2_cross(ahead, rest),
                         0.5 * body->box.width_m + slack_m) ||
           passes_beside(vec2_dot(ahead, centre), vec2_dot(ahead, rest),
                         0.5 * body->box.length_m + slack_m);
}

/* A plane in the world. */
struct side {
    struct vec2 from, to, along;
};

static struct side side_of(const struct look_body *body, const struct plane_reflector *plane)
{
    return (struct side){.from = reflectors_place(&body->box, plane->from_x, plane->from_y),
                         .to = reflectors_place(&body->box, plane->to_x, plane->to_y),
                         .along = reflectors_along(&body->box, plane)};
}

/* Has the body a side in line with this one that begins where it ends (or ends where it begins),
 * but for so much? */
static bool joins(const struct look_body *body, const struct side *side, bool begins,
                  double within_m)
{
    for (size_t i = 0; body->set != NULL && i < body->set->planes.count; i++) {
        const struct plane_reflector *plane = &body->set->planes.items[i];
        struct side other = side_of(body, plane);
        struct vec2 gap = begins ? vec2_sub(other.from, side->to) : vec2_sub(other.to, side->from);
        if (plane->margin_m == 0 && vec2_same(other.along, side->along) &&
            vec2_length(gap) <= within_m)
            return true;
    }
    return false;
}

/* A foot exactly at the joint of two sides in line is the second one's (NUMERICS 33). */
static bool next_side_has_foot(const struct look *look, const struct side *side)
{
    if (orientation_along(side->to, look->position_m, side->along) != 0)
        return false;
    for (size_t i = 0; i < look->body_count; i++)
        if (joins(&look->bodies[i], side, true, 0))
            return true;
    return false;
}

/* Which objects to ask for when a body's reflectors are looked at. */
static void find_blockers(struct look *look, const struct look_body *own,
                          const struct reflector_set *set)
{
    const struct selection *selection = look->selection;
    int64_t begin = effects_begin(selection);
    struct sector wanted = own->sector;
    wanted.radius_m = reflectors_radius_m(set, own->sector.radius_m);
    look->blocker_count = 0;
    if (!effects_may(selection, EFFECT_OCCLUSION))
        return;
    bool all = effects_must(selection, EFFECT_OCCLUSION);
    double reach_m = knife_edge_reach_m(wanted.distance_m + wanted.radius_m, look->wavelength_m);
    for (size_t i = 0; i < look->body_count; i++) {
        const struct look_body *body = &look->bodies[i];
        struct sector shadow = body->sector;
        shadow.radius_m += reach_m;
        if (body != own && body->blocks && (all || sectors_overlap(&shadow, &wanted)))
            look->blockers[look->blocker_count++] = body;
    }
    bool some = all || look->blocker_count > 0;
    effects_note(selection, EFFECT_OCCLUSION, some);
    effects_note(selection, EFFECT_HEIGHT, look->over && some);
    effects_note(selection, EFFECT_DIFFRACTION, look->wavelength_m > 0 && some);
    effects_end(selection, EFFECT_OCCLUSION, begin);
}

double look_top_m(const struct look *look, const struct look_body *body)
{
    return look->over && body->object->height_m > 0 ? body->object->height_m : (double)INFINITY;
}

/* What one body lets through, and which effects beside occlusion matter to it. */
static struct look_way past(const struct look *look, const struct look_body *body,
                            const struct passage_line *line)
{
    struct passage passage =
        passage_of(body->corner, 4, look_top_m(look, body), line, look->wavelength_m);
    return (struct look_way){
        .factor = passage.factor,
        .by = passage.factor == 0 ? body : NULL,
        .effects = (passage.bent ? EFFECT_BIT(EFFECT_DIFFRACTION) : 0) |
                   (passage.over ? EFFECT_BIT(EFFECT_HEIGHT) : 0),
    };
}

/* What comes through to a place on the body that is looked at, on a side of it or not (NULL); only
 * those objects count that no radar can look under if solid. */
static struct look_way way_along(const struct look *look, const struct side *side,
                                 const struct passage_line *line, bool solid)
{
    struct look_way all = {.factor = 1};
    for (size_t i = 0; i < look->blocker_count; i++) {
        const struct look_body *body = look->blockers[i];
        if ((solid && body->raised) || passes_clear(body, line->from, line->to, look->wavelength_m))
            continue;
        struct look_way way = past(look, body, line);
        if ((way.factor == 1 && way.effects == 0) ||
            (side != NULL &&
             (joins(body, side, true, LOOK_JOINT_M) || joins(body, side, false, LOOK_JOINT_M))))
            continue;
        if (way.by != NULL)
            return way;
        all.factor *= way.factor;
        all.effects |= way.effects;
    }
    return all;
}

static bool is_among(const struct look_body *body, const struct look_body *const *bodies,
                     size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (bodies[i] == body)
            return true;
    return false;
}

struct look_way look_along(const struct look *look, const struct passage_line *line,
                           const struct look_body *const *but, size_t count)
{
    struct look_way all = {.factor = 1};
    for (size_t i = 0; i < look->body_count && effects_may(look->selection, EFFECT_OCCLUSION);
         i++) {
        const struct look_body *body = &look->bodies[i];
        if (!body->blocks || passes_clear(body, line->from, line->to, look->wavelength_m) ||
            is_among(body, but, count))
            continue;
        struct look_way way = past(look, body, line);
        if (way.by != NULL)
            return way;
        all.factor *= way.factor;
        all.effects |= way.effects;
    }
    return all;
}

/* Of all objects that can be in the way: how near the sight line comes to the nearest that lets it
 * pass, beside it or over it, or how deep it is in those in the way. Of a soft shadow nothing is
 * known but how deep the line lies in what is always dark. */
static double blocking_margin_m(const struct look *look, const struct look_body *const *but,
                                size_t count, const struct passage_line *line, bool solid,
                                bool blocked)
{
    double nearest_m = (double)INFINITY, deepest_m = 0;
    double length_m = vec2_length(vec2_sub(line->to, line->from));
    double soft_m = 2 * knife_edge_reach_m(length_m, look->wavelength_m);
    for (size_t i = 0; i < look->body_count; i++) {
        const struct look_body *body = &look->bodies[i];
        const struct vec2 *corner = body->corner, from = line->from, to = line->to;
        if (!body->blocks || (solid && body->raised) || is_among(body, but, count))
            continue;
        if (!occlusion_outline_blocks(corner, 4, from, to)) {
            nearest_m = fmin(nearest_m, clearance_outline_m(corner, 4, from, to));
            continue;
        }
        double above_m = passage_above_m(corner, 4, look_top_m(look, body), line);
        if (above_m > 0 || soft_m > 0)
            nearest_m = fmin(nearest_m, fmax(above_m, 0));
        double depth_m = fmin(clearance_depth_m(corner, 4, from, to), -above_m);
        deepest_m = fmax(deepest_m, depth_m - soft_m);
    }
    return blocked ? deepest_m : nearest_m;
}

double look_clearance_m(const struct look *look, const struct passage_line *line,
                        const struct look_body *const *but, size_t count)
{
    return effects_may(look->selection, EFFECT_OCCLUSION)
               ? blocking_margin_m(look, but, count, line, false, false)
               : (double)INFINITY;
}

static struct margins margins_of(const struct look *look, double margin_m)
{
    struct margins margins = {0};
    if (look->frame->margins)
        margins_note(&margins, MARGIN_SIGHT, margin_m);
    return margins;
}

static void lose(struct look *look, const struct look_body *body, const char *reflector,
                 enum loss reason, const struct look_body *by, double margin_m)
{
    frame_lose(look->frame, stage_name, look->sensor->name, reason,
               &(struct lost_echo){.object = body->object->id,
                                   .reflector = reflector,
                                   .by = by != NULL ? by->object->id : NULL,
                                   .margins = margins_of(look, margin_m)});
}

/* One reflector that faces the sensor. */
struct glimpse {
    const char *reflector;
    const struct side *side; /* that it is, or NULL for a point */
    struct vec2 place;
    double height_m;
    double z, extent; /* as described */
    enum moving_part moving_part;
    double ercs;
    double under_vehicles;
    double margin_m;  /* by which it faces the sensor */
    uint64_t effects; /* that changed something so far */
};

static double sight_margin_m(const struct look *look, const struct look_body *body,
                             const struct passage_line *line, bool under)
{
    if (!under)
        return look_clearance_m(look, line, &body, 1);
    return fmin(blocking_margin_m(look, &body, 1, line, true, false),
                blocking_margin_m(look, &body, 1, line, false, true));
}

/* The way past what stands there, or under it where that lets more through. */
static struct look_way best_way(const struct look *look, const struct glimpse *seen,
                                const struct passage_line *line, bool *under)
{
    *under = false;
    struct look_way way = way_along(look, seen->side, line, false);
    if (seen->under_vehicles == 0 || way.factor == 1)
        return way;
    struct look_way below = way_along(look, seen->side, line, true);
    below.factor *= seen->under_vehicles;
    below.effects |= EFFECT_BIT(EFFECT_OCCLUSION);
    *under = below.factor > way.factor;
    return *under ? below : way;
}

struct sight look_lifted(const struct look *look, double reflector_m, struct sight sight,
                         double *gain, uint64_t *effects)
{
    const struct selection *selection = look->selection;
    double height_m = reflector_m - look->height_m;
    *gain = 1;
    bool lift = look->height_m > 0 && effects_may(selection, EFFECT_ELEVATION) &&
                (effects_must(selection, EFFECT_ELEVATION) || height_m != 0);
    effects_note(selection, EFFECT_ELEVATION, lift);
    if (!lift)
        return sight;
    int64_t begin = effects_begin(selection);
    struct elevation elevation = elevation_of(sight.range_m, height_m);
    struct sight slant = {
        .range_m = elevation.range_m,
        .azimuth_rad = elevation_azimuth_rad(elevation, sight.azimuth_rad),
        .range_rate_mps = elevation.cosine * sight.range_rate_mps,
    };
    double half_width_rad = look->sensor->elevation_half_width_rad;
    if (half_width_rad > 0)
        *gain = elevation_amplitude_factor(elevation, half_width_rad);
    if (slant.range_m != sight.range_m || slant.azimuth_rad != sight.azimuth_rad ||
        slant.range_rate_mps != sight.range_rate_mps || *gain != 1)
        *effects |= EFFECT_BIT(EFFECT_ELEVATION);
    effects_end(selection, EFFECT_ELEVATION, begin);
    return slant;
}

/* Is it in range and in view? If not, it is lost. */
static bool in_reach(struct look *look, const struct look_body *body, struct glimpse *seen,
                     const struct sight *sight)
{
    const struct sensor *sensor = look->sensor;
    double azimuth = fabs(sight->azimuth_rad);
    double reach_m =
        fabs(fmin(sight->range_m - sensor->range_min_m, sensor->range_max_m - sight->range_m));
    double view_m = sight->range_m * fabs(look_border_rad(sensor) - azimuth);
    if (!(sight->range_m > 0 && sight->range_m >= sensor->range_min_m &&
          sight->range_m <= sensor->range_max_m)) {
        lose(look, body, seen->reflector, LOSS_OUT_OF_RANGE, NULL, reach_m);
        return false;
    }
    if (!(azimuth < look_border_rad(sensor))) {
        lose(look, body, seen->reflector, LOSS_OUT_OF_VIEW, NULL, view_m);
        return false;
    }
    seen->margin_m = fmin(seen->margin_m, fmin(reach_m, view_m));
    return true;
}

/* Its height over the road, where that is described, in a world that is not flat. */
static void tell_height(const struct look *look, const struct look_body *body,
                        const struct glimpse *seen, struct echo *echo)
{
    bool mirrors = look->frame->conditions.road != ROAD_UNKNOWN;
    if (!(mirrors && look->height_m > 0 && seen->z > 0))
        return;
    echo->height_m = seen->height_m;
    echo->extent_m = seen->extent * body->object->height_m;
}

/* How a part moves that turns or swings: its motion over ground has the same share of the range
 * rate along the line on which it is seen as in the plane. */
static void tell_motion(const struct look *look, const struct look_body *body,
                        const struct glimpse *seen, struct vec2 velocity, struct echo *echo)
{
    struct vec2 still = {0, 0}, boresight = look->boresight, heading = body->box.heading;
    if (!look->sensor->micro_motion || seen->moving_part == MOVING_NONE)
        return;
    struct sight ground = sight_of(look->position_m, still, boresight, seen->place, velocity);
    echo->moving_part = seen->moving_part;
    echo->ground_rate_mps = ground.range_rate_mps * (ground.range_m / echo->range_m);
    echo->heading_rad =
        elementary_atan2(vec2_cross(boresight, heading), vec2_dot(boresight, heading));
}

/* An echo if it is in range, in view and not blocked. */
static void look_at(struct look *look, const struct look_body *body, struct glimpse seen)
{
    bool tell = look->frame->margins, under;
    struct vec2 velocity = motion_velocity_at(&body->box.motion, seen.place);
    double gain;
    struct sight sight = look_lifted(
        look, seen.height_m,
        sight_of(look->position_m, look->velocity_mps, look->boresight, seen.place, velocity),
        &gain, &seen.effects);
    seen.ercs *= gain;
    if (!in_reach(look, body, &seen, &sight))
        return;
    const struct passage_line line = {look->position_m, seen.place, look->height_m, seen.height_m};
    int64_t begin = effects_begin(look->selection);
    struct look_way way = best_way(look, &seen, &line, &under);
    effects_end(look->selection, EFFECT_OCCLUSION, begin);
    if (way.by != NULL) {
        lose(look, body, seen.reflector, LOSS_BLOCKED, way.by,
             tell ? blocking_margin_m(look, &body, 1, &line, seen.under_vehicles > 0, true) : 0);
        return;
    }
    if (tell)
        seen.margin_m = fmin(seen.margin_m, sight_margin_m(look, body, &line, under));
    look->echoes++;
    struct echo *echo = list_add(&look->frame->echoes, look->frame->arena);
    *echo = (struct echo){
        .sensor = look->sensor->name,
        .object = body->object->id,
        .reflector = seen.reflector,
        .path = PATH_DIRECT,
        .range_m = sight.range_m,
        .azimuth_rad = sight.azimuth_rad,
        .range_rate_mps = sight.range_rate_mps,
        .ercs = way.factor * seen.ercs,
        .time_s = look->time_s,
        .effects = seen.effects | way.effects,
        .margins = margins_of(look, seen.margin_m),
    };
    tell_height(look, body, &seen, echo);
    tell_motion(look, body, &seen, velocity, echo);
}

double look_height_m(const struct look *look, const struct look_body *body, double z)
{
    return z > 0 ? z * body->object->height_m : look->height_m;
}

uint64_t look_aged(const struct look *look, const struct look_body *body)
{
    return look->moved || body->moved ? EFFECT_BIT(EFFECT_LATENCY) : 0;
}

static void look_at_point(struct look *look, const struct look_body *body,
                          const struct point_reflector *point, struct vec2 place)
{
    look->pairs++;
    bool selective = effects_may(look->selection, EFFECT_VISIBILITY);
    double visible =
        selective ? reflectors_visibility(&body->box, point->shape, point->facing_rad,
                                          point->full_rad, point->zero_rad, place, look->position_m)
                  : 1;
    double margin_m = (double)INFINITY;
    if (look->frame->margins && selective)
        margin_m = clearance_facing_m(&body->box, point->shape, point->facing_rad, point->zero_rad,
                                      place, look->position_m);
    if (visible > 0)
        look_at(look, body,
                (struct glimpse){
                    .reflector = point->name,
                    .place = place,
                    .height_m = look_height_m(look, body, point->z),
                    .z = point->z,
                    .extent = point->extent,
                    .moving_part = point->moving_part,
                    .ercs = visible * point->ercs,
                    .under_vehicles = point->under_vehicles,
                    .margin_m = margin_m,
                    .effects =
                        look_aged(look, body) | (visible < 1 ? EFFECT_BIT(EFFECT_VISIBILITY) : 0),
                });
    else
        lose(look, body, point->name, LOSS_FACING_AWAY, NULL, margin_m);
}

double look_plane_ercs(const struct look *look, const struct plane_reflector *plane, double range_m,
                       uint64_t *effects)
{
    bool curved = look->sensor->curved_sides && plane->profile_radius_m > 0 &&
                  effects_may(look->selection, EFFECT_CURVATURE);
    effects_note(look->selection, EFFECT_CURVATURE, curved);
    if (!curved)
        return plane->ercs;
    double radius_m = plane->radius_m > 0 ? plane->radius_m : (double)INFINITY;
    double ercs = specular_ercs(plane->profile_radius_m, radius_m, range_m);
    if (ercs != plane->ercs)
        *effects |= EFFECT_BIT(EFFECT_CURVATURE);
    return ercs;
}

static void look_at_plane(struct look *look, const struct look_body *body,
                          const struct plane_reflector *plane)
{
    look->pairs++;
    if (!effects_may(look->selection, EFFECT_PLANE_REFLECTION)) {
        lose(look, body, plane->name, LOSS_SWITCHED_OFF, NULL, (double)INFINITY);
        return;
    }
    struct side side = side_of(body, plane);
    struct vec2 foot;
    double margin_m = look->frame->margins ? clearance_foot_m(side.from, side.to, side.along,
                                                              plane->margin_m, look->position_m)
                                           : 0;
    if (reflection_foot(side.from, side.to, side.along, plane->margin_m, look->position_m, &foot) &&
        !next_side_has_foot(look, &side)) {
        struct glimpse seen = {
            .reflector = plane->name,
            .side = &side,
            .place = foot,
            .height_m = look_height_m(look, body, plane->z),
            .z = plane->z,
            .extent = plane->extent,
            .margin_m = margin_m,
            .effects = look_aged(look, body) | EFFECT_BIT(EFFECT_PLANE_REFLECTION),
        };
        double range_m = vec2_length(vec2_sub(foot, look->position_m));
        seen.ercs = look_plane_ercs(look, plane, range_m, &seen.effects);
        look_at(look, body, seen);
    } else
        lose(look, body, plane->name, LOSS_NO_SPECULAR, NULL, margin_m);
}

static const char *post_name(struct arena *arena, const struct post_row *row, int64_t post)
{
    size_t size = strlen(row->name) + 24;
    char *name = arena_get(arena, size);
    snprintf(name, size, "%s_%lld", row->name, (long long)post);
    return name;
}

struct point_reflector look_post(const struct look *look, const struct post_row *row, int64_t post)
{
    return (struct point_reflector){
        .name = post_name(look->frame->arena, row, post),
        .z = row->z,
        .extent = row->extent,
        .facing_rad = row->facing_rad,
        .full_rad = row->full_rad,
        .zero_rad = row->zero_rad,
        .shape = row->shape,
        .ercs = row->ercs,
    };
}

static void look_along_row(struct look *look, const struct look_body *body,
                           const struct post_row *row)
{
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->position_m, look->sensor->range_max_m, &first,
                            &end);
    for (int64_t number = first; number < end; number++) {
        const struct point_reflector post = look_post(look, row, number);
        look_at_point(look, body, &post, reflectors_post_place(&body->box, row, number));
    }
}

static void look_at_body(struct look *look, const struct look_body *body,
                         const struct reflector_set *set)
{
    const struct selection *selection = look->selection;
    find_blockers(look, body, set);
    effects_note(selection, EFFECT_VISIBILITY, set->points.count + set->rows.count > 0);
    effects_note(selection, EFFECT_PLANE_REFLECTION, set->planes.count > 0);
    effects_note(selection, EFFECT_ROWS, set->rows.count > 0);
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        look_at_point(look, body, point, reflectors_point_place(&body->box, point));
    }
    for (size_t i = 0; i < set->planes.count; i++)
        look_at_plane(look, body, &set->planes.items[i]);
    for (size_t i = 0; i < set->rows.count && effects_may(selection, EFFECT_ROWS); i++)
        look_along_row(look, body, &set->rows.items[i]);
}

void look_around(struct look *look)
{
    struct frame *frame = look->frame;
    look->blockers = arena_get(frame->arena, (look->body_count + 1) * sizeof(*look->blockers));
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        const struct reflector_set *set = &frame->reflectors.items[i];
        for (size_t j = 0; j < set->worn_by.count; j++)
            look_at_body(look, body_of(look, set->worn_by.items[j]), set);
    }
    frame_count_pairs(frame, look->sensor->name, look->pairs);
    frame_count_echoes(frame, look->sensor->name, PATH_DIRECT, look->echoes);
}
