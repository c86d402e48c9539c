/* Tables in CSV files: columns found by their names, cells read as numbers or text.
 *
 * Read by libcsv in strict mode, plain or gzip. The first row names the columns; a byte order mark
 * before it and CRLF are fine. Every row must have as many cells as the header. Rows without any
 * cell are passed over, and blanks around a cell without quotes do not belong to it. Messages name
 * the row as a spreadsheet shows it (the header is usually row 1, empty rows count, line breaks
 * inside quotes do not) and, for a cell, its column. */
#ifndef CSV_TABLE_H
#define CSV_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

/* A table may be this large; recordings are tens of megabytes. */
#define CSV_TABLE_SIZE ((size_t)(SIZE_MAX < UINT64_C(4) << 30 ? SIZE_MAX / 2 : UINT64_C(4) << 30))

struct csv_table {
    size_t columns;
    const char *const *header;
    size_t rows;              /* without the header */
    const char *const *cells; /* row by row */
    const size_t *numbers;    /* of the rows, for messages */
};

/* The whole table, in the arena. Messages do not name the file. */
int csv_table_read(const char *path, struct csv_table *table, struct arena *arena,
                   struct diag *diag);

/* The same for one whose bytes are at hand; it keeps nothing of them. */
int csv_table_parse(const struct text *text, struct csv_table *table, struct arena *arena,
                    struct diag *diag);

/* One cell of a table that is written, quoted (by libcsv) where it must be: its length. The room
 * must be twice the text's length and two. */
size_t csv_table_quote(const char *text, char *cell, size_t room);

/* The column of that name; -1 and a message with what was found instead. */
int csv_table_column(const struct csv_table *table, const char *name, size_t *column,
                     struct diag *diag);

const char *csv_table_cell(const struct csv_table *table, size_t row, size_t column);

/* A cell as a finite number in [low, high], in the form that JSON gives numbers; white space, nan,
 * inf, hexadecimal and a leading + are refused. */
int csv_table_number(const struct csv_table *table, size_t row, size_t column, double low,
                     double high, double *value, struct diag *diag);

#endif
