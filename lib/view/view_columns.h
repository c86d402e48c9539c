/* The columns of the page of glint-view, filled and written.
 *
 * A column has real numbers in single precision, or whole numbers. Those of names count in the
 * table of names, from 0. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"

#define COLUMN(name, key, kind) COLUMN_##name,
enum view_column {
#include "view/view_columns.def"
    COLUMN_COUNT
};

/* Empty with an arena, from which all memory comes. */
struct view_columns {
    struct arena *arena;
    struct intern names;
    LIST_OF(uint32_t) list[COLUMN_COUNT]; /* real numbers as their bits in single precision */
};

void view_columns_real(struct view_columns *columns, enum view_column column, double value);
void view_columns_count(struct view_columns *columns, enum view_column column, uint32_t value);

/* The number of a name; of an optional one that plus 1, and 0 for NULL. */
uint32_t view_columns_name(struct view_columns *columns, const char *word);
uint32_t view_columns_optional_name(struct view_columns *columns, const char *word);

/* The number of the object of an echo; that of clutter and false alarms is no object's. */
uint32_t view_columns_object(struct view_columns *columns, const struct echo_id *echo);

/* The place of a column in the text of view_columns_write. */
struct view_column_place {
    const char *name;
    const char *type; /* "f4", "u1", "u2" or "u4": kind and bytes of its numbers */
    int64_t count;    /* how many numbers it has */
    int64_t begin;    /* index of its first character */
};

/* Fills in the places of all COLUMN_COUNT columns. Whole numbers take as few bytes as the largest
 * of the column allows. */
void view_columns_places(const struct view_columns *columns, struct view_column_place *places);

/* Writes all columns in base64, each beginning at a multiple of 16 characters. */
void view_columns_write(const struct view_columns *columns, struct text *text);
