/* Reading a table of recorded traffic to rows in memory, beside libcsv whose callback turns the
 * same cells into numbers by from_chars and keeps them: ROUNDS lines of NAME and ns per row,
 * between tabs, the two in turn. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <csv.h>

#include "clock.h"
#include "digits.h"
#include "recorded/recorded_row.h"
#include "text/input.h"

enum { PIECE = 1 << 16, MOST_COLUMNS = 256, ROW = 10, KEPT_ROWS = 4096 };

/* ---- libcsv with from_chars ---- */

struct plain {
    double *rows; /* the last KEPT_ROWS */
    size_t row, column, kept;
    bool header;
    bool wanted[MOST_COLUMNS];
    const char *names; /* each between separators */
};

static void on_cell(void *text, size_t length, void *context)
{
    struct plain *plain = context;
    size_t column = plain->column++;
    if (!plain->header) {
        char name[128];
        snprintf(name, sizeof name, "%c%.*s%c", *plain->names, (int)(length < 100 ? length : 100),
                 (char *)text, *plain->names);
        plain->wanted[column] = strstr(plain->names, name) != NULL;
        return;
    }
    if (!plain->wanted[column])
        return;
    const char *cell = text;
    digits_read(cell, cell + length,
                &plain->rows[plain->row % KEPT_ROWS * ROW + plain->kept++ % ROW]);
}

static void on_row(int end, void *context)
{
    (void)end;
    struct plain *plain = context;
    plain->row += plain->header;
    plain->header = true;
    plain->column = plain->kept = 0;
}

/* Semicolons separate the cells where they separate the names. */
static size_t read_plainly(const char *path, const char *names, double *rows)
{
    static char piece[PIECE];
    struct plain plain = {.rows = rows, .names = names};
    struct csv_parser parser;
    FILE *file = fopen(path, "rb");
    if (file == NULL || csv_init(&parser, CSV_STRICT | CSV_APPEND_NULL) != 0)
        abort();
    csv_set_delim(&parser, (unsigned char)*names);
    for (size_t length; (length = fread(piece, 1, PIECE, file)) > 0;)
        if (csv_parse(&parser, piece, length, on_cell, on_row, &plain) != length)
            abort();
    csv_fini(&parser, on_cell, on_row, &plain);
    csv_free(&parser);
    fclose(file);
    return plain.row;
}

/* ---- glint's reader ---- */

static size_t read_table(const char *path, struct recorded_row *rows)
{
    struct arena arena = {0};
    struct diag diag = {0};
    struct input *input = input_open(path, &diag);
    struct recorded_reader reader = {0};
    if (input != NULL)
        reader = recorded_table_open(input, path, &arena, &diag);
    size_t count = 0;
    while (reader.format != NULL &&
           reader.format->next(reader.state, &rows[count % KEPT_ROWS], &diag) > 0)
        count++;
    if (diag.code != DIAG_OK) {
        fprintf(stderr, "read_table: %s\n", diag.text);
        exit(1);
    }
    reader.format->close(reader.state);
    arena_free(&arena);
    return count;
}

int main(int count, char **words)
{
    static double plain_rows[KEPT_ROWS * ROW];
    static struct recorded_row rows[KEPT_ROWS];
    if (count != 4) {
        fprintf(stderr, "usage: read_table ROUNDS TABLE ,COLUMN,COLUMN,\n");
        return 64;
    }
    for (int round = 0; round < atoi(words[1]); round++) {
        double begin_ns = cpu_ns();
        size_t read = read_table(words[2], rows);
        double middle_ns = cpu_ns();
        size_t lines = read_plainly(words[2], words[3], plain_rows);
        double end_ns = cpu_ns();
        printf("table\t%.1f\n", (middle_ns - begin_ns) / (double)read);
        printf("libcsv with from_chars\t%.1f\n", (end_ns - middle_ns) / (double)lines);
    }
    return 0;
}
