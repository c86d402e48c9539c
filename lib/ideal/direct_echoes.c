#include "ideal/direct_echoes.h"

#include "base/elementary.h"
#include "geometry/mirror.h"
#include "ideal/line_of_sight.h"

/* The stage that losses name. */
static const char stage_name[] = "ideal";

/* True if the frame reports the fate of every reflector. If not, reflectors that surely send no
 * echo may be skipped. */
static bool reports_all(const struct look *look)
{
    return frame_carries(look->frame, CARRY_ACCOUNT) || look->sightings != NULL;
}

/* Counts a reflector in the sighting of its body: by its loss, or as an echo (LOSS_OWN). */
static void count_fate(struct look *look, const struct look_body *body, enum loss reason)
{
    if (look->sightings == NULL)
        return;
    struct sighting *sighting = &look->sightings[body - look->bodies];
    sighting->reflectors++;
    bool in_view = reason == LOSS_BLOCKED || reason == LOSS_OWN;
    sighting->in_range += in_view || reason == LOSS_OUT_OF_VIEW;
    sighting->in_view += in_view;
    sighting->blocked += reason == LOSS_BLOCKED;
}

static void lose(struct look *look, const struct look_body *body, const char *reflector,
                 struct vec2 place, enum loss reason, const struct look_body *by, double margin_m)
{
    count_fate(look, body, reason);
    if (!frame_carries(look->frame, CARRY_ACCOUNT))
        return;
    struct vec2 sight = vec2_sub(place, look->pose.position_m), boresight = look->pose.boresight;
    frame_lose(look->frame, stage_name, look->sensor->name, reason,
               &(struct lost_echo){.id.object = body->object->id,
                                   .id.reflector = reflector,
                                   .range_m = vec2_length(sight),
                                   .azimuth_rad = elementary_atan2(vec2_cross(boresight, sight),
                                                                   vec2_dot(boresight, sight)),
                                   .by = by != NULL ? by->object->id : NULL,
                                   .margins = look_sight_margins(look, margin_m)});
}

/* A reflector that may become an echo. */
struct candidate {
    const char *reflector;
    const struct side *side; /* NULL for a point */
    struct vec2 place;
    double height_m;  /* over the road */
    double z, extent; /* fractions of the object's height, as described */
    enum moving_part moving_part;
    double ercs;
    double under_vehicles;
    double margin_m;  /* the least sight margin so far */
    uint64_t effects; /* the effects that changed a value so far */
    bool line_known;  /* the line and what follows are set */
    struct obstruction_line line;
    struct line_of_sight line_of_sight;
    bool under;   /* the line leads under raised vehicles */
    bool by_road; /* the line is that of the wave that the road mirrors */
};

static struct obstruction_line line_from_sensor(const struct look *look,
                                                const struct candidate *candidate)
{
    return (struct obstruction_line){look->pose.position_m, candidate->place, look->height_m,
                                     candidate->height_m};
}

/* May the wave that the road mirrors reach the candidate? An upright side mirrors it away from the
 * sensor, and a reflector without a height has no such way. */
static bool has_road_way(const struct look *look, const struct candidate *candidate)
{
    return look->sees_under && candidate->side == NULL && candidate->z > 0;
}

/* That wave's line, unfolded at the road (MODEL 14.3). */
static struct obstruction_line line_by_road(const struct look *look,
                                            const struct candidate *candidate)
{
    struct obstruction_line line = line_from_sensor(look, candidate);
    line.to_height_m = -line.to_height_m;
    return line;
}

/* Distance of an echo's line from being blocked. For a line under raised vehicles or by the road
 * the depth of the straight line in vehicles counts too, as the echo would change if it passed
 * beside them. */
static double blocking_margin_m(const struct look *look, const struct look_body *body,
                                const struct candidate *candidate)
{
    const struct obstruction_line straight = line_from_sensor(look, candidate);
    double margin_m =
        line_of_sight_margin_m(look, &body, 1, &candidate->line, candidate->under, false);
    if (!candidate->under && !candidate->by_road)
        return margin_m;
    return elementary_min(margin_m, line_of_sight_margin_m(look, &body, 1, &straight, false, true));
}

/* Distance of a blocked candidate from the nearest way that would let it through. */
static double blocked_margin_m(const struct look *look, const struct look_body *body,
                               const struct candidate *candidate)
{
    bool under = candidate->under_vehicles > 0;
    double margin_m = line_of_sight_margin_m(look, &body, 1, &candidate->line, under, true);
    if (!has_road_way(look, candidate))
        return margin_m;
    const struct obstruction_line line = line_by_road(look, candidate);
    return elementary_min(margin_m, line_of_sight_margin_m(look, &body, 1, &line, false, true));
}

/* Takes the way by the road if more of the echo passes there. */
static void try_road(const struct look *look, struct candidate *candidate)
{
    const struct obstruction_line line = line_by_road(look, candidate);
    struct line_of_sight way = line_of_sight_past_blockers(look, NULL, &line, false);
    candidate->by_road = way.factor > candidate->line_of_sight.factor;
    if (!candidate->by_road)
        return;
    candidate->line = line;
    candidate->line_of_sight = way;
}

/* The line of sight past the blockers, or under the raised ones if more of the echo passes there.
 */
static void find_line_of_sight(const struct look *look, struct candidate *candidate)
{
    if (candidate->line_known)
        return;
    const struct obstruction_line line = line_from_sensor(look, candidate);
    candidate->line_known = true;
    candidate->line = line;
    candidate->line_of_sight = line_of_sight_past_blockers(look, candidate->side, &line, false);
    if (has_road_way(look, candidate) && candidate->line_of_sight.factor != 1)
        try_road(look, candidate);
    if (candidate->under_vehicles != 0 && candidate->line_of_sight.factor != 1) {
        struct line_of_sight under =
            line_of_sight_past_blockers(look, candidate->side, &line, true);
        under.factor *= candidate->under_vehicles;
        under.effects |= EFFECT_BIT(EFFECT_OCCLUSION);
        candidate->under = under.factor > candidate->line_of_sight.factor;
        if (!candidate->under)
            return;
        candidate->by_road = false;
        candidate->line = line;
        candidate->line_of_sight = under;
    }
}

/* True if the candidate is out of reach or blocked, by a few products instead of the arctangent of
 * its azimuth. Not for accounts and sightings, which need the first reason in the order of MODEL
 * 2.5; and not by reach for a log, which counts the effects that the full test tries. */
static bool is_surely_lost(const struct look *look, struct candidate *candidate)
{
    if (reports_all(look))
        return false;
    struct silhouette place =
        silhouette_of_place(vec2_sub(candidate->place, look->pose.position_m));
    double rise_m = fabs(candidate->height_m - look->height_m);
    if (look->selection->log == NULL && look_out_of_reach(look, rise_m, &place))
        return true;
    find_line_of_sight(look, candidate);
    return candidate->line_of_sight.by != NULL;
}

/* True if the candidate is in range and in view; else adds its loss. */
static bool in_reach(struct look *look, const struct look_body *body, struct candidate *candidate,
                     const struct kinematics *read)
{
    double within_m = look_within_range_m(look, read);
    double inside_rad = look_within_view_rad(look, read->azimuth_rad);
    double view_m = read->range_m * fabs(inside_rad);
    bool in_range = read->range_m > 0 && within_m >= 0;
    if (in_range && inside_rad > 0) {
        candidate->margin_m = elementary_min(candidate->margin_m, elementary_min(within_m, view_m));
        return true;
    }
    lose(look, body, candidate->reflector, candidate->place,
         in_range ? LOSS_OUT_OF_VIEW : LOSS_OUT_OF_RANGE, NULL, in_range ? view_m : fabs(within_m));
    return false;
}

/* Sets the echo's height over the road and its extent, if the road mirrors beside the straight wave
 * and both the sensor and the reflector have a height. */
static void describe_height(const struct look *look, const struct look_body *body,
                            const struct candidate *candidate, struct echo *echo)
{
    bool mirroring = look->frame->conditions.road != ROAD_UNKNOWN;
    if (!(mirroring && look->height_m > 0 && candidate->z > 0) || candidate->by_road)
        return;
    echo->height_m = candidate->height_m;
    echo->extent_m = candidate->extent * body->object->height_m;
}

/* Sets what micro-Doppler of a wheel or limb needs: the kind of part, its heading, and its range
 * rate over ground, which is scaled from the plane to the slant as the echo's range rate is. */
static void describe_motion(const struct look *look, const struct look_body *body,
                            const struct candidate *candidate, struct vec2 velocity,
                            struct echo *echo)
{
    struct vec2 still = {0, 0};
    struct vec2 boresight = look->pose.boresight, heading = body->box.heading;
    if (!look->sensor->micro_motion || candidate->moving_part == MOVING_NONE)
        return;
    struct kinematics ground =
        kinematics_of(look->pose.position_m, still, boresight, candidate->place, velocity);
    echo->moving_part = candidate->moving_part;
    echo->ground_rate_mps = ground.range_rate_mps * (ground.range_m / echo->range_m);
    echo->heading_rad =
        elementary_atan2(vec2_cross(boresight, heading), vec2_dot(boresight, heading));
}

static void add_echo(struct look *look, const struct look_body *body,
                     const struct candidate *candidate, const struct kinematics *read,
                     struct vec2 velocity)
{
    look->echoes++;
    count_fate(look, body, LOSS_OWN);
    struct echo *echo = list_add(&look->frame->echoes, look->frame->arena);
    *echo = (struct echo){
        .sensor = look->sensor->name,
        .id.object = body->object->id,
        .id.reflector = candidate->reflector,
        .id.path = PATH_DIRECT,
        .range_m = read->range_m,
        .azimuth_rad = read->azimuth_rad,
        .range_rate_mps = read->range_rate_mps,
        .ercs = candidate->line_of_sight.factor * candidate->ercs,
        .time_s = look->time_s,
        .effects = candidate->effects | candidate->line_of_sight.effects,
        .margins = look_sight_margins(look, candidate->margin_m),
    };
    double from_m = candidate->by_road ? -candidate->height_m : candidate->height_m;
    look_set_elevation(look, candidate->place, from_m, echo);
    describe_height(look, body, candidate, echo);
    describe_motion(look, body, candidate, velocity, echo);
}

/* Adds the candidate's echo if it is in range, in view and not blocked, else its loss. */
static void add_candidate(struct look *look, const struct look_body *body,
                          struct candidate *candidate)
{
    bool margins = frame_carries(look->frame, CARRY_MARGINS);
    struct vec2 velocity = motion_velocity_at(&body->box.motion, candidate->place);
    struct kinematics plane = look_kinematics(look, candidate->place, velocity);
    double gain;
    struct kinematics read =
        look_slant(look, candidate->height_m, plane, &gain, &candidate->effects);
    candidate->ercs *= gain;
    if (!in_reach(look, body, candidate, &read))
        return;
    find_line_of_sight(look, candidate);
    if (candidate->line_of_sight.by != NULL) {
        lose(look, body, candidate->reflector, candidate->place, LOSS_BLOCKED,
             candidate->line_of_sight.by, margins ? blocked_margin_m(look, body, candidate) : 0);
        return;
    }
    if (margins)
        candidate->margin_m =
            elementary_min(candidate->margin_m, blocking_margin_m(look, body, candidate));
    add_echo(look, body, candidate, &read, velocity);
}

static void add_point(struct look *look, const struct look_body *body,
                      const struct point_reflector *point, struct vec2 facing, struct vec2 place)
{
    look->pairs++;
    struct candidate candidate = {
        .reflector = point->name,
        .place = place,
        .height_m = look_reflector_height_m(look, body, point->z),
        .z = point->z,
        .extent = point->extent,
        .moving_part = point->moving_part,
        .under_vehicles = point->under_vehicles,
        .margin_m = (double)INFINITY,
        .effects = look_latency_effect(look, body),
    };
    if (is_surely_lost(look, &candidate))
        return;
    double visible = look_visibility(look, body, point, facing, place, look->pose.position_m);
    if (frame_carries(look->frame, CARRY_MARGINS) &&
        effects_enabled(look->selection, EFFECT_VISIBILITY))
        candidate.margin_m =
            line_of_sight_facing_margin_m(&body->box, point->shape, point->facing_rad,
                                          point->zero_rad, place, look->pose.position_m);
    if (visible == 0) {
        lose(look, body, point->name, place, LOSS_FACING_AWAY, NULL, candidate.margin_m);
        return;
    }
    candidate.ercs = visible * point->ercs;
    candidate.effects |= visible < 1 ? EFFECT_BIT(EFFECT_VISIBILITY) : 0;
    add_candidate(look, body, &candidate);
}

static void add_plane(struct look *look, const struct look_body *body,
                      const struct plane_reflector *plane)
{
    look->pairs++;
    struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    struct vec2 middle = vec2_scale(0.5, vec2_add(side.from, side.to));
    if (!effects_enabled(look->selection, EFFECT_PLANE_REFLECTION)) {
        lose(look, body, plane->name, middle, LOSS_SWITCHED_OFF, NULL, (double)INFINITY);
        return;
    }
    struct vec2 foot;
    double margin_m = frame_carries(look->frame, CARRY_MARGINS)
                          ? line_of_sight_foot_margin_m(side.from, side.to, side.along,
                                                        plane->margin_m, look->pose.position_m)
                          : 0;
    if (mirror_specular_point(side.from, side.to, side.along, plane->margin_m,
                              look->pose.position_m, &foot) &&
        !line_of_sight_next_side_has_foot(look, &side)) {
        struct candidate candidate = {
            .reflector = plane->name,
            .side = &side,
            .place = foot,
            .height_m = look_reflector_height_m(look, body, plane->z),
            .z = plane->z,
            .extent = plane->extent,
            .margin_m = margin_m,
            .effects = look_latency_effect(look, body) | EFFECT_BIT(EFFECT_PLANE_REFLECTION),
        };
        if (is_surely_lost(look, &candidate))
            return;
        double range_m = vec2_length(vec2_sub(foot, look->pose.position_m));
        candidate.ercs = look_plane_ercs(look, plane, range_m, &candidate.effects);
        add_candidate(look, body, &candidate);
    } else
        lose(look, body, plane->name, middle, LOSS_NO_SPECULAR, NULL, margin_m);
}

static void add_row(struct look *look, const struct look_body *body, const struct post_row *row)
{
    struct vec2 facing = vec2_heading(row->facing_rad);
    struct point_reflector post = look_post(row);
    int64_t first, end;
    reflectors_posts_within(&body->box, row, look->pose.position_m, look->sensor->range_max_m,
                            &first, &end);
    for (int64_t number = first; number < end; number++) {
        post.name = reflectors_post_name(row->name, number, look->frame->arena);
        add_point(look, body, &post, facing, reflectors_post_place(&body->box, row, number));
    }
}

/* True if all reflectors of a body are skipped, because it is surely out of reach or hidden; else
 * finds the body's blockers. None is skipped where the reason of each is reported, where a log
 * counts the effects that were tried, and where the posts of a row in range are counted. */
static bool is_skipped(struct look *look, const struct look_body *body, const struct look_set *set)
{
    struct look_extent extent = look_reflectors_extent(look, body, set);
    bool skippable =
        !reports_all(look) && look->selection->log == NULL && set->reflectors->rows.count == 0;
    if (skippable && look_out_of_reach(look, look_rise_m(look, body, set), &extent.silhouette))
        return true;
    line_of_sight_find_blockers(look, body, &extent);
    return skippable && !effects_forced(look->selection, EFFECT_OCCLUSION) &&
           line_of_sight_all_hidden(look, set, &extent);
}

/* Adds the points of a set. Points that surely face away are only counted, unless all is true. */
static void add_points(struct look *look, const struct look_body *body, const struct look_set *set,
                       bool all)
{
    for (size_t i = 0; i < set->reflectors->points.count; i++) {
        const struct point_reflector *point = &set->reflectors->points.items[i];
        const struct reflectors_face *face = &set->shape->faces[i];
        if (all || !reflectors_surely_unseen(&body->box, point, face, body->sensor_m))
            add_point(look, body, point, face->heading, reflectors_point_place(&body->box, point));
        else
            look->pairs++;
    }
}

/* Adds the planes of a set. Planes that surely have no foot are only counted, unless all is true.
 */
static void add_planes(struct look *look, const struct look_body *body,
                       const struct reflector_set *set, bool all)
{
    for (size_t i = 0; i < set->planes.count; i++) {
        const struct plane_reflector *plane = &set->planes.items[i];
        if (all || !reflectors_surely_no_foot(&body->box, plane, body->sensor_m))
            add_plane(look, body, plane);
        else
            look->pairs++;
    }
}

static void add_body(struct look *look, const struct look_body *body, const struct look_set *set)
{
    const struct selection *selection = look->selection;
    const struct reflector_set *all = set->reflectors;
    if (is_skipped(look, body, set)) {
        look->pairs += (int64_t)(all->points.count + all->planes.count);
        return;
    }
    effects_note(selection, EFFECT_VISIBILITY, all->points.count + all->rows.count > 0);
    effects_note(selection, EFFECT_PLANE_REFLECTION, all->planes.count > 0);
    effects_note(selection, EFFECT_ROWS, all->rows.count > 0);
    bool each = reports_all(look);
    add_points(look, body, set, each || !effects_enabled(selection, EFFECT_VISIBILITY));
    add_planes(look, body, all, each);
    if (!effects_enabled(selection, EFFECT_ROWS))
        return;
    for (size_t i = 0; i < all->rows.count; i++)
        add_row(look, body, &all->rows.items[i]);
}

/* Begins a sighting of every body, if the frame carries them. */
static void begin_sightings(struct look *look)
{
    struct frame *frame = look->frame;
    if (!frame_carries(frame, CARRY_VISIBILITY))
        return;
    for (size_t i = 0; i < look->body_count; i++)
        *list_add(&frame->visibility, frame->arena) =
            (struct sighting){.sensor = look->sensor->name, .object = look->bodies[i].object->id};
    look->sightings = frame->visibility.items + frame->visibility.count - look->body_count;
}

void direct_echoes_add(struct look *look)
{
    struct frame *frame = look->frame;
    begin_sightings(look);
    look->blockers = arena_get(frame->arena, (look->body_count + 1) * sizeof(*look->blockers));
    for (size_t i = 0; i < frame->reflectors.count; i++)
        for (size_t j = 0; j < look->sets[i].reflectors->objects.count; j++)
            add_body(look, look->sets[i].bodies[j], &look->sets[i]);
    if (look->sightings != NULL)
        for (size_t i = 0; i < look->body_count; i++)
            sightings_judge(&look->sightings[i]);
    frame_count_pairs(frame, look->sensor->name, look->pairs);
    frame_count_echoes(frame, look->sensor->name, PATH_DIRECT, look->echoes);
}
