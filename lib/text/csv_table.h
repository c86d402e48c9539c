/* CSV tables with named columns, read and written.
 *
 * libcsv reads them in strict mode, plain or gzip. The first row names the columns; a byte order
 * mark before it and CRLF are accepted. Every row must have as many cells as the header and end
 * with a line end, because the last number of a file that was cut may be incomplete. Rows without
 * cells are skipped, and blanks around an unquoted cell are dropped. Messages name the row as a
 * spreadsheet numbers it (the header is usually row 1; empty rows count, line breaks inside quotes
 * do not) and the column. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "text/input.h"

/* The largest table, in bytes; recordings are tens of megabytes. */
#define CSV_TABLE_SIZE ((size_t)(SIZE_MAX < UINT64_C(4) << 30 ? SIZE_MAX / 2 : UINT64_C(4) << 30))

struct csv_table {
    size_t columns;
    const char *const *header;
    size_t rows;              /* without the header */
    const char *const *cells; /* row by row */
    const size_t *numbers;    /* numbers of the rows, for messages */
};

/* Reads a whole table from its bytes into the arena. Messages do not name the file. */
int csv_table_parse(const struct text *text, struct csv_table *table, struct arena *arena,
                    struct diag *diag);

/* The beginning of a table whose first line is not the header. */
struct csv_table_form {
    const char *const *names; /* of columns, NULL after the last: used where the first row has as
                               * many cells and begins with a number */
    const char *preamble;     /* if the first line begins so, lines are skipped up to the header */
    const char *header;       /* the beginning of the header after a preamble */
};

/* Reads a table row by row in constant memory; form may be NULL. Where the first line has no comma,
 * cells are separated by semicolons, or else by any number of blanks. Opening reads the header; the
 * input stays the caller's. NULL after a message. */
struct csv_table_rows;
struct csv_table_rows *csv_table_open(struct input *input, const struct csv_table_form *form,
                                      struct diag *diag);
void csv_table_close(struct csv_table_rows *rows);

/* The header, in a table that may have no rows. */
const struct csv_table *csv_table_names(const struct csv_table_rows *rows);

/* The rows that end in the next line, most often one; NULL at the end, or after a message. */
const struct csv_table *csv_table_next(struct csv_table_rows *rows, struct diag *diag);

/* Writes one cell, quoted (by libcsv) where it must be; returns its length. The room must be twice
 * the text's length and two. */
size_t csv_table_quote(const char *text, char *cell, size_t room);

/* Finds the column of that name; -1 after a message with the header that was found. */
int csv_table_column(const struct csv_table *table, const char *name, size_t *column,
                     struct diag *diag);

const char *csv_table_cell(const struct csv_table *table, size_t row, size_t column);

/* Reads a cell as a finite number in [low, high], in the form of JSON's numbers; white space, nan,
 * inf, hexadecimal and a leading + are refused. */
int csv_table_number(const struct csv_table *table, size_t row, size_t column, double low,
                     double high, double *value, struct diag *diag);
