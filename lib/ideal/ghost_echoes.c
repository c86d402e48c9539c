#include "ideal/ghost_echoes.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/ghost_path.h"
#include "geometry/predicates.h"
#include "geometry/specular_point.h"
#include "ideal/line_of_sight.h"
#include "ideal/sight_margins.h"

enum { ONE_WAY = 2, BOTH_WAYS = 3 };

/* Posts of a row that are asked for together. */
enum { PIECE = 8 };

/* A mirror in the world. */
struct mirror_face {
    const struct look_body *body;
    int64_t number;
    struct mirror mirror;
    struct vec2 along;
    double reflection;
    const struct look_body *before, *after; /* with a mirror in line that meets this one there */
    bool shares_end;                        /* bit by bit, with the mirror of after */
};

struct mirror_faces {
    struct mirror_face *items;
    size_t count;
};

static struct mirror_face mirror_face_of(const struct look_body *body, size_t index)
{
    const struct mirror_plane *plane = &body->set->reflectors->mirrors.items[index];
    return (struct mirror_face){
        .body = body,
        .number = (int64_t)index + 1,
        .mirror = {.a = box_place(&body->box, plane->from_x, plane->from_y),
                   .b = box_place(&body->box, plane->to_x, plane->to_y),
                   .body = body->box.motion},
        .along = box_along(&body->box, plane->from_x, plane->from_y, plane->to_x, plane->to_y),
        .reflection = plane->reflection,
    };
}

static size_t mirrors_of(const struct look_body *body)
{
    return body->set != NULL ? body->set->reflectors->mirrors.count : 0;
}

static void join(struct mirror_faces *mirror_faces)
{
    for (size_t i = 0; i < mirror_faces->count; i++)
        for (size_t j = 0; j < mirror_faces->count; j++) {
            struct mirror_face *first = &mirror_faces->items[i], *second = &mirror_faces->items[j];
            struct vec2 gap = vec2_sub(second->mirror.a, first->mirror.b);
            if (vec2_length(gap) <= LINE_OF_SIGHT_JOINT_M &&
                vec2_same(first->along, second->along)) {
                first->after = second->body;
                second->before = first->body;
                first->shares_end |= vec2_same(first->mirror.b, second->mirror.a);
            }
        }
}

static struct mirror_faces mirror_faces_of(const struct look *look)
{
    struct mirror_faces mirror_faces = {0};
    size_t count = 0;
    for (size_t i = 0; i < look->body_count; i++)
        count += mirrors_of(&look->bodies[i]);
    mirror_faces.items = arena_get(look->frame->arena, (count + 1) * sizeof *mirror_faces.items);
    for (size_t i = 0; i < look->body_count; i++)
        for (size_t j = 0; j < mirrors_of(&look->bodies[i]); j++)
            mirror_faces.items[mirror_faces.count++] = mirror_face_of(&look->bodies[i], j);
    join(&mirror_faces);
    return mirror_faces;
}

/* One of two ways between the sensor and a reflector: straight, or by the mirror. */
struct leg {
    struct kinematics sight;
    double factor; /* on amplitude, for there and back */
    double margin_m;
    uint64_t effects;
};

/* A reflector and how a mirror shows it. */
struct ghost_candidate {
    const struct mirror_face *mirror_face;
    const struct look_body *body;
    const char *reflector;
    struct vec2 place, bounce;
    double height_m;
    double ercs;
    struct leg direct, mirrored;
};

static struct leg leg_to(const struct look *look, struct vec2 place, struct vec2 velocity,
                         double height_m)
{
    struct leg leg = {.margin_m = (double)INFINITY};
    struct kinematics sight = kinematics_of(look->pose.position_m, look->pose.velocity_mps,
                                            look->pose.boresight, place, velocity);
    leg.sight = look_slant(look, height_m, sight, &leg.factor, &leg.effects);
    return leg;
}

static struct ghost_candidate ghost_candidate_of(const struct look *look,
                                                 const struct mirror_face *mirror_face,
                                                 const struct look_body *body, struct vec2 place,
                                                 double z, struct vec2 bounce)
{
    struct vec2 velocity = motion_velocity_at(&body->box.motion, place);
    struct mirror_image image = mirror_image(&mirror_face->mirror, place, velocity);
    double height_m = look_height_m(look, body, z);
    return (struct ghost_candidate){
        .mirror_face = mirror_face,
        .body = body,
        .place = place,
        .bounce = bounce,
        .height_m = height_m,
        .direct = leg_to(look, place, velocity, height_m),
        .mirrored = leg_to(look, image.place_m, image.velocity_mps, height_m),
    };
}

static bool bounces(const struct look *look, const struct mirror_face *mirror_face,
                    struct vec2 place, struct vec2 *bounce)
{
    if (!mirror_bounce(&mirror_face->mirror, look->pose.position_m, place, bounce))
        return false;
    if (!mirror_face->shares_end)
        return true;
    struct vec2 image = mirror_image(&mirror_face->mirror, place, (struct vec2){0, 0}).place_m;
    return predicates_orientation(look->pose.position_m, image, mirror_face->mirror.b) != 0;
}

/* Of the bounce from the mirror's ends, and of the sensor and the reflector from its line. */
static double bounce_margin_m(const struct look *look,
                              const struct ghost_candidate *ghost_candidate)
{
    const struct mirror_face *mirror_face = ghost_candidate->mirror_face;
    struct vec2 a = mirror_face->mirror.a, b = mirror_face->mirror.b, along = mirror_face->along;
    double ends_m = elementary_min(fabs(vec2_dot(vec2_sub(ghost_candidate->bounce, a), along)),
                                   fabs(vec2_dot(vec2_sub(b, ghost_candidate->bounce), along)));
    double line_m = elementary_min(fabs(vec2_cross(along, vec2_sub(look->pose.position_m, a))),
                                   fabs(vec2_cross(along, vec2_sub(ghost_candidate->place, a))));
    return elementary_min(ends_m, line_m);
}

/* Adds one leg to a course. False if nothing comes through. */
static bool pass(const struct look *look, struct leg *leg, struct obstruction_line line,
                 const struct look_body *const *but, size_t count)
{
    struct line_of_sight way = line_of_sight_along(look, &line, but, count);
    leg->factor *= way.factor;
    leg->effects |= way.effects;
    if (look->frame->margins && way.factor > 0)
        leg->margin_m =
            elementary_min(leg->margin_m, line_of_sight_clearance_m(look, &line, but, count));
    return leg->factor > 0;
}

static bool pass_directly(const struct look *look, struct ghost_candidate *ghost_candidate)
{
    struct obstruction_line line = {look->pose.position_m, ghost_candidate->place, look->height_m,
                                    ghost_candidate->height_m};
    return pass(look, &ghost_candidate->direct, line, &ghost_candidate->body, 1);
}

static bool pass_by_mirror(const struct look *look, struct ghost_candidate *ghost_candidate)
{
    const struct mirror_face *mirror_face = ghost_candidate->mirror_face;
    const struct look_body *touched[] = {mirror_face->body, mirror_face->before, mirror_face->after,
                                         ghost_candidate->body};
    double out_m = vec2_length(vec2_sub(ghost_candidate->bounce, look->pose.position_m));
    double on_m = vec2_length(vec2_sub(ghost_candidate->place, ghost_candidate->bounce));
    double height_m =
        look->height_m + (ghost_candidate->height_m - look->height_m) * (out_m / (out_m + on_m));
    double below_m = look_top_m(look, mirror_face->body) - height_m;
    struct leg *leg = &ghost_candidate->mirrored;
    struct obstruction_line out = {look->pose.position_m, ghost_candidate->bounce, look->height_m,
                                   height_m};
    struct obstruction_line on = {ghost_candidate->bounce, ghost_candidate->place, height_m,
                                  ghost_candidate->height_m};
    if (!(leg->factor > 0 && below_m >= 0) || !pass(look, leg, out, touched, 3) ||
        !pass(look, leg, on, touched, 4))
        return false;
    if (look->frame->margins)
        leg->margin_m = elementary_min(
            leg->margin_m, elementary_min(bounce_margin_m(look, ghost_candidate), below_m));
    return true;
}

static bool is_listed(const struct sensor *sensor, const struct kinematics *sight,
                      double departure_rad)
{
    return sight->range_m >= sensor->range_min_m && sight->range_m <= sensor->range_max_m &&
           fabs(sight->azimuth_rad) < suite_border_rad(sensor) && fabs(departure_rad) <= PI / 2;
}

static double limits_margin_m(const struct sensor *sensor, const struct kinematics *sight,
                              double departure_rad)
{
    double view_rad = elementary_min(suite_border_rad(sensor) - fabs(sight->azimuth_rad),
                                     PI / 2 - fabs(departure_rad));
    return elementary_min(
        elementary_min(sight->range_m - sensor->range_min_m, sensor->range_max_m - sight->range_m),
        sight->range_m * view_rad);
}

static struct margins margins_of(const struct look *look, const struct kinematics *sight,
                                 const struct leg *out, const struct leg *back)
{
    struct margins margins = {0};
    double limits_m = limits_margin_m(look->sensor, sight, out->sight.azimuth_rad);
    if (look->frame->margins)
        margins_note(&margins, MARGIN_SIGHT,
                     elementary_min(limits_m, elementary_min(out->margin_m, back->margin_m)));
    return margins;
}

static void add(struct look *look, const struct ghost_candidate *ghost_candidate, enum path path,
                struct ghost_path ghost, const struct leg *out, const struct leg *back)
{
    double departure_rad = out->sight.azimuth_rad;
    frame_count_echoes(look->frame, look->sensor->name, path, 1);
    *list_add(&look->frame->echoes, look->frame->arena) = (struct echo){
        .sensor = look->sensor->name,
        .id.object = ghost_candidate->body->object->id,
        .id.reflector = ghost_candidate->reflector,
        .id.path = path,
        .id.mirror = ghost_candidate->mirror_face->body->object->id,
        .id.number = ghost_candidate->mirror_face->number,
        .range_m = ghost.kinematics.range_m,
        .azimuth_rad = ghost.kinematics.azimuth_rad,
        .range_rate_mps = ghost.kinematics.range_rate_mps,
        .ercs = sqrt(out->factor * back->factor) * ghost_candidate->ercs * ghost.ercs_factor,
        .departure_rad = departure_rad - ghost.kinematics.azimuth_rad,
        .time_s = look->time_s,
        .effects = EFFECT_BIT(EFFECT_GHOSTS) | out->effects | back->effects |
                   look_latency_effect(look, ghost_candidate->body) |
                   look_latency_effect(look, ghost_candidate->mirror_face->body),
        .margins = margins_of(look, &ghost.kinematics, out, back),
    };
}

/* Whatever of the reflector's paths there is. What stands in their way is only asked where the
 * sensor would list one. */
static void add_paths(struct look *look, struct ghost_candidate *ghost_candidate, bool one_way)
{
    const struct sensor *sensor = look->sensor;
    const struct leg *direct = &ghost_candidate->direct, *mirrored = &ghost_candidate->mirrored;
    const struct kinematics *straight = &direct->sight, *image = &mirrored->sight;
    double reflection = ghost_candidate->mirror_face->reflection;
    struct ghost_path both = ghost_path_both(reflection, image), out = both, back = both;
    one_way = one_way && direct->factor > 0 && straight->range_m > 0;
    if (one_way) {
        out = ghost_path_out(reflection, straight, image);
        back = ghost_path_back(reflection, straight, image);
    }
    bool has_both =
        sensor->bounces >= BOTH_WAYS && is_listed(sensor, &both.kinematics, image->azimuth_rad);
    bool has_out = one_way && is_listed(sensor, &out.kinematics, image->azimuth_rad);
    bool has_back = one_way && is_listed(sensor, &back.kinematics, straight->azimuth_rad);
    if (!(has_both || has_out || has_back) || !pass_by_mirror(look, ghost_candidate))
        return;
    if (has_both)
        add(look, ghost_candidate, PATH_WALL_OBJECT_WALL, both, mirrored, mirrored);
    if (!(has_out || has_back) || !pass_directly(look, ghost_candidate))
        return;
    if (has_out)
        add(look, ghost_candidate, PATH_WALL_OBJECT, out, mirrored, direct);
    if (has_back)
        add(look, ghost_candidate, PATH_OBJECT_WALL, back, direct, mirrored);
}

/* What a viewer at the sensor or the bounce sees of a point. */
static void show(const struct look *look, const struct ghost_candidate *ghost_candidate,
                 const struct point_reflector *point, struct vec2 facing, struct vec2 viewer,
                 struct leg *leg)
{
    const struct box *box = &ghost_candidate->body->box;
    if (!effects_enabled(look->selection, EFFECT_VISIBILITY))
        return;
    double visible =
        look_visibility(look, ghost_candidate->body, point, facing, ghost_candidate->place, viewer);
    leg->factor *= visible;
    if (visible < 1)
        leg->effects |= EFFECT_BIT(EFFECT_VISIBILITY);
    if (look->frame->margins)
        leg->margin_m = sight_margins_facing_m(box, point->shape, point->facing_rad,
                                               point->zero_rad, ghost_candidate->place, viewer);
}

/* Can the sensor list any path of the point, as far as ranges and its face tell? Asked before what
 * costs more. No path is shorter than half of the way there by the mirror and straight back. */
static bool may_list(const struct look *look, const struct look_body *body,
                     const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                     struct vec2 bounce)
{
    double out_m = vec2_length(vec2_sub(bounce, look->pose.position_m));
    double on_m = vec2_length(vec2_sub(place, bounce));
    double straight_m = vec2_length(vec2_sub(place, look->pose.position_m));
    return out_m + on_m + straight_m <= 2 * look->sensor->range_max_m + 1e-6 &&
           (!effects_enabled(look->selection, EFFECT_VISIBILITY) ||
            reflectors_visibility(&body->box, point, facing, place, bounce) > 0);
}

static void add_point(struct look *look, const struct mirror_face *mirror_face,
                      const struct look_body *body, const struct point_reflector *point,
                      struct vec2 facing, struct vec2 place, struct vec2 bounce)
{
    if (!may_list(look, body, point, facing, place, bounce))
        return;
    struct ghost_candidate ghost_candidate =
        ghost_candidate_of(look, mirror_face, body, place, point->z, bounce);
    ghost_candidate.reflector = point->name;
    ghost_candidate.ercs = point->ercs;
    show(look, &ghost_candidate, point, facing, look->pose.position_m, &ghost_candidate.direct);
    show(look, &ghost_candidate, point, facing, bounce, &ghost_candidate.mirrored);
    add_paths(look, &ghost_candidate, true);
}

static void add_points(struct look *look, const struct mirror_face *mirror_face,
                       const struct look_body *body)
{
    const struct reflector_set *set = body->set->reflectors;
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        struct vec2 place = reflectors_point_place(&body->box, point), bounce;
        if (bounces(look, mirror_face, place, &bounce))
            add_point(look, mirror_face, body, point, body->set->shape->faces[i].heading, place,
                      bounce);
    }
}

/* Can the mirror show any of the posts from first to last? */
static bool may_show(const struct look *look, const struct mirror_face *mirror_face,
                     const struct look_body *body, const struct post_row *row, int64_t first,
                     int64_t last)
{
    struct vec2 from = reflectors_post_place(&body->box, row, first);
    struct vec2 to = reflectors_post_place(&body->box, row, last);
    struct vec2 centre = vec2_scale(0.5, vec2_add(from, to));
    return mirror_may_bounce(&mirror_face->mirror, look->pose.position_m, centre,
                             0.5 * vec2_length(vec2_sub(to, from)) + 1e-6);
}

static void add_post(struct look *look, const struct mirror_face *mirror_face,
                     const struct look_body *body, const struct post_row *row, struct vec2 facing,
                     int64_t number)
{
    struct vec2 place = reflectors_post_place(&body->box, row, number), bounce;
    if (!bounces(look, mirror_face, place, &bounce))
        return;
    struct point_reflector post = look_post(look, row, number);
    add_point(look, mirror_face, body, &post, facing, place, bounce);
}

/* No path is shorter than the direct one: posts out of its range have no ghost in range. A row is
 * longer than most mirrors: of most of its pieces they can show nothing. */
static void add_row(struct look *look, const struct mirror_face *mirror_face,
                    const struct look_body *body, const struct post_row *row)
{
    bool all = effects_forced(look->selection, EFFECT_GHOSTS);
    struct vec2 facing = vec2_heading(row->facing_rad);
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->pose.position_m, look->sensor->range_max_m,
                            &first, &end);
    for (int64_t next; first < end; first = next) {
        next = first + PIECE < end ? first + PIECE : end;
        if (all || may_show(look, mirror_face, body, row, first, next - 1))
            for (int64_t number = first; number < next; number++)
                add_post(look, mirror_face, body, row, facing, number);
    }
}

static void add_plane(struct look *look, const struct mirror_face *mirror_face,
                      const struct look_body *body, const struct plane_reflector *plane)
{
    const struct side side = line_of_sight_side(body, plane);
    struct vec2 eye =
        mirror_image(&mirror_face->mirror, look->pose.position_m, (struct vec2){0, 0}).place_m;
    struct vec2 foot, bounce;
    if (!specular_point_foot(side.from, side.to, side.along, plane->margin_m, eye, &foot) ||
        !bounces(look, mirror_face, foot, &bounce))
        return;
    struct ghost_candidate ghost_candidate =
        ghost_candidate_of(look, mirror_face, body, foot, plane->z, bounce);
    struct leg *leg = &ghost_candidate.mirrored;
    double range_m = vec2_length(vec2_sub(foot, eye));
    ghost_candidate.reflector = plane->name;
    ghost_candidate.ercs = look_plane_ercs(look, plane, range_m, &leg->effects);
    leg->effects |= EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    if (look->frame->margins)
        leg->margin_m = sight_margins_foot_m(side.from, side.to, side.along, plane->margin_m, eye);
    add_paths(look, &ghost_candidate, false);
}

static void add_body(struct look *look, const struct mirror_face *mirror_face,
                     const struct look_body *body)
{
    const struct reflector_set *set = body->set->reflectors;
    bool planes = look->sensor->bounces >= BOTH_WAYS &&
                  effects_enabled(look->selection, EFFECT_PLANE_REFLECTION);
    bool rows = effects_enabled(look->selection, EFFECT_ROWS);
    add_points(look, mirror_face, body);
    for (size_t i = 0; i < set->planes.count && planes; i++)
        add_plane(look, mirror_face, body, &set->planes.items[i]);
    for (size_t i = 0; i < set->rows.count && rows; i++)
        add_row(look, mirror_face, body, &set->rows.items[i]);
}

static void add_all(struct look *look, const struct mirror_faces *mirror_faces,
                    const struct look_body *body)
{
    const struct selection *selection = look->selection;
    bool all = effects_forced(selection, EFFECT_GHOSTS);
    struct vec2 centre = body->box.motion.position_m;
    double radius_m = look_reflectors_radius_m(body, body->set);
    for (size_t i = 0; i < mirror_faces->count; i++) {
        const struct mirror_face *mirror_face = &mirror_faces->items[i];
        if (mirror_face->body == body)
            continue;
        bool reach =
            all || mirror_may_bounce(&mirror_face->mirror, look->pose.position_m, centre, radius_m);
        effects_note(selection, EFFECT_GHOSTS, reach);
        if (reach)
            add_body(look, mirror_face, body);
    }
}

void ghost_echoes_add(struct look *look)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_GHOSTS, false);
    if (look->sensor->bounces < ONE_WAY || !effects_enabled(selection, EFFECT_GHOSTS))
        return;
    int64_t begin = effects_begin(selection);
    struct mirror_faces mirror_faces = mirror_faces_of(look);
    for (size_t i = 0; i < look->body_count && mirror_faces.count > 0; i++)
        if (look->bodies[i].set != NULL)
            add_all(look, &mirror_faces, &look->bodies[i]);
    effects_end(selection, EFFECT_GHOSTS, begin);
}
