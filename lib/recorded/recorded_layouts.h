/* Columns of highD, inD, INTERACTION, NGSIM, SUMO and esmini tables.
 *
 * A layout lists the columns of a table. Their order, the case of their letters and other columns
 * do not matter. A table has the layout of which it has all needed columns. If it has those of
 * several, it has the one that needs the most, and the first of equals.
 *
 * Columns of one kind and one member are spellings of the same value, for instance in another unit.
 * A table has the value if it has one of them; the first one that it has is read. */
#pragma once

#include "recorded/recorded_row.h"

/* Cells of columns that are not needed may be empty. */
enum recorded_need {
    RECORDED_NEEDED,
    RECORDED_OPTIONAL,
    RECORDED_TOGETHER, /* all of these columns or none */
};

/* A column of text (a name: an id or a class; or words of any bytes), of times, of frame numbers,
 * of a value that all rows share, or of numbers that become scale * (number + shift) in a member of
 * struct recorded_row. */
struct recorded_column {
    const char *name; /* NULL after the last */
    enum {
        RECORDED_NAME,
        RECORDED_WORDS,
        RECORDED_TIME,
        RECORDED_FRAMES,
        RECORDED_ALIKE,
        RECORDED_NUMBER
    } kind;
    enum recorded_need need;
    size_t offset;       /* of the member, in struct recorded_cells */
    double low, high;    /* of a number in the file */
    double scale, shift; /* scale of a time: its unit in s; below 1 s times are whole */
};

/* One kind of road user in a table. Its first columns are spellings of the id. A row is of the
 * first kind whose id it has; its class is that of the kind unless a column gives another. All
 * kinds but the first may be passengers. */
struct recorded_kind {
    const struct recorded_column *columns;
    const char *class;
    double ahead; /* recorded_row.ahead */
};

/* The values of a row, and two numbers for the layout's function complete. */
struct recorded_cells {
    struct recorded_row row;
    double aside[2];
};

enum { RECORDED_KINDS = 3, RECORDED_COLUMNS = 24, RECORDED_ABSENT = -1 };

struct recorded_layout {
    struct recorded_format format;              /* place, next and close are those of all tables */
    struct recorded_kind kinds[RECORDED_KINDS]; /* columns NULL: no more */
    /* Names of columns in the file NN_tracksMeta.csv beside the table; id NULL: there is no file.
     * Values of direction are 1 against x and 2 along x; NULL: there is no such column. */
    struct {
        const char *id, *direction;
    } beside;
    /* A row has columns for every road user: "#1 NAME", "#2 NAME", and so on; columns of times have
     * plain names. A road user without an id in a row is not there. */
    bool wide;
    void (*complete)(struct recorded_cells *cells); /* computes the other values, or NULL */
};

/* A kind of road user that a table has; in a wide table one road user. */
struct recorded_part {
    const struct recorded_kind *kind;
    const char *user;         /* "#1" or "#2" or ... in a wide table, else NULL */
    int id;                   /* the place of its id; RECORDED_ABSENT */
    int at[RECORDED_COLUMNS]; /* the places of its columns; RECORDED_ABSENT: not read */
};

/* What a table has of a layout: parts, and how many needed values these have and lack. */
struct recorded_fit {
    const struct recorded_layout *layout;
    LIST_OF(struct recorded_part) parts;
    size_t found, lacking;
};

struct csv_table;

/* Finds the layout of whose needed values a table with these names of columns has the largest
 * share; of two with the same share that with more values. If the table lacks any of them it is
 * refused (DIAG_DATA): the message names the layout, what is lacking, and the header. */
int recorded_layouts_find(const struct csv_table *names, struct recorded_fit *fit,
                          struct arena *arena, struct diag *diag);

/* The columns of NGSIM's files that have no header. */
extern const char *const recorded_layouts_ngsim_names[];
