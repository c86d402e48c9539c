#include "text/csv_table.h"

#include <stdlib.h>
#include <string.h>

#include <csv.h>

#include "base/intern.h"
#include "base/number.h"
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
    bool semicolons;  /* separate the cells */
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
    if (!reader->semicolons)
        refuse_semicolons(table, reader->diag);
    refuse_repeated_names(table, reader->arena, reader->diag);
}

static void take_row(struct reader *reader)
{
    size_t cells = reader->cells.count - reader->row_begin;
    if (cells == reader->table->columns)
        *list_add(&reader->numbers, reader->arena) = reader->row;
    else
        diag_fail(reader->diag, DIAG_DATA, "row %zu: %zu cell%s; expected %zu as in the header",
                  reader->row, cells, cells == 1 ? "" : "s", reader->table->columns);
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
    return reader->diag->code == DIAG_OK ? 0 : -1;
}

static int finish(struct csv_parser *parser, struct reader *reader)
{
    if (csv_fini(parser, on_cell, on_row, reader) != 0)
        return diag_fail(reader->diag, DIAG_DATA,
                         "row %zu: a quote opens a cell and nothing closes it", reader->row);
    if (reader->table->header == NULL)
        return diag_fail(reader->diag, DIAG_DATA, "the table is empty; expected a header");
    return reader->diag->code == DIAG_OK ? 0 : -1;
}

static int begin(struct csv_parser *parser, struct reader *reader)
{
    if (csv_init(parser, CSV_STRICT | CSV_STRICT_FINI | CSV_APPEND_NULL | CSV_REPALL_NL) != 0)
        return diag_fail(reader->diag, DIAG_INTERNAL, "libcsv refuses to start");
    csv_set_realloc_func(parser, memory_resize);
    csv_set_free_func(parser, free);
    return 0;
}

/* The length of a byte order mark. */
static size_t mark_length(const char *bytes, size_t length)
{
    return length >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

static int read_text(const struct text *text, struct reader *reader)
{
    size_t skipped = mark_length(text->bytes, text->length);
    struct csv_parser parser;
    if (begin(&parser, reader) != 0)
        return -1;
    int done = parse(&parser, reader, text->bytes + skipped, text->length - skipped);
    if (done == 0)
        done = finish(&parser, reader);
    csv_free(&parser);
    return done;
}

static void show_rows(const struct reader *reader)
{
    reader->table->rows = reader->numbers.count;
    reader->table->cells = reader->cells.items;
    reader->table->numbers = reader->numbers.items;
}

int csv_table_parse(const struct text *text, struct csv_table *table, struct arena *arena,
                    struct diag *diag)
{
    *table = (struct csv_table){0};
    struct reader reader = {.table = table, .arena = arena, .diag = diag, .row = 1};
    int done = read_text(text, &reader);
    show_rows(&reader);
    return done;
}

/* ---- row by row ---- */

struct csv_table_rows {
    struct csv_table table; /* the rows of one line */
    struct csv_parser parser;
    struct reader reader;
    struct input *input;
    struct arena names, cells;
    struct diag fault; /* that ended the table, after the rows before it */
    bool begun, ended;
};

/* Parses a line more, and the end after the last. */
static void parse_line(struct csv_table_rows *rows)
{
    const char *line;
    size_t length;
    int more = input_line(rows->input, CSV_TABLE_SIZE, &line, &length, &rows->fault);
    size_t skipped = more > 0 && !rows->begun ? mark_length(line, length) : 0;
    if (more > 0 && !rows->begun && memchr(line, ',', length) == NULL &&
        memchr(line, ';', length) != NULL) {
        rows->reader.semicolons = true;
        csv_set_delim(&rows->parser, ';');
    }
    rows->begun = true;
    if (more > 0)
        more = parse(&rows->parser, &rows->reader, line + skipped, length - skipped) == 0 &&
               parse(&rows->parser, &rows->reader, "\n", 1) == 0;
    else if (more == 0)
        finish(&rows->parser, &rows->reader);
    rows->ended = more <= 0;
}

const struct csv_table *csv_table_next(struct csv_table_rows *rows, struct diag *diag)
{
    struct reader *reader = &rows->reader;
    arena_clear(&rows->cells);
    memset(&reader->cells, 0, sizeof reader->cells);
    memset(&reader->numbers, 0, sizeof reader->numbers);
    reader->row_begin = 0;
    while (!rows->ended && reader->numbers.count == 0)
        parse_line(rows);
    show_rows(reader);
    if (rows->table.rows > 0)
        return &rows->table;
    if (rows->fault.code != DIAG_OK)
        *diag = rows->fault;
    return NULL;
}

struct csv_table_rows *csv_table_open(struct input *input, struct diag *diag)
{
    struct csv_table_rows *rows = memory_get(sizeof *rows);
    *rows = (struct csv_table_rows){.input = input};
    rows->reader = (struct reader){
        .table = &rows->table, .arena = &rows->names, .diag = &rows->fault, .row = 1};
    rows->ended = begin(&rows->parser, &rows->reader) != 0;
    while (!rows->ended && rows->table.header == NULL)
        parse_line(rows);
    rows->reader.arena = &rows->cells;
    if (rows->fault.code == DIAG_OK)
        return rows;
    *diag = rows->fault;
    csv_table_close(rows);
    return NULL;
}

const struct csv_table *csv_table_names(const struct csv_table_rows *rows)
{
    return &rows->table;
}

void csv_table_close(struct csv_table_rows *rows)
{
    if (rows == NULL)
        return;
    csv_free(&rows->parser);
    arena_free(&rows->names);
    arena_free(&rows->cells);
    free(rows);
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
    const char *end = text + strlen(text);
    if (number_take(text, end, value) == end)
        return true;
    if (*text != '-' && (*text < '0' || *text > '9'))
        return false;
    struct diag ignored;
    ignored.code = DIAG_OK;
    struct json_scan scan = {.at = text, .end = end, .diag = &ignored};
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
    size_t length = 0;
    for (; text[length] != '\0'; length++) {
        if (text[length] == ',' || text[length] == '"' || text[length] == '\r' ||
            text[length] == '\n')
            return csv_write(cell, room, text, strlen(text));
        cell[length] = text[length];
    }
    return length;
}
