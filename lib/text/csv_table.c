#include "text/csv_table.h"

#include <stdlib.h>
#include <string.h>

#include <csv.h>

#include "base/intern.h"
#include "text/field.h"
#include "text/input.h"
#include "text/json_scan.h"

struct reader {
    struct csv_table *table;
    struct arena *arena;
    struct diag *diag;
    LIST_OF(const char *) cells;
    LIST_OF(size_t) numbers;
    size_t row_begin; /* the current row's first cell */
    size_t row;       /* number of the current row */
    int last_end;     /* character that ended the row before */
};

static void refuse_semicolons(const struct csv_table *table, struct diag *diag)
{
    if (table->columns == 1 && strchr(table->header[0], ';') != NULL)
        diag_fail(diag, DIAG_DATA, "the columns are separated by semicolons; expected commas");
}

static void refuse_repeated_names(const struct csv_table *table, struct arena *arena,
                                  struct diag *diag)
{
    struct intern names = intern_begin(table->columns, arena);
    for (size_t i = 0; i < table->columns && diag->code == DIAG_OK; i++) {
        uint32_t number = intern_word(&names, table->header[i], arena);
        if (number < i)
            diag_fail(diag, DIAG_DATA, "columns %zu and %zu are both named \"%.80s\"",
                      (size_t)number + 1, i + 1, table->header[i]);
    }
}

static void take_header(struct reader *reader)
{
    struct csv_table *table = reader->table;
    size_t columns = reader->cells.count;
    const char **header = arena_get(reader->arena, columns * sizeof *header);
    memcpy(header, reader->cells.items, columns * sizeof *header);
    table->header = header;
    table->columns = columns;
    reader->cells.count = 0;
    refuse_semicolons(table, reader->diag);
    refuse_repeated_names(table, reader->arena, reader->diag);
}

static void take_row(struct reader *reader)
{
    size_t cells = reader->cells.count - reader->row_begin;
    if (cells != reader->table->columns)
        diag_fail(reader->diag, DIAG_DATA, "row %zu: %zu cell%s; expected %zu as in the header",
                  reader->row, cells, cells == 1 ? "" : "s", reader->table->columns);
    *list_add(&reader->numbers, reader->arena) = reader->row;
}

static void on_cell(void *text, size_t length, void *context)
{
    struct reader *reader = context;
    if (reader->diag->code == DIAG_OK)
        *list_add(&reader->cells, reader->arena) = arena_text(reader->arena, text, length);
}

/* libcsv reports CR and LF of one line end as the ends of two rows. */
static void on_row(int end, void *context)
{
    struct reader *reader = context;
    bool empty = reader->cells.count == reader->row_begin;
    bool second_half = empty && end == CSV_LF && reader->last_end == CSV_CR;
    reader->last_end = end;
    if (second_half || reader->diag->code != DIAG_OK)
        return;
    if (!empty && reader->table->header == NULL)
        take_header(reader);
    else if (!empty)
        take_row(reader);
    reader->row_begin = reader->cells.count;
    reader->row++;
}

static int parse(struct csv_parser *parser, struct reader *reader, const char *bytes, size_t length)
{
    const char *nul = length > 0 ? memchr(bytes, '\0', length) : NULL;
    size_t readable = nul != NULL ? (size_t)(nul - bytes) : length;
    if (csv_parse(parser, bytes, readable, on_cell, on_row, reader) != readable)
        return diag_fail(reader->diag, DIAG_DATA,
                         "row %zu: a misplaced quote; expected quotes around the whole cell, and "
                         "those inside it doubled",
                         reader->row);
    if (nul != NULL)
        return diag_fail(reader->diag, DIAG_DATA, "row %zu: a NUL byte; expected text",
                         reader->row);
    if (csv_fini(parser, on_cell, on_row, reader) != 0)
        return diag_fail(reader->diag, DIAG_DATA,
                         "row %zu: a quote opens a cell and nothing closes it", reader->row);
    if (reader->table->header == NULL)
        return diag_fail(reader->diag, DIAG_DATA, "the table is empty; expected a header");
    return reader->diag->code == DIAG_OK ? 0 : -1;
}

static int read_bytes(const char *path, struct text *text, struct diag *diag)
{
    struct input *input = input_open(path, diag);
    if (input == NULL)
        return -1;
    int done = input_all(input, CSV_TABLE_SIZE, text, diag);
    input_close(input);
    return done;
}

static int read_text(const struct text *text, struct reader *reader)
{
    static const char mark[] = "\xef\xbb\xbf";
    size_t skipped = text->length >= 3 && memcmp(text->bytes, mark, 3) == 0 ? 3 : 0;
    struct csv_parser parser;
    if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI | CSV_APPEND_NULL | CSV_REPALL_NL) != 0)
        return diag_fail(reader->diag, DIAG_INTERNAL, "libcsv refuses to start");
    csv_set_realloc_func(&parser, memory_resize);
    csv_set_free_func(&parser, free);
    int done = parse(&parser, reader, text->bytes + skipped, text->length - skipped);
    csv_free(&parser);
    return done;
}

int csv_table_parse(const struct text *text, struct csv_table *table, struct arena *arena,
                    struct diag *diag)
{
    *table = (struct csv_table){0};
    struct reader reader = {.table = table, .arena = arena, .diag = diag, .row = 1};
    int done = read_text(text, &reader);
    table->rows = reader.numbers.count;
    table->cells = reader.cells.items;
    table->numbers = reader.numbers.items;
    return done;
}

int csv_table_read(const char *path, struct csv_table *table, struct arena *arena,
                   struct diag *diag)
{
    *table = (struct csv_table){0};
    struct text text = {0};
    int done = read_bytes(path, &text, diag);
    if (done == 0)
        done = csv_table_parse(&text, table, arena, diag);
    text_free(&text);
    return done;
}

int csv_table_column(const struct csv_table *table, const char *name, size_t *column,
                     struct diag *diag)
{
    for (size_t i = 0; i < table->columns; i++)
        if (strcmp(table->header[i], name) == 0) {
            *column = i;
            return 0;
        }
    struct text header = {0};
    for (size_t i = 0; i < table->columns; i++)
        text_format(&header, "%s%s", i == 0 ? "" : ", ", table->header[i]);
    diag_fail(diag, DIAG_DATA, "column \"%s\" is missing; the header is: %.*s", name,
              (int)(header.length < 800 ? header.length : 800), header.bytes);
    text_free(&header);
    return -1;
}

const char *csv_table_cell(const struct csv_table *table, size_t row, size_t column)
{
    return table->cells[row * table->columns + column];
}

static bool number_of(const char *text, double *value)
{
    if (*text != '-' && (*text < '0' || *text > '9'))
        return false;
    struct diag ignored;
    ignored.code = DIAG_OK;
    struct json_scan scan = {.at = text, .end = text + strlen(text), .diag = &ignored};
    return json_scan_number(&scan, value) == 0 && scan.at == scan.end;
}

int csv_table_number(const struct csv_table *table, size_t row, size_t column, double low,
                     double high, double *value, struct diag *diag)
{
    const char *text = csv_table_cell(table, row, column);
    const char *name = table->header[column];
    if (!number_of(text, value))
        return diag_fail(diag, DIAG_DATA, "row %zu, column \"%.80s\": \"%.80s\" is not a number",
                         table->numbers[row], name, text);
    if (*value >= low && *value <= high)
        return 0;
    const char *unit = field_unit(name);
    return diag_fail(diag, DIAG_DATA, "row %zu, column \"%.80s\": %.80s is outside [%g, %g]%s%s",
                     table->numbers[row], name, text, low, high, *unit != '\0' ? " " : "", unit);
}

size_t csv_table_quote(const char *text, char *cell, size_t room)
{
    if (strpbrk(text, ",\"\r\n") != NULL)
        return csv_write(cell, room, text, strlen(text));
    size_t length = 0;
    for (; text[length] != '\0'; length++)
        cell[length] = text[length];
    return length;
}
