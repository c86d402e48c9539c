/* Vehicles that jump to another lane or angle (SUMO).
 *
 * A jump is what the place moves beyond its speed: sideways by more than JUMP_LEAST_M and faster
 * than JUMP_LEAST_MPS, but by no more than JUMP_MOST_M, which is wider than a lane; what is longer
 * is a teleport (recorded_plausibility.h). The body goes on from where it is: its distance to the
 * recorded place falls to 0 along a cubic within RECORDED_JUMP_S, an ordinary time of a lane change
 * (4.0 s with a standard deviation of 2.3 s in NGSIM: Thiemann, Treiber and Kesting, TRR 2088,
 * 2008). A jump of a standing vehicle within one lane, where the source names lanes, is no change
 * of lanes: SUMO parks it beside its lane, or takes it back. That way is not the body's own.
 *
 * A body turns about the middle of its front bumper, which the recording places. Where that moves
 * at an angle to the body, and the body turns at 2 v / l times the sine of that angle, the centre
 * moves along the body, as a trailer follows. The turn rate is at most that one and the one that
 * moves the centre sideways by v/4. Below CREEP_MPS, v is CREEP_MPS. */
#include "base/units.h"
#include "recorded/recorded_steps.h"

static const double JUMP_LEAST_M = 1, JUMP_LEAST_MPS = 2, JUMP_MOST_M = 5, STANDS_MPS = 0.1,
                    TURN_SLACK = 0.5, CREEP_MPS = 1,
                    COURSE_M = 1e-3; /* the least way that tells a direction */

/* The part of the way that the speed does not explain; zero if it is no jump, or if the angle turns
 * so far in the step (a junction within a second) that the way may have any direction. */
static struct vec2 jump_of(const struct recorded_state *state, const struct recorded_state *before,
                           struct vec2 way_m, double length_s)
{
    double speed_mps = isnan(state->speed_mps) ? before->speed_mps : state->speed_mps;
    double said_m = speed_mps * length_s, aside_m = fabs(vec2_cross(before->jumps->along, way_m));
    double turn_rad = units_wrap_rad(state->object.yaw_rad - before->jumps->angle_rad);
    struct vec2 jump_m = vec2_sub(way_m, vec2_scale(said_m, before->jumps->along));
    bool sideways = aside_m > JUMP_LEAST_M && aside_m > JUMP_LEAST_MPS * length_s;
    bool unsaid = vec2_dot(way_m, way_m) > said_m * said_m + JUMP_LEAST_M * JUMP_LEAST_M;
    bool known = said_m * fabs(turn_rad) <= JUMP_LEAST_M && vec2_length(jump_m) <= JUMP_MOST_M;
    return sideways && unsaid && known ? jump_m : (struct vec2){0, 0};
}

enum recorded_way recorded_jumps_way(const struct recorded_state *state,
                                     const struct recorded_state *before, double length_s)
{
    const struct recorded_jumps *now = state->jumps, *last = before->jumps;
    if (now == NULL || last == NULL)
        return RECORDED_WAY_PLAIN;
    struct vec2 way_m = vec2_sub(state->stretch->at_m, before->stretch->at_m);
    struct vec2 jump_m = jump_of(state, before, way_m, length_s);
    if (jump_m.x == 0 && jump_m.y == 0)
        return RECORDED_WAY_PLAIN;
    bool within = now->lane != NULL && last->lane != NULL && strcmp(now->lane, last->lane) == 0;
    bool stands = elementary_min(state->speed_mps, before->speed_mps) < STANDS_MPS;
    return within && stands ? RECORDED_WAY_LEFT : RECORDED_WAY_EXPLAINED;
}

/* Sets what is still left, length_s later, of the jumps before. */
static void fade(struct recorded_jumps *jumps, const struct recorded_jumps *before, double length_s)
{
    if (before->left_s <= length_s)
        return;
    double share = length_s / before->left_s, rest = 1 - share;
    struct vec2 rest_m =
        vec2_add(vec2_scale(1 + 2 * share, before->rest_m), vec2_scale(length_s, before->rest_mps));
    jumps->left_s = before->left_s - length_s;
    jumps->rest_m = vec2_scale(rest * rest, rest_m);
    jumps->rest_mps = vec2_add(vec2_scale(-6 * share * rest / before->left_s, before->rest_m),
                               vec2_scale(rest * (1 - 3 * share), before->rest_mps));
}

/* The yaw after the way, as near to the recorded angle as the body can turn. */
static double turned_rad(const struct recorded_state *state, const struct recorded_state *before,
                         struct vec2 way_m, double length_s)
{
    double yaw_rad = before->object.yaw_rad, way = vec2_length(way_m);
    double wanted_rad = units_wrap_rad(state->object.yaw_rad - yaw_rad);
    struct vec2 heading = vec2_heading(yaw_rad);
    double aside = way > COURSE_M ? vec2_cross(heading, way_m) / way : 0;
    if (vec2_dot(heading, way_m) < 0)
        aside = copysign(1, aside);
    double unit_rad = elementary_max(way, CREEP_MPS * length_s) / state->object.length_m;
    double low_rad = (elementary_min(0, 2 * aside) - TURN_SLACK) * unit_rad;
    double high_rad = (elementary_max(0, 2 * aside) + TURN_SLACK) * unit_rad;
    double turn_rad = elementary_min(elementary_max(wanted_rad, low_rad), high_rad);
    bool turns = state->object.length_m > 0 && turn_rad != wanted_rad;
    return turns ? units_wrap_rad(yaw_rad + turn_rad) : state->object.yaw_rad;
}

void recorded_jumps_spread(struct recorded_state *state, const struct recorded_state *before,
                           double length_s, struct recorded_jump_counts *counts)
{
    struct object *object = &state->object;
    struct recorded_jumps *jumps = state->jumps;
    jumps->angle_rad = object->yaw_rad;
    jumps->along = vec2_heading(object->yaw_rad);
    if (before == NULL || before->jumps == NULL)
        return;
    struct vec2 way_m = vec2_sub(state->stretch->at_m, before->stretch->at_m);
    struct vec2 jump_m = jump_of(state, before, way_m, length_s);
    bool jumped = jump_m.x != 0 || jump_m.y != 0;
    way_m = vec2_sub(way_m, jump_m);
    double way = vec2_length(way_m);
    jumps->along = way > COURSE_M ? vec2_scale(1 / way, way_m) : before->jumps->along;
    if (isnan(state->speed_mps))
        state->speed_mps = way / length_s;
    fade(jumps, before->jumps, length_s);
    if (jumped)
        jumps->left_s = RECORDED_JUMP_S;
    jumps->rest_m = vec2_add(jumps->rest_m, jump_m);
    object->x_m -= jumps->rest_m.x;
    object->y_m -= jumps->rest_m.y;
    object->yaw_rad = turned_rad(state, before, way_m, length_s);
    jumps->turns = object->yaw_rad != jumps->angle_rad;
    counts->lanes += jumped;
    counts->angles += jumps->turns && !before->jumps->turns;
}
