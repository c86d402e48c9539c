#include "recorded/recorded_memory.h"

#include <math.h>

#include "base/sort.h"

/* Values that many rows share, interned by their bytes. */
struct body {
    double length_m, width_m, height_m, ahead, direction_rad;
    uint32_t id, class; /* names */
};

static struct recorded_stamp *stamp_of(struct recorded_memory *memory, int64_t time_ns)
{
    uint32_t number = intern_number(&memory->times, &time_ns, sizeof time_ns, memory->arena);
    if (number == memory->stamps.count)
        *list_add(&memory->stamps, memory->arena) =
            (struct recorded_stamp){time_ns, RECORDED_NONE, 0};
    return &memory->stamps.items[number];
}

void recorded_memory_add(struct recorded_memory *memory, const struct recorded_row *row)
{
    struct arena *arena = memory->arena;
    if (memory->rows % RECORDED_MEMORY_CHUNK == 0)
        *list_add(&memory->chunks, arena) =
            arena_get(arena, RECORDED_MEMORY_CHUNK * sizeof(struct recorded_memory_row));
    uint32_t number = memory->rows++;
    struct recorded_stamp *stamp = stamp_of(memory, row->time_ns);
    bool vector = !isnan(row->vy_mps);
    struct body body = {row->length_m,
                        row->width_m,
                        row->height_m,
                        row->ahead,
                        row->direction_rad,
                        intern_word(&memory->names, row->id, arena),
                        intern_word(&memory->names, row->class, arena)};
    *recorded_memory_row(memory, number) = (struct recorded_memory_row){
        {row->x_m, row->y_m, row->yaw_rad, vector ? row->vx_mps : row->speed_mps, row->vy_mps},
        (float)row->yaw_rate_radps,
        intern_number(&memory->bodies, &body, sizeof body, arena),
        (uint32_t)row->place,
        stamp->first,
    };
    stamp->first = number;
}

static struct body body_of(const struct recorded_memory *memory,
                           const struct recorded_memory_row *row)
{
    struct body body;
    memcpy(&body, intern_text(&memory->bodies, row->body), sizeof body);
    return body;
}

void recorded_memory_get(const struct recorded_memory *memory, uint32_t number,
                         struct recorded_row *row)
{
    const struct recorded_memory_row *stored = recorded_memory_row(memory, number);
    struct body body = body_of(memory, stored);
    *row = recorded_row_unsaid;
    row->id = intern_text(&memory->names, body.id);
    row->class = intern_text(&memory->names, body.class);
    row->x_m = stored->values[RECORDED_X_M];
    row->y_m = stored->values[RECORDED_Y_M];
    row->yaw_rad = stored->values[RECORDED_YAW_RAD];
    row->vy_mps = stored->values[RECORDED_VY_MPS];
    if (isnan(row->vy_mps))
        row->speed_mps = stored->values[RECORDED_VX_MPS];
    else
        row->vx_mps = stored->values[RECORDED_VX_MPS];
    row->yaw_rate_radps = (double)stored->yaw_rate_radps;
    row->ahead = body.ahead;
    row->direction_rad = body.direction_rad;
    row->length_m = body.length_m;
    row->width_m = body.width_m;
    row->height_m = body.height_m;
    row->place = stored->place;
    row->time_ns = recorded_memory_time_ns(memory, number);
}

struct recorded_track *recorded_memory_track(const struct recorded_memory *memory, uint32_t row)
{
    const char *body = intern_text(&memory->bodies, recorded_memory_row(memory, row)->body);
    uint32_t name;
    memcpy(&name, body + offsetof(struct body, id), sizeof name);
    return &memory->tracks[name];
}

static int compare_times(const void *a, const void *b)
{
    const struct recorded_stamp *one = a, *other = b;
    return (one->time_ns > other->time_ns) - (one->time_ns < other->time_ns);
}

void recorded_memory_sort(struct recorded_memory *memory)
{
    size_t count = memory->names.list.count;
    sort_list(&memory->stamps, compare_times, memory->arena);
    memory->stamp_at = arena_room(memory->arena, memory->rows * sizeof *memory->stamp_at);
    memory->tracks = arena_room(memory->arena, count * sizeof *memory->tracks);
    for (size_t i = 0; i < count; i++)
        memory->tracks[i] =
            (struct recorded_track){RECORDED_NONE, RECORDED_NONE, RECORDED_NONE, RECORDED_NONE, 0};
    for (uint32_t i = 0; i < memory->stamps.count; i++) {
        for (uint32_t row = memory->stamps.items[i].first; row != RECORDED_NONE;
             row = recorded_memory_next(memory, row)) {
            struct recorded_track *track = recorded_memory_track(memory, row);
            memory->stamp_at[row] = i;
            if (track->last == RECORDED_NONE)
                *list_add(&memory->order, memory->arena) = (uint32_t)(track - memory->tracks);
            track->last = row;
        }
    }
}

void recorded_memory_link_by_track(struct recorded_memory *memory)
{
    for (size_t i = 0; i < memory->order.count; i++)
        memory->tracks[memory->order.items[i]].first = RECORDED_NONE;
    for (size_t i = 0; i < memory->stamps.count; i++) {
        for (uint32_t row = memory->stamps.items[i].first, next; row != RECORDED_NONE; row = next) {
            struct recorded_track *track = recorded_memory_track(memory, row);
            next = recorded_memory_next(memory, row);
            recorded_memory_row(memory, row)->next = RECORDED_NONE;
            if (track->first == RECORDED_NONE)
                track->first = row;
            else
                recorded_memory_row(memory, track->last)->next = row;
            track->last = row;
        }
    }
}

void recorded_memory_link_by_stamp(struct recorded_memory *memory)
{
    for (size_t i = 0; i < memory->stamps.count; i++)
        memory->stamps.items[i].first = RECORDED_NONE;
    for (size_t i = memory->order.count; i > 0; i--) {
        uint32_t row = memory->tracks[memory->order.items[i - 1]].first, next;
        for (; row != RECORDED_NONE; row = next) {
            struct recorded_stamp *stamp = &memory->stamps.items[memory->stamp_at[row]];
            next = recorded_memory_next(memory, row);
            recorded_memory_row(memory, row)->next = stamp->first;
            stamp->first = row;
        }
    }
}
