/* Rows of a recording, and their readers.
 *
 * A reader gives the rows of a file one by one; recorded_steps.h makes steps of them, with classes,
 * centres, velocities and yaw rates. A new format is a file that fills a struct
 * recorded_format: of this folder, or of a plug-in. A new layout of CSV tables is a row of
 * recorded_layouts.c. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"

struct input;

/* A road user at one instant. NAN means that the source does not give the value. Names are valid
 * until the reader is called again. */
struct recorded_row {
    int64_t time_ns;
    const char *id;
    const char *class;     /* a word of the format, known or not */
    const char *likely;    /* the word to take if the class is unknown; NULL: none */
    const char *lane;      /* on which SUMO has the vehicle; NULL: not said */
    const char *untold;    /* of a class that the source does not tell: what it lacks; NULL */
    double x_m, y_m;       /* y is to the left of x; of any size, UTM too */
    double ahead;          /* distance of the place ahead of the box's centre, in lengths */
    double yaw_rad;        /* NAN: along the velocity */
    double direction_rad;  /* yaw at rest; NAN: that of the step before */
    double vx_mps, vy_mps; /* of the centre over ground; NAN: from the places */
    double yaw_rate_radps; /* NAN: from the yaws */
    double speed_mps;      /* along the yaw; stated instead of vx_mps and vy_mps */
    double z_m;            /* height of the road below the body */
    double pitch_rad;      /* of that road along the yaw, positive upward; 0 too: not known */
    double length_m, width_m, height_m; /* 0: that of the word, or of the class */
    size_t place;                       /* row, line or byte in the file, for messages */
    bool passenger;                     /* left out at the place of the vehicle in the row before */
    bool stands;                        /* a thing, of which any part may be on a road */
};

/* A row without any value: NAN, NULL and 0. */
extern const struct recorded_row recorded_row_unsaid;

/* The result of a reader's call; -1 after a message. */
enum recorded_event {
    RECORDED_END,
    RECORDED_ROW,
    RECORDED_STEP, /* the step of row.time_ns is whole; it may have no rows */
};

/* A word of a format, the class of data/vehicles/ that it means, and the sizes of bodies that have
 * none of their own; 0: those of our class. */
struct recorded_word {
    const char *word, *class;
    double length_m, width_m, height_m;
};

/* A type of road users that a file tells beside the recording. */
struct recorded_type {
    struct recorded_word word; /* its class is another word of the format */
    const char *file;
    size_t line;
};

struct recorded_types {
    LIST_OF(struct recorded_type) list;
};

/* A row of recorded_classes.def as such a word. */
#define RECORDED_WORD(word, class) {word, class, 0, 0, 0},

struct recorded_format {
    const char *name;    /* "a table of INTERACTION" */
    const char *id_name; /* the format's word for an id, for messages: "track_id" */
    const char *place;   /* unit of recorded_row.place: "row", "byte" */
    double slow_mps;     /* no yaw follows from a slower velocity */
    bool by_time;        /* rows ascend in time; if not, all are stored, without their heights */
    /* SUMO's: sizes are those of types, and vehicles may jump to another lane or
     * angle (recorded_jumps.c). */
    bool of_sumo;
    bool marks_steps; /* gives RECORDED_STEP; if not, a step ends where the time changes */
    const struct recorded_word *words; /* ends with a word NULL */
    int (*next)(void *state, struct recorded_row *row, struct diag *diag);
    void (*close)(void *state); /* NULL: nothing to free */
};

struct recorded_reader {
    const struct recorded_format *format; /* NULL: none was opened */
    void *state;
};

/* A time in a file, in seconds times 1 / unit_s (1e-3 for milliseconds), as whole nanoseconds. */
int64_t recorded_row_time_ns(double time, double unit_s);

/* Nanoseconds as the nearest double in seconds. */
double recorded_row_seconds(int64_t time_ns);

/* False for an id or class that is empty, longer than FIELD_NAME_SIZE or not printable ASCII:
 * frames are UTF-8, and the encoding of a table is unknown. */
bool recorded_row_name_fits(const char *name);

/* The time of an instant, counted from begin_ns. A recording may last longer than an int64_t has
 * nanoseconds, but not longer than a uint64_t. */
int64_t recorded_row_instant_ns(int64_t begin_ns, int64_t number, double rate_hz);

/* Refuses two different rows of one road user at one time; returns -1. */
int recorded_row_refuse_second(const struct recorded_format *format, const char *id,
                               int64_t time_ns, size_t place, size_t other, struct diag *diag);

/* ---- readers ---- */

/* Opens a CSV table of any layout (recorded_layouts.h): reads the header, and takes over the input.
 * Other files of the recording may lie beside path. The reader's format is NULL after a message. */
struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag);
