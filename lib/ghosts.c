#include "ghosts.h"

#include <math.h>

#include "clearance.h"
#include "ghost.h"
#include "orientation.h"
#include "reflection.h"
#include "units.h"

enum { ONE_WAY = 2, BOTH_WAYS = 3 };

/* A mirror in the world. */
struct facet {
    const struct look_body *body;
    int64_t number;
    struct mirror mirror;
    struct vec2 along;
    double reflection;
    const struct look_body *before, *after; /* with a mirror in line that meets this one there */
};

struct facets {
    struct facet *items;
    size_t count;
};

static struct facet facet_of(const struct look_body *body, size_t index)
{
    const struct mirror_plane *plane = &body->set->mirrors.items[index];
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
    return body->set != NULL ? body->set->mirrors.count : 0;
}

static void join(struct facets *facets)
{
    for (size_t i = 0; i < facets->count; i++)
        for (size_t j = 0; j < facets->count; j++) {
            struct facet *first = &facets->items[i], *second = &facets->items[j];
            if (vec2_same(first->mirror.b, second->mirror.a) &&
                vec2_same(first->along, second->along)) {
                first->after = second->body;
                second->before = first->body;
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

/* A reflector and how a mirror shows it. */
struct reflex {
    const struct facet *facet;
    const struct look_body *body;
    const char *reflector;
    struct vec2 place, bounce;
    struct sight direct, image;
    double ercs;
    double visible_direct, visible_mirrored;
    double margin_m, direct_margin_m; /* of what decides about it, and about its direct way */
    uint64_t effects;
};

static struct reflex reflex_of(const struct look *look, const struct facet *facet,
                               const struct look_body *body, struct vec2 place, struct vec2 bounce)
{
    struct vec2 velocity = motion_velocity_at(&body->box.motion, place);
    struct mirror_image image = mirror_image(&facet->mirror, place, velocity);
    return (struct reflex){
        .facet = facet,
        .body = body,
        .place = place,
        .bounce = bounce,
        .direct = sight_of(look->position_m, look->velocity_mps, look->boresight, place, velocity),
        .image = sight_of(look->position_m, look->velocity_mps, look->boresight, image.place_m,
                          image.velocity_mps),
        .visible_direct = 1,
        .visible_mirrored = 1,
        .margin_m = (double)INFINITY,
        .direct_margin_m = (double)INFINITY,
        .effects = EFFECT_BIT(EFFECT_GHOSTS) | look_aged(look, body) | look_aged(look, facet->body),
    };
}

static bool bounces(const struct look *look, const struct facet *facet, struct vec2 place,
                    struct vec2 *bounce)
{
    if (!mirror_bounce(&facet->mirror, look->position_m, place, bounce))
        return false;
    if (facet->after == NULL)
        return true;
    struct vec2 image = mirror_image(&facet->mirror, place, (struct vec2){0, 0}).place_m;
    return orientation_sign(look->position_m, image, facet->mirror.b) != 0;
}

/* Of the bounce from the mirror's ends, and of the sensor and the reflector from its line. */
static double bounce_margin_m(const struct look *look, const struct reflex *reflex)
{
    const struct facet *facet = reflex->facet;
    struct vec2 a = facet->mirror.a, b = facet->mirror.b, along = facet->along;
    double ends_m = fmin(fabs(vec2_dot(vec2_sub(reflex->bounce, a), along)),
                         fabs(vec2_dot(vec2_sub(b, reflex->bounce), along)));
    double line_m = fmin(fabs(vec2_cross(along, vec2_sub(look->position_m, a))),
                         fabs(vec2_cross(along, vec2_sub(reflex->place, a))));
    return fmin(ends_m, line_m);
}

static bool mirrored_way_is_free(const struct look *look, struct reflex *reflex)
{
    const struct facet *facet = reflex->facet;
    const struct look_body *touched[] = {facet->body, facet->before, facet->after, reflex->body};
    if (look_blocked(look, look->position_m, reflex->bounce, touched, 3) ||
        look_blocked(look, reflex->bounce, reflex->place, touched, 4))
        return false;
    if (look->frame->margins) {
        double out_m = look_clearance_m(look, look->position_m, reflex->bounce, touched, 3);
        double on_m = look_clearance_m(look, reflex->bounce, reflex->place, touched, 4);
        reflex->margin_m =
            fmin(fmin(reflex->margin_m, bounce_margin_m(look, reflex)), fmin(out_m, on_m));
    }
    return true;
}

static bool direct_way_is_free(const struct look *look, struct reflex *reflex)
{
    if (look_blocked(look, look->position_m, reflex->place, &reflex->body, 1))
        return false;
    if (look->frame->margins)
        reflex->direct_margin_m =
            fmin(reflex->direct_margin_m,
                 look_clearance_m(look, look->position_m, reflex->place, &reflex->body, 1));
    return true;
}

static bool is_listed(const struct sensor *sensor, const struct sight *sight, double departure_rad)
{
    return sight->range_m >= sensor->range_min_m && sight->range_m <= sensor->range_max_m &&
           fabs(sight->azimuth_rad) < look_border_rad(sensor) && fabs(departure_rad) <= PI / 2;
}

static double limits_margin_m(const struct sensor *sensor, const struct sight *sight,
                              double departure_rad)
{
    double view_rad =
        fmin(look_border_rad(sensor) - fabs(sight->azimuth_rad), PI / 2 - fabs(departure_rad));
    return fmin(fmin(sight->range_m - sensor->range_min_m, sensor->range_max_m - sight->range_m),
                sight->range_m * view_rad);
}

static void add(struct look *look, const struct reflex *reflex, enum path path,
                const struct ghost *ghost, double visible, double departure_rad)
{
    if (!is_listed(look->sensor, &ghost->sight, departure_rad))
        return;
    struct margins margins = {0};
    double margin_m = path == PATH_WALL_OBJECT_WALL
                          ? reflex->margin_m
                          : fmin(reflex->margin_m, reflex->direct_margin_m);
    if (look->frame->margins)
        margins_note(&margins, MARGIN_SIGHT,
                     fmin(margin_m, limits_margin_m(look->sensor, &ghost->sight, departure_rad)));
    frame_count_echoes(look->frame, look->sensor->name, path, 1);
    *list_add(&look->frame->echoes, look->frame->arena) = (struct echo){
        .sensor = look->sensor->name,
        .object = reflex->body->object->id,
        .reflector = reflex->reflector,
        .path = path,
        .mirror = reflex->facet->body->object->id,
        .number = reflex->facet->number,
        .range_m = ghost->sight.range_m,
        .azimuth_rad = ghost->sight.azimuth_rad,
        .range_rate_mps = ghost->sight.range_rate_mps,
        .ercs = visible * reflex->ercs * ghost->ercs_factor,
        .departure_rad = departure_rad - ghost->sight.azimuth_rad,
        .time_s = look->time_s,
        .effects = reflex->effects | (visible < 1 ? EFFECT_BIT(EFFECT_VISIBILITY) : 0),
        .margins = margins,
    };
}

static void add_one_way(struct look *look, struct reflex *reflex)
{
    if (!(reflex->visible_direct > 0 && reflex->direct.range_m > 0) ||
        !direct_way_is_free(look, reflex))
        return;
    double reflection = reflex->facet->reflection;
    double visible = sqrt(reflex->visible_direct * reflex->visible_mirrored);
    struct ghost out = ghost_out(reflection, &reflex->direct, &reflex->image);
    struct ghost back = ghost_back(reflection, &reflex->direct, &reflex->image);
    add(look, reflex, PATH_WALL_OBJECT, &out, visible, reflex->image.azimuth_rad);
    add(look, reflex, PATH_OBJECT_WALL, &back, visible, reflex->direct.azimuth_rad);
}

static void add_both_ways(struct look *look, const struct reflex *reflex)
{
    struct ghost both = ghost_both(reflex->facet->reflection, &reflex->image);
    add(look, reflex, PATH_WALL_OBJECT_WALL, &both, reflex->visible_mirrored,
        reflex->image.azimuth_rad);
}

/* What a viewer at the sensor or the bounce sees of a point, and how near it is to losing it. */
static double visible_from(const struct look *look, const struct reflex *reflex,
                           const struct point_reflector *point, struct vec2 viewer,
                           double *margin_m)
{
    const struct box *box = &reflex->body->box;
    if (!effects_may(look->selection, EFFECT_VISIBILITY))
        return 1;
    if (look->frame->margins)
        *margin_m = clearance_facing_m(box, point->shape, point->facing_rad, point->zero_rad,
                                       reflex->place, viewer);
    return reflectors_visibility(box, point->shape, point->facing_rad, point->full_rad,
                                 point->zero_rad, reflex->place, viewer);
}

static void add_point(struct look *look, const struct facet *facet, const struct look_body *body,
                      const struct point_reflector *point, struct vec2 place, struct vec2 bounce)
{
    struct reflex reflex = reflex_of(look, facet, body, place, bounce);
    reflex.reflector = point->name;
    reflex.ercs = point->ercs;
    reflex.visible_direct =
        visible_from(look, &reflex, point, look->position_m, &reflex.direct_margin_m);
    reflex.visible_mirrored = visible_from(look, &reflex, point, bounce, &reflex.margin_m);
    if (!(reflex.visible_mirrored > 0) || !mirrored_way_is_free(look, &reflex))
        return;
    add_one_way(look, &reflex);
    if (look->sensor->bounces >= BOTH_WAYS)
        add_both_ways(look, &reflex);
}

static void add_points(struct look *look, const struct facet *facet, const struct look_body *body)
{
    for (size_t i = 0; i < body->set->points.count; i++) {
        const struct point_reflector *point = &body->set->points.items[i];
        struct vec2 place = reflectors_point_place(&body->box, point), bounce;
        if (bounces(look, facet, place, &bounce))
            add_point(look, facet, body, point, place, bounce);
    }
}

/* No path is shorter than the direct one: posts out of its range have no ghost in range. */
static void add_row(struct look *look, const struct facet *facet, const struct look_body *body,
                    const struct post_row *row)
{
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->position_m, look->sensor->range_max_m, &first,
                            &end);
    for (int64_t number = first; number < end; number++) {
        struct vec2 place = reflectors_post_place(&body->box, row, number), bounce;
        if (bounces(look, facet, place, &bounce)) {
            struct point_reflector post = look_post(look, row, number);
            add_point(look, facet, body, &post, place, bounce);
        }
    }
}

static void add_plane(struct look *look, const struct facet *facet, const struct look_body *body,
                      const struct plane_reflector *plane)
{
    struct vec2 a = reflectors_place(&body->box, plane->from_x, plane->from_y);
    struct vec2 b = reflectors_place(&body->box, plane->to_x, plane->to_y);
    struct vec2 eye = mirror_image(&facet->mirror, look->position_m, (struct vec2){0, 0}).place_m;
    struct vec2 along = reflectors_along(&body->box, plane), foot, bounce;
    if (!reflection_foot(a, b, along, plane->margin_m, eye, &foot) ||
        !bounces(look, facet, foot, &bounce))
        return;
    struct reflex reflex = reflex_of(look, facet, body, foot, bounce);
    reflex.reflector = plane->name;
    reflex.ercs = plane->ercs;
    reflex.effects |= EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    if (look->frame->margins)
        reflex.margin_m = clearance_foot_m(a, b, along, plane->margin_m, eye);
    if (mirrored_way_is_free(look, &reflex))
        add_both_ways(look, &reflex);
}

static void add_body(struct look *look, const struct facet *facet, const struct look_body *body)
{
    const struct reflector_set *set = body->set;
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
    double radius_m = reflectors_radius_m(body->set, body->sector.radius_m);
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

void ghosts_around(struct look *look)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_GHOSTS, false);
    if (look->sensor->bounces < ONE_WAY || !effects_may(selection, EFFECT_GHOSTS))
        return;
    int64_t begin = effects_begin(selection);
    struct facets facets = facets_of(look);
    for (size_t i = 0; i < look->body_count && facets.count > 0; i++)
        if (look->bodies[i].set != NULL)
            add_all(look, &facets, &look->bodies[i]);
    effects_end(selection, EFFECT_GHOSTS, begin);
}
