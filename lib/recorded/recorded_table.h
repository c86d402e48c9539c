/* CSV tables of recorded traffic, of every layout.
 *
 * A layout is a file beside this one, which says what the columns are; their order, the case of
 * their letters and other columns do not matter. The first layout whose mark is among the columns
 * is taken, the last one where none is. */
#pragma once

#include "recorded/recorded_beside.h"
#include "recorded/recorded_row.h"
#include "text/csv_table.h"

/* Cells of columns that are not needed may be empty. */
enum recorded_need {
    RECORDED_NEEDED,
    RECORDED_OPTIONAL,
    RECORDED_TOGETHER, /* all of these columns or none */
};

/* A column of text (an id or a class), of times, of frames, of what all rows have alike, or of
 * numbers that become scale * (number + shift) in a member of struct recorded_row. */
struct recorded_column {
    const char *name; /* NULL after the last */
    enum { RECORDED_TEXT, RECORDED_TIME, RECORDED_FRAMES, RECORDED_ALIKE, RECORDED_NUMBER } kind;
    enum recorded_need need; /* of several columns of times, one is needed */
    size_t offset;           /* of the member, in struct recorded_cells */
    double low, high;        /* of a number in the file */
    double scale, shift;     /* of a time: seconds for 1, which is whole unless it is a second */
};

#define RECORDED_COLUMN(name, kind, need, member, low, high, scale, shift)                         \
    {                                                                                              \
        name, kind, need, offsetof(struct recorded_cells, member), low, high, scale, shift         \
    }
#define RECORDED_ID(name) RECORDED_COLUMN(name, RECORDED_TEXT, RECORDED_NEEDED, row.id, 0, 0, 0, 0)
#define RECORDED_CLASS(name, need) RECORDED_COLUMN(name, RECORDED_TEXT, need, row.class, 0, 0, 0, 0)
#define RECORDED_RECORDING(name)                                                                   \
    RECORDED_COLUMN(name, RECORDED_ALIKE, RECORDED_OPTIONAL, row.id, 0, 0, 0, 0)
#define RECORDED_TIME_IN(name, unit_s)                                                             \
    RECORDED_COLUMN(name, RECORDED_TIME, RECORDED_OPTIONAL, row.time_ns, 0, 0, unit_s, 0)
#define RECORDED_FRAME(name)                                                                       \
    RECORDED_COLUMN(name, RECORDED_FRAMES, RECORDED_NEEDED, row.time_ns, 0, 1e9, 1, 0)
#define RECORDED_VALUE(name, member, need, low, high, scale, shift)                                \
    RECORDED_COLUMN(name, RECORDED_NUMBER, need, row.member, low, high, scale, shift)
#define RECORDED_ASIDE(name, index, low, high)                                                     \
    RECORDED_COLUMN(name, RECORDED_NUMBER, RECORDED_NEEDED, aside[index], low, high, 1, 0)

/* One kind of road user in a table. Its first column is the id; a row is of the first kind whose id
 * it has, and has the kind's class if no column says another. All kinds but the first may ride. */
struct recorded_kind {
    const struct recorded_column *columns;
    const char *class;
    double ahead; /* recorded_row.ahead */
};

/* What a row says, with members for the layout's function alone. */
struct recorded_cells {
    struct recorded_row row;
    double aside[2];
};

enum { RECORDED_KINDS = 3, RECORDED_COLUMNS = 16 };

struct recorded_layout {
    struct recorded_format format;              /* next and close are those of all tables */
    const char *mark;                           /* name of a column that no other layout has */
    struct recorded_kind kinds[RECORDED_KINDS]; /* columns NULL: no more */
    struct recorded_beside_columns beside;      /* id NULL: there are no files beside it */
    /* A row has columns for everybody: "#1 NAME" for one, "#2 NAME" for another, and so on. Columns
     * of times have their plain names. Who has no id in a row is not there. */
    bool wide;
    void (*complete)(struct recorded_cells *cells); /* NULL: its columns say it all */
};

extern const struct recorded_layout esmini_table_layout, highd_table_layout, ind_table_layout,
    interaction_table_layout, ngsim_table_layout, sumo_table_layout, sumo_table_plain_layout;

/* The columns of NGSIM's files that have no header. */
extern const char *const ngsim_table_names[];

/* Reads the header, and takes over the input. path is that of the table, beside which other files
 * of its recording may lie. The reader's format is NULL after a message. */
struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag);

/* What the formats of all tables have: next and close take their struct recorded_table. */
#define RECORDED_TABLE .place = "row", .next = recorded_table_next, .close = recorded_table_close
int recorded_table_next(void *table, struct recorded_row *row, struct diag *diag);
void recorded_table_close(void *table);
