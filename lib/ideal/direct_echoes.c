#include "ideal/direct_echoes.h"

#include <math.h>

#include "base/elementary.h"
#include "geometry/specular_point.h"
#include "ideal/line_of_sight.h"
#include "ideal/sight_margins.h"

/* Losses name the stage whose work this is. */
static const char stage_name[] = "ideal";

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
    if (!look->frame->account)
        return;
    frame_lose(look->frame, stage_name, look->sensor->name, reason,
               &(struct lost_echo){.id.object = body->object->id,
                                   .id.reflector = reflector,
                                   .by = by != NULL ? by->object->id : NULL,
                                   .margins = margins_of(look, margin_m)});
}

/* One reflector that may face the sensor. */
struct candidate {
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
    bool sought;      /* is the way to it known, */
    struct line_of_sight way;
    bool under; /* and does it lead under what stands there? */
};

static struct obstruction_line line_to(const struct look *look, const struct candidate *seen)
{
    return (struct obstruction_line){look->pose.position_m, seen->place, look->height_m,
                                     seen->height_m};
}

static double sight_margin_m(const struct look *look, const struct look_body *body,
                             const struct obstruction_line *line, bool under)
{
    if (!under)
        return line_of_sight_clearance_m(look, line, &body, 1);
    return elementary_min(line_of_sight_margin_m(look, &body, 1, line, true, false),
                          line_of_sight_margin_m(look, &body, 1, line, false, true));
}

/* The way past what stands there, or under it where that lets more through. */
static void seek_way(const struct look *look, struct candidate *seen)
{
    if (seen->sought)
        return;
    const struct obstruction_line line = line_to(look, seen);
    int64_t begin = effects_begin(look->selection);
    seen->sought = true;
    seen->way = line_of_sight_past_blockers(look, seen->side, &line, false);
    if (seen->under_vehicles != 0 && seen->way.factor != 1) {
        struct line_of_sight below = line_of_sight_past_blockers(look, seen->side, &line, true);
        below.factor *= seen->under_vehicles;
        below.effects |= EFFECT_BIT(EFFECT_OCCLUSION);
        seen->under = below.factor > seen->way.factor;
        seen->way = seen->under ? below : seen->way;
    }
    effects_end(look->selection, EFFECT_OCCLUSION, begin);
}

/* That it is out of view or blocked is found with a few products, what it reads with arctangents:
 * the latter are spared unless somebody asks what comes first of the reasons for its loss. */
static bool is_hidden(const struct look *look, const struct look_body *body, struct candidate *seen)
{
    if (look->frame->account)
        return false;
    struct silhouette place = silhouette_of_place(vec2_sub(seen->place, look->pose.position_m));
    if (look->selection->log == NULL && look_out_of_reach(look, body, &place))
        return true;
    seek_way(look, seen);
    return seen->way.by != NULL;
}

/* Is it in range and in view? If not, it is lost. */
static bool in_reach(struct look *look, const struct look_body *body, struct candidate *seen,
                     const struct kinematics *sight)
{
    const struct sensor *sensor = look->sensor;
    double azimuth = fabs(sight->azimuth_rad);
    double reach_m = fabs(
        elementary_min(sight->range_m - sensor->range_min_m, sensor->range_max_m - sight->range_m));
    double view_m = sight->range_m * fabs(suite_border_rad(sensor) - azimuth);
    if (!(sight->range_m > 0 && sight->range_m >= sensor->range_min_m &&
          sight->range_m <= sensor->range_max_m)) {
        lose(look, body, seen->reflector, LOSS_OUT_OF_RANGE, NULL, reach_m);
        return false;
    }
    if (!(azimuth < suite_border_rad(sensor))) {
        lose(look, body, seen->reflector, LOSS_OUT_OF_VIEW, NULL, view_m);
        return false;
    }
    seen->margin_m = elementary_min(seen->margin_m, elementary_min(reach_m, view_m));
    return true;
}

/* Its height over the road, where that is described, in a world that is not flat. */
static void tell_height(const struct look *look, const struct look_body *body,
                        const struct candidate *seen, struct echo *echo)
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
                        const struct candidate *seen, struct vec2 velocity, struct echo *echo)
{
    struct vec2 still = {0, 0}, boresight = look->pose.boresight, heading = body->box.heading;
    if (!look->sensor->micro_motion || seen->moving_part == MOVING_NONE)
        return;
    struct kinematics ground =
        kinematics_of(look->pose.position_m, still, boresight, seen->place, velocity);
    echo->moving_part = seen->moving_part;
    echo->ground_rate_mps = ground.range_rate_mps * (ground.range_m / echo->range_m);
    echo->heading_rad =
        elementary_atan2(vec2_cross(boresight, heading), vec2_dot(boresight, heading));
}

/* An echo if it is in range, in view and not blocked. */
static void look_at(struct look *look, const struct look_body *body, struct candidate *seen)
{
    bool tell = look->frame->margins;
    struct vec2 velocity = motion_velocity_at(&body->box.motion, seen->place);
    double gain;
    struct kinematics sight =
        look_slant(look, seen->height_m,
                   kinematics_of(look->pose.position_m, look->pose.velocity_mps,
                                 look->pose.boresight, seen->place, velocity),
                   &gain, &seen->effects);
    seen->ercs *= gain;
    if (!in_reach(look, body, seen, &sight))
        return;
    const struct obstruction_line line = line_to(look, seen);
    seek_way(look, seen);
    if (seen->way.by != NULL) {
        lose(look, body, seen->reflector, LOSS_BLOCKED, seen->way.by,
             tell ? line_of_sight_margin_m(look, &body, 1, &line, seen->under_vehicles > 0, true)
                  : 0);
        return;
    }
    if (tell)
        seen->margin_m =
            elementary_min(seen->margin_m, sight_margin_m(look, body, &line, seen->under));
    look->echoes++;
    struct echo *echo = list_add(&look->frame->echoes, look->frame->arena);
    *echo = (struct echo){
        .sensor = look->sensor->name,
        .id.object = body->object->id,
        .id.reflector = seen->reflector,
        .id.path = PATH_DIRECT,
        .range_m = sight.range_m,
        .azimuth_rad = sight.azimuth_rad,
        .range_rate_mps = sight.range_rate_mps,
        .ercs = seen->way.factor * seen->ercs,
        .time_s = look->time_s,
        .effects = seen->effects | seen->way.effects,
        .margins = margins_of(look, seen->margin_m),
    };
    tell_height(look, body, seen, echo);
    tell_motion(look, body, seen, velocity, echo);
}

static void look_at_point(struct look *look, const struct look_body *body,
                          const struct point_reflector *point, struct vec2 facing,
                          struct vec2 place)
{
    look->pairs++;
    struct candidate seen = {
        .reflector = point->name,
        .place = place,
        .height_m = look_height_m(look, body, point->z),
        .z = point->z,
        .extent = point->extent,
        .moving_part = point->moving_part,
        .under_vehicles = point->under_vehicles,
        .margin_m = (double)INFINITY,
        .effects = look_latency_effect(look, body),
    };
    if (is_hidden(look, body, &seen))
        return;
    double visible = look_visibility(look, body, point, facing, place, look->pose.position_m);
    if (look->frame->margins && effects_enabled(look->selection, EFFECT_VISIBILITY))
        seen.margin_m = sight_margins_facing_m(&body->box, point->shape, point->facing_rad,
                                               point->zero_rad, place, look->pose.position_m);
    if (visible == 0) {
        lose(look, body, point->name, LOSS_FACING_AWAY, NULL, seen.margin_m);
        return;
    }
    seen.ercs = visible * point->ercs;
    seen.effects |= visible < 1 ? EFFECT_BIT(EFFECT_VISIBILITY) : 0;
    look_at(look, body, &seen);
}

static void look_at_plane(struct look *look, const struct look_body *body,
                          const struct plane_reflector *plane)
{
    look->pairs++;
    if (!effects_enabled(look->selection, EFFECT_PLANE_REFLECTION)) {
        lose(look, body, plane->name, LOSS_SWITCHED_OFF, NULL, (double)INFINITY);
        return;
    }
    struct side side = line_of_sight_side(body, plane);
    struct vec2 foot;
    double margin_m = look->frame->margins
                          ? sight_margins_foot_m(side.from, side.to, side.along, plane->margin_m,
                                                 look->pose.position_m)
                          : 0;
    if (specular_point_foot(side.from, side.to, side.along, plane->margin_m, look->pose.position_m,
                            &foot) &&
        !line_of_sight_next_side_has_foot(look, &side)) {
        struct candidate seen = {
            .reflector = plane->name,
            .side = &side,
            .place = foot,
            .height_m = look_height_m(look, body, plane->z),
            .z = plane->z,
            .extent = plane->extent,
            .margin_m = margin_m,
            .effects = look_latency_effect(look, body) | EFFECT_BIT(EFFECT_PLANE_REFLECTION),
        };
        if (is_hidden(look, body, &seen))
            return;
        double range_m = vec2_length(vec2_sub(foot, look->pose.position_m));
        seen.ercs = look_plane_ercs(look, plane, range_m, &seen.effects);
        look_at(look, body, &seen);
    } else
        lose(look, body, plane->name, LOSS_NO_SPECULAR, NULL, margin_m);
}

static void look_along_row(struct look *look, const struct look_body *body,
                           const struct post_row *row)
{
    struct vec2 facing = vec2_heading(row->facing_rad);
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->pose.position_m, look->sensor->range_max_m,
                            &first, &end);
    for (int64_t number = first; number < end; number++) {
        const struct point_reflector post = look_post(look, row, number);
        look_at_point(look, body, &post, facing, reflectors_post_place(&body->box, row, number));
    }
}

/* Does nobody ask why the set's reflectors are not seen, or what was tried? How many a row has in
 * range takes a look. */
static bool unasked(const struct look *look, const struct look_set *set)
{
    return !look->frame->account && look->selection->log == NULL &&
           set->reflectors->rows.count == 0;
}

/* Is the whole body out of range, out of view or hidden? If not, its blockers are found. */
static bool passed_over(struct look *look, const struct look_body *body, const struct look_set *set)
{
    struct look_extent seen = look_reflectors(look, body, set);
    bool plain = unasked(look, set);
    if (plain && look_out_of_reach(look, body, &seen.silhouette))
        return true;
    line_of_sight_find_blockers(look, body, &seen);
    return plain && !effects_forced(look->selection, EFFECT_OCCLUSION) &&
           line_of_sight_all_hidden(look, set, &seen);
}

/* Those that do not plainly face away, unless somebody asks why not. */
static void look_at_points(struct look *look, const struct look_body *body,
                           const struct look_set *set, bool all)
{
    for (size_t i = 0; i < set->reflectors->points.count; i++) {
        const struct point_reflector *point = &set->reflectors->points.items[i];
        const struct reflectors_face *face = &set->shape->faces[i];
        if (all || !reflectors_plainly_away(&body->box, point, face, body->sensor_m))
            look_at_point(look, body, point, face->heading,
                          reflectors_point_place(&body->box, point));
        else
            look->pairs++;
    }
}

static void look_at_planes(struct look *look, const struct look_body *body,
                           const struct reflector_set *set, bool all)
{
    for (size_t i = 0; i < set->planes.count; i++) {
        const struct plane_reflector *plane = &set->planes.items[i];
        if (all || !reflectors_plainly_aside(&body->box, plane, body->sensor_m))
            look_at_plane(look, body, plane);
        else
            look->pairs++;
    }
}

static void look_at_body(struct look *look, const struct look_body *body,
                         const struct look_set *set)
{
    const struct selection *selection = look->selection;
    const struct reflector_set *all = set->reflectors;
    if (passed_over(look, body, set)) {
        look->pairs += (int64_t)(all->points.count + all->planes.count);
        return;
    }
    effects_note(selection, EFFECT_VISIBILITY, all->points.count + all->rows.count > 0);
    effects_note(selection, EFFECT_PLANE_REFLECTION, all->planes.count > 0);
    effects_note(selection, EFFECT_ROWS, all->rows.count > 0);
    bool asked = look->frame->account;
    look_at_points(look, body, set, asked || !effects_enabled(selection, EFFECT_VISIBILITY));
    look_at_planes(look, body, all, asked);
    for (size_t i = 0; i < all->rows.count && effects_enabled(selection, EFFECT_ROWS); i++)
        look_along_row(look, body, &all->rows.items[i]);
}

void direct_echoes_add(struct look *look)
{
    struct frame *frame = look->frame;
    look->blockers = arena_get(frame->arena, (look->body_count + 1) * sizeof(*look->blockers));
    for (size_t i = 0; i < frame->reflectors.count; i++)
        for (size_t j = 0; j < look->sets[i].reflectors->objects.count; j++)
            look_at_body(look, look->sets[i].bodies[j], &look->sets[i]);
    frame_count_pairs(frame, look->sensor->name, look->pairs);
    frame_count_echoes(frame, look->sensor->name, PATH_DIRECT, look->echoes);
}
