#include "ideal/ghost_echoes.h"

#include "base/elementary.h"
#include "base/units.h"
#include "ideal/line_of_sight.h"
#include "ideal/mirror_faces.h"
#include "propagation/reflection.h"

/* Bounces of a path that takes the mirror one way, or both ways. */
enum { BOUNCES_ONE_WAY = 2, BOUNCES_BOTH_WAYS = 3 };

/* A route between the sensor and a reflector: the direct one, or that by the mirror. */
struct route {
    struct vec2 place;      /* of the reflector, or of its image */
    struct kinematics read; /* of the same */
    double factor;          /* on amplitude, for there and back */
    double margin_m;        /* the least sight margin so far */
    uint64_t effects;       /* the effects that changed a value */
};

/* The wave on the way between the sensor and a reflector by the mirror. */
struct mirror_way {
    bool known; /* the other members are set */
    struct line_of_sight out, onward;
    double margin_m; /* the least sight margin of both legs and the bounce */
};

/* A reflector that may have ghosts in a mirror. */
struct ghost_candidate {
    const struct mirror_face *face;
    const struct look_body *body;
    const char *reflector;
    struct vec2 place, bounce;
    double height_m; /* of the reflector over the road */
    double ercs;
    struct mirror_way way;
    struct route direct, mirrored;
};

/* A mirror and a body that it may show. */
struct ghost_pair {
    const struct mirror_face *face;
    const struct look_body *body;
    bool all;           /* nothing is left out */
    bool image_in_view; /* false: surely no wave arrives from the mirror */
};

static struct route route_to(const struct look *look, struct vec2 place, struct vec2 velocity,
                             double height_m)
{
    struct route route = {.place = place, .margin_m = (double)INFINITY};
    route.read = look_slant(look, height_m, look_kinematics(look, place, velocity), &route.factor,
                            &route.effects);
    return route;
}

static struct ghost_candidate candidate_of(const struct look *look, const struct ghost_pair *pair,
                                           const char *reflector, struct vec2 place, double z,
                                           struct vec2 bounce)
{
    return (struct ghost_candidate){
        .face = pair->face,
        .body = pair->body,
        .reflector = reflector,
        .place = place,
        .bounce = bounce,
        .height_m = look_reflector_height_m(look, pair->body, z),
    };
}

static void set_routes(const struct look *look, struct ghost_candidate *candidate)
{
    struct vec2 velocity = motion_velocity_at(&candidate->body->box.motion, candidate->place);
    struct mirror_image image = mirror_image(&candidate->face->mirror, candidate->place, velocity);
    double height_m = candidate->height_m;
    candidate->direct = route_to(look, candidate->place, velocity, height_m);
    candidate->mirrored = route_to(look, image.place_m, image.velocity_mps, height_m);
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

/* The wave that passes a leg, which the bodies of except do not block. Lowers margin_m to the
 * leg's. */
static struct line_of_sight leg_of(const struct look *look, const struct obstruction_line *line,
                                   const struct look_body *const *except, size_t count,
                                   double *margin_m)
{
    struct line_of_sight passed = line_of_sight_along(look, line, except, count);
    if (frame_carries(look->frame, CARRY_MARGINS) && passed.factor > 0)
        *margin_m = elementary_min(*margin_m,
                                   line_of_sight_margin_m(look, except, count, line, false, false));
    return passed;
}

/* Multiplies the direct route by the wave that passes. False if nothing passes. */
static bool pass_straight(const struct look *look, struct ghost_candidate *candidate)
{
    const struct obstruction_line line = {look->pose.position_m, candidate->place, look->height_m,
                                          candidate->height_m};
    struct route *route = &candidate->direct;
    struct line_of_sight passed = leg_of(look, &line, &candidate->body, 1, &route->margin_m);
    route->factor *= passed.factor;
    route->effects |= passed.effects;
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

/* Finds what passes on the way by the mirror. False if nothing. */
static bool has_way(const struct look *look, struct ghost_candidate *candidate)
{
    const struct mirror_face *face = candidate->face;
    struct mirror_way *way = &candidate->way;
    if (way->known)
        return way->onward.factor > 0;
    double out_m = vec2_length(vec2_sub(candidate->bounce, look->pose.position_m));
    double onward_m = vec2_length(vec2_sub(candidate->place, candidate->bounce));
    double height_m =
        look->height_m + (candidate->height_m - look->height_m) * (out_m / (out_m + onward_m));
    struct obstruction_line out = {look->pose.position_m, candidate->bounce, look->height_m,
                                   height_m};
    struct obstruction_line onward = {candidate->bounce, candidate->place, height_m,
                                      candidate->height_m};
    const struct mirror_joints *joints = mirror_faces_joints(look, face);
    const struct look_body *touched[] = {face->body, joints->before, joints->after,
                                         candidate->body};
    way->known = true;
    way->margin_m = upright_margin_m(look, face, height_m);
    if (way->margin_m >= 0)
        way->out = leg_of(look, &out, touched, 3, &way->margin_m);
    if (way->out.factor > 0)
        way->onward = leg_of(look, &onward, touched, 4, &way->margin_m);
    if (frame_carries(look->frame, CARRY_MARGINS) && way->onward.factor > 0)
        way->margin_m = elementary_min(way->margin_m, bounce_margin_m(look, candidate));
    return way->onward.factor > 0;
}

static bool pass_by_mirror(const struct look *look, struct ghost_candidate *candidate)
{
    struct route *route = &candidate->mirrored;
    const struct mirror_way *way = &candidate->way;
    if (!(route->factor > 0) || !has_way(look, candidate))
        return false;
    route->factor = route->factor * way->out.factor * way->onward.factor;
    route->effects |= way->out.effects | way->onward.effects;
    route->margin_m = elementary_min(route->margin_m, way->margin_m);
    return route->factor > 0;
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
    bool one_way = path != PATH_WALL_OBJECT_WALL;
    struct echo *echo = list_add(&look->frame->echoes, look->frame->arena);
    frame_count_echoes(look->frame, look->sensor->name, path, 1);
    *echo = (struct echo){
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
        .departure_azimuth_rad = one_way ? out->read.azimuth_rad : 0,
        .time_s = look->time_s,
        .effects = EFFECT_BIT(EFFECT_GHOSTS) | out->effects | back->effects |
                   look_latency_effect(look, candidate->body) |
                   look_latency_effect(look, candidate->face->body),
        .margins = margins_of(look, &ghost.kinematics, out, back),
    };
    look_set_elevation(look, back->place, candidate->height_m, echo);
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
 * false. Unless the way by the mirror is known, it is searched only if a path is within the
 * sensor's limits. */
static void add_paths(struct look *look, struct ghost_candidate *candidate, bool one_way)
{
    const struct route *direct = &candidate->direct, *mirrored = &candidate->mirrored;
    const struct kinematics *object = &direct->read, *image = &mirrored->read;
    double reflection = bounce_factor(look, candidate);
    struct mirror_ghost both = mirror_ghost_both_ways(reflection, image);
    struct mirror_ghost out = both, back = both;
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
    if (!(has_out || has_back) || !pass_straight(look, candidate))
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
 * way and straight the other. Waves arrive from the point or from its image. */
static bool may_have_path(const struct look *look, const struct ghost_pair *pair,
                          const struct point_reflector *point, struct vec2 facing,
                          struct vec2 place, struct vec2 bounce)
{
    struct vec2 sensor = look->pose.position_m;
    struct vec2 image = mirror_image_place(&pair->face->mirror, place);
    struct silhouette straight = silhouette_of_place(vec2_sub(place, sensor));
    double rise_m = fabs(look_reflector_height_m(look, pair->body, point->z) - look->height_m);
    if (!pair->all && look_disc_out_of_view(look, rise_m, image, 0) &&
        look_out_of_reach(look, rise_m, &straight))
        return false;
    double way_m = vec2_length(vec2_sub(image, sensor)) + straight.nearest_m;
    return way_m <= 2 * look->sensor->range_max_m + 1e-6 &&
           (!effects_enabled(look->selection, EFFECT_VISIBILITY) ||
            reflectors_visibility(&pair->body->box, point, facing, place, bounce) > 0);
}

/* Adds the ghosts of a point. Under auto most of those that are left have a blocked way, which
 * costs less to find than the kinematics of both routes. */
static void add_point(struct look *look, const struct ghost_pair *pair,
                      const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                      struct vec2 bounce)
{
    struct ghost_candidate candidate =
        candidate_of(look, pair, point->name, place, point->z, bounce);
    if (!pair->all && !has_way(look, &candidate))
        return;
    set_routes(look, &candidate);
    candidate.ercs = point->ercs;
    apply_visibility(look, &candidate, point, facing, look->pose.position_m, &candidate.direct);
    apply_visibility(look, &candidate, point, facing, bounce, &candidate.mirrored);
    add_paths(look, &candidate, true);
}

/* Adds ghosts of the points. If none arrives from the mirror, all arrive from the point itself. */
static void add_points(struct look *look, const struct ghost_pair *pair)
{
    const struct look_body *body = pair->body;
    bool straight = !pair->image_in_view && effects_enabled(look->selection, EFFECT_VISIBILITY);
    for (size_t i = 0; i < body->set->reflectors->points.count; i++) {
        const struct point_reflector *point = &body->set->reflectors->points.items[i];
        const struct reflectors_face *face = &body->set->shape->faces[i];
        if (straight && reflectors_surely_unseen(&body->box, point, face, body->sensor_m))
            continue;
        struct vec2 place = reflectors_point_place(&body->box, point), bounce;
        if (mirror_faces_bounce(look, pair->face, place, &bounce) &&
            may_have_path(look, pair, point, face->heading, place, bounce))
            add_point(look, pair, point, face->heading, place, bounce);
    }
}

/* Adds ghosts of the posts in range, as no path is shorter than the direct one, that the mirror may
 * show. */
static void add_row(struct look *look, const struct ghost_pair *pair, const struct post_row *row)
{
    const struct box *box = &pair->body->box;
    struct vec2 facing = vec2_heading(row->facing_rad), bounce;
    struct point_reflector post = look_post(row);
    struct side line =
        line_of_sight_side(pair->body, row->from_x, row->from_y, row->to_x, row->to_y);
    double first_m = 0, end_m = vec2_length(vec2_sub(line.to, line.from));
    int64_t number, end;
    reflectors_posts_within(box, row, look->pose.position_m, look->sensor->range_max_m, &number,
                            &end);
    if (!pair->all && end_m > 0) {
        mirror_clip(&pair->face->mirror, line.from, line.along, &first_m, &end_m);
        reflectors_cut_posts(row, first_m, end_m, &number, &end);
    }
    for (; number < end; number++) {
        struct vec2 place = reflectors_post_place(box, row, number);
        if (!mirror_faces_bounce(look, pair->face, place, &bounce) ||
            !may_have_path(look, pair, &post, facing, place, bounce))
            continue;
        post.name = reflectors_post_name(row->name, number, look->frame->arena);
        add_point(look, pair, &post, facing, place, bounce);
    }
}

static void add_plane(struct look *look, const struct ghost_pair *pair,
                      const struct plane_reflector *plane)
{
    const struct look_body *body = pair->body;
    const struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    struct vec2 eye = pair->face->mirror.eye_m, foot, bounce;
    if (!mirror_specular_point(side.from, side.to, side.along, plane->margin_m, eye, &foot) ||
        !mirror_faces_bounce(look, pair->face, foot, &bounce))
        return;
    struct ghost_candidate candidate =
        candidate_of(look, pair, plane->name, foot, plane->z, bounce);
    struct route *route = &candidate.mirrored;
    double range_m = vec2_length(vec2_sub(foot, eye));
    set_routes(look, &candidate);
    candidate.ercs = look_plane_ercs(look, plane, range_m, &route->effects);
    route->effects |= EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    if (frame_carries(look->frame, CARRY_MARGINS))
        route->margin_m =
            line_of_sight_foot_margin_m(side.from, side.to, side.along, plane->margin_m, eye);
    add_paths(look, &candidate, false);
}

/* Adds ghosts of the flat sides, whose only path arrives from the mirror. */
static void add_planes(struct look *look, const struct ghost_pair *pair)
{
    const struct reflector_set *set = pair->body->set->reflectors;
    if (look->sensor->bounces < BOUNCES_BOTH_WAYS || !pair->image_in_view ||
        !effects_enabled(look->selection, EFFECT_PLANE_REFLECTION))
        return;
    for (size_t i = 0; i < set->planes.count; i++)
        add_plane(look, pair, &set->planes.items[i]);
}

/* Sets up a pair. False only if the body has no ghosts in the mirror, which has no bounce for it,
 * or neither the body nor its image is in view. */
static bool begin_pair(const struct look *look, struct ghost_pair *pair, double radius_m,
                       double rise_m, bool in_view)
{
    const struct mirror *mirror = &pair->face->mirror;
    struct vec2 centre = pair->body->box.motion.position_m;
    if (!pair->all &&
        (!(in_view || pair->face->in_view) || !mirror_may_bounce(mirror, centre, radius_m)))
        return false;
    struct vec2 image = mirror_image_place(mirror, centre);
    pair->image_in_view = pair->all || !look_disc_out_of_view(look, rise_m, image, radius_m);
    return in_view || pair->image_in_view;
}

/* Adds the ghosts of a body. A path is no shorter than twice the distance of the body, and arrives
 * from the mirror or from the body; one of the two is in view. */
static void add_ghosts_of(struct look *look, const struct mirror_faces *faces,
                          const struct look_body *body)
{
    const struct selection *selection = look->selection;
    const struct look_set *set = body->set;
    bool all = effects_forced(selection, EFFECT_GHOSTS);
    double radius_m = set->shape->share * body->radius_m + set->shape->inset_m;
    double rise_m = look_rise_m(look, body, set);
    struct look_extent extent = look_reflectors_extent(look, body, set);
    bool in_view = all || !look_out_of_reach(look, rise_m, &extent.silhouette);
    if (!in_view && look_out_of_range(look, &extent.silhouette))
        return;
    for (size_t i = 0; i < faces->list.count; i++) {
        struct ghost_pair pair = {.face = &faces->list.items[i], .body = body, .all = all};
        if (pair.face->body == body || !begin_pair(look, &pair, radius_m, rise_m, in_view))
            continue;
        effects_note(selection, EFFECT_GHOSTS, true);
        add_points(look, &pair);
        add_planes(look, &pair);
        for (size_t j = 0; j < set->reflectors->rows.count; j++)
            if (effects_enabled(selection, EFFECT_ROWS))
                add_row(look, &pair, &set->reflectors->rows.items[j]);
    }
}

void ghost_echoes_add(struct look *look)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_GHOSTS, false);
    if (look->sensor->bounces < BOUNCES_ONE_WAY || !effects_enabled(selection, EFFECT_GHOSTS))
        return;
    struct mirror_faces faces = mirror_faces_of(look);
    if (faces.list.count == 0)
        return;
    for (size_t i = 0; i < look->body_count; i++)
        if (look->bodies[i].set != NULL)
            add_ghosts_of(look, &faces, &look->bodies[i]);
}
