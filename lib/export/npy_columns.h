/* Columns as arrays of NumPy: heads, and cells of rows.
 *
 * A head is that of a .npy file, whose items are records of cells of eight bytes: real numbers are
 * doubles, whole numbers signed, flags a byte of 0 or 1 before seven others. All text (names,
 * choices, sets, seeds) is a number without a sign: that of a name in one list, which all tables of
 * a stream share and whose first name is empty. A cell without a value is NaN, -1, or the empty
 * name. */
#pragma once

#include "base/intern.h"
#include "export/csv_columns.h"

/* All names of a stream by number. */
struct npy_names {
    struct intern list;
    struct arena *arena;
    struct text word; /* of the cell at work */
};

struct npy_names npy_columns_begin(struct arena *arena);
void npy_columns_end(struct npy_names *names);

/* Appends the head of so many rows, which have the columns of these lists one after another. Its
 * length does not depend on the number of rows. */
void npy_columns_write_head(const struct csv_columns *lists, size_t count, int64_t rows,
                            struct text *text);

/* Appends the cells of a struct, which have no value where it is NULL. */
void npy_columns_write(const struct csv_columns *columns, const void *base, struct npy_names *names,
                       struct text *row);

/* Appends all names as an array of JSON. */
void npy_columns_write_names(const struct npy_names *names, struct text *text);
