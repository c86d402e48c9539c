#include "ideal/ghost_echoes.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/mirror.h"
#include "geometry/predicates.h"
#include "ideal/line_of_sight.h"
#include "propagation/reflection.h"

/* Bounces of a path that takes the mirror one way, or both ways. */
enum { BOUNCES_ONE_WAY = 2, BOUNCES_BOTH_WAYS = 3 };

/* Bodies with a mirror in line that ends where a mirror begins, or begins where it ends. */
struct mirror_joints {
    bool known;
    const struct look_body *before, *after;
    bool shares_end; /* a mirror begins exactly there, bit by bit */
};

/* A mirror in the world whose outer face is turned to the sensor. */
struct mirror_face {
    const struct look_body *body;
    int64_t number; /* among the body's mirrors, from 1 */
    struct mirror mirror;
    struct vec2 along; /* unit vector from a to b */
    const struct mirror_plane *plane;
    struct material_permittivity permittivity; /* of its material at the sensor's carrier */
    bool in_view;                              /* false: surely out of the field of view */
    struct mirror_joints *joints;              /* found at the first bounce */
};

struct mirror_faces {
    LIST_OF(struct mirror_face) list;
};

/* Adds a mirror of a body that is turned to the sensor. */
static void add_face(const struct look *look, const struct look_body *body, size_t index,
                     bool in_view, struct mirror_faces *faces)
{
    const struct mirror_plane *plane = &body->set->reflectors->mirrors.items[index];
    struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    struct mirror mirror = mirror_of(side.from, side.to, body->box.motion, look->pose.position_m);
    if (mirror.sensor_height_m == 0)
        return;
    *list_add(&faces->list, look->frame->arena) = (struct mirror_face){
        .body = body,
        .number = (int64_t)index + 1,
        .mirror = mirror,
        .along = side.along,
        .plane = plane,
        .permittivity = reflection_permittivity(plane->material, look->sensor->carrier_hz),
        .in_view = in_view,
        .joints = arena_get(look->frame->arena, sizeof(struct mirror_joints)),
    };
}

/* The mirrors that may have a path: every path touches its mirror within the sensor's range. */
static struct mirror_faces mirror_faces_of(const struct look *look)
{
    bool all = effects_forced(look->selection, EFFECT_GHOSTS);
    struct mirror_faces faces = {0};
    for (size_t i = 0; i < look->body_count; i++) {
        const struct look_body *body = &look->bodies[i];
        if (body->set == NULL)
            continue;
        struct look_extent extent = look_reflectors_extent(look, body, body->set);
        if (!all && look_out_of_range(look, &extent.silhouette))
            continue;
        bool in_view = all || !look_out_of_view(look, &extent.silhouette);
        for (size_t j = 0; j < body->set->reflectors->mirrors.count; j++)
            add_face(look, body, j, in_view, &faces);
    }
    return faces;
}

/* Notes the body if its mirror is in line with the face and meets an end of it. */
static void join(const struct mirror_face *face, const struct look_body *body,
                 const struct mirror_plane *plane)
{
    struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    if (!vec2_same(face->along, side.along))
        return;
    if (vec2_length(vec2_sub(side.from, face->mirror.b)) <= LINE_OF_SIGHT_JOINT_M) {
        face->joints->after = body;
        face->joints->shares_end |= vec2_same(side.from, face->mirror.b);
    }
    if (vec2_length(vec2_sub(face->mirror.a, side.to)) <= LINE_OF_SIGHT_JOINT_M)
        face->joints->before = body;
}

static const struct mirror_joints *joints_of(const struct look *look,
                                             const struct mirror_face *face)
{
    double half_m = 0.5 * vec2_length(vec2_sub(face->mirror.b, face->mirror.a));
    for (size_t i = 0; i < look->body_count && !face->joints->known; i++) {
        const struct look_body *body = &look->bodies[i];
        struct vec2 way = vec2_sub(face->mirror.middle, body->box.motion.position_m);
        if (body->set == NULL)
            continue;
        double reach_m =
            half_m + 10 * LINE_OF_SIGHT_JOINT_M + body->set->shape->share * body->radius_m;
        if (fabs(way.x) > reach_m || fabs(way.y) > reach_m)
            continue;
        for (size_t j = 0; j < body->set->reflectors->mirrors.count; j++)
            join(face, body, &body->set->reflectors->mirrors.items[j]);
    }
    face->joints->known = true;
    return face->joints;
}

/* A route between the sensor and a reflector: the direct one, or that by the mirror. */
struct route {
    struct kinematics read; /* of the reflector, or of its image */
    double factor;          /* on amplitude, for there and back */
    double margin_m;        /* the least sight margin so far */
    uint64_t effects;       /* the effects that changed a value */
};

/* A reflector that may have ghosts in a mirror. */
struct ghost_candidate {
    const struct mirror_face *face;
    const struct look_body *body;
    const char *reflector;
    struct vec2 place, bounce;
    double height_m; /* of the reflector over the road */
    double ercs;
    struct route direct, mirrored;
};

static struct route route_to(const struct look *look, struct vec2 place, struct vec2 velocity,
                             double height_m)
{
    struct route route = {.margin_m = (double)INFINITY};
    route.read = look_slant(look, height_m, look_kinematics(look, place, velocity), &route.factor,
                            &route.effects);
    return route;
}

static struct ghost_candidate candidate_of(const struct look *look, const struct mirror_face *face,
                                           const struct look_body *body, const char *reflector,
                                           struct vec2 place, double z, struct vec2 bounce)
{
    struct vec2 velocity = motion_velocity_at(&body->box.motion, place);
    struct mirror_image image = mirror_image(&face->mirror, place, velocity);
    double height_m = look_reflector_height_m(look, body, z);
    return (struct ghost_candidate){
        .face = face,
        .body = body,
        .reflector = reflector,
        .place = place,
        .bounce = bounce,
        .height_m = height_m,
        .direct = route_to(look, place, velocity, height_m),
        .mirrored = route_to(look, image.place_m, image.velocity_mps, height_m),
    };
}

/* True if the mirror has a bounce for the place. A bounce exactly on an end that two mirrors share
 * belongs to the next one. */
static bool has_bounce(const struct look *look, const struct mirror_face *face, struct vec2 place,
                       struct vec2 *bounce)
{
    if (!mirror_bounce(&face->mirror, place, bounce))
        return false;
    struct vec2 image = mirror_image(&face->mirror, place, (struct vec2){0, 0}).place_m;
    return predicates_orientation(look->pose.position_m, image, face->mirror.b) != 0 ||
           !joints_of(look, face)->shares_end;
}

/* Distance of the bounce from vanishing: the least of its distances from the mirror's ends, and of
 * those of sensor and reflector from the mirror's line. */
static double bounce_margin_m(const struct look *look, const struct ghost_candidate *candidate)
{
    const struct mirror_face *face = candidate->face;
    struct vec2 a = face->mirror.a, along = face->along;
    double from_a_m = vec2_dot(vec2_sub(candidate->bounce, a), along);
    double to_b_m = vec2_dot(vec2_sub(face->mirror.b, candidate->bounce), along);
    double line_m = elementary_min(fabs(vec2_cross(along, vec2_sub(look->pose.position_m, a))),
                                   fabs(vec2_cross(along, vec2_sub(candidate->place, a))));
    return elementary_min(elementary_min(fabs(from_a_m), fabs(to_b_m)), line_m);
}

/* Multiplies a route by the wave that passes one of its legs, which the bodies of except do not
 * block. False if nothing passes. */
static bool pass_leg(const struct look *look, struct route *route, struct obstruction_line line,
                     const struct look_body *const *except, size_t count)
{
    struct line_of_sight passed = line_of_sight_along(look, &line, except, count);
    route->factor *= passed.factor;
    route->effects |= passed.effects;
    if (frame_carries(look->frame, CARRY_MARGINS) && passed.factor > 0)
        route->margin_m = elementary_min(
            route->margin_m, line_of_sight_margin_m(look, except, count, &line, false, false));
    return route->factor > 0;
}

/* Distance of the bounce from the mirror's top and its lower edge; negative beyond one. */
static double upright_margin_m(const struct look *look, const struct mirror_face *face,
                               double height_m)
{
    double top_m = look_heights(look, face->body).top_m, below_m = top_m - height_m;
    double bottom_m = isinf(top_m) ? 0 : face->plane->bottom * top_m;
    return bottom_m > 0 ? elementary_min(below_m, height_m - bottom_m) : below_m;
}

static bool pass_by_mirror(const struct look *look, struct ghost_candidate *candidate)
{
    const struct mirror_face *face = candidate->face;
    double out_m = vec2_length(vec2_sub(candidate->bounce, look->pose.position_m));
    double onward_m = vec2_length(vec2_sub(candidate->place, candidate->bounce));
    double height_m =
        look->height_m + (candidate->height_m - look->height_m) * (out_m / (out_m + onward_m));
    double within_m = upright_margin_m(look, face, height_m);
    struct route *route = &candidate->mirrored;
    struct obstruction_line out = {look->pose.position_m, candidate->bounce, look->height_m,
                                   height_m};
    struct obstruction_line onward = {candidate->bounce, candidate->place, height_m,
                                      candidate->height_m};
    if (!(route->factor > 0 && within_m >= 0))
        return false;
    const struct mirror_joints *joints = joints_of(look, face);
    const struct look_body *touched[] = {face->body, joints->before, joints->after,
                                         candidate->body};
    if (!pass_leg(look, route, out, touched, 3) || !pass_leg(look, route, onward, touched, 4))
        return false;
    if (frame_carries(look->frame, CARRY_MARGINS))
        route->margin_m = elementary_min(
            route->margin_m, elementary_min(bounce_margin_m(look, candidate), within_m));
    return true;
}

static bool is_within_limits(const struct look *look, const struct kinematics *read,
                             double departure_rad)
{
    return look_within_range_m(look, read) >= 0 &&
           look_within_view_rad(look, read->azimuth_rad) > 0 && fabs(departure_rad) <= PI / 2;
}

static struct margins margins_of(const struct look *look, const struct kinematics *read,
                                 const struct route *out, const struct route *back)
{
    double view_rad = elementary_min(look_within_view_rad(look, read->azimuth_rad),
                                     PI / 2 - fabs(out->read.azimuth_rad));
    double limits_m = elementary_min(look_within_range_m(look, read), read->range_m * view_rad);
    double legs_m = elementary_min(out->margin_m, back->margin_m);
    return look_sight_margins(look, elementary_min(limits_m, legs_m));
}

static void add_ghost(struct look *look, const struct ghost_candidate *candidate, enum path path,
                      struct mirror_ghost ghost, const struct route *out, const struct route *back)
{
    double departure_rad = out->read.azimuth_rad;
    frame_count_echoes(look->frame, look->sensor->name, path, 1);
    *list_add(&look->frame->echoes, look->frame->arena) = (struct echo){
        .sensor = look->sensor->name,
        .id.object = candidate->body->object->id,
        .id.reflector = candidate->reflector,
        .id.path = path,
        .id.mirror = candidate->face->body->object->id,
        .id.number = candidate->face->number,
        .range_m = ghost.kinematics.range_m,
        .azimuth_rad = ghost.kinematics.azimuth_rad,
        .range_rate_mps = ghost.kinematics.range_rate_mps,
        .ercs = sqrt(out->factor * back->factor) * candidate->ercs * ghost.ercs_factor,
        .departure_rad = departure_rad - ghost.kinematics.azimuth_rad,
        .time_s = look->time_s,
        .effects = EFFECT_BIT(EFFECT_GHOSTS) | out->effects | back->effects |
                   look_latency_effect(look, candidate->body) |
                   look_latency_effect(look, candidate->face->body),
        .margins = margins_of(look, &ghost.kinematics, out, back),
    };
}

/* Part of the amplitude that is left after the bounce, relative to a perfect flat mirror. A
 * vertical field is parallel to the mirror, which is upright. */
static double bounce_factor(const struct look *look, const struct ghost_candidate *candidate)
{
    const struct mirror_face *face = candidate->face;
    const struct mirror_plane *plane = face->plane;
    double sensor_m = face->mirror.sensor_height_m;
    double place_m = mirror_height_m(&face->mirror, candidate->place);
    double way_m = candidate->mirrored.read.range_m;
    double share = sensor_m / (sensor_m + place_m), cosine = (sensor_m + place_m) / way_m;
    double radius_m = plane->radius_m > 0 ? plane->radius_m : (double)INFINITY;
    double profile_m = plane->profile_radius_m > 0 ? plane->profile_radius_m : (double)INFINITY;
    bool upright = look->sensor->polarization == POLARIZATION_VERTICAL;
    double part = plane->reflection;
    if (plane->material != MATERIAL_NONE) {
        double _Complex reflected =
            reflection_fresnel(&face->permittivity, upright ? MATERIAL_TE : MATERIAL_TM, cosine);
        part = elementary_hypot(creal(reflected), cimag(reflected));
    }
    return part * reflection_divergence(radius_m, profile_m, cosine, share * (1 - share) * way_m);
}

/* Adds the ghosts of a candidate: on all three paths, or on wall_object_wall alone if one_way is
 * false. Blocking bodies are searched only if a path is within the sensor's limits. */
static void add_paths(struct look *look, struct ghost_candidate *candidate, bool one_way)
{
    const struct route *direct = &candidate->direct, *mirrored = &candidate->mirrored;
    const struct kinematics *object = &direct->read, *image = &mirrored->read;
    double reflection = bounce_factor(look, candidate);
    struct mirror_ghost both = mirror_ghost_both_ways(reflection, image), out = both, back = both;
    one_way = one_way && direct->factor > 0 && object->range_m > 0;
    if (one_way) {
        out = mirror_ghost_one_way(reflection, object, image, object->azimuth_rad);
        back = mirror_ghost_one_way(reflection, object, image, image->azimuth_rad);
    }
    bool has_both = look->sensor->bounces >= BOUNCES_BOTH_WAYS &&
                    is_within_limits(look, &both.kinematics, image->azimuth_rad);
    bool has_out = one_way && is_within_limits(look, &out.kinematics, image->azimuth_rad);
    bool has_back = one_way && is_within_limits(look, &back.kinematics, object->azimuth_rad);
    if (!(has_both || has_out || has_back) || !pass_by_mirror(look, candidate))
        return;
    if (has_both)
        add_ghost(look, candidate, PATH_WALL_OBJECT_WALL, both, mirrored, mirrored);
    const struct obstruction_line line = {look->pose.position_m, candidate->place, look->height_m,
                                          candidate->height_m};
    if (!(has_out || has_back) || !pass_leg(look, &candidate->direct, line, &candidate->body, 1))
        return;
    if (has_out)
        add_ghost(look, candidate, PATH_WALL_OBJECT, out, mirrored, direct);
    if (has_back)
        add_ghost(look, candidate, PATH_OBJECT_WALL, back, direct, mirrored);
}

/* Multiplies a route by the point's visibility for its viewer: the sensor or the bounce. */
static void apply_visibility(const struct look *look, const struct ghost_candidate *candidate,
                             const struct point_reflector *point, struct vec2 facing,
                             struct vec2 viewer, struct route *route)
{
    if (!effects_enabled(look->selection, EFFECT_VISIBILITY))
        return;
    double visible =
        look_visibility(look, candidate->body, point, facing, candidate->place, viewer);
    route->factor *= visible;
    if (visible < 1)
        route->effects |= EFFECT_BIT(EFFECT_VISIBILITY);
    if (frame_carries(look->frame, CARRY_MARGINS))
        route->margin_m =
            line_of_sight_facing_margin_m(&candidate->body->box, point->shape, point->facing_rad,
                                          point->zero_rad, candidate->place, viewer);
}

/* A cheap test before all others. False if every path of the point is out of range or, under auto,
 * out of view, or if the point faces away from the bounce. The shortest path goes by the mirror one
 * way and straight the other. */
static bool may_have_path(const struct look *look, const struct look_body *body,
                          const struct point_reflector *point, struct vec2 facing,
                          struct vec2 place, struct vec2 bounce)
{
    struct silhouette straight = silhouette_of_place(vec2_sub(place, look->pose.position_m));
    struct silhouette mirrored = silhouette_of_place(vec2_sub(bounce, look->pose.position_m));
    if (!effects_forced(look->selection, EFFECT_GHOSTS) && look_out_of_view(look, &mirrored) &&
        look_out_of_reach(look, body->object->height_m, &straight))
        return false;
    double onward_m = vec2_length(vec2_sub(place, bounce));
    double way_m = mirrored.nearest_m + onward_m + straight.nearest_m;
    return way_m <= 2 * look->sensor->range_max_m + 1e-6 &&
           (!effects_enabled(look->selection, EFFECT_VISIBILITY) ||
            reflectors_visibility(&body->box, point, facing, place, bounce) > 0);
}

static void add_point(struct look *look, const struct mirror_face *face,
                      const struct look_body *body, const struct point_reflector *point,
                      struct vec2 facing, struct vec2 place, struct vec2 bounce)
{
    if (!may_have_path(look, body, point, facing, place, bounce))
        return;
    struct ghost_candidate candidate =
        candidate_of(look, face, body, point->name, place, point->z, bounce);
    candidate.ercs = point->ercs;
    apply_visibility(look, &candidate, point, facing, look->pose.position_m, &candidate.direct);
    apply_visibility(look, &candidate, point, facing, bounce, &candidate.mirrored);
    add_paths(look, &candidate, true);
}

static void add_points(struct look *look, const struct mirror_face *face,
                       const struct look_body *body)
{
    const struct reflector_set *set = body->set->reflectors;
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        struct vec2 place = reflectors_point_place(&body->box, point), bounce;
        if (has_bounce(look, face, place, &bounce))
            add_point(look, face, body, point, body->set->shape->faces[i].heading, place, bounce);
    }
}

/* Adds ghosts of the posts in range: no path is shorter than the direct one. */
static void add_row(struct look *look, const struct mirror_face *face, const struct look_body *body,
                    const struct post_row *row)
{
    struct vec2 facing = vec2_heading(row->facing_rad), bounce;
    int64_t number, end;
    reflectors_posts_within(&body->box, row, look->pose.position_m, look->sensor->range_max_m,
                            &number, &end);
    for (; number < end; number++) {
        struct vec2 place = reflectors_post_place(&body->box, row, number);
        if (!has_bounce(look, face, place, &bounce))
            continue;
        struct point_reflector post = look_post(look, row, number);
        add_point(look, face, body, &post, facing, place, bounce);
    }
}

static void add_plane(struct look *look, const struct mirror_face *face,
                      const struct look_body *body, const struct plane_reflector *plane)
{
    const struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    struct vec2 eye = face->mirror.eye_m, foot, bounce;
    if (!mirror_specular_point(side.from, side.to, side.along, plane->margin_m, eye, &foot) ||
        !has_bounce(look, face, foot, &bounce))
        return;
    struct ghost_candidate candidate =
        candidate_of(look, face, body, plane->name, foot, plane->z, bounce);
    struct route *route = &candidate.mirrored;
    double range_m = vec2_length(vec2_sub(foot, eye));
    candidate.ercs = look_plane_ercs(look, plane, range_m, &route->effects);
    route->effects |= EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    if (frame_carries(look->frame, CARRY_MARGINS))
        route->margin_m =
            line_of_sight_foot_margin_m(side.from, side.to, side.along, plane->margin_m, eye);
    add_paths(look, &candidate, false);
}

static void add_body(struct look *look, const struct mirror_face *face,
                     const struct look_body *body)
{
    const struct reflector_set *set = body->set->reflectors;
    bool planes = look->sensor->bounces >= BOUNCES_BOTH_WAYS &&
                  effects_enabled(look->selection, EFFECT_PLANE_REFLECTION);
    bool rows = effects_enabled(look->selection, EFFECT_ROWS);
    add_points(look, face, body);
    for (size_t i = 0; i < set->planes.count && planes; i++)
        add_plane(look, face, body, &set->planes.items[i]);
    for (size_t i = 0; i < set->rows.count && rows; i++)
        add_row(look, face, body, &set->rows.items[i]);
}

/* Adds the ghosts of a body. A path is no shorter than twice the distance of the body, and arrives
 * from the mirror or from the body; one of the two is in view. */
static void add_ghosts_of(struct look *look, const struct mirror_faces *faces,
                          const struct look_body *body)
{
    const struct selection *selection = look->selection;
    bool all = effects_forced(selection, EFFECT_GHOSTS);
    const struct reflectors_shape *shape = body->set->shape;
    double radius_m = shape->share * body->radius_m + shape->inset_m;
    struct look_extent extent = look_reflectors_extent(look, body, body->set);
    bool in_view = all || !look_out_of_reach(look, body->object->height_m, &extent.silhouette);
    if (!in_view && look_out_of_range(look, &extent.silhouette))
        return;
    for (size_t i = 0; i < faces->list.count; i++) {
        const struct mirror_face *face = &faces->list.items[i];
        if (face->body == body || !(in_view || face->in_view) ||
            !(all || mirror_may_bounce(&face->mirror, body->box.motion.position_m, radius_m)))
            continue;
        effects_note(selection, EFFECT_GHOSTS, true);
        add_body(look, face, body);
    }
}

void ghost_echoes_add(struct look *look)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_GHOSTS, false);
    if (look->sensor->bounces < BOUNCES_ONE_WAY || !effects_enabled(selection, EFFECT_GHOSTS))
        return;
    struct mirror_faces faces = mirror_faces_of(look);
    for (size_t i = 0; i < look->body_count && faces.list.count > 0; i++)
        if (look->bodies[i].set != NULL)
            add_ghosts_of(look, &faces, &look->bodies[i]);
}
