/* Rows of a recording: readers, and rows kept in memory.
 *
 * A reader gives a recording row by row, as it stands in the file; recorded_steps.h makes steps of
 * the rows: it maps classes, finds centres, velocities and yaw rates. A new format is a file beside
 * this one that fills a struct recorded_format. A new layout of CSV tables is a row of
 * recorded_layouts.c. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"

struct input;

/* A road user at one instant. NAN stands for what the source does not say. Names are valid until
 * the reader is called again. */
struct recorded_row {
    int64_t time_ns;
    const char *id;
    const char *class;     /* the format's own word, of its vocabulary or not */
    const char *likely;    /* the word to take if the class is unknown; NULL */
    double x_m, y_m;       /* y counter-clockwise of x; any size, UTM too */
    double ahead;          /* how many lengths the place lies ahead of the box's centre */
    double yaw_rad;        /* NAN: along the velocity */
    double direction_rad;  /* which is the yaw at rest; NAN: that of the step before */
    double vx_mps, vy_mps; /* of the centre over ground; NAN: from the places */
    double yaw_rate_radps; /* NAN: from the yaws */
    double speed_mps;      /* along the yaw, for the step in which the places tell no velocity */
    double length_m, width_m, height_m; /* 0: that of the word, or of the class */
    size_t place;                       /* row, line or byte in the file, for messages */
    bool passenger; /* left out at the place of the vehicle in the row before, which hides it */
};

/* A row without any value: NAN, NULL and 0. */
extern const struct recorded_row recorded_row_unsaid;

/* What a call of a reader gives; -1 after a message. */
enum recorded_event {
    RECORDED_END,
    RECORDED_ROW,
    RECORDED_STEP, /* the step of row.time_ns is whole; it may have no rows */
};

/* A word of a format's vocabulary, the class of data/vehicles/ that it stands for, and the sizes
 * that the format gives to bodies of this class that have none of their own; 0: our class's. */
struct recorded_word {
    const char *word, *class;
    double length_m, width_m, height_m;
};

/* A row of recorded_classes.def in such a vocabulary. */
#define RECORDED_WORD(word, class) {word, class, 0, 0, 0},

struct recorded_format {
    const char *name;    /* "a table of INTERACTION" */
    const char *id_name; /* what the format calls an id, for messages: "track_id" */
    const char *place;   /* what recorded_row.place counts: "row", "byte" */
    double slow_mps;     /* a velocity below it says no yaw, as one of 0 */
    bool by_time;        /* rows come in ascending time; if not, the recording is stored whole */
    /* Of SUMO: sizes are those of types (sumo_types.h), vehicles may jump to another lane or angle
     * (recorded_jumps.c), and ways are held against speeds, because places may be in degrees. */
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

/* Refuses an id or class that is empty, longer than FIELD_NAME_SIZE or not printable ASCII: names
 * go into frames, which are UTF-8, and tables do not say how they are encoded. */
bool recorded_row_name_fits(const char *name);

/* ---- readers ---- */

/* Opens a CSV table of any layout (recorded_layouts.h): reads the header, and takes over the input.
 * path is that of the table, beside which other files of its recording may lie. The reader's format
 * is NULL after a message. */
struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag);

/* Read the formats of others, and take over the input. They need expat and protobuf-c, so they are
 * no part of libglint.a; stages that need the library, too, are linked with them. Velocities of an
 * OSI trace are those of rear axles if rear_axle is set. *host becomes the id of the host vehicle
 * that the first message names, or NULL, and format is NULL after a message. */
struct recorded_reader recorded_sumo_open(struct input *input, struct arena *arena);
struct recorded_reader recorded_commonroad_open(struct input *input, struct arena *arena);
struct recorded_reader recorded_osi_open(struct input *input, bool rear_axle, const char **host,
                                         struct arena *arena, struct diag *diag);

/* Reads all rows of a reader into memory and closes it. The new reader gives them in the order of
 * time and marks steps; its format is NULL after a message. It takes 64 bytes a row, and some
 * hundred for each step, track and size of a body. A yaw rate is kept to 24 bits, a speed not at
 * all. */
struct recorded_reader recorded_row_store(struct recorded_reader reader, struct arena *arena,
                                          struct diag *diag);
