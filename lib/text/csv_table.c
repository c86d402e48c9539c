#include "text/csv_table.h"

#include <assert.h>
#include <stdlib.h>

#include <csv.h>

#include "base/intern.h"
#include "base/number.h"
#include "text/field.h"
#include "text/json_scan.h"

struct reader {
    struct csv_table *table;
    struct arena *arena;
    struct diag *diag;
    struct text text;       /* the cells, a NUL after each */
    LIST_OF(size_t) begins; /* of the cells in it */
    LIST_OF(const char *) cells;
    LIST_OF(size_t) numbers;
    size_t row_begin;         /* the current row's first cell */
    size_t row;               /* number of the current row */
    int last_end;             /* character that ended the row before */
    const char *const *names; /* csv_table_form.names, or NULL */
};

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

/* True if the first row has values, with a given name for each: no column is named by a number. */
static bool lacks_header(const struct reader *reader)
{
    size_t count = 0;
    while (reader->names != NULL && reader->names[count] != NULL)
        count++;
    const char *first = reader->text.bytes;
    return count > 0 && count == reader->begins.count && first[strspn(first, "0123456789")] == '\0';
}

static void take_header(struct reader *reader)
{
    struct csv_table *table = reader->table;
    size_t columns = reader->begins.count;
    if (lacks_header(reader)) {
        table->header = reader->names;
        table->columns = columns;
        *list_add(&reader->numbers, reader->arena) = reader->row;
        return;
    }
    const char **header = arena_get(reader->arena, columns * sizeof *header);
    const char *names = arena_text(reader->arena, reader->text.bytes, reader->text.length);
    for (size_t i = 0; i < columns; i++)
        header[i] = names + reader->begins.items[i];
    table->header = header;
    table->columns = columns;
    reader->begins.count = reader->text.length = 0;
    refuse_repeated_names(table, reader->arena, reader->diag);
}

static void take_row(struct reader *reader)
{
    size_t cells = reader->begins.count - reader->row_begin;
    if (cells == reader->table->columns)
        *list_add(&reader->numbers, reader->arena) = reader->row;
    else
        diag_fail(reader->diag, DIAG_DATA, "row %zu: %zu cell%s; expected %zu as in the header",
                  reader->row, cells, cells == 1 ? "" : "s", reader->table->columns);
}

static void on_cell(void *text, size_t length, void *context)
{
    struct reader *reader = context;
    if (reader->diag->code != DIAG_OK)
        return;
    *list_add(&reader->begins, reader->arena) = reader->text.length;
    text_add(&reader->text, text, length + 1);
}

/* libcsv reports CR and LF of one line end as ends of two rows, and the end of the text as -1. */
static void on_row(int end, void *context)
{
    struct reader *reader = context;
    bool empty = reader->begins.count == reader->row_begin;
    bool second_half = empty && end == CSV_LF && reader->last_end == CSV_CR;
    reader->last_end = end;
    if (second_half || reader->diag->code != DIAG_OK)
        return;
    if (end < 0)
        diag_fail(reader->diag, DIAG_DATA,
                  "row %zu: the file ends inside this row; expected a line end after the last row",
                  reader->row);
    else if (!empty && reader->table->header == NULL)
        take_header(reader);
    else if (!empty)
        take_row(reader);
    reader->row_begin = reader->begins.count;
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
    if (reader->table->header == NULL && reader->diag->code == DIAG_OK)
        diag_fail(reader->diag, DIAG_DATA, "the table is empty; expected a header");
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

static void end_text(struct reader *reader)
{
    memset(text_room(&reader->text, NUMBER_ROOM), 0, NUMBER_ROOM);
}

/* Called when the text does not grow any more: then addresses of its cells stay valid. */
static void show_rows(struct reader *reader)
{
    reader->cells.count = 0;
    for (size_t i = 0; i < reader->begins.count; i++)
        *list_add(&reader->cells, reader->arena) = reader->text.bytes + reader->begins.items[i];
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
    end_text(&reader);
    struct text kept = reader.text;
    reader.text.bytes = arena_text(arena, kept.bytes, kept.length + NUMBER_ROOM);
    show_rows(&reader);
    text_free(&kept);
    return done;
}

/* ---- row by row ---- */

struct csv_table_rows {
    struct csv_table table; /* the rows of one line */
    struct csv_parser parser;
    struct reader reader;
    struct input *input;
    struct arena arena;
    struct diag fault; /* that ended the table, after the rows before it */
    const struct csv_table_form *form;
    struct text commas; /* the line, with commas for its blanks */
    bool begun, ended;
    bool before_header;
    bool blanks; /* separate the cells */
    bool held;   /* was the first line a row? */
};

/* Finds in the first line what separates cells, and whether the header is in a later line. */
static void look_at_first(struct csv_table_rows *rows, const char *line, size_t length)
{
    const struct csv_table_form *form = rows->form;
    rows->before_header =
        form != NULL && strncmp(line, form->preamble, strlen(form->preamble)) == 0;
    if (rows->before_header || memchr(line, ',', length) != NULL)
        return;
    if (memchr(line, ';', length) != NULL)
        csv_set_delim(&rows->parser, ';');
    else
        rows->blanks = memchr(line, '"', length) == NULL;
}

/* Replaces every run of blanks by a comma, and drops blanks at the ends. */
static void put_commas(struct csv_table_rows *rows, const char **line, size_t *length)
{
    struct text *commas = &rows->commas;
    commas->length = 0;
    char *to = text_room(commas, *length);
    bool waits = false;
    for (size_t i = 0; i < *length; i++) {
        bool blank = strchr(" \t\r", (*line)[i]) != NULL && (*line)[i] != '\0';
        if (!blank && waits && commas->length > 0)
            to[commas->length++] = ',';
        if (!blank)
            to[commas->length++] = (*line)[i];
        waits = blank;
    }
    *line = to;
    *length = commas->length;
}

/* Parses the next line, or the end of the table. */
static void parse_line(struct csv_table_rows *rows)
{
    const char *line;
    size_t length;
    int more = input_line(rows->input, CSV_TABLE_SIZE, &line, &length, &rows->fault);
    rows->ended = more <= 0;
    if (more == 0)
        finish(&rows->parser, &rows->reader);
    if (more <= 0)
        return;
    if (!rows->begun) {
        size_t mark = mark_length(line, length);
        line += mark;
        length -= mark;
        look_at_first(rows, line, length);
        rows->begun = true;
    }
    bool whole = line[length] == '\n';
    if (rows->before_header)
        rows->before_header = strncmp(line, rows->form->header, strlen(rows->form->header)) != 0;
    if (rows->before_header) {
        rows->reader.row++;
        return;
    }
    if (rows->blanks)
        put_commas(rows, &line, &length);
    rows->ended = parse(&rows->parser, &rows->reader, line, length) != 0 ||
                  parse(&rows->parser, &rows->reader, "\n", whole) != 0;
}

const struct csv_table *csv_table_next(struct csv_table_rows *rows, struct diag *diag)
{
    struct reader *reader = &rows->reader;
    if (rows->held) {
        rows->held = false;
        return &rows->table;
    }
    reader->begins.count = reader->numbers.count = reader->text.length = reader->row_begin = 0;
    while (!rows->ended && reader->numbers.count == 0)
        parse_line(rows);
    end_text(reader);
    show_rows(reader);
    if (rows->table.rows > 0)
        return &rows->table;
    if (rows->fault.code != DIAG_OK)
        *diag = rows->fault;
    return NULL;
}

struct csv_table_rows *csv_table_open(struct input *input, const struct csv_table_form *form,
                                      struct diag *diag)
{
    struct csv_table_rows *rows = memory_get(sizeof *rows);
    *rows = (struct csv_table_rows){.input = input, .form = form};
    rows->reader = (struct reader){.table = &rows->table,
                                   .arena = &rows->arena,
                                   .diag = &rows->fault,
                                   .row = 1,
                                   .names = form != NULL ? form->names : NULL};
    rows->ended = begin(&rows->parser, &rows->reader) != 0;
    while (!rows->ended && rows->table.header == NULL)
        parse_line(rows);
    rows->held = rows->reader.numbers.count > 0;
    end_text(&rows->reader);
    show_rows(&rows->reader);
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
    arena_free(&rows->arena);
    text_free(&rows->reader.text);
    text_free(&rows->commas);
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
    assert(row < table->rows && column < table->columns);
    return table->cells[row * table->columns + column];
}

/* The text is a cell, which has NUMBER_ROOM bytes behind it. */
static bool number_of(const char *text, double *value)
{
    const char *end = number_take(text, text + NUMBER_ROOM, value);
    if (end != NULL && *end == '\0')
        return true;
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
    size_t length = 0; /* strcspn and memcpy take more instructions for short cells */
    for (; text[length] != '\0'; length++) {
        if (text[length] == ',' || text[length] == '"' || text[length] == '\r' ||
            text[length] == '\n')
            return csv_write(cell, room, text, strlen(text));
        cell[length] = text[length];
    }
    return length;
}
