#include "recorded/resampling.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/motion.h"

static int64_t next_instant_ns(const struct resampling *resampling)
{
    return recorded_row_instant_ns(resampling->begin_ns,
                                   resampling->first + (int64_t)resampling->made_count,
                                   resampling->rate_hz);
}

/* Finds the first instant that is made; the quotient finds it but for rounding. */
static void begin(struct resampling *resampling, int64_t begin_ns)
{
    const int64_t from_ns = resampling->from_ns;
    resampling->begin_ns = begin_ns;
    if (from_ns <= begin_ns)
        return;
    double ahead_ns = (double)((uint64_t)from_ns - (uint64_t)begin_ns);
    resampling->first = (int64_t)elementary_max(ahead_ns * 1e-9 * resampling->rate_hz - 1, 0);
    while (next_instant_ns(resampling) < from_ns)
        resampling->first++;
}

/* The distance travelled, on the cubic through those of the steps with the speeds as its slopes. */
static double travelled_between(const struct object *a, const struct object *b, double from_mps,
                                double to_mps, double length_s, double share)
{
    struct vec2 at_m, speed_mps, gain_mps2;
    double way_m = b->travelled_m - a->travelled_m;
    double limit = motion_monotone_share(from_mps, to_mps, way_m / length_s);
    motion_hermite((struct vec2){0, 0}, (struct vec2){limit * from_mps, 0}, (struct vec2){way_m, 0},
                   (struct vec2){limit * to_mps, 0}, length_s, share, &at_m, &speed_mps,
                   &gain_mps2);
    return a->travelled_m + at_m.x;
}

/* Lessens the velocities along the heading if the body would roll back on it, although it moves
 * forward and both velocities lead forward; or the reverse. A yaw that is not stated (NAN) lessens
 * nothing. */
static void roll_on(struct vec2 heading, struct vec2 way_mps, struct vec2 *from_mps,
                    struct vec2 *to_mps)
{
    double from = vec2_dot(*from_mps, heading), to = vec2_dot(*to_mps, heading);
    double mean = vec2_dot(way_mps, heading);
    if (isnan(heading.x) || from * to < 0 || from * mean < 0 || to * mean < 0)
        return;
    double less = 1 - motion_monotone_share(fabs(from), fabs(to), fabs(mean));
    if (less == 0)
        return;
    *from_mps = vec2_sub(*from_mps, vec2_scale(less * from, heading));
    *to_mps = vec2_sub(*to_mps, vec2_scale(less * to, heading));
}

struct object resampling_between(const struct object *a, const struct object *b, double length_s,
                                 double share)
{
    struct object object = *a;
    struct vec2 from_m = {a->x_m, a->y_m}, from_mps = {a->vx_mps, a->vy_mps};
    struct vec2 to_m = {b->x_m, b->y_m}, to_mps = {b->vx_mps, b->vy_mps};
    struct vec2 place_m, velocity_mps, acceleration_mps2;
    double from = vec2_length(from_mps), to = vec2_length(to_mps);
    double limit = 1;
    object.travelled_m = travelled_between(a, b, from, to, length_s, share);
    if (vec2_dot(from_mps, to_mps) >= 0)
        limit = motion_monotone_share(from, to, vec2_length(vec2_sub(to_m, from_m)) / length_s);
    double turned_rad = units_wrap_rad(b->yaw_rad - a->yaw_rad);
    from_mps = vec2_scale(limit, from_mps);
    to_mps = vec2_scale(limit, to_mps);
    roll_on(vec2_heading(a->yaw_rad + turned_rad / 2),
            vec2_scale(1 / length_s, vec2_sub(to_m, from_m)), &from_mps, &to_mps);
    motion_hermite(from_m, from_mps, to_m, to_mps, length_s, share, &place_m, &velocity_mps,
                   &acceleration_mps2);
    object.x_m = place_m.x;
    object.y_m = place_m.y;
    object.vx_mps = velocity_mps.x;
    object.vy_mps = velocity_mps.y;
    object.yaw_rad = units_wrap_rad(a->yaw_rad + share * turned_rad);
    object.yaw_rate_radps += share * (b->yaw_rate_radps - a->yaw_rate_radps);
    return object;
}

/* Fills the states at an instant after the step before, at the latest at this step. */
static void interpolate(const struct resampling *resampling, struct recorded_step *made)
{
    const struct recorded_step *from = resampling->from, *to = resampling->to;
    double length_s = (double)to->interval_ns * 1e-9;
    double share = 1 - (double)(to->time_ns - made->time_ns) * 1e-9 / length_s;
    bool between = made->time_ns < to->time_ns;
    for (size_t i = 0; i < to->states.count; i++) {
        struct recorded_state state = to->states.items[i];
        if (between && (from == NULL || state.before == SIZE_MAX))
            continue;
        if (between) {
            const struct recorded_state *before = &from->states.items[state.before];
            state.object = resampling_between(&before->object, &state.object, length_s, share);
            state.z_m = before->z_m + share * (state.z_m - before->z_m);
        }
        state.object.id = arena_text(&made->arena, state.object.id, strlen(state.object.id));
        *list_add(&made->states, &made->arena) = state;
    }
}

/* False behind the last instant, and where a fault ends the recording. */
static bool make_instant(struct resampling *resampling)
{
    const struct recorded_step **to = &resampling->to;
    int64_t time_ns = 0;
    while (*to == NULL || ((time_ns = next_instant_ns(resampling)) > (*to)->time_ns &&
                           time_ns <= resampling->to_ns)) {
        resampling->from = *to;
        if (recorded_steps_next(resampling->steps, to, &resampling->fault) <= 0)
            return false;
        if (resampling->from == NULL)
            begin(resampling, (*to)->time_ns);
    }
    if (time_ns > resampling->to_ns)
        return false;
    struct recorded_step *made = &resampling->made[resampling->made_count % 2];
    struct arena arena = made->arena;
    arena_clear(&arena);
    *made = (struct recorded_step){.arena = arena, .time_ns = time_ns};
    made->interval_ns = (int64_t)round(1e9 / resampling->rate_hz);
    interpolate(resampling, made);
    resampling->made_count++;
    return true;
}

int resampling_next(struct resampling *resampling, const struct recorded_step **step,
                    struct diag *diag)
{
    while (!resampling->ended && resampling->made_count < resampling->given + 2)
        resampling->ended = !make_instant(resampling);
    bool whole = resampling->fault.code == DIAG_OK;
    if (resampling->given == resampling->made_count) {
        if (!whole)
            *diag = resampling->fault;
        return whole ? 0 : -1;
    }
    struct recorded_step *made = &resampling->made[resampling->given++ % 2];
    bool last = resampling->given == resampling->made_count;
    for (size_t i = 0; i < made->states.count; i++) {
        struct recorded_state *state = &made->states.items[i];
        const struct recorded_state *same =
            last ? NULL
                 : recorded_steps_find(&resampling->made[resampling->given % 2], state->object.id);
        state->leaves = same == NULL ? whole || !last : same->since_ns != state->since_ns;
    }
    *step = made;
    return 1;
}

void resampling_close(struct resampling *resampling)
{
    arena_free(&resampling->made[0].arena);
    arena_free(&resampling->made[1].arena);
}
