#include "ideal/line_of_sight.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/predicates.h"

double line_of_sight_facing_margin_m(const struct box *box, enum visibility_shape shape,
                                     double facing_rad, double zero_rad, struct vec2 place,
                                     struct vec2 sensor)
{
    if (shape == VISIBILITY_HARD && zero_rad >= PI)
        return (double)INFINITY;
    struct vec2 facing = vec2_turn(vec2_heading(facing_rad), box->heading);
    struct vec2 sight = vec2_sub(sensor, place);
    return fabs(zero_rad - directivity_angle_rad(facing, sight)) * vec2_length(sight);
}

double line_of_sight_foot_margin_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                                   struct vec2 sensor)
{
    if (vec2_same(a, b))
        return (double)NAN;
    double outside_m = -vec2_cross(along, vec2_sub(sensor, a));
    double from_a_m = vec2_dot(vec2_sub(sensor, a), along) - margin_m;
    double from_b_m = vec2_dot(vec2_sub(b, sensor), along) - margin_m;
    return fabs(elementary_min(outside_m, elementary_min(from_a_m, from_b_m)));
}

static double to_line_m(struct vec2 a, struct vec2 b, struct vec2 point)
{
    struct vec2 line = vec2_sub(b, a), offset = vec2_sub(point, a);
    double length_m = vec2_length(line);
    return length_m > 0 ? fabs(vec2_cross(line, offset)) / length_m : vec2_length(offset);
}

static double to_segment_m(struct vec2 a, struct vec2 b, struct vec2 point)
{
    struct vec2 line = vec2_sub(b, a);
    if (vec2_dot(line, vec2_sub(point, a)) <= 0)
        return vec2_length(vec2_sub(point, a));
    if (vec2_dot(line, vec2_sub(point, b)) >= 0)
        return vec2_length(vec2_sub(point, b));
    return to_line_m(a, b, point);
}

/* The least distance of an end of p to q from a to b, or of an end of a to b from p to q. */
static double least_m(double (*distance_m)(struct vec2 a, struct vec2 b, struct vec2 point),
                      struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return elementary_min(elementary_min(distance_m(p, q, a), distance_m(p, q, b)),
                          elementary_min(distance_m(a, b, p), distance_m(a, b, q)));
}

double line_of_sight_outline_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                      struct vec2 to)
{
    double nearest_m = (double)INFINITY;
    for (size_t i = 0; i < count; i++)
        nearest_m = elementary_min(
            nearest_m, least_m(to_segment_m, from, to, corners[i], corners[(i + 1) % count]));
    return nearest_m;
}

double line_of_sight_depth_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                    struct vec2 to)
{
    double deepest_m = 0;
    for (size_t i = 0; i < count; i++) {
        struct vec2 next = corners[(i + 1) % count];
        if (obstruction_segments_touch(from, to, corners[i], next))
            deepest_m = elementary_max(deepest_m, least_m(to_line_m, from, to, corners[i], next));
    }
    return deepest_m;
}

/* True if both ends of a line lie beyond the same side of a body. The ends and the reach of the
 * body are measured along one of its axes. */
static bool ends_beside(double from_m, double to_m, double reach_m)
{
    return (from_m > reach_m && to_m > reach_m) || (from_m < -reach_m && to_m < -reach_m);
}

/* Whether a line touches a body's outline, by cheap tests that settle most cases. */
enum crossing { CROSSING_UNSURE, CROSSING_NONE, CROSSING_SURE };

/* None: the line stays clear of the circle around the body and its rim, or the line, a side or the
 * front of the body parts both. The rim is what a line of this length feels, which is less than
 * look->rim_m. Sure: the line runs through the circle inside the body's sides, from end to end of
 * the circle around it. The slack covers the rounding of these tests. */
static enum crossing crossing_by_circles(const struct look_body *body, struct vec2 from,
                                         struct vec2 to, double wavelength_m)
{
    struct vec2 line = vec2_sub(to, from), centre = vec2_sub(body->box.motion.position_m, from);
    double square = vec2_dot(line, line), length_m = sqrt(square);
    double along = vec2_dot(line, centre);
    double aside = fabs(vec2_cross(line, centre));
    double slack_m = 1e-6 + obstruction_edge_reach_m(length_m, wavelength_m);
    double reach = (body->radius_m + slack_m) * (1 + 1e-9) * length_m;
    if (aside > reach || along < -reach || along > square + reach)
        return CROSSING_NONE;
    double inner_m =
        0.5 * elementary_min(body->box.length_m, body->box.width_m) * (1 - 1e-9) - slack_m;
    if (aside < inner_m * length_m && along > reach && along < square - reach)
        return CROSSING_SURE;
    struct vec2 ahead = body->box.heading, rest = vec2_sub(centre, line);
    double half_length_m = 0.5 * body->box.length_m, half_width_m = 0.5 * body->box.width_m;
    slack_m += 1e-9 * (length_m + body->radius_m);
    bool beside =
        aside > half_length_m * fabs(vec2_cross(line, ahead)) +
                    half_width_m * fabs(vec2_dot(line, ahead)) + slack_m * length_m ||
        ends_beside(vec2_cross(ahead, centre), vec2_cross(ahead, rest), half_width_m + slack_m) ||
        ends_beside(vec2_dot(ahead, centre), vec2_dot(ahead, rest), half_length_m + slack_m);
    return beside ? CROSSING_NONE : CROSSING_UNSURE;
}

/* The same for a line from the sensor to a place, whose silhouette is given. */
static enum crossing crossing_by_silhouette(const struct look_body *body,
                                            const struct silhouette *place)
{
    if (!silhouette_overlaps(&body->shadow.silhouette, place))
        return CROSSING_NONE;
    return silhouette_covers(&body->shadow.silhouette, place) ? CROSSING_SURE : CROSSING_UNSURE;
}

struct side line_of_sight_side(const struct look_body *body, double from_x, double from_y,
                               double to_x, double to_y)
{
    return (struct side){.from = motion_box_place(&body->box, from_x, from_y),
                         .to = motion_box_place(&body->box, to_x, to_y),
                         .along = motion_box_along(&body->box, from_x, from_y, to_x, to_y)};
}

/* True if the body has a side in line with this one that, within within_m, begins at its end
 * (begins) or ends at its beginning. */
static bool joins(const struct look_body *body, const struct side *side, bool begins,
                  double within_m)
{
    if (body->set == NULL)
        return false;
    for (size_t i = 0; i < body->set->reflectors->planes.count; i++) {
        const struct plane_reflector *plane = &body->set->reflectors->planes.items[i];
        struct side other =
            line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
        if (plane->margin_m != 0 || !vec2_same(other.along, side->along))
            continue;
        struct vec2 gap = begins ? vec2_sub(other.from, side->to) : vec2_sub(other.to, side->from);
        if (vec2_length(gap) <= within_m)
            return true;
    }
    return false;
}

bool line_of_sight_next_side_has_foot(const struct look *look, const struct side *side)
{
    if (predicates_along(side->to, look->pose.position_m, side->along) != 0)
        return false;
    for (size_t i = 0; i < look->body_count; i++)
        if (!look->bodies[i].spare && joins(&look->bodies[i], side, true, 0))
            return true;
    return false;
}

void line_of_sight_note(const struct look *look, bool some)
{
    const struct selection *selection = look->selection;
    effects_note(selection, EFFECT_OCCLUSION, some);
    effects_note(selection, EFFECT_HEIGHT, look->sees_over && some);
    effects_note(selection, EFFECT_DIFFRACTION, look->wavelength_m > 0 && some);
}

void line_of_sight_find_blockers(struct look *look, const struct look_body *own,
                                 const struct look_extent *wanted)
{
    const struct selection *selection = look->selection;
    look->blocker_count = 0;
    if (!effects_enabled(selection, EFFECT_OCCLUSION))
        return;
    bool all = effects_forced(selection, EFFECT_OCCLUSION);
    struct silhouette_span span = all ? silhouette_everywhere : wanted->span;
    size_t count = silhouette_index_find(&look->blocker_index, span);
    for (size_t i = 0; i < count; i++) {
        const struct look_body *body = look->indexed[look->blocker_index.found[i]];
        /* No branch here: it would go either way too often to be predicted. */
        look->blockers[look->blocker_count] = body;
        look->blocker_count +=
            (size_t)((body != own) &
                     (all | silhouette_overlaps(&body->shadow.silhouette, &wanted->silhouette)));
    }
    line_of_sight_note(look, all || look->blocker_count > 0);
}

/* True if a body hides everything behind its outline. */
static bool blocks_sharply(const struct look *look)
{
    return look->wavelength_m == 0 && !look->sees_over;
}

bool line_of_sight_all_hidden(const struct look *look, const struct look_set *set,
                              const struct look_extent *wanted)
{
    if (!blocks_sharply(look))
        return false;
    /* A blocker with all its reflectors in its box that ends before the set begins has no side in
     * line with a side of the set. */
    for (size_t i = 0; i < look->blocker_count; i++) {
        const struct look_body *body = look->blockers[i];
        if (silhouette_covers(&body->shadow.silhouette, &wanted->silhouette) &&
            body->set->shape->share == 1 && !(set->shape->under && body->raised))
            return true;
    }
    return false;
}

/* The wave that passes one body on a line. */
static struct line_of_sight past_body(const struct look *look, const struct look_body *body,
                                      const struct obstruction_line *line, enum crossing crossing)
{
    if (crossing == CROSSING_NONE)
        return (struct line_of_sight){.factor = 1};
    if (crossing == CROSSING_SURE && blocks_sharply(look))
        return (struct line_of_sight){.factor = 0, .by = body};
    struct obstruction obstruction =
        obstruction_of(body->corner, 4, look_heights(look, body), line, look->wavelength_m);
    return (struct line_of_sight){
        .factor = obstruction.factor,
        .by = obstruction.factor == 0 ? body : NULL,
        .effects = (obstruction.bent ? EFFECT_BIT(EFFECT_DIFFRACTION) : 0) |
                   (obstruction.over ? EFFECT_BIT(EFFECT_HEIGHT) : 0),
    };
}

struct line_of_sight line_of_sight_past_blockers(const struct look *look, const struct side *side,
                                                 const struct obstruction_line *line, bool under)
{
    struct line_of_sight all = {.factor = 1};
    struct silhouette place = silhouette_of_place(vec2_sub(line->to, look->pose.position_m));
    bool exact = effects_forced(look->selection, EFFECT_OCCLUSION);
    for (size_t i = 0; i < look->blocker_count; i++) {
        const struct look_body *body = look->blockers[i];
        if (under && body->raised)
            continue;
        enum crossing crossing = exact ? CROSSING_UNSURE : crossing_by_silhouette(body, &place);
        if (crossing == CROSSING_UNSURE)
            crossing = crossing_by_circles(body, line->from, line->to, look->wavelength_m);
        struct line_of_sight past = past_body(look, body, line, crossing);
        if ((past.factor == 1 && past.effects == 0) ||
            (side != NULL && (joins(body, side, true, LINE_OF_SIGHT_JOINT_M) ||
                              joins(body, side, false, LINE_OF_SIGHT_JOINT_M))))
            continue;
        if (past.by != NULL)
            return past;
        all.factor *= past.factor;
        all.effects |= past.effects;
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

struct line_of_sight line_of_sight_along(const struct look *look,
                                         const struct obstruction_line *line,
                                         const struct look_body *const *except, size_t count)
{
    struct line_of_sight all = {.factor = 1};
    if (!effects_enabled(look->selection, EFFECT_OCCLUSION))
        return all;
    struct silhouette_span span =
        effects_forced(look->selection, EFFECT_OCCLUSION)
            ? silhouette_everywhere
            : silhouette_span_between(vec2_sub(line->from, look->pose.position_m),
                                      vec2_sub(line->to, look->pose.position_m));
    size_t near = silhouette_index_find(&look->blocker_index, span);
    for (size_t i = 0; i < near; i++) {
        const struct look_body *body = look->indexed[look->blocker_index.found[i]];
        if (is_among(body, except, count))
            continue;
        struct line_of_sight past = past_body(
            look, body, line, crossing_by_circles(body, line->from, line->to, look->wavelength_m));
        if (past.by != NULL)
            return past;
        all.factor *= past.factor;
        all.effects |= past.effects;
    }
    return all;
}

double line_of_sight_margin_m(const struct look *look, const struct look_body *const *except,
                              size_t count, const struct obstruction_line *line, bool under,
                              bool blocked)
{
    double nearest_m = (double)INFINITY, deepest_m = 0;
    double length_m = vec2_length(vec2_sub(line->to, line->from));
    double soft_m = 2 * obstruction_edge_reach_m(length_m, look->wavelength_m);
    bool occlusion = effects_enabled(look->selection, EFFECT_OCCLUSION);
    size_t bodies = occlusion ? look->indexed_count : 0;
    for (size_t i = 0; i < bodies; i++) {
        const struct look_body *body = look->indexed[i];
        const struct vec2 *corner = body->corner;
        const struct vec2 from = line->from, to = line->to;
        if (body->spare || (under && body->raised) || is_among(body, except, count))
            continue;
        if (!obstruction_blocks(corner, 4, from, to)) {
            nearest_m =
                elementary_min(nearest_m, line_of_sight_outline_margin_m(corner, 4, from, to));
            continue;
        }
        double clear_m = obstruction_clear_m(corner, 4, look_heights(look, body), line);
        if (clear_m > 0 || soft_m > 0)
            nearest_m = elementary_min(nearest_m, elementary_max(clear_m, 0));
        double depth_m =
            elementary_min(line_of_sight_depth_margin_m(corner, 4, from, to), -clear_m);
        deepest_m = elementary_max(deepest_m, depth_m - soft_m);
    }
    return blocked ? deepest_m : nearest_m;
}
