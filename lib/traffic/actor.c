#include "traffic/actor.h"

#include "base/elementary.h"
#include "base/search.h"
#include "base/units.h"

static const struct field segment_fields[] = {
    {FIELD_REAL_IN(struct segment, duration_s, 0, 1e6, "the next segment begins after this time")},
    {OPTIONAL_REAL(struct segment, acceleration_mps2, -1e3, 1e3, "along the heading")},
    {OPTIONAL_REAL(struct segment, yaw_rate_radps, -1e3, 1e3, "turn rate, left positive")},
    {0},
};

static const struct record segment_record = {FIELD_TABLE(
    struct segment, segment_fields, "segment", "A time of constant acceleration and turn rate.")};

static const struct field waypoint_fields[] = {
    {FIELD_REAL_IN(struct waypoint, time_s, 0, 1e6,
                   "when the object is there; later than at the waypoint before")},
    {FIELD_REAL_IN(struct waypoint, x_m, -1e9, 1e9, "centre of the box")},
    {FIELD_REAL_IN(struct waypoint, y_m, -1e9, 1e9, "centre of the box")},
    {0},
};

static const struct record waypoint_record = {
    FIELD_TABLE(struct waypoint, waypoint_fields, "waypoint", "A place and when to be there.")};

static const struct field actor_fields[] = {
    {FIELD_NAME_OF(struct actor, id, "unique in the scenario")},
    {FIELD_NAME_OF(struct actor, class, "names the vehicle document")},
    {OPTIONAL_REAL(struct actor, length_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, width_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, height_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, x_m, -1e9, 1e9, "centre of the box at time 0")},
    {OPTIONAL_REAL(struct actor, y_m, -1e9, 1e9, "centre of the box at time 0")},
    {OPTIONAL_REAL(struct actor, yaw_rad, -2 * PI, 2 * PI, "heading at time 0")},
    {OPTIONAL_REAL(struct actor, speed_mps, -1e3, 1e3, "at time 0; below 0: backwards")},
    {OPTIONAL_LIST(struct actor, segments, &segment_record, "driven one after another")},
    {OPTIONAL_LIST(struct actor, waypoints, &waypoint_record, "followed instead of segments")},
    {0},
};

const struct record actor_record = {
    FIELD_TABLE(struct actor, actor_fields, "object", "A road user or thing, and how it moves.")};

int actor_check(const struct actor *actor, struct diag *diag)
{
    const struct waypoint *waypoints = actor->waypoints.items;
    if (actor->waypoints.count == 0)
        return 0;
    if (actor->waypoints.count < 2)
        return diag_fail(diag, DIAG_CONFIG, "waypoints: only one; expected two or more, or none");
    for (size_t i = 1; i < actor->waypoints.count; i++)
        if (!(waypoints[i].time_s > waypoints[i - 1].time_s))
            return diag_fail(diag, DIAG_CONFIG,
                             "waypoints[%zu].time_s: %g is not after the previous waypoint's %g", i,
                             waypoints[i].time_s, waypoints[i - 1].time_s);
    if (actor->segments.count > 0)
        return diag_fail(diag, DIAG_CONFIG, "segments: expected none beside waypoints");
    if (actor->x_m != 0 || actor->y_m != 0 || actor->speed_mps != 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "waypoints: they give place and speed; expected no x_m, y_m, speed_mps");
    return 0;
}

void actor_shift(struct actor *actor, struct vec2 origin_m)
{
    for (size_t i = 0; i < actor->waypoints.count; i++) {
        actor->waypoints.items[i].x_m -= origin_m.x;
        actor->waypoints.items[i].y_m -= origin_m.y;
    }
    if (actor->waypoints.count > 0)
        return;
    actor->x_m -= origin_m.x;
    actor->y_m -= origin_m.y;
}

struct segment_begin {
    struct motion body;
    double speed_mps, travelled_m;
};

/* The begin of a segment, and then of the segment after it. */
static struct segment_begin after_segment(struct segment_begin begin, const struct segment *segment)
{
    begin.travelled_m +=
        motion_drive_length_m(begin.speed_mps, segment->acceleration_mps2, segment->duration_s);
    begin.body =
        motion_drive(begin.body.position_m, begin.body.yaw_rad, begin.speed_mps,
                     segment->acceleration_mps2, segment->yaw_rate_radps, segment->duration_s);
    begin.speed_mps += segment->acceleration_mps2 * segment->duration_s;
    return begin;
}

static void prepare_segments(struct actor *actor, struct arena *arena)
{
    struct segment_begin begin = {
        .body = {.position_m = {actor->x_m, actor->y_m}, .yaw_rad = actor->yaw_rad},
        .speed_mps = actor->speed_mps};
    actor->begins = arena_get(arena, (actor->segments.count + 1) * sizeof begin);
    actor->begins[0] = begin;
    for (size_t i = 0; i < actor->segments.count; i++)
        actor->begins[i + 1] = after_segment(actor->begins[i], &actor->segments.items[i]);
}

static struct motion drive_segments(const struct actor *actor, double time_s, double *travelled_m)
{
    const struct segment *segments = actor->segments.items;
    struct segment current = {0};
    size_t number = 0;
    for (; number < actor->segments.count && time_s >= segments[number].duration_s; number++)
        time_s -= segments[number].duration_s;
    if (number < actor->segments.count)
        current = segments[number];
    current.duration_s = time_s;
    struct segment_begin now = after_segment(actor->begins[number], &current);
    *travelled_m = now.travelled_m;
    return now.body;
}

/* What is computed once for the way from one waypoint to the next. */
struct span {
    double length_m;
    double standing_yaw_rad; /* where the rest of the span does not move */
};

static double span_duration_s(const struct actor *actor, size_t span)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    return from[1].time_s - from[0].time_s;
}

/* The mean velocity from one waypoint to the next. */
static struct vec2 span_mean_mps(const struct actor *actor, size_t span)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    struct vec2 way_m = {from[1].x_m - from[0].x_m, from[1].y_m - from[0].y_m};
    return vec2_scale(1 / span_duration_s(actor, span), way_m);
}

/* The velocity at a waypoint by finite differences: of two points at the ends, where the
 * three-point formula can start a body backwards. Next to two equal places it is 0, or the body
 * would swing. */
static struct vec2 waypoint_velocity_mps(const struct actor *actor, size_t waypoint)
{
    size_t spans = actor->waypoints.count - 1;
    if (waypoint == 0 || waypoint == spans)
        return span_mean_mps(actor, waypoint == 0 ? 0 : spans - 1);
    struct vec2 before_mps = span_mean_mps(actor, waypoint - 1);
    struct vec2 after_mps = span_mean_mps(actor, waypoint);
    if (vec2_dot(before_mps, before_mps) == 0 || vec2_dot(after_mps, after_mps) == 0)
        return (struct vec2){0, 0};
    double before_s = span_duration_s(actor, waypoint - 1);
    double after_s = span_duration_s(actor, waypoint);
    double weight = after_s / (before_s + after_s);
    return vec2_add(vec2_scale(weight, before_mps), vec2_scale(1 - weight, after_mps));
}

struct curve_state {
    struct vec2 position_m, velocity_mps, acceleration_mps2;
};

/* The curve at the fraction s of a span. */
static struct curve_state curve_at(const struct actor *actor, size_t span, double s)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    struct curve_state state;
    motion_hermite((struct vec2){from[0].x_m, from[0].y_m}, waypoint_velocity_mps(actor, span),
                   (struct vec2){from[1].x_m, from[1].y_m}, waypoint_velocity_mps(actor, span + 1),
                   span_duration_s(actor, span), s, &state.position_m, &state.velocity_mps,
                   &state.acceleration_mps2);
    return state;
}

static bool is_moving(struct vec2 velocity_mps)
{
    return vec2_dot(velocity_mps, velocity_mps) >= 1e-6 * 1e-6;
}

/* Finds the yaw at the first place where the body moves, from one fraction of a span towards
 * another; false if it does not move. The steps begin tiny and double. */
static bool find_yaw(const struct actor *actor, size_t span, double from, double to,
                     double *yaw_rad)
{
    for (int halvings = 20; halvings >= 0; halvings--) {
        double s = from + ldexp(to - from, -halvings);
        struct vec2 velocity_mps = curve_at(actor, span, s).velocity_mps;
        if (is_moving(velocity_mps)) {
            *yaw_rad = elementary_atan2(velocity_mps.y, velocity_mps.x);
            return true;
        }
    }
    return false;
}

/* The curve's length from the beginning of a span to the fraction s, by five-point Gauss-Legendre
 * quadrature: exact where the body goes straight without reversing. */
static double span_length_m(const struct actor *actor, size_t span, double s)
{
    static const double rule[][2] = {
        {-0.90617984593866399, 0.23692688505618909},
        {-0.53846931010568309, 0.47862867049936647},
        {0, 0.56888888888888889},
        {0.53846931010568309, 0.47862867049936647},
        {0.90617984593866399, 0.23692688505618909},
    };
    double sum_mps = 0;
    for (size_t i = 0; i < sizeof rule / sizeof rule[0]; i++) {
        struct curve_state state = curve_at(actor, span, s / 2 * (1 + rule[i][0]));
        sum_mps += rule[i][1] * vec2_length(state.velocity_mps);
    }
    return s / 2 * span_duration_s(actor, span) * sum_mps;
}

/* A body that stands points along its next motion, else its last one, else along yaw_rad. */
static void prepare_spans(struct actor *actor, struct arena *arena)
{
    size_t count = actor->waypoints.count - 1;
    struct span *spans = arena_get(arena, count * sizeof *spans);
    double yaw_rad = actor->yaw_rad;
    for (size_t i = 0; i < count; i++) {
        find_yaw(actor, i, 1, 0, &yaw_rad);
        spans[i].standing_yaw_rad = yaw_rad;
        spans[i].length_m = span_length_m(actor, i, 1);
    }
    bool moves_later = false;
    for (size_t i = count; i-- > 0;) {
        if (moves_later)
            spans[i].standing_yaw_rad = yaw_rad;
        moves_later = find_yaw(actor, i, 0, 1, &yaw_rad) || moves_later;
    }
    actor->spans = spans;
}

void actor_prepare(struct actor *actor, struct arena *arena)
{
    if (actor->waypoints.count > 0)
        prepare_spans(actor, arena);
    else
        prepare_segments(actor, arena);
}

static size_t span_of(const struct actor *actor, double time_s)
{
    const struct waypoint *waypoints = actor->waypoints.items;
    return search_row(&waypoints[0].time_s, sizeof *waypoints, actor->waypoints.count - 1, time_s);
}

/* The fraction of a span at time_s, below 0 and above 1 before and after it. */
static double fraction_at(const struct actor *actor, size_t span, double time_s)
{
    return (time_s - actor->waypoints.items[span].time_s) / span_duration_s(actor, span);
}

static double within_span(double fraction)
{
    return elementary_max(elementary_min(fraction, 1), 0);
}

struct vec2 actor_start(const struct actor *actor)
{
    if (actor->waypoints.count == 0)
        return (struct vec2){actor->x_m, actor->y_m};
    return curve_at(actor, 0, within_span(fraction_at(actor, 0, 0))).position_m;
}

static struct motion follow_waypoints(const struct actor *actor, double time_s, double *travelled_m)
{
    size_t span = span_of(actor, time_s);
    double fraction = fraction_at(actor, span, time_s);
    double s = within_span(fraction);
    *travelled_m = span_length_m(actor, span, s);
    for (size_t i = 0; i < span; i++)
        *travelled_m += actor->spans[i].length_m;
    struct curve_state state = curve_at(actor, span, s);
    bool moving = is_moving(state.velocity_mps);
    struct motion body = {.position_m = state.position_m,
                          .yaw_rad = actor->spans[span].standing_yaw_rad};
    if (moving)
        body.yaw_rad = elementary_atan2(state.velocity_mps.y, state.velocity_mps.x);
    else
        find_yaw(actor, span, s, 1, &body.yaw_rad);
    if (fraction < 0 || fraction > 1)
        return body;
    body.velocity_mps = state.velocity_mps;
    if (moving)
        body.yaw_rate_radps = vec2_cross(state.velocity_mps, state.acceleration_mps2) /
                              vec2_dot(state.velocity_mps, state.velocity_mps);
    return body;
}

struct motion actor_motion(const struct actor *actor, double time_s, double *travelled_m)
{
    struct motion body = actor->waypoints.count > 0 ? follow_waypoints(actor, time_s, travelled_m)
                                                    : drive_segments(actor, time_s, travelled_m);
    body.yaw_rad = units_wrap_rad(body.yaw_rad);
    return body;
}
