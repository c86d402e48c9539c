#include "recorded/recorded_row.h"

#include <math.h>

#include "base/intern.h"
#include "base/sort.h"
#include "text/field.h"

const struct recorded_row recorded_row_unsaid = {.yaw_rad = (double)NAN,
                                                 .direction_rad = (double)NAN,
                                                 .vx_mps = (double)NAN,
                                                 .vy_mps = (double)NAN,
                                                 .yaw_rate_radps = (double)NAN,
                                                 .speed_mps = (double)NAN};

int64_t recorded_row_time_ns(double time, double unit_s)
{
    const double per_unit = unit_s * 1e9;
    double whole = floor(time);
    return (int64_t)whole * (int64_t)per_unit + (int64_t)round((time - whole) * per_unit);
}

/* Divides whole milliseconds, microseconds or nanoseconds, so that the numerator is exact. */
double recorded_row_seconds(int64_t time_ns)
{
    int64_t unit = time_ns % 1000000 == 0 ? 1000000 : time_ns % 1000 == 0 ? 1000 : 1;
    int64_t whole = time_ns / unit;
    return (double)whole / (1e9 / (double)unit);
}

bool recorded_row_name_fits(const char *name)
{
    size_t length = 0;
    for (; name[length] >= ' ' && name[length] <= '~'; length++)
        continue;
    return length > 0 && length <= FIELD_NAME_SIZE && name[length] == '\0';
}

/* ---- a recording in memory ---- */

enum { CHUNK = 4096 };

static const uint32_t NONE = UINT32_MAX;

struct stored_row {
    double values[5]; /* x_m, y_m, yaw_rad, vx_mps, vy_mps; or the speed and NAN for the last two */
    float yaw_rate_radps;
    uint32_t body, place;
    uint32_t next; /* of the same step; NONE */
};

_Static_assert(sizeof(struct stored_row) <= 60, "with what lists take a row has 64 bytes at most");

/* Values that many rows share, interned by their bytes. */
struct body {
    double length_m, width_m, height_m, ahead, direction_rad;
    uint32_t id, class; /* names */
};

struct stored_step {
    int64_t time_ns;
    uint32_t first; /* row; NONE */
};

struct store {
    struct recorded_format format;
    struct arena *arena;
    LIST_OF(struct stored_row *) chunks;
    uint32_t rows;
    struct intern names, bodies, times;
    LIST_OF(struct stored_step) steps;
    size_t step;  /* that is given out */
    uint32_t row; /* the last one of it that was given; NONE */
};

static struct stored_row *row_at(const struct store *store, uint32_t number)
{
    return &store->chunks.items[number / CHUNK][number % CHUNK];
}

static struct stored_step *step_of(struct store *store, int64_t time_ns)
{
    uint32_t number = intern_number(&store->times, &time_ns, sizeof time_ns, store->arena);
    if (number == store->steps.count)
        *list_add(&store->steps, store->arena) = (struct stored_step){time_ns, NONE};
    return &store->steps.items[number];
}

static void store_row(struct store *store, const struct recorded_row *row)
{
    struct arena *arena = store->arena;
    if (store->rows % CHUNK == 0)
        *list_add(&store->chunks, arena) = arena_get(arena, CHUNK * sizeof(struct stored_row));
    uint32_t number = store->rows++;
    bool vector = !isnan(row->vy_mps);
    struct stored_step *step = step_of(store, row->time_ns);
    struct body body = {row->length_m,
                        row->width_m,
                        row->height_m,
                        row->ahead,
                        row->direction_rad,
                        intern_word(&store->names, row->id, arena),
                        intern_word(&store->names, row->class, arena)};
    *row_at(store, number) = (struct stored_row){
        {row->x_m, row->y_m, row->yaw_rad, vector ? row->vx_mps : row->speed_mps, row->vy_mps},
        (float)row->yaw_rate_radps,
        intern_number(&store->bodies, &body, sizeof body, arena),
        (uint32_t)row->place,
        step->first,
    };
    step->first = number;
}

static void unpack(const struct store *store, const struct stored_row *stored,
                   struct recorded_row *row)
{
    struct body body;
    memcpy(&body, intern_text(&store->bodies, stored->body), sizeof body);
    *row = recorded_row_unsaid;
    row->id = intern_text(&store->names, body.id);
    row->class = intern_text(&store->names, body.class);
    row->x_m = stored->values[0];
    row->y_m = stored->values[1];
    row->yaw_rad = stored->values[2];
    row->vy_mps = stored->values[4];
    if (isnan(row->vy_mps))
        row->speed_mps = stored->values[3];
    else
        row->vx_mps = stored->values[3];
    row->yaw_rate_radps = (double)stored->yaw_rate_radps;
    row->ahead = body.ahead;
    row->direction_rad = body.direction_rad;
    row->length_m = body.length_m;
    row->width_m = body.width_m;
    row->height_m = body.height_m;
    row->place = stored->place;
}

static int next(void *state, struct recorded_row *row, struct diag *diag)
{
    (void)diag;
    struct store *store = state;
    if (store->step == store->steps.count)
        return RECORDED_END;
    const struct stored_step *step = &store->steps.items[store->step];
    store->row = store->row == NONE ? step->first : row_at(store, store->row)->next;
    if (store->row == NONE)
        store->step++;
    else
        unpack(store, row_at(store, store->row), row);
    row->time_ns = step->time_ns;
    return store->row == NONE ? RECORDED_STEP : RECORDED_ROW;
}

static int compare_times(const void *a, const void *b)
{
    const struct stored_step *one = a, *other = b;
    return (one->time_ns > other->time_ns) - (one->time_ns < other->time_ns);
}

struct recorded_reader recorded_row_store(struct recorded_reader reader, struct arena *arena,
                                          struct diag *diag)
{
    struct store *store = arena_get(arena, sizeof *store);
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
    if (event < 0)
        return (struct recorded_reader){0};
    sort_list(&store->steps, compare_times, arena);
    store->row = NONE;
    return (struct recorded_reader){&store->format, store};
}

void recorded_row_rewind(struct recorded_reader reader)
{
    struct store *store = reader.state;
    store->step = 0;
    store->row = NONE;
}
