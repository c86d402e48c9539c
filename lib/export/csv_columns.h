/* Members of structs as columns of CSV tables.
 *
 * Every member of a field table that is one value is a column of its name: numbers, flags, names,
 * choices, seeds and sets, whose words stand in one cell with blanks between them. The members of
 * an embedded struct are columns as well, with its name before theirs (margins_sight_m). Lists and
 * raw members are no columns. A cell is empty where a line of JSON would lack the member
 * (record_write.h), unless zeros says otherwise; a flag is always true or false, and a choice that
 * may be absent has its word. Numbers are the shortest that read back to the same double. */
#pragma once

#include "base/text.h"
#include "text/field.h"

struct csv_column {
    const char *name;
    const struct field *field;
    const struct record *record; /* whose field it is */
    size_t offset;               /* of that record in the struct of the row */
    const struct field
        *embedded; /* the member that it is of that struct; NULL: the struct itself */
};

/* All zero before the first member. */
struct csv_columns {
    LIST_OF(struct csv_column) list;
    bool zeros; /* numbers that a line of JSON would lack are written as 0 */
};

/* Appends the columns of a record, but those of the names in without, which ends with NULL. */
void csv_columns_add(struct csv_columns *columns, const struct record *record,
                     const char *const *without, struct arena *arena);

/* The value of column i of the struct at base, which may be NULL: returns the struct that the
 * column's field is a member of, itself or one embedded in it, or NULL if there is no value.
 * Columns are asked for in order, with the same `there`, which keeps for the columns of an embedded
 * struct whether it is present. */
const void *csv_columns_owner(const struct csv_columns *columns, size_t i, const void *base,
                              bool *there);

/* Appends the text of a cell: of this member of the struct at base. */
void csv_columns_add_cell(const struct field *field, const void *base, struct text *row);

/* Appends to a row the names of the columns, or the cells of a struct, which are empty where it is
 * NULL; behind each stands a comma, which csv_columns_end_row turns into the end of the row. */
void csv_columns_write_names(const struct csv_columns *columns, struct text *row);
void csv_columns_write(const struct csv_columns *columns, const void *base, struct text *row);
void csv_columns_end_row(struct text *row);
