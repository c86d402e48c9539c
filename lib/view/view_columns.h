/* Columns of numbers, packed for the page of glint-view. Real numbers are written in single
 * precision, whole numbers as narrowly as the largest of the column allows. view_data.h says what
 * the columns hold. */
#pragma once

#include "base/text.h"
#include "text/field.h"

#define COLUMN(name, key, kind) COLUMN_##name,
enum view_column {
#include "view/view_columns.def"
    COLUMN_COUNT
};

struct view_columns {
    LIST_OF(uint32_t) list[COLUMN_COUNT]; /* real numbers as their bits in single precision */
};

/* Appends a number to a column of its kind. */
void view_columns_add_real(struct view_columns *columns, enum view_column column, double value,
                           struct arena *arena);
void view_columns_add_count(struct view_columns *columns, enum view_column column, uint32_t value,
                            struct arena *arena);

/* The place of a column in the text of view_columns_write. */
struct view_column_place {
    const char *name;
    const char *type; /* "f4", "u1", "u2" or "u4": kind and bytes of its numbers */
    int64_t count;    /* how many numbers it has */
    int64_t begin;    /* index of its first character */
};

extern const struct record view_column_place_record;

/* Fills in the places of all COLUMN_COUNT columns. */
void view_columns_places(const struct view_columns *columns, struct view_column_place *places);

/* Writes all columns in base64, each beginning at a multiple of 16 characters. */
void view_columns_write(const struct view_columns *columns, struct text *text);
