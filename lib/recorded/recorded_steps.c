#include "recorded/recorded_steps.h"

#include <stdlib.h>

#include "base/sort.h"
#include "base/units.h"
#include "frame/frame_order.h"

static const size_t NONE = SIZE_MAX;

_Static_assert(offsetof(struct recorded_state, object.id) == 0, "frame_order_names compares it");

static struct recorded_step *step_at(struct recorded_steps *steps, size_t number)
{
    return &steps->ring[number % RECORDED_STEPS_RING];
}

static double seconds_between(const struct recorded_step *from, const struct recorded_step *to)
{
    return (double)(to->time_ns - from->time_ns) * 1e-9;
}

/* ---- rows become states ---- */

/* True if the row is a passenger of the vehicle that was taken last, at exactly the same place.
 * Waiting persons may share a place too. */
static bool rides(const struct recorded_row *row, const struct recorded_step *step)
{
    if (!row->passenger || step->states.count == 0)
        return false;
    const struct recorded_state *last = &step->states.items[step->states.count - 1];
    return !last->passenger && last->at_m.x == row->x_m && last->at_m.y == row->y_m;
}

/* Jumps are those of SUMO's vehicles. */
static struct recorded_jumps *begin_jumps(const struct recorded_steps *steps,
                                          struct recorded_step *step)
{
    const struct recorded_row *row = &steps->row;
    if (!steps->reader.format->of_sumo || row->passenger)
        return NULL;
    struct recorded_jumps *jumps = arena_get(&step->arena, sizeof *jumps);
    if (row->lane != NULL)
        jumps->lane = arena_text(&step->arena, row->lane, strlen(row->lane));
    return jumps;
}

static int take_row(struct recorded_steps *steps, struct recorded_step *step, struct diag *diag)
{
    const struct recorded_row *row = &steps->row;
    if (rides(row, step))
        return 0;
    const struct recorded_word *word = recorded_classes_find(&steps->classes, row->class);
    if (word == NULL && row->likely != NULL)
        word = recorded_classes_find(&steps->classes, row->likely);
    if (word == NULL) {
        recorded_classes_refuse(&steps->classes, row->class, row->untold, diag);
        return diag_prefix(diag, "%s %zu: ", steps->reader.format->place, row->place);
    }
    double length_m = row->length_m != 0 ? row->length_m : word->length_m;
    struct recorded_stretch *stretch = arena_get(&step->arena, sizeof *stretch);
    *stretch = recorded_plausibility_begin(row);
    *list_add(&step->states, &step->arena) = (struct recorded_state){
        .object = {.id = arena_text(&step->arena, row->id, strlen(row->id)),
                   .class = word->class,
                   .x_m = row->x_m,
                   .y_m = row->y_m,
                   .yaw_rad = row->yaw_rad,
                   .vx_mps = row->vx_mps,
                   .vy_mps = row->vy_mps,
                   .yaw_rate_radps = row->yaw_rate_radps,
                   .length_m = length_m,
                   .width_m = row->width_m != 0 ? row->width_m : word->width_m,
                   .height_m = row->height_m != 0 ? row->height_m : word->height_m},
        .since_ns = step->time_ns,
        .passenger = row->passenger,
        .place = row->place,
        .jumps = begin_jumps(steps, step),
        .at_m = {row->x_m, row->y_m},
        .direction_rad = row->direction_rad,
        .ahead_m = row->ahead * length_m,
        .speed_mps = row->speed_mps,
        .z_m = row->z_m,
        .slope = recorded_levels_pitched(row->pitch_rad),
        .stands = row->stands,
        .stretch = stretch,
        .before = NONE,
        .after = NONE,
    };
    return 0;
}

/* Sets the object's yaw if it is NAN: from the velocity, at rest from the direction of travel or
 * the step before. Then moves the object to the centre of its box. */
static void place_object(struct recorded_state *state, const struct recorded_state *before,
                         double slow_mps)
{
    struct object *object = &state->object;
    double speed_mps = vec2_length((struct vec2){object->vx_mps, object->vy_mps});
    if (isnan(object->yaw_rad) && speed_mps > 0 && speed_mps >= slow_mps)
        object->yaw_rad = elementary_atan2(object->vy_mps, object->vx_mps);
    if (isnan(object->yaw_rad))
        object->yaw_rad = state->direction_rad;
    if (isnan(object->yaw_rad))
        object->yaw_rad =
            before != NULL && !isnan(before->object.yaw_rad) ? before->object.yaw_rad : 0;
    object->yaw_rad = units_wrap_rad(object->yaw_rad);
    if (state->ahead_m == 0)
        return;
    struct vec2 heading = vec2_heading(object->yaw_rad);
    object->x_m -= state->ahead_m * heading.x;
    object->y_m -= state->ahead_m * heading.y;
}

/* True if two states of a road user do not differ in what their rows state; what the first one
 * leaves open is then that of the other. */
static bool agree(struct recorded_state *state, const struct recorded_state *other)
{
#define MEMBER(name) offsetof(struct recorded_state, name)
    static const size_t members[] = {MEMBER(object.x_m),
                                     MEMBER(object.y_m),
                                     MEMBER(object.yaw_rad),
                                     MEMBER(object.vx_mps),
                                     MEMBER(object.vy_mps),
                                     MEMBER(object.yaw_rate_radps),
                                     MEMBER(object.length_m),
                                     MEMBER(object.width_m),
                                     MEMBER(object.height_m),
                                     MEMBER(direction_rad),
                                     MEMBER(ahead_m),
                                     MEMBER(speed_mps),
                                     MEMBER(z_m),
                                     MEMBER(slope)};
#undef MEMBER
    for (size_t i = 0; i < sizeof members / sizeof members[0]; i++) {
        double mine, its;
        memcpy(&mine, (const char *)state + members[i], sizeof mine);
        memcpy(&its, (const char *)other + members[i], sizeof its);
        if (isnan(mine))
            memcpy((char *)state + members[i], &its, sizeof its);
        else if (!isnan(its) && its != mine)
            return false;
    }
    return strcmp(state->object.class, other->object.class) == 0;
}

/* Sorts the states. Of a row that stands twice unchanged one is left; different rows of one road
 * user are refused. */
static int sort_states(const struct recorded_steps *steps, struct recorded_step *step,
                       struct diag *diag)
{
    struct recorded_state *states = step->states.items;
    size_t kept = 0;
    sort_list(&step->states, frame_order_names, &step->arena);
    for (size_t i = 0; i < step->states.count; i++) {
        struct recorded_state *last = kept > 0 ? &states[kept - 1] : NULL;
        bool again = last != NULL && strcmp(last->object.id, states[i].object.id) == 0;
        if (again && !agree(last, &states[i]))
            return recorded_row_refuse_second(steps->reader.format, last->object.id, step->time_ns,
                                              last->place, states[i].place, diag);
        if (!again)
            states[kept++] = states[i];
    }
    step->states.count = kept;
    return 0;
}

/* The state of the same visit in the step before: that of the id, unless the way from it is denied.
 * Spreads jumps. */
static struct recorded_state *visit_before(struct recorded_steps *steps,
                                           struct recorded_state *state,
                                           struct recorded_state *named, double length_s)
{
    enum recorded_way way = RECORDED_WAY_PLAIN;
    if (named != NULL)
        way = recorded_jumps_way(state, named, length_s);
    struct recorded_state *before = named;
    if (named != NULL && !recorded_plausibility_follow(&steps->plausibility, state->stretch,
                                                       named->stretch, length_s, way))
        before = NULL;
    if (state->jumps != NULL)
        recorded_jumps_spread(state, before, length_s, &steps->jumps);
    return before;
}

/* Sorts the states and links each to the state of its visit in the step before. Places objects
 * whose rows give yaw or velocity. */
static int link_states(struct recorded_steps *steps, struct recorded_step *step, struct diag *diag)
{
    struct recorded_step *last = steps->read > 0 ? step_at(steps, steps->read - 1) : NULL;
    double length_s = last != NULL ? seconds_between(last, step) : 0;
    if (sort_states(steps, step, diag) != 0)
        return -1;
    for (size_t i = 0, j = 0; i < step->states.count; i++) {
        struct recorded_state *state = &step->states.items[i], *named = NULL;
        const char *id = state->object.id;
        while (last != NULL && j < last->states.count &&
               strcmp(last->states.items[j].object.id, id) < 0)
            j++;
        if (last != NULL && j < last->states.count &&
            strcmp(last->states.items[j].object.id, id) == 0)
            named = &last->states.items[j];
        struct recorded_state *before = visit_before(steps, state, named, length_s);
        if (!isnan(state->object.yaw_rad) || !isnan(state->object.vx_mps)) {
            place_object(state, named, steps->reader.format->slow_mps);
            state->at_m = (struct vec2){state->object.x_m, state->object.y_m};
        }
        if (before == NULL)
            continue;
        state->before = j;
        before->after = i;
        state->since_ns = before->since_ns;
    }
    return 0;
}

/* ---- reading a step ---- */

static int refuse_time(const struct recorded_steps *steps, const struct recorded_step *step,
                       const struct recorded_step *last, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA,
                     "%s %zu: %.12g s after a step of %.12g s; expected a later time, by at most "
                     "1e6 s",
                     steps->reader.format->place, steps->row.place,
                     recorded_row_seconds(step->time_ns), recorded_row_seconds(last->time_ns));
}

/* A step may have the time of the one before if it is the same one again. */
static int begin_step(struct recorded_steps *steps, struct recorded_step *step, struct diag *diag)
{
    step->time_ns = steps->row.time_ns;
    if (steps->read == 0)
        return 0;
    struct recorded_step *last = step_at(steps, steps->read - 1);
    step->interval_ns = step->time_ns - last->time_ns;
    if (step->interval_ns < 0 || step->interval_ns > INT64_C(1000000) * 1000000000)
        return refuse_time(steps, step, last, diag);
    if (steps->read == 1 && step->interval_ns > 0)
        last->interval_ns = step->interval_ns;
    return 0;
}

/* Takes one event; 1 while the step goes on, 0 when it is whole or the source at its end, -1 after
 * a message. */
static int take_event(struct recorded_steps *steps, struct recorded_step *step, bool *begun,
                      struct diag *diag)
{
    struct recorded_row *row = &steps->row;
    const struct recorded_reader *reader = &steps->reader;
    int event = steps->row_waits ? RECORDED_ROW : reader->format->next(reader->state, row, diag);
    if (event < 0)
        return -1;
    steps->row_waits = event == RECORDED_ROW && *begun && row->time_ns != step->time_ns;
    steps->ended = event == RECORDED_END;
    if (steps->ended || steps->row_waits)
        return 0;
    if (!*begun && begin_step(steps, step, diag) != 0)
        return -1;
    *begun = true;
    if (event == RECORDED_STEP)
        return 0;
    return take_row(steps, step, diag) == 0 ? 1 : -1;
}

static bool is_same(double one, double other)
{
    return one == other || (isnan(one) && isnan(other));
}

/* True if two rows state the same of a road user. */
static bool stands_again(const struct recorded_state *one, const struct recorded_state *other)
{
    const struct recorded_stretch *a = one->stretch, *b = other->stretch;
    return strcmp(one->object.id, other->object.id) == 0 && a->at_m.x == b->at_m.x &&
           a->at_m.y == b->at_m.y && is_same(a->velocity_mps.x, b->velocity_mps.x) &&
           is_same(a->velocity_mps.y, b->velocity_mps.y) && is_same(a->yaw_rad, b->yaw_rad) &&
           is_same(a->speed_mps, b->speed_mps);
}

/* True if both steps have the same states. */
static bool is_repeated(const struct recorded_step *step, const struct recorded_step *last)
{
    if (step->states.count != last->states.count)
        return false;
    for (size_t i = 0; i < step->states.count; i++)
        if (!stands_again(&step->states.items[i], &last->states.items[i]))
            return false;
    return true;
}

/* Adds a step that has been read; not one that stands twice unchanged. */
static int add_step(struct recorded_steps *steps, struct recorded_step *step, struct diag *diag)
{
    if (steps->read > 0 && step->interval_ns == 0) {
        const struct recorded_step *last = step_at(steps, steps->read - 1);
        if (sort_states(steps, step, diag) != 0)
            return -1;
        return is_repeated(step, last) ? 0 : refuse_time(steps, step, last, diag);
    }
    if (link_states(steps, step, diag) != 0)
        return -1;
    steps->read++;
    return 0;
}

/* Reads a step into the ring, if there is one. A fault drops the step and ends the recording. */
static void read_step(struct recorded_steps *steps)
{
    struct recorded_step *step = step_at(steps, steps->read);
    struct arena arena = step->arena;
    arena_clear(&arena);
    *step = (struct recorded_step){.arena = arena};
    bool begun = false;
    int more;
    do
        more = take_event(steps, step, &begun, &steps->fault);
    while (more > 0);
    if (more == 0 && begun)
        more = add_step(steps, step, &steps->fault);
    if (more < 0 || step->time_ns > steps->to_ns)
        steps->ended = true;
    if (steps->fault.code == DIAG_OK &&
        recorded_plausibility_check(&steps->plausibility, steps->reader.format, steps->ended,
                                    &steps->fault) != 0)
        steps->ended = true;
}

/* ---- what the rows leave open ---- */

double recorded_steps_slope(double before, double before_s, double after, double after_s)
{
    if (before_s > 0 && after_s > 0)
        return (before * after_s * after_s + after * before_s * before_s) /
               (before_s * after_s * (before_s + after_s));
    if (before_s > 0)
        return before / before_s;
    return after_s > 0 ? after / after_s : (double)NAN;
}

/* Without a neighbouring step a road user has the speed of the source, or 0. */
static void find_velocity(struct recorded_state *state, const struct recorded_state *before,
                          double before_s, const struct recorded_state *after, double after_s)
{
    struct object *object = &state->object;
    struct vec2 at_m = state->at_m, from_m = before != NULL ? before->at_m : at_m;
    struct vec2 to_m = after != NULL ? after->at_m : at_m;
    object->vx_mps = recorded_steps_slope(at_m.x - from_m.x, before_s, to_m.x - at_m.x, after_s);
    object->vy_mps = recorded_steps_slope(at_m.y - from_m.y, before_s, to_m.y - at_m.y, after_s);
    if (before != NULL || after != NULL)
        return;
    bool known = !isnan(state->speed_mps) && !isnan(object->yaw_rad);
    struct vec2 heading = vec2_heading(known ? object->yaw_rad : 0);
    object->vx_mps = known ? state->speed_mps * heading.x : 0;
    object->vy_mps = known ? state->speed_mps * heading.y : 0;
}

static void find_yaw_rate(struct object *object, const struct recorded_state *before,
                          double before_s, const struct recorded_state *after, double after_s)
{
    double left_rad = 0, right_rad = 0;
    if (before != NULL)
        left_rad = units_wrap_rad(object->yaw_rad - before->object.yaw_rad);
    if (after != NULL && !isnan(after->object.yaw_rad))
        right_rad = units_wrap_rad(after->object.yaw_rad - object->yaw_rad);
    else
        after_s = 0;
    double rate_radps = recorded_steps_slope(left_rad, before_s, right_rad, after_s);
    object->yaw_rate_radps = isnan(rate_radps) ? 0 : rate_radps;
}

/* Adds up the path length; compensated (Neumaier), as a track may have very many short steps. */
static void travel(struct recorded_state *state, const struct recorded_state *before)
{
    struct vec2 way_m = {state->object.x_m - before->object.x_m,
                         state->object.y_m - before->object.y_m};
    double sum_m = before->way_m, step_m = vec2_length(way_m);
    state->way_m = sum_m + step_m;
    state->way_rest_m = before->way_rest_m + (sum_m >= step_m ? (sum_m - state->way_m) + step_m
                                                              : (step_m - state->way_m) + sum_m);
    state->object.travelled_m = state->way_m + state->way_rest_m;
}

/* Finds the slope by the track up to this step; in the first step by that to the next. */
static void climb(struct recorded_state *state, const struct recorded_state *before,
                  const struct recorded_state *after)
{
    struct vec2 heading = vec2_heading(state->object.yaw_rad);
    const struct recorded_state *from = state, *to = after;
    if (before != NULL) {
        from = before;
        to = state;
        state->climb = before->climb;
    }
    if (to == NULL || isnan(from->z_m) || isnan(to->z_m))
        return;
    double run_m = vec2_dot(vec2_sub(to->stretch->at_m, from->stretch->at_m), heading);
    state->climb = recorded_levels_climb(state->climb, run_m, to->z_m - from->z_m);
    double slope = recorded_levels_slope(state->climb);
    if (!isnan(slope))
        state->slope = slope;
}

static void complete_step(struct recorded_steps *steps, size_t number)
{
    struct recorded_step *step = step_at(steps, number);
    struct recorded_step *last = NULL, *next = NULL;
    if (number > 0)
        last = step_at(steps, number - 1);
    if (number + 1 < steps->read)
        next = step_at(steps, number + 1);
    bool open = steps->live || (next == NULL && steps->fault.code != DIAG_OK);
    bool closes = next != NULL && next->time_ns > steps->to_ns;
    for (size_t i = 0; i < step->states.count; i++) {
        struct recorded_state *state = &step->states.items[i];
        struct recorded_state *before = NULL, *after = NULL;
        if (last != NULL && state->before != NONE)
            before = &last->states.items[state->before];
        if (next != NULL && state->after != NONE)
            after = &next->states.items[state->after];
        double before_s = before != NULL ? seconds_between(last, step) : 0;
        double after_s = after != NULL ? seconds_between(step, next) : 0;
        if (isnan(state->object.vx_mps))
            find_velocity(state, before, before_s, after, after_s);
        if (isnan(state->object.yaw_rad))
            place_object(state, before, steps->reader.format->slow_mps);
        if (isnan(state->object.yaw_rate_radps))
            find_yaw_rate(&state->object, before, before_s, after, after_s);
        if (before != NULL)
            travel(state, before);
        if (!isnan(state->z_m))
            climb(state, before, after);
        state->leaves = !open && (after == NULL || closes);
    }
}

int recorded_steps_judge(struct recorded_steps *steps, struct diag *diag)
{
    struct recorded_plausibility *plausibility = &steps->plausibility;
    const int64_t to_ns = steps->to_ns;
    if (plausibility->learned)
        return 0;
    steps->to_ns = INT64_MAX;
    plausibility->whole = true;
    while (!steps->ended)
        read_step(steps);
    if (recorded_plausibility_learn(plausibility, steps->reader.format, diag) != 0)
        return -1;
    steps->to_ns = to_ns;
    steps->read = 0;
    steps->jumps = (struct recorded_jump_counts){0};
    steps->fault = (struct diag){0};
    steps->row_waits = steps->ended = false;
    return 0;
}

int recorded_steps_next(struct recorded_steps *steps, const struct recorded_step **step,
                        struct diag *diag)
{
    size_t wanted = steps->given + (steps->live ? 1 : 2);
    while (!steps->ended && steps->read < wanted)
        read_step(steps);
    if (steps->read > steps->given && step_at(steps, steps->given)->time_ns <= steps->to_ns) {
        *step = step_at(steps, steps->given);
        complete_step(steps, steps->given++);
        return 1;
    }
    if (steps->fault.code == DIAG_OK)
        return 0;
    *diag = steps->fault;
    return -1;
}

static int compare_id(const void *id, const void *state)
{
    return strcmp(id, ((const struct recorded_state *)state)->object.id);
}

const struct recorded_state *recorded_steps_find(const struct recorded_step *step, const char *id)
{
    return step->states.count == 0 ? NULL
                                   : bsearch(id, step->states.items, step->states.count,
                                             sizeof *step->states.items, compare_id);
}

void recorded_steps_close(struct recorded_steps *steps)
{
    const struct recorded_reader *reader = &steps->reader;
    if (reader->format != NULL && reader->format->close != NULL)
        reader->format->close(reader->state);
    for (size_t i = 0; i < RECORDED_STEPS_RING; i++)
        arena_free(&steps->ring[i].arena);
}
