#include "traffic/trajectory.h"

#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/sort.h"
#include "base/units.h"
#include "base/vec2.h"
#include "text/csv_table.h"
#include "text/field.h"

struct column {
    const char *name;
    size_t offset;
    double low, high;
};

#define COLUMN(name_, member, low_, high_)                                                         \
    {                                                                                              \
        .name = (name_), .offset = FIELD_AT(double, struct recorded_state, member), .low = (low_), \
        .high = (high_)                                                                            \
    }

enum { MOVING = 4, BOX = 3 };

/* Frames have times to 1e10 s; microseconds since 1970 are beyond that. */
#define MOST_MS 1e13

static const struct column moving_columns[MOVING] = {
    COLUMN("x", x_m, -1e9, 1e9),
    COLUMN("y", y_m, -1e9, 1e9),
    COLUMN("vx", vx_mps, -1e4, 1e4),
    COLUMN("vy", vy_mps, -1e4, 1e4),
};

static const struct column box_columns[BOX] = {
    COLUMN("psi_rad", yaw_rad, -1e3, 1e3),
    COLUMN("length", length_m, 0, 1e6),
    COLUMN("width", width_m, 0, 1e6),
};

/* Indices of the columns in the table that is read. */
struct layout {
    size_t id, class, time;
    size_t moving[MOVING];
    size_t box[BOX];
    bool has_box;
};

static int find_columns(const struct csv_table *table, const struct column *columns, size_t count,
                        size_t *found, struct diag *diag)
{
    for (size_t i = 0; i < count; i++)
        if (csv_table_column(table, columns[i].name, &found[i], diag) != 0)
            return -1;
    return 0;
}

static bool has_any_box_column(const struct csv_table *table)
{
    for (size_t i = 0; i < table->columns; i++)
        for (size_t j = 0; j < BOX; j++)
            if (strcmp(table->header[i], box_columns[j].name) == 0)
                return true;
    return false;
}

static int find_layout(const struct csv_table *table, struct layout *layout, struct diag *diag)
{
    layout->has_box = has_any_box_column(table);
    if (csv_table_column(table, "track_id", &layout->id, diag) != 0 ||
        csv_table_column(table, "timestamp_ms", &layout->time, diag) != 0 ||
        csv_table_column(table, "agent_type", &layout->class, diag) != 0 ||
        find_columns(table, moving_columns, MOVING, layout->moving, diag) != 0)
        return -1;
    return layout->has_box ? find_columns(table, box_columns, BOX, layout->box, diag) : 0;
}

static int read_numbers(const struct csv_table *table, size_t row, const struct column *columns,
                        const size_t *found, size_t count, struct recorded_state *state,
                        struct diag *diag)
{
    for (size_t i = 0; i < count; i++) {
        double value;
        if (csv_table_number(table, row, found[i], columns[i].low, columns[i].high, &value, diag) !=
            0)
            return -1;
        memcpy((char *)state + columns[i].offset, &value, sizeof value);
    }
    return 0;
}

static int read_time(const struct csv_table *table, size_t row, size_t column, int64_t *time_ms,
                     struct diag *diag)
{
    double value;
    if (csv_table_number(table, row, column, -MOST_MS, MOST_MS, &value, diag) != 0)
        return -1;
    if (value != floor(value))
        return diag_fail(diag, DIAG_DATA, "row %zu, column \"%s\": %s is not a whole number",
                         table->numbers[row], table->header[column],
                         csv_table_cell(table, row, column));
    *time_ms = (int64_t)value;
    return 0;
}

/* Reads a name, which must be ASCII: names go into frames, which are UTF-8, and a CSV file does not
 * say how it is encoded. */
static int read_name(const struct csv_table *table, size_t row, size_t column, const char **name,
                     struct diag *diag)
{
    const char *text = csv_table_cell(table, row, column);
    size_t length = strlen(text);
    bool good = length > 0 && length <= FIELD_NAME_SIZE;
    for (size_t i = 0; i < length && good; i++)
        good = text[i] >= ' ' && text[i] <= '~';
    if (!good)
        return diag_fail(
            diag, DIAG_DATA,
            "row %zu, column \"%s\": \"%.80s\"; expected 1 to %d printable ASCII characters",
            table->numbers[row], table->header[column], text, FIELD_NAME_SIZE);
    *name = text;
    return 0;
}

static bool box_is_empty(const struct csv_table *table, size_t row, const struct layout *layout)
{
    for (size_t i = 0; i < BOX; i++)
        if (csv_table_cell(table, row, layout->box[i])[0] != '\0')
            return false;
    return true;
}

static int read_state(const struct csv_table *table, size_t row, const struct layout *layout,
                      struct recorded_state *state, struct diag *diag)
{
    state->row = table->numbers[row];
    if (read_name(table, row, layout->id, &state->id, diag) != 0 ||
        read_name(table, row, layout->class, &state->class, diag) != 0 ||
        read_time(table, row, layout->time, &state->time_ms, diag) != 0 ||
        read_numbers(table, row, moving_columns, layout->moving, MOVING, state, diag) != 0)
        return -1;
    if (strcmp(state->class, "pedestrian/bicycle") == 0)
        state->class = "pedestrian";
    if (layout->has_box && !box_is_empty(table, row, layout)) {
        if (read_numbers(table, row, box_columns, layout->box, BOX, state, diag) != 0)
            return -1;
        state->yaw_rad = units_wrap_rad(state->yaw_rad);
    } else if (state->vx_mps != 0 || state->vy_mps != 0) {
        state->yaw_rad = elementary_atan2(state->vy_mps, state->vx_mps);
    }
    return 0;
}

static int compare_tracks(const void *a, const void *b)
{
    const struct recorded_state *one = a, *other = b;
    int order = strcmp(one->id, other->id);
    if (order == 0)
        order = (one->time_ms > other->time_ms) - (one->time_ms < other->time_ms);
    return order != 0 ? order : (one->row > other->row) - (one->row < other->row);
}

static int compare_instants(const void *a, const void *b)
{
    const struct recorded_state *one = a, *other = b;
    int order = (one->time_ms > other->time_ms) - (one->time_ms < other->time_ms);
    return order != 0 ? order : strcmp(one->id, other->id);
}

static int refuse_repeated_states(const struct recorded_state *states, size_t count,
                                  struct diag *diag)
{
    for (size_t i = 1; i < count; i++)
        if (states[i].time_ms == states[i - 1].time_ms &&
            strcmp(states[i].id, states[i - 1].id) == 0)
            return diag_fail(diag, DIAG_DATA, "row %zu: track %s at %lld ms is in row %zu already",
                             states[i].row, states[i].id, (long long)states[i].time_ms,
                             states[i - 1].row);
    return 0;
}

static double yaw_rate_between(const struct recorded_state *from, const struct recorded_state *to)
{
    double turn_rad = units_wrap_rad(to->yaw_rad - from->yaw_rad);
    return turn_rad / (1e-3 * (double)(to->time_ms - from->time_ms));
}

/* The sum is compensated (Neumaier), because a track may have very many very short steps. */
static void follow_track(struct recorded_state *track, size_t count)
{
    double sum_m = 0, rest_m = 0;
    for (size_t i = 1; i < count; i++) {
        struct vec2 way_m = {track[i].x_m - track[i - 1].x_m, track[i].y_m - track[i - 1].y_m};
        double step_m = vec2_length(way_m), next_m = sum_m + step_m;
        rest_m += sum_m >= step_m ? (sum_m - next_m) + step_m : (step_m - next_m) + sum_m;
        sum_m = next_m;
        track[i].travelled_m = sum_m + rest_m;
        track[i - 1].yaw_rate_radps = yaw_rate_between(&track[i - 1], &track[i]);
    }
    if (count > 1)
        track[count - 1].yaw_rate_radps = track[count - 2].yaw_rate_radps;
}

/* Completes the states track by track; they are sorted by id, then time. */
static void follow_tracks(struct recorded_state *states, size_t count, struct arena *arena,
                          struct trajectories *trajectories)
{
    LIST_OF(const char *) ids = {0};
    for (size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && strcmp(states[end].id, states[begin].id) == 0;)
            end++;
        follow_track(states + begin, end - begin);
        *list_add(&ids, arena) = states[begin].id;
    }
    trajectories->ids = ids.items;
    trajectories->id_count = ids.count;
}

/* Divides the states into steps; they are sorted by time, then id. */
static void divide_steps(const struct recorded_state *states, size_t count, struct arena *arena,
                         struct trajectories *trajectories)
{
    LIST_OF(struct recorded_step) steps = {0};
    for (size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && states[end].time_ms == states[begin].time_ms;)
            end++;
        struct recorded_step *step = list_add(&steps, arena);
        *step = (struct recorded_step){
            .time_ms = states[begin].time_ms, .states = states + begin, .count = end - begin};
        if (steps.count > 1)
            step->interval_ms = step->time_ms - (step - 1)->time_ms;
    }
    if (steps.count > 1)
        steps.items[0].interval_ms = steps.items[1].interval_ms;
    trajectories->steps = steps.items;
    trajectories->step_count = steps.count;
}

int trajectory_read(const char *path, struct arena *arena, struct trajectories *trajectories,
                    struct diag *diag)
{
    *trajectories = (struct trajectories){0};
    struct csv_table table;
    struct layout layout;
    if (csv_table_read(path, &table, arena, diag) != 0 || find_layout(&table, &layout, diag) != 0)
        return -1;
    struct recorded_state *states = arena_get(arena, table.rows * sizeof *states);
    for (size_t row = 0; row < table.rows; row++)
        if (read_state(&table, row, &layout, &states[row], diag) != 0)
            return -1;
    sort_items(states, table.rows, sizeof *states, compare_tracks, arena);
    if (refuse_repeated_states(states, table.rows, diag) != 0)
        return -1;
    follow_tracks(states, table.rows, arena, trajectories);
    sort_items(states, table.rows, sizeof *states, compare_instants, arena);
    divide_steps(states, table.rows, arena, trajectories);
    return 0;
}

static int compare_names(const void *key, const void *item)
{
    return strcmp(key, *(const char *const *)item);
}

bool trajectory_has(const struct trajectories *trajectories, const char *id)
{
    return trajectories->id_count > 0 && bsearch(id, trajectories->ids, trajectories->id_count,
                                                 sizeof *trajectories->ids, compare_names) != NULL;
}
