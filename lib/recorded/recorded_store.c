#include "recorded/recorded_store.h"

#include "base/sort.h"
#include "base/units.h"
#include "geometry/motion.h"
#include "recorded/recorded_memory.h"
#include "recorded/resampling.h"

enum { USUAL_ROWS = 4096, ENOUGH = 3 };

struct store {
    struct recorded_format format;
    struct recorded_memory memory;
    LIST_OF(int64_t) step_ns; /* times of the steps */
    double rate_hz;           /* of the instants; 0: the steps are those of the rows */
    bool *begins; /* by row: a visit begins behind a denied way; NULL: not known, and none */
    /* What the reader gives next. */
    size_t stamp, instant;
    uint32_t row;           /* the last one of the stamp that was given; NONE */
    LIST_OF(uint32_t) live; /* numbers of the tracks that have begun and not ended */
    size_t begun, given;    /* numbers of tracks of the order and of live */
};

/* ---- steps ---- */

/* The lower quartile of the times between the first rows of a road user, so that absences do not
 * count; 0 if it has one row. *known is the number of these times. */
static double usual_step_ns(const struct recorded_memory *memory,
                            const struct recorded_track *track, double *times_ns, size_t *known)
{
    struct arena scratch = {0};
    uint32_t row = track->first, after;
    *known = 0;
    for (; (after = recorded_memory_next(memory, row)) != RECORDED_NONE; row = after) {
        uint64_t between_ns = recorded_memory_between_ns(memory, row, after);
        if (between_ns > 0)
            times_ns[(*known)++] = (double)between_ns;
        if (*known == USUAL_ROWS)
            break;
    }
    sort_numbers(times_ns, *known, &scratch);
    arena_free(&scratch);
    return *known > 0 ? times_ns[(*known - 1) / 4] : 0;
}

/* Finds what is usual for each road user; returns the median of all, 0 if nobody has two times. A
 * road user with fewer times than ENOUGH has the usual step of all. */
static double find_usual_steps(struct recorded_memory *memory)
{
    struct arena scratch = {0};
    double *times_ns = arena_room(&scratch, USUAL_ROWS * sizeof *times_ns);
    double *all_ns = arena_room(&scratch, memory->order.count * sizeof *all_ns);
    size_t count = 0;
    for (size_t i = 0; i < memory->order.count; i++) {
        struct recorded_track *track = &memory->tracks[memory->order.items[i]];
        size_t known;
        double usual_ns = usual_step_ns(memory, track, times_ns, &known);
        track->most_ns = known < ENOUGH ? 0 : (uint64_t)(1.5 * usual_ns);
        if (known > 0)
            all_ns[count++] = usual_ns;
    }
    sort_numbers(all_ns, count, &scratch);
    double median_ns = count > 0 ? all_ns[(count - 1) / 2] : 0;
    for (size_t i = 0; i < memory->order.count; i++) {
        struct recorded_track *track = &memory->tracks[memory->order.items[i]];
        if (track->most_ns == 0)
            track->most_ns = (uint64_t)(1.5 * median_ns);
    }
    arena_free(&scratch);
    return median_ns;
}

/* What the steps tell about the recording. */
struct step_counts {
    size_t moved;       /* stamps that differ from the time of their step */
    size_t pairs, torn; /* successive rows of a visit, and those with steps of others in between */
};

/* True if a road user of the stamp is in the step already. */
static bool is_in_step(const struct recorded_memory *memory, const struct recorded_stamp *stamp,
                       uint32_t step)
{
    bool found = false;
    for (uint32_t row = stamp->first; row != RECORDED_NONE && !found;
         row = recorded_memory_next(memory, row)) {
        const struct recorded_track *track = recorded_memory_track(memory, row);
        found = track->stamp != RECORDED_NONE && memory->stamps.items[track->stamp].step == step;
    }
    return found;
}

/* Puts the rows of a stamp into its step; returns their number. */
static size_t join_step(struct recorded_memory *memory, const struct recorded_stamp *stamp,
                        struct step_counts *counts)
{
    const struct recorded_stamp *stamps = memory->stamps.items;
    size_t rows = 0;
    for (uint32_t row = stamp->first; row != RECORDED_NONE;
         row = recorded_memory_next(memory, row), rows++) {
        struct recorded_track *track = recorded_memory_track(memory, row);
        const struct recorded_stamp *before =
            track->stamp != RECORDED_NONE ? &stamps[track->stamp] : stamp;
        track->stamp = (uint32_t)(stamp - stamps);
        if (before == stamp ||
            (uint64_t)stamp->time_ns - (uint64_t)before->time_ns > track->most_ns)
            continue;
        counts->pairs++;
        counts->torn += stamp->step - before->step > 1;
    }
    return rows;
}

/* Makes steps of the stamps. */
static struct step_counts form_steps(struct store *store, double usual_ns)
{
    const uint64_t tolerance_ns = (uint64_t)(RECORDED_STORE_STEP_SHARE * usual_ns);
    struct recorded_memory *memory = &store->memory;
    struct step_counts counts = {0};
    int64_t first_ns = 0;
    size_t most = 0;
    for (size_t i = 0; i < memory->stamps.count; i++) {
        struct recorded_stamp *stamp = &memory->stamps.items[i];
        uint32_t last = (uint32_t)store->step_ns.count - 1;
        if (i == 0 || (uint64_t)stamp->time_ns - (uint64_t)first_ns > tolerance_ns ||
            is_in_step(memory, stamp, last)) {
            *list_add(&store->step_ns, memory->arena) = first_ns = stamp->time_ns;
            most = 0;
            last++;
        }
        stamp->step = last;
        size_t rows = join_step(memory, stamp, &counts);
        if (rows > most)
            store->step_ns.items[last] = stamp->time_ns;
        most = rows > most ? rows : most;
    }
    counts.moved = memory->stamps.count - store->step_ns.count;
    return counts;
}

/* ---- rows at other times than their own ---- */

/* Time between two rows of a road user; 0 if one is missing or they are those of two visits. */
static double seconds_between(const struct store *store, const struct recorded_track *track,
                              uint32_t from, uint32_t to)
{
    const struct recorded_memory *memory = &store->memory;
    if (from == RECORDED_NONE || to == RECORDED_NONE ||
        recorded_memory_between_ns(memory, from, to) > track->most_ns)
        return 0;
    if (store->begins != NULL && store->begins[to])
        return 0;
    return (double)recorded_memory_between_ns(memory, from, to) * 1e-9;
}

static double rise(const struct recorded_memory *memory, uint32_t from, uint32_t to, size_t value)
{
    if (from == RECORDED_NONE || to == RECORDED_NONE)
        return 0;
    return recorded_memory_row(memory, to)->values[value] -
           recorded_memory_row(memory, from)->values[value];
}

/* Finds the velocities and yaw rates that the rows of a road user lack. */
static void find_rates(const struct store *store, const struct recorded_track *track)
{
    const struct recorded_memory *memory = &store->memory;
    for (uint32_t before = RECORDED_NONE, at = track->first, after; at != RECORDED_NONE;
         before = at, at = after) {
        struct recorded_memory_row *row = recorded_memory_row(memory, at);
        after = row->next;
        double before_s = seconds_between(store, track, before, at);
        double after_s = seconds_between(store, track, at, after);
        bool vector = !isnan(row->values[RECORDED_VY_MPS]);
        for (size_t i = 0; i < 2 && !vector; i++)
            row->values[RECORDED_VX_MPS + i] = recorded_steps_slope(
                rise(memory, before, at, i), before_s, rise(memory, at, after, i), after_s);
        if (isnan(row->yaw_rate_radps))
            row->yaw_rate_radps = (float)recorded_steps_slope(
                units_wrap_rad(rise(memory, before, at, RECORDED_YAW_RAD)), before_s,
                units_wrap_rad(rise(memory, at, after, RECORDED_YAW_RAD)), after_s);
    }
}

/* Moves a row to a time near its own, as far as its velocity and yaw rate are known. */
static void move(struct recorded_row *row, int64_t time_ns)
{
    bool turns = !isnan(row->yaw_rate_radps), moves = !isnan(row->vx_mps);
    double length_s = (double)(time_ns - row->time_ns) * 1e-9;
    row->time_ns = time_ns;
    if (length_s == 0 || !moves)
        return;
    struct motion body = {{row->x_m, row->y_m},
                          {row->vx_mps, row->vy_mps},
                          row->yaw_rad,
                          turns ? row->yaw_rate_radps : 0};
    body = motion_after(body, length_s);
    row->x_m = body.position_m.x;
    row->y_m = body.position_m.y;
    row->vx_mps = body.velocity_mps.x;
    row->vy_mps = body.velocity_mps.y;
    row->yaw_rad = body.yaw_rad;
}

static struct object object_of(const struct recorded_row *row)
{
    return (struct object){.x_m = row->x_m,
                           .y_m = row->y_m,
                           .yaw_rad = row->yaw_rad,
                           .vx_mps = row->vx_mps,
                           .vy_mps = row->vy_mps,
                           .yaw_rate_radps = row->yaw_rate_radps};
}

/* Interpolates between two rows of a road user; the row is the earlier one. */
static void interpolate(struct recorded_row *row, const struct recorded_row *after, double length_s,
                        double share)
{
    struct object from = object_of(row), to = object_of(after);
    struct object between = resampling_between(&from, &to, length_s, share);
    row->x_m = between.x_m;
    row->y_m = between.y_m;
    row->yaw_rad = between.yaw_rad;
    row->vx_mps = between.vx_mps;
    row->vy_mps = between.vy_mps;
    row->yaw_rate_radps = between.yaw_rate_radps;
}

/* Leaves one of rows that stand twice unchanged. */
static void drop_repeats(const struct recorded_memory *memory, const struct recorded_track *track)
{
    for (uint32_t at = track->first; at != RECORDED_NONE;) {
        struct recorded_memory_row *row = recorded_memory_row(memory, at);
        const struct recorded_memory_row *again = row;
        if (row->next != RECORDED_NONE && memory->stamp_at[row->next] == memory->stamp_at[at])
            again = recorded_memory_row(memory, row->next);
        if (again != row && memcmp(again, row, offsetof(struct recorded_memory_row, place)) == 0)
            row->next = again->next;
        else
            at = row->next;
    }
}

/* ---- road users with times of their own ---- */

/* Refuses different rows of one road user at one time, as the steps of other recordings do. */
static int refuse_seconds(const struct store *store, const struct recorded_track *track,
                          struct diag *diag)
{
    const struct recorded_memory *memory = &store->memory;
    for (uint32_t at = track->first, after; at != RECORDED_NONE; at = after) {
        struct recorded_row row;
        after = recorded_memory_next(memory, at);
        recorded_memory_get(memory, at, &row);
        if (after != RECORDED_NONE && memory->stamp_at[after] == memory->stamp_at[at])
            return recorded_row_refuse_second(&store->format, row.id, row.time_ns, row.place,
                                              recorded_memory_row(memory, after)->place, diag);
    }
    return 0;
}

static int refuse_all_seconds(const struct store *store, struct diag *diag)
{
    const struct recorded_memory *memory = &store->memory;
    for (size_t i = 0; i < memory->order.count; i++)
        if (refuse_seconds(store, &memory->tracks[memory->order.items[i]], diag) != 0)
            return -1;
    return 0;
}

/* Compares the ways between the rows of each road user with its speeds. */
static void follow_tracks(struct store *store, struct recorded_plausibility *plausibility)
{
    const struct recorded_memory *memory = &store->memory;
    for (size_t i = 0; i < memory->order.count; i++) {
        const struct recorded_track *track = &memory->tracks[memory->order.items[i]];
        uint32_t at = track->first, after;
        struct recorded_row row;
        recorded_memory_get(memory, at, &row);
        struct recorded_stretch before = recorded_plausibility_begin(&row);
        for (; (after = recorded_memory_next(memory, at)) != RECORDED_NONE; at = after) {
            recorded_memory_get(memory, after, &row);
            struct recorded_stretch now = recorded_plausibility_begin(&row);
            store->begins[after] = false;
            double length_s = seconds_between(store, track, at, after);
            store->begins[after] =
                length_s > 0 && !recorded_plausibility_follow(plausibility, &now, &before, length_s,
                                                              RECORDED_WAY_PLAIN);
            before = now;
        }
    }
}

/* Judges the recording by the rows, as what is interpolated between them contradicts nothing. */
static int judge_tracks(struct store *store, struct recorded_plausibility *plausibility,
                        struct diag *diag)
{
    size_t size = store->memory.rows * sizeof *store->begins;
    store->begins = arena_get(store->memory.arena, size);
    plausibility->whole = true;
    follow_tracks(store, plausibility);
    if (recorded_plausibility_learn(plausibility, &store->format, diag) != 0)
        return -1;
    follow_tracks(store, plausibility);
    plausibility->counted = true;
    return 0;
}

/* ---- the reader ---- */

/* The next row of a step, or its end. */
static int next_row(struct store *store, struct recorded_row *row)
{
    const struct recorded_memory *memory = &store->memory;
    for (; store->stamp < memory->stamps.count; store->stamp++) {
        const struct recorded_stamp *stamp = &memory->stamps.items[store->stamp];
        const int64_t step_ns = store->step_ns.items[stamp->step];
        store->row =
            store->row == RECORDED_NONE ? stamp->first : recorded_memory_next(memory, store->row);
        row->time_ns = step_ns;
        if (store->row != RECORDED_NONE) {
            recorded_memory_get(memory, store->row, row);
            move(row, step_ns);
            return RECORDED_ROW;
        }
        if (store->stamp + 1 == memory->stamps.count || stamp[1].step != stamp->step) {
            store->stamp++;
            return RECORDED_STEP;
        }
    }
    return RECORDED_END;
}

/* Drops the tracks that end before the instant, and adds those that have begun. */
static void begin_instant(struct store *store, int64_t time_ns)
{
    const struct recorded_memory *memory = &store->memory;
    size_t kept = 0;
    for (size_t i = 0; i < store->live.count; i++) {
        uint32_t number = store->live.items[i];
        if (recorded_memory_time_ns(memory, memory->tracks[number].last) >= time_ns)
            store->live.items[kept++] = number;
    }
    store->live.count = kept;
    for (; store->begun < memory->order.count; store->begun++) {
        uint32_t number = memory->order.items[store->begun];
        struct recorded_track *track = &memory->tracks[number];
        if (recorded_memory_time_ns(memory, track->first) > time_ns)
            break;
        track->at = track->first;
        *list_add(&store->live, memory->arena) = number;
    }
}

/* The state of a road user at an instant; false if it is not there. */
static bool state_at(const struct store *store, struct recorded_track *track, int64_t time_ns,
                     struct recorded_row *row)
{
    const struct recorded_memory *memory = &store->memory;
    uint32_t to;
    while ((to = recorded_memory_next(memory, track->at)) != RECORDED_NONE &&
           recorded_memory_time_ns(memory, to) <= time_ns)
        track->at = to;
    recorded_memory_get(memory, track->at, row);
    if (row->time_ns == time_ns)
        return true;
    double length_s = seconds_between(store, track, track->at, to);
    if (length_s == 0)
        return false;
    double since_s = (double)(time_ns - row->time_ns) * 1e-9;
    struct recorded_row after;
    recorded_memory_get(memory, to, &after);
    interpolate(row, &after, length_s, since_s / length_s);
    row->time_ns = time_ns;
    return true;
}

/* The next road user of an instant, or its end. */
static int next_state(struct store *store, struct recorded_row *row)
{
    const struct recorded_memory *memory = &store->memory;
    const struct recorded_stamp *stamps = memory->stamps.items;
    int64_t time_ns =
        recorded_row_instant_ns(stamps[0].time_ns, (int64_t)store->instant, store->rate_hz);
    if (time_ns > stamps[memory->stamps.count - 1].time_ns)
        return RECORDED_END;
    if (store->given == 0)
        begin_instant(store, time_ns);
    while (store->given < store->live.count) {
        struct recorded_track *track = &memory->tracks[store->live.items[store->given++]];
        if (state_at(store, track, time_ns, row))
            return RECORDED_ROW;
    }
    store->given = 0;
    store->instant++;
    row->time_ns = time_ns;
    return RECORDED_STEP;
}

static int next(void *state, struct recorded_row *row, struct diag *diag)
{
    (void)diag;
    struct store *store = state;
    if (store->memory.stamps.count == 0)
        return RECORDED_END;
    return store->rate_hz > 0 ? next_state(store, row) : next_row(store, row);
}

void recorded_store_rewind(struct recorded_reader reader)
{
    struct store *store = reader.state;
    store->stamp = store->instant = store->begun = store->given = 0;
    store->live.count = 0;
    store->row = RECORDED_NONE;
}

/* Makes steps of the rows, or instants if road users have times of their own. */
static int choose_times(struct store *store, double rate_hz,
                        struct recorded_plausibility *plausibility, struct diag *diag)
{
    struct recorded_memory *memory = &store->memory;
    recorded_memory_sort(memory);
    recorded_memory_link_by_track(memory);
    for (size_t i = 0; i < memory->order.count; i++)
        drop_repeats(memory, &memory->tracks[memory->order.items[i]]);
    double usual_ns = find_usual_steps(memory);
    recorded_memory_link_by_stamp(memory);
    struct step_counts counts = form_steps(store, usual_ns);
    double most = rate_hz > 0 ? 0 : RECORDED_STORE_APART_SHARE * (double)counts.pairs;
    bool apart = (double)counts.torn > most;
    if (apart && rate_hz <= 0)
        return diag_fail(diag, DIAG_DATA,
                         "the road users have times of their own: of %zu times between two rows of "
                         "a road user, %zu have a step of others in between; --rate-hz %.3g "
                         "interpolates each between its own rows",
                         counts.pairs, counts.torn, 1e9 / usual_ns);
    if (!apart && counts.moved == 0)
        return 0;
    recorded_memory_link_by_track(memory);
    if (apart &&
        (refuse_all_seconds(store, diag) != 0 || judge_tracks(store, plausibility, diag) != 0))
        return -1;
    for (size_t i = 0; i < memory->order.count; i++)
        find_rates(store, &memory->tracks[memory->order.items[i]]);
    if (apart)
        store->rate_hz = rate_hz;
    else
        recorded_memory_link_by_stamp(memory);
    return 0;
}

struct recorded_reader recorded_store_open(struct recorded_reader reader, double rate_hz,
                                           struct recorded_plausibility *plausibility,
                                           struct arena *arena, struct diag *diag)
{
    struct store *store = arena_get(arena, sizeof *store);
    struct recorded_reader stored = {&store->format, store};
    store->memory.arena = arena;
    store->format = *reader.format;
    store->format.by_time = store->format.marks_steps = true;
    store->format.next = next;
    store->format.close = NULL;
    struct recorded_row row;
    int event;
    while ((event = reader.format->next(reader.state, &row, diag)) > 0) {
        if (event == RECORDED_ROW)
            recorded_memory_add(&store->memory, &row);
    }
    if (reader.format->close != NULL)
        reader.format->close(reader.state);
    if (event < 0 || choose_times(store, rate_hz, plausibility, diag) != 0)
        return (struct recorded_reader){0};
    recorded_store_rewind(stored);
    return stored;
}
