#include "recorded/recorded_store.h"

#include <math.h>

#include "base/intern.h"
#include "base/sort.h"
#include "base/units.h"
#include "recorded/resampling.h"

/* ---- rows in memory ---- */

enum { CHUNK = 4096 };

static const uint32_t NONE = UINT32_MAX;

enum { X_M, Y_M, YAW_RAD, VX_MPS, VY_MPS };

struct stored_row {
    double values[5]; /* X_M, Y_M, YAW_RAD, VX_MPS, VY_MPS */
    float yaw_rate_radps;
    uint32_t body;
    uint32_t place; /* rows that are the same up to this member are one row that stands twice */
    uint32_t stamp; /* its number in the order of time */
    uint32_t next;  /* row of the same stamp; NONE */
    uint32_t after; /* row of the same road user, at the same time or later; NONE */
};

_Static_assert(sizeof(struct stored_row) <= 64, "the header says so");

/* Values that many rows share, interned by their bytes. */
struct body {
    double length_m, width_m, height_m, ahead, direction_rad;
    uint32_t id, class; /* names */
};

struct stamp {
    int64_t time_ns;
    uint32_t first; /* row; NONE */
    uint32_t step;  /* its number */
};

/* A road user. */
struct track {
    uint32_t first, last; /* rows; NONE */
    uint32_t at;          /* its last row up to the present instant */
    uint32_t step;        /* the last one formed with it; NONE */
    int64_t most_ns;      /* between two rows of one visit */
};

struct store {
    struct recorded_format format;
    struct arena *arena;
    LIST_OF(struct stored_row *) chunks;
    uint32_t rows;
    struct intern names, bodies, times;
    LIST_OF(struct stamp) stamps;
    struct track *tracks;     /* by the number of the id's name */
    LIST_OF(uint32_t) order;  /* numbers of the tracks by their first stamps */
    LIST_OF(int64_t) step_ns; /* times of the steps */
    double rate_hz;           /* of the instants; 0: the steps are those of the rows */
    /* What the reader gives next. */
    size_t stamp, instant;
    uint32_t row;           /* the last one of the stamp that was given; NONE */
    LIST_OF(uint32_t) live; /* numbers of the tracks that have begun and not ended */
    size_t begun, given;    /* numbers of tracks of the order and of live */
};

static struct stored_row *row_at(const struct store *store, uint32_t number)
{
    return &store->chunks.items[number / CHUNK][number % CHUNK];
}

static struct stamp *stamp_of(struct store *store, int64_t time_ns)
{
    uint32_t number = intern_number(&store->times, &time_ns, sizeof time_ns, store->arena);
    if (number == store->stamps.count)
        *list_add(&store->stamps, store->arena) = (struct stamp){time_ns, NONE, 0};
    return &store->stamps.items[number];
}

static void store_row(struct store *store, const struct recorded_row *row)
{
    struct arena *arena = store->arena;
    if (store->rows % CHUNK == 0)
        *list_add(&store->chunks, arena) = arena_get(arena, CHUNK * sizeof(struct stored_row));
    uint32_t number = store->rows++;
    struct stamp *stamp = stamp_of(store, row->time_ns);
    struct body body = {row->length_m,
                        row->width_m,
                        row->height_m,
                        row->ahead,
                        row->direction_rad,
                        intern_word(&store->names, row->id, arena),
                        intern_word(&store->names, row->class, arena)};
    *row_at(store, number) = (struct stored_row){
        {row->x_m, row->y_m, row->yaw_rad, row->vx_mps, row->vy_mps},
        (float)row->yaw_rate_radps,
        intern_number(&store->bodies, &body, sizeof body, arena),
        (uint32_t)row->place,
        NONE,
        stamp->first,
        NONE,
    };
    stamp->first = number;
}

static struct body body_of(const struct store *store, const struct stored_row *row)
{
    struct body body;
    memcpy(&body, intern_text(&store->bodies, row->body), sizeof body);
    return body;
}

static void unpack(const struct store *store, const struct stored_row *stored,
                   struct recorded_row *row)
{
    struct body body = body_of(store, stored);
    *row = recorded_row_unsaid;
    row->id = intern_text(&store->names, body.id);
    row->class = intern_text(&store->names, body.class);
    row->x_m = stored->values[X_M];
    row->y_m = stored->values[Y_M];
    row->yaw_rad = stored->values[YAW_RAD];
    row->vx_mps = stored->values[VX_MPS];
    row->vy_mps = stored->values[VY_MPS];
    row->yaw_rate_radps = (double)stored->yaw_rate_radps;
    row->ahead = body.ahead;
    row->direction_rad = body.direction_rad;
    row->length_m = body.length_m;
    row->width_m = body.width_m;
    row->height_m = body.height_m;
    row->place = stored->place;
}

/* ---- steps ---- */

static struct track *track_of(const struct store *store, const struct stored_row *row)
{
    return &store->tracks[body_of(store, row).id];
}

static int64_t time_of(const struct store *store, const struct stored_row *row)
{
    return store->stamps.items[row->stamp].time_ns;
}

static const struct stored_row *after_of(const struct store *store, const struct stored_row *row)
{
    return row->after != NONE ? row_at(store, row->after) : NULL;
}

/* Links the rows of each road user in the order of time. */
static void link_tracks(struct store *store)
{
    size_t count = store->names.list.count;
    store->tracks = arena_room(store->arena, count * sizeof *store->tracks);
    for (size_t i = 0; i < count; i++)
        store->tracks[i] = (struct track){NONE, NONE, NONE, NONE, 0};
    for (uint32_t i = 0; i < store->stamps.count; i++) {
        for (uint32_t at = store->stamps.items[i].first; at != NONE; at = row_at(store, at)->next) {
            struct stored_row *row = row_at(store, at);
            struct track *track = track_of(store, row);
            row->stamp = i;
            if (track->first == NONE)
                *list_add(&store->order, store->arena) = (uint32_t)(track - store->tracks);
            if (track->first == NONE)
                track->first = at;
            else
                row_at(store, track->last)->after = at;
            track->last = at;
        }
    }
}

/* Finds the usual step of each road user, and returns that of all; 0 if nobody has two times. */
static double usual_step_ns(struct store *store)
{
    struct arena scratch = {0};
    double *all = arena_room(&scratch, store->rows * sizeof *all);
    size_t count = 0;
    for (size_t i = 0; i < store->order.count; i++) {
        struct track *track = &store->tracks[store->order.items[i]];
        size_t begin = count;
        const struct stored_row *row = row_at(store, track->first), *after;
        for (; (after = after_of(store, row)) != NULL; row = after)
            if (after->stamp != row->stamp)
                all[count++] = (double)(time_of(store, after) - time_of(store, row));
        sort_numbers(all + begin, count - begin, &scratch);
        if (count > begin)
            track->most_ns = (int64_t)(1.5 * all[begin + (count - begin - 1) / 2]);
    }
    sort_numbers(all, count, &scratch);
    double usual_ns = count > 0 ? all[(count - 1) / 2] : 0;
    arena_free(&scratch);
    return usual_ns;
}

/* True if a road user of the stamp is in the step already. */
static bool is_in_step(const struct store *store, const struct stamp *stamp, uint32_t step)
{
    bool found = false;
    for (uint32_t at = stamp->first; at != NONE && !found; at = row_at(store, at)->next)
        found = track_of(store, row_at(store, at))->step == step;
    return found;
}

/* Puts the rows of the stamp into the step; returns their number. */
static size_t join_step(struct store *store, struct stamp *stamp, uint32_t step)
{
    size_t rows = 0;
    stamp->step = step;
    for (uint32_t at = stamp->first; at != NONE; at = row_at(store, at)->next, rows++)
        track_of(store, row_at(store, at))->step = step;
    return rows;
}

/* Makes steps of the stamps; returns true if a row has another stamp than its step. */
static bool form_steps(struct store *store, double usual_ns)
{
    const uint64_t tolerance_ns = (uint64_t)(RECORDED_STORE_STEP_SHARE * usual_ns);
    int64_t first_ns = 0;
    size_t most = 0;
    for (size_t i = 0; i < store->stamps.count; i++) {
        struct stamp *stamp = &store->stamps.items[i];
        uint32_t last = (uint32_t)store->step_ns.count - 1;
        if (i == 0 || (uint64_t)stamp->time_ns - (uint64_t)first_ns > tolerance_ns ||
            is_in_step(store, stamp, last)) {
            *list_add(&store->step_ns, store->arena) = first_ns = stamp->time_ns;
            most = 0;
            last++;
        }
        size_t rows = join_step(store, stamp, last);
        if (rows > most)
            store->step_ns.items[last] = stamp->time_ns;
        most = rows > most ? rows : most;
    }
    return store->step_ns.count < store->stamps.count;
}

/* Counts successive rows of one visit, and those that have a step of others between them. */
static void count_torn(const struct store *store, size_t *pairs, size_t *torn)
{
    for (size_t i = 0; i < store->order.count; i++) {
        const struct track *track = &store->tracks[store->order.items[i]];
        const struct stored_row *row = row_at(store, track->first), *after;
        for (; (after = after_of(store, row)) != NULL; row = after) {
            int64_t between_ns = time_of(store, after) - time_of(store, row);
            const struct stamp *stamps = store->stamps.items;
            bool pair = between_ns > 0 && between_ns <= track->most_ns;
            *pairs += pair;
            *torn += pair && stamps[after->stamp].step - stamps[row->stamp].step > 1;
        }
    }
}

/* ---- rows at other times than their own ---- */

/* Time between two rows of a road user; 0 if one is missing or they are those of two visits. */
static double seconds_between(const struct store *store, const struct track *track,
                              const struct stored_row *from, const struct stored_row *to)
{
    if (from == NULL || to == NULL || time_of(store, to) - time_of(store, from) > track->most_ns)
        return 0;
    return (double)(time_of(store, to) - time_of(store, from)) * 1e-9;
}

static double rise(const struct stored_row *from, const struct stored_row *to, size_t value)
{
    return from != NULL && to != NULL ? to->values[value] - from->values[value] : 0;
}

/* Finds the velocities and yaw rates that the rows of a road user lack. */
static void find_rates(struct store *store, const struct track *track)
{
    struct stored_row *before = NULL, *row = row_at(store, track->first), *after;
    for (; row != NULL; before = row, row = after) {
        after = row->after != NONE ? row_at(store, row->after) : NULL;
        double before_s = seconds_between(store, track, before, row);
        double after_s = seconds_between(store, track, row, after);
        if (isnan(row->values[VX_MPS])) {
            for (size_t i = 0; i < 2; i++)
                row->values[VX_MPS + i] = recorded_steps_slope(rise(before, row, i), before_s,
                                                               rise(row, after, i), after_s);
        }
        if (isnan(row->yaw_rate_radps))
            row->yaw_rate_radps =
                (float)recorded_steps_slope(units_wrap_rad(rise(before, row, YAW_RAD)), before_s,
                                            units_wrap_rad(rise(row, after, YAW_RAD)), after_s);
    }
}

/* Moves a row to a time near its own, as far as its velocity and yaw rate are known. */
static void move(struct recorded_row *row, int64_t own_ns, int64_t time_ns)
{
    double length_s = (double)(time_ns - own_ns) * 1e-9;
    if (own_ns == time_ns || isnan(row->vx_mps))
        return;
    row->x_m += length_s * row->vx_mps;
    row->y_m += length_s * row->vy_mps;
    if (!isnan(row->yaw_rate_radps))
        row->yaw_rad += length_s * row->yaw_rate_radps;
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

/* Leaves one of rows that stand twice unchanged, and refuses different ones of one time, as the
 * steps of other recordings do. */
static int drop_repeats(struct store *store, const struct track *track, struct diag *diag)
{
    struct stored_row *row = row_at(store, track->first), *after;
    for (; row->after != NONE; row = after) {
        after = row_at(store, row->after);
        if (after->stamp != row->stamp)
            continue;
        if (memcmp(after, row, offsetof(struct stored_row, place)) != 0)
            return recorded_row_refuse_second(&store->format,
                                              intern_text(&store->names, body_of(store, row).id),
                                              time_of(store, row), row->place, after->place, diag);
        row->after = after->after;
        after = row; /* and the one after it */
    }
    return 0;
}

/* ---- the reader ---- */

static int64_t last_ns(const struct store *store)
{
    return store->stamps.items[store->stamps.count - 1].time_ns;
}

/* The next row of a step, or its end. */
static int next_row(struct store *store, struct recorded_row *row)
{
    const struct stamp *stamps = store->stamps.items;
    for (; store->stamp < store->stamps.count; store->stamp++) {
        const struct stamp *stamp = &stamps[store->stamp];
        store->row = store->row == NONE ? stamp->first : row_at(store, store->row)->next;
        row->time_ns = store->step_ns.items[stamp->step];
        if (store->row != NONE) {
            unpack(store, row_at(store, store->row), row);
            row->time_ns = store->step_ns.items[stamp->step];
            move(row, stamp->time_ns, row->time_ns);
            return RECORDED_ROW;
        }
        if (store->stamp + 1 == store->stamps.count || stamp[1].step != stamp->step) {
            store->stamp++;
            return RECORDED_STEP;
        }
    }
    return RECORDED_END;
}

/* Drops the tracks that end before the instant, and adds those that have begun. */
static void begin_instant(struct store *store, int64_t time_ns)
{
    size_t kept = 0;
    for (size_t i = 0; i < store->live.count; i++) {
        uint32_t number = store->live.items[i];
        if (time_of(store, row_at(store, store->tracks[number].last)) >= time_ns)
            store->live.items[kept++] = number;
    }
    store->live.count = kept;
    for (; store->begun < store->order.count; store->begun++) {
        uint32_t number = store->order.items[store->begun];
        struct track *track = &store->tracks[number];
        if (time_of(store, row_at(store, track->first)) > time_ns)
            break;
        track->at = track->first;
        *list_add(&store->live, store->arena) = number;
    }
}

/* The state of a road user at an instant; false if it is not there. */
static bool state_at(const struct store *store, struct track *track, int64_t time_ns,
                     struct recorded_row *row)
{
    const struct stored_row *from = row_at(store, track->at), *to;
    while ((to = after_of(store, from)) != NULL && time_of(store, to) <= time_ns) {
        track->at = from->after;
        from = to;
    }
    double length_s = seconds_between(store, track, from, to);
    int64_t since_ns = time_ns - time_of(store, from);
    if (since_ns > 0 && length_s == 0)
        return false;
    unpack(store, from, row);
    row->time_ns = time_ns;
    if (since_ns == 0)
        return true;
    struct recorded_row after;
    unpack(store, to, &after);
    interpolate(row, &after, length_s, (double)since_ns * 1e-9 / length_s);
    return true;
}

/* The next road user of an instant, or its end. */
static int next_state(struct store *store, struct recorded_row *row)
{
    int64_t time_ns = recorded_row_instant_ns(store->stamps.items[0].time_ns,
                                              (int64_t)store->instant, store->rate_hz);
    if (time_ns > last_ns(store))
        return RECORDED_END;
    if (store->given == 0)
        begin_instant(store, time_ns);
    while (store->given < store->live.count) {
        struct track *track = &store->tracks[store->live.items[store->given++]];
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
    if (store->stamps.count == 0)
        return RECORDED_END;
    return store->rate_hz > 0 ? next_state(store, row) : next_row(store, row);
}

void recorded_store_rewind(struct recorded_reader reader)
{
    struct store *store = reader.state;
    store->stamp = store->instant = store->begun = store->given = 0;
    store->live.count = 0;
    store->row = NONE;
}

static int compare_times(const void *a, const void *b)
{
    const struct stamp *one = a, *other = b;
    return (one->time_ns > other->time_ns) - (one->time_ns < other->time_ns);
}

/* Makes steps of the rows, or instants if road users have times of their own. */
static int choose_times(struct store *store, double rate_hz, struct diag *diag)
{
    link_tracks(store);
    double usual_ns = usual_step_ns(store);
    bool moved = form_steps(store, usual_ns);
    size_t pairs = 0, torn = 0;
    count_torn(store, &pairs, &torn);
    bool apart = (double)torn > RECORDED_STORE_APART_SHARE * (double)pairs;
    if (apart && rate_hz <= 0)
        return diag_fail(diag, DIAG_DATA,
                         "the road users have times of their own: of %zu times between two rows of "
                         "a road user, %zu have a step of others in between; --rate-hz %.3g "
                         "interpolates each between its own rows",
                         pairs, torn, 1e9 / usual_ns);
    store->rate_hz = apart ? rate_hz : 0;
    for (size_t i = 0; i < store->order.count; i++) {
        struct track *track = &store->tracks[store->order.items[i]];
        if (apart && drop_repeats(store, track, diag) != 0)
            return -1;
        if (apart || moved)
            find_rates(store, track);
    }
    return 0;
}

struct recorded_reader recorded_store_open(struct recorded_reader reader, double rate_hz,
                                           struct arena *arena, struct diag *diag)
{
    struct store *store = arena_get(arena, sizeof *store);
    struct recorded_reader stored = {&store->format, store};
    store->arena = arena;
    store->format = *reader.format;
    store->format.by_time = store->format.marks_steps = true;
    store->format.next = next;
    store->format.close = NULL;
    struct recorded_row row;
    int event;
    while ((event = reader.format->next(reader.state, &row, diag)) > 0) {
        if (event == RECORDED_ROW)
            store_row(store, &row);
    }
    if (reader.format->close != NULL)
        reader.format->close(reader.state);
    sort_list(&store->stamps, compare_times, arena);
    if (event < 0 || choose_times(store, rate_hz, diag) != 0)
        return (struct recorded_reader){0};
    recorded_store_rewind(stored);
    return stored;
}
