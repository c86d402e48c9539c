/* Rows of a recording, packed into 64 bytes each.
 *
 * Rows have numbers in the order in which they come, stamps in the order of time. A row is linked
 * to others: to those of its stamp, or to the next one of its road user, at the same time or later.
 * A row takes 64 bytes with its links; a stamp, a track and a size of a body some hundred each. Yaw
 * rates are kept to 24 bits, speeds only of rows without velocities. */
#pragma once

#include "base/intern.h"
#include "recorded/recorded_row.h"

enum { RECORDED_MEMORY_CHUNK = 4096 };
#define RECORDED_NONE UINT32_MAX /* no number */

enum recorded_memory_value {
    RECORDED_X_M,
    RECORDED_Y_M,
    RECORDED_YAW_RAD,
    RECORDED_VX_MPS, /* the speed, where the next one is NAN */
    RECORDED_VY_MPS,
    RECORDED_VALUES
};

struct recorded_memory_row {
    double values[RECORDED_VALUES];
    float yaw_rate_radps;
    uint32_t body;
    uint32_t place; /* rows that are the same up to this member are one row that stands twice */
    uint32_t next;  /* the row that this one is linked to; RECORDED_NONE */
};

_Static_assert(sizeof(struct recorded_memory_row) <= 56, "with stamp and lists a row has 64 bytes");

struct recorded_stamp {
    int64_t time_ns;
    uint32_t first; /* row, where rows are linked by stamp; RECORDED_NONE */
    uint32_t step;  /* for the user of the memory */
};

/* A road user. */
struct recorded_track {
    uint32_t first, last; /* rows, where rows are linked by track; RECORDED_NONE */
    uint32_t stamp, at;   /* for the user of the memory; RECORDED_NONE at first */
    uint64_t most_ns;     /* the same; 0 at first */
};

struct recorded_memory {
    struct arena *arena; /* set by the caller */
    LIST_OF(struct recorded_memory_row *) chunks;
    uint32_t rows;
    struct intern names, bodies, times;
    LIST_OF(struct recorded_stamp) stamps;
    uint32_t *stamp_at;            /* number of the stamp, by that of the row */
    struct recorded_track *tracks; /* by the number of the id's name */
    LIST_OF(uint32_t) order;       /* numbers of the tracks by their first stamps */
};

void recorded_memory_add(struct recorded_memory *memory, const struct recorded_row *row);

/* After the last row: sorts the stamps and makes the tracks. Rows are linked by stamp. */
void recorded_memory_sort(struct recorded_memory *memory);

/* Links rows by track that are linked by stamp, and the reverse. */
void recorded_memory_link_by_track(struct recorded_memory *memory);
void recorded_memory_link_by_stamp(struct recorded_memory *memory);

/* The row as its reader gave it; names are those of the memory. */
void recorded_memory_get(const struct recorded_memory *memory, uint32_t number,
                         struct recorded_row *row);

struct recorded_track *recorded_memory_track(const struct recorded_memory *memory, uint32_t number);

static inline struct recorded_memory_row *recorded_memory_row(const struct recorded_memory *memory,
                                                              uint32_t number)
{
    return &memory->chunks.items[number / RECORDED_MEMORY_CHUNK][number % RECORDED_MEMORY_CHUNK];
}

static inline int64_t recorded_memory_time_ns(const struct recorded_memory *memory, uint32_t number)
{
    return memory->stamps.items[memory->stamp_at[number]].time_ns;
}

/* The time from a row to a later one; recordings may be longer than an int64_t has nanoseconds. */
static inline uint64_t recorded_memory_between_ns(const struct recorded_memory *memory,
                                                  uint32_t from, uint32_t to)
{
    return (uint64_t)recorded_memory_time_ns(memory, to) -
           (uint64_t)recorded_memory_time_ns(memory, from);
}

static inline uint32_t recorded_memory_next(const struct recorded_memory *memory, uint32_t number)
{
    return recorded_memory_row(memory, number)->next;
}
