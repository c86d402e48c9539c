#include "ghost_echoes.h"

#include <math.h>

#include "sight_margins.h"
#include "elementary.h"
#include "ghost_path.h"
#include "predicates.h"
#include "specular_point.h"
#include "units.h"
#include "line_of_sight.h"

enum { ONE_WAY = 2, BOTH_WAYS = 3 };

/* Posts of a row that are asked for together. */
enum { PIECE = 8 };

/* A mirror in the world. */
struct facet {
    const struct look_body *body;
    int64_t number;
    struct mirror mirror;
    struct vec2 along;
    double reflection;
    const struct look_body *before, *after; /* with a mirror in line that meets this one there */
    bool shares_end;                        /* bit by bit, with the mirror of after */
};

struct facets {
    struct facet *items;
    size_t count;
};

static struct facet facet_of(const struct look_body *body, size_t index)
{
    const struct mirror_plane *plane = &body->worn->set->mirrors.items[index];
    const struct plane_reflector side = {
        .from_x = plane->from_x, .from_y = plane->from_y, .to_x = plane->to_x, .to_y = plane->to_y};
    return (struct facet){
        .body = body,
        .number = (int64_t)index + 1,
        .mirror = {.a = reflectors_place(&body->box, plane->from_x, plane->from_y),
                   .b = reflectors_place(&body->box, plane->to_x, plane->to_y),
                   .body = body->box.motion},
        .along = reflectors_along(&body->box, &side),
        .reflection = plane->reflection,
    };
}

static size_t mirrors_of(const struct look_body *body)
{
    return body->worn != NULL ? body->worn->set->mirrors.count : 0;
}

static void join(struct facets *facets)
{
    for (size_t i = 0; i < facets->count; i++)
        for (size_t j = 0; j < facets->count; j++) {
            struct facet *first = &facets->items[i], *second = &facets->items[j];
            struct vec2 gap = vec2_sub(second->mirror.a, first->mirror.b);
            if (vec2_length(gap) <= LINE_OF_SIGHT_JOINT_M && vec2_same(first->along, second->along)) {
                first->after = second->body;
                second->before = first->body;
                first->shares_end |= vec2_same(first->mirror.b, second->mirror.a);
            }
        }
}

static struct facets facets_of(const struct look *look)
{
    struct facets facets = {0};
    size_t count = 0;
    for (size_t i = 0; i < look->body_count; i++)
        count += mirrors_of(&look->bodies[i]);
    facets.items = arena_get(look->frame->arena, (count + 1) * sizeof *facets.items);
    for (size_t i = 0; i < look->body_count; i++)
        for (size_t j = 0; j < mirrors_of(&look->bodies[i]); j++)
            facets.items[facets.count++] = facet_of(&look->bodies[i], j);
    join(&facets);
    return facets;
}

/* One of two ways between the sensor and a reflector: straight, or by the mirror. */
struct course {
    struct kinematics sight;
    double factor; /* on amplitude, for there and back */
    double margin_m;
    uint64_t effects;
};

/* A reflector and how a mirror shows it. */
struct reflex {
    const struct facet *facet;
    const struct look_body *body;
    const char *reflector;
    struct vec2 place, bounce;
    double height_m;
    double ercs;
    struct course direct, mirrored;
};

static struct course course_to(const struct look *look, struct vec2 place, struct vec2 velocity,
                               double height_m)
{
    struct course course = {.margin_m = (double)INFINITY};
    struct kinematics sight =
        kinematics_of(look->position_m, look->velocity_mps, look->boresight, place, velocity);
    course.sight = look_lifted(look, height_m, sight, &course.factor, &course.effects);
    return course;
}

static struct reflex reflex_of(const struct look *look, const struct facet *facet,
                               const struct look_body *body, struct vec2 place, double z,
                               struct vec2 bounce)
{
    struct vec2 velocity = motion_velocity_at(&body->box.motion, place);
    struct mirror_image image = mirror_image(&facet->mirror, place, velocity);
    double height_m = look_height_m(look, body, z);
    return (struct reflex){
        .facet = facet,
        .body = body,
        .place = place,
        .bounce = bounce,
        .height_m = height_m,
        .direct = course_to(look, place, velocity, height_m),
        .mirrored = course_to(look, image.place_m, image.velocity_mps, height_m),
    };
}

static bool bounces(const struct look *look, const struct facet *facet, struct vec2 place,
                    struct vec2 *bounce)
{
    if (!mirror_bounce(&facet->mirror, look->position_m, place, bounce))
        return false;
    if (!facet->shares_end)
        return true;
    struct vec2 image = mirror_image(&facet->mirror, place, (struct vec2){0, 0}).place_m;
    return predicates_orientation(look->position_m, image, facet->mirror.b) != 0;
}

/* Of the bounce from the mirror's ends, and of the sensor and the reflector from its line. */
static double bounce_margin_m(const struct look *look, const struct reflex *reflex)
{
    const struct facet *facet = reflex->facet;
    struct vec2 a = facet->mirror.a, b = facet->mirror.b, along = facet->along;
    double ends_m = elementary_least(fabs(vec2_dot(vec2_sub(reflex->bounce, a), along)),
                                     fabs(vec2_dot(vec2_sub(b, reflex->bounce), along)));
    double line_m = elementary_least(fabs(vec2_cross(along, vec2_sub(look->position_m, a))),
                                     fabs(vec2_cross(along, vec2_sub(reflex->place, a))));
    return elementary_least(ends_m, line_m);
}

/* Adds one leg to a course. False if nothing comes through. */
static bool pass(const struct look *look, struct course *course, struct obstruction_line line,
                 const struct look_body *const *but, size_t count)
{
    struct way way = line_of_sight_along(look, &line, but, count);
    course->factor *= way.factor;
    course->effects |= way.effects;
    if (look->frame->margins && way.factor > 0)
        course->margin_m =
            elementary_least(course->margin_m, line_of_sight_clearance_m(look, &line, but, count));
    return course->factor > 0;
}

static bool pass_directly(const struct look *look, struct reflex *reflex)
{
    struct obstruction_line line = {look->position_m, reflex->place, look->height_m, reflex->height_m};
    return pass(look, &reflex->direct, line, &reflex->body, 1);
}

static bool pass_by_mirror(const struct look *look, struct reflex *reflex)
{
    const struct facet *facet = reflex->facet;
    const struct look_body *touched[] = {facet->body, facet->before, facet->after, reflex->body};
    double out_m = vec2_length(vec2_sub(reflex->bounce, look->position_m));
    double on_m = vec2_length(vec2_sub(reflex->place, reflex->bounce));
    double height_m =
        look->height_m + (reflex->height_m - look->height_m) * (out_m / (out_m + on_m));
    double below_m = look_top_m(look, facet->body) - height_m;
    struct course *course = &reflex->mirrored;
    struct obstruction_line out = {look->position_m, reflex->bounce, look->height_m, height_m};
    struct obstruction_line on = {reflex->bounce, reflex->place, height_m, reflex->height_m};
    if (!(course->factor > 0 && below_m >= 0) || !pass(look, course, out, touched, 3) ||
        !pass(look, course, on, touched, 4))
        return false;
    if (look->frame->margins)
        course->margin_m = elementary_least(
            course->margin_m, elementary_least(bounce_margin_m(look, reflex), below_m));
    return true;
}

static bool is_listed(const struct sensor *sensor, const struct kinematics *sight, double departure_rad)
{
    return sight->range_m >= sensor->range_min_m && sight->range_m <= sensor->range_max_m &&
           fabs(sight->azimuth_rad) < look_border_rad(sensor) && fabs(departure_rad) <= PI / 2;
}

static double limits_margin_m(const struct sensor *sensor, const struct kinematics *sight,
                              double departure_rad)
{
    double view_rad = elementary_least(look_border_rad(sensor) - fabs(sight->azimuth_rad),
                                       PI / 2 - fabs(departure_rad));
    return elementary_least(elementary_least(sight->range_m - sensor->range_min_m,
                                             sensor->range_max_m - sight->range_m),
                            sight->range_m * view_rad);
}

static struct margins margins_of(const struct look *look, const struct kinematics *sight,
                                 const struct course *out, const struct course *back)
{
    struct margins margins = {0};
    double limits_m = limits_margin_m(look->sensor, sight, out->sight.azimuth_rad);
    if (look->frame->margins)
        margins_note(&margins, MARGIN_SIGHT,
                     elementary_least(limits_m, elementary_least(out->margin_m, back->margin_m)));
    return margins;
}

static void add(struct look *look, const struct reflex *reflex, enum path path, struct ghost_path ghost,
                const struct course *out, const struct course *back)
{
    double departure_rad = out->sight.azimuth_rad;
    frame_count_echoes(look->frame, look->sensor->name, path, 1);
    *list_add(&look->frame->echoes, look->frame->arena) = (struct echo){
        .sensor = look->sensor->name,
        .object = reflex->body->object->id,
        .reflector = reflex->reflector,
        .path = path,
        .mirror = reflex->facet->body->object->id,
        .number = reflex->facet->number,
        .range_m = ghost.sight.range_m,
        .azimuth_rad = ghost.sight.azimuth_rad,
        .range_rate_mps = ghost.sight.range_rate_mps,
        .ercs = sqrt(out->factor * back->factor) * reflex->ercs * ghost.ercs_factor,
        .departure_rad = departure_rad - ghost.sight.azimuth_rad,
        .time_s = look->time_s,
        .effects = EFFECT_BIT(EFFECT_GHOSTS) | out->effects | back->effects |
                   look_aged(look, reflex->body) | look_aged(look, reflex->facet->body),
        .margins = margins_of(look, &ghost.sight, out, back),
    };
}

/* Whatever of the reflector's paths there is. What stands in their way is only asked where the
 * sensor would list one. */
static void add_paths(struct look *look, struct reflex *reflex, bool one_way)
{
    const struct sensor *sensor = look->sensor;
    const struct course *direct = &reflex->direct, *mirrored = &reflex->mirrored;
    const struct kinematics *straight = &direct->sight, *image = &mirrored->sight;
    double reflection = reflex->facet->reflection;
    struct ghost_path both = ghost_path_both(reflection, image), out = both, back = both;
    one_way = one_way && direct->factor > 0 && straight->range_m > 0;
    if (one_way) {
        out = ghost_path_out(reflection, straight, image);
        back = ghost_path_back(reflection, straight, image);
    }
    bool has_both =
        sensor->bounces >= BOTH_WAYS && is_listed(sensor, &both.sight, image->azimuth_rad);
    bool has_out = one_way && is_listed(sensor, &out.sight, image->azimuth_rad);
    bool has_back = one_way && is_listed(sensor, &back.sight, straight->azimuth_rad);
    if (!(has_both || has_out || has_back) || !pass_by_mirror(look, reflex))
        return;
    if (has_both)
        add(look, reflex, PATH_WALL_OBJECT_WALL, both, mirrored, mirrored);
    if (!(has_out || has_back) || !pass_directly(look, reflex))
        return;
    if (has_out)
        add(look, reflex, PATH_WALL_OBJECT, out, mirrored, direct);
    if (has_back)
        add(look, reflex, PATH_OBJECT_WALL, back, direct, mirrored);
}

/* What a viewer at the sensor or the bounce sees of a point. */
static void show(const struct look *look, const struct reflex *reflex,
                 const struct point_reflector *point, struct vec2 facing, struct vec2 viewer,
                 struct course *course)
{
    const struct box *box = &reflex->body->box;
    if (!effects_may(look->selection, EFFECT_VISIBILITY))
        return;
    double visible = look_visibility(look, reflex->body, point, facing, reflex->place, viewer);
    course->factor *= visible;
    if (visible < 1)
        course->effects |= EFFECT_BIT(EFFECT_VISIBILITY);
    if (look->frame->margins)
        course->margin_m = sight_margins_facing_m(box, point->shape, point->facing_rad, point->zero_rad,
                                              reflex->place, viewer);
}

/* Can the sensor list any path of the point, as far as ranges and its face tell? Asked before what
 * costs more. No path is shorter than half of the way there by the mirror and straight back. */
static bool may_list(const struct look *look, const struct look_body *body,
                     const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                     struct vec2 bounce)
{
    double out_m = vec2_length(vec2_sub(bounce, look->position_m));
    double on_m = vec2_length(vec2_sub(place, bounce));
    double straight_m = vec2_length(vec2_sub(place, look->position_m));
    return out_m + on_m + straight_m <= 2 * look->sensor->range_max_m + 1e-6 &&
           (!effects_may(look->selection, EFFECT_VISIBILITY) ||
            reflectors_visibility(&body->box, point, facing, place, bounce) > 0);
}

static void add_point(struct look *look, const struct facet *facet, const struct look_body *body,
                      const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                      struct vec2 bounce)
{
    if (!may_list(look, body, point, facing, place, bounce))
        return;
    struct reflex reflex = reflex_of(look, facet, body, place, point->z, bounce);
    reflex.reflector = point->name;
    reflex.ercs = point->ercs;
    show(look, &reflex, point, facing, look->position_m, &reflex.direct);
    show(look, &reflex, point, facing, bounce, &reflex.mirrored);
    add_paths(look, &reflex, true);
}

static void add_points(struct look *look, const struct facet *facet, const struct look_body *body)
{
    const struct reflector_set *set = body->worn->set;
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        struct vec2 place = reflectors_point_place(&body->box, point), bounce;
        if (bounces(look, facet, place, &bounce))
            add_point(look, facet, body, point, body->worn->shape->faces[i].heading, place, bounce);
    }
}

/* Can the mirror show any of the posts from first to last? */
static bool may_show(const struct look *look, const struct facet *facet,
                     const struct look_body *body, const struct post_row *row, int64_t first,
                     int64_t last)
{
    struct vec2 from = reflectors_post_place(&body->box, row, first);
    struct vec2 to = reflectors_post_place(&body->box, row, last);
    struct vec2 centre = vec2_scale(0.5, vec2_add(from, to));
    return mirror_may_bounce(&facet->mirror, look->position_m, centre,
                             0.5 * vec2_length(vec2_sub(to, from)) + 1e-6);
}

static void add_post(struct look *look, const struct facet *facet, const struct look_body *body,
                     const struct post_row *row, struct vec2 facing, int64_t number)
{
    struct vec2 place = reflectors_post_place(&body->box, row, number), bounce;
    if (!bounces(look, facet, place, &bounce))
        return;
    struct point_reflector post = look_post(look, row, number);
    add_point(look, facet, body, &post, facing, place, bounce);
}

/* No path is shorter than the direct one: posts out of its range have no ghost in range. A row is
 * longer than most mirrors: of most of its pieces they can show nothing. */
static void add_row(struct look *look, const struct facet *facet, const struct look_body *body,
                    const struct post_row *row)
{
    bool all = effects_must(look->selection, EFFECT_GHOSTS);
    struct vec2 facing = vec2_heading(row->facing_rad);
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->position_m, look->sensor->range_max_m, &first,
                            &end);
    for (int64_t next; first < end; first = next) {
        next = first + PIECE < end ? first + PIECE : end;
        if (all || may_show(look, facet, body, row, first, next - 1))
            for (int64_t number = first; number < next; number++)
                add_post(look, facet, body, row, facing, number);
    }
}

static void add_plane(struct look *look, const struct facet *facet, const struct look_body *body,
                      const struct plane_reflector *plane)
{
    struct vec2 a = reflectors_place(&body->box, plane->from_x, plane->from_y);
    struct vec2 b = reflectors_place(&body->box, plane->to_x, plane->to_y);
    struct vec2 eye = mirror_image(&facet->mirror, look->position_m, (struct vec2){0, 0}).place_m;
    struct vec2 along = reflectors_along(&body->box, plane), foot, bounce;
    if (!specular_point_foot(a, b, along, plane->margin_m, eye, &foot) ||
        !bounces(look, facet, foot, &bounce))
        return;
    struct reflex reflex = reflex_of(look, facet, body, foot, plane->z, bounce);
    struct course *course = &reflex.mirrored;
    double range_m = vec2_length(vec2_sub(foot, eye));
    reflex.reflector = plane->name;
    reflex.ercs = look_plane_ercs(look, plane, range_m, &course->effects);
    course->effects |= EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    if (look->frame->margins)
        course->margin_m = sight_margins_foot_m(a, b, along, plane->margin_m, eye);
    add_paths(look, &reflex, false);
}

static void add_body(struct look *look, const struct facet *facet, const struct look_body *body)
{
    const struct reflector_set *set = body->worn->set;
    bool planes =
        look->sensor->bounces >= BOTH_WAYS && effects_may(look->selection, EFFECT_PLANE_REFLECTION);
    bool rows = effects_may(look->selection, EFFECT_ROWS);
    add_points(look, facet, body);
    for (size_t i = 0; i < set->planes.count && planes; i++)
        add_plane(look, facet, body, &set->planes.items[i]);
    for (size_t i = 0; i < set->rows.count && rows; i++)
        add_row(look, facet, body, &set->rows.items[i]);
}

static void add_all(struct look *look, const struct facets *facets, const struct look_body *body)
{
    const struct selection *selection = look->selection;
    bool all = effects_must(selection, EFFECT_GHOSTS);
    struct vec2 centre = body->box.motion.position_m;
    double radius_m = look_reflectors_radius_m(body, body->worn);
    for (size_t i = 0; i < facets->count; i++) {
        const struct facet *facet = &facets->items[i];
        if (facet->body == body)
            continue;
        bool reach = all || mirror_may_bounce(&facet->mirror, look->position_m, centre, radius_m);
        effects_note(selection, EFFECT_GHOSTS, reach);
        if (reach)
            add_body(look, facet, body);
    }
}

void ghost_echoes_add(struct look *look)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_GHOSTS, false);
    if (look->sensor->bounces < ONE_WAY || !effects_may(selection, EFFECT_GHOSTS))
        return;
    int64_t begin = effects_begin(selection);
    struct facets facets = facets_of(look);
    for (size_t i = 0; i < look->body_count && facets.count > 0; i++)
        if (look->bodies[i].worn != NULL)
            add_all(look, &facets, &look->bodies[i]);
    effects_end(selection, EFFECT_GHOSTS, begin);
}
