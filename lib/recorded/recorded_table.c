/* Rows of a CSV table of recorded traffic. */
#include <math.h>
#include <stdio.h>

#include "base/intern.h"
#include "base/units.h"
#include "recorded/recorded_layouts.h"
#include "text/csv_table.h"
#include "text/field.h"
#include "text/file_format.h"
#include "text/packing.h"

static const struct csv_table_form form = {
    .names = recorded_layouts_ngsim_names, .preamble = "esmini ", .header = "Index "};

/* A row of the file of tracks. */
struct track {
    const char *class;
    double direction_rad; /* of travel; NAN: not said */
};

struct table {
    struct recorded_format format;
    struct csv_table_rows *lines;
    struct input *input;
    struct recorded_fit fit;
    const struct csv_table *rows; /* of the last line, or NULL */
    size_t row;                   /* of those, which is read */
    size_t part;                  /* of the row, which is next */
    struct intern recordings;
    struct arena *arena;
    double rate_hz; /* of the file of the recording, and from that of the tracks: */
    struct intern tracks;
    LIST_OF(struct track) track_list; /* by the number of the id */
};

/* ---- files beside a table ---- */

/* NN_tracks.csv has NN_tracksMeta.csv beside it, with a row for each track, and
 * NN_recordingMeta.csv with a single row. Each may be gzip, under its name or with ".gz" behind
 * it. */

/* The value of a column in the row. */
static int take_number(const struct csv_table *row, const char *name, double low, double high,
                       double *value, struct diag *diag)
{
    size_t column;
    if (csv_table_column(row, name, &column, diag) != 0)
        return -1;
    return csv_table_number(row, 0, column, low, high, value, diag);
}

static const char *take_text(const struct csv_table *row, const char *name, struct arena *arena,
                             struct diag *diag)
{
    size_t column;
    if (csv_table_column(row, name, &column, diag) != 0)
        return NULL;
    const char *text = csv_table_cell(row, 0, column);
    return arena_text(arena, text, strlen(text));
}

static int take_recording(struct table *table, const struct csv_table *row, struct diag *diag)
{
    if (table->rate_hz != 0)
        return diag_fail(diag, DIAG_DATA, "row %zu: a second recording; expected one",
                         row->numbers[0]);
    return take_number(row, "frameRate", 1, 1e6, &table->rate_hz, diag);
}

static int take_track(struct table *table, const struct csv_table *row, struct diag *diag)
{
    const char *id_name = table->fit.layout->beside.id, *way = table->fit.layout->beside.direction;
    const char *id = take_text(row, id_name, table->arena, diag);
    const char *class = id != NULL ? take_text(row, "class", table->arena, diag) : NULL;
    double direction = 0;
    if (class == NULL || (way != NULL && take_number(row, way, 1, 2, &direction, diag) != 0))
        return -1;
    if (intern_word(&table->tracks, id, table->arena) < table->track_list.count)
        return diag_fail(diag, DIAG_DATA, "row %zu: %s %.80s is in a row above already",
                         row->numbers[0], id_name, id);
    double direction_rad = (double)NAN;
    if (way != NULL)
        direction_rad = direction == 1 ? PI : 0;
    *list_add(&table->track_list, table->arena) = (struct track){class, direction_rad};
    return 0;
}

/* Opens the file whose name has these letters in place of "tracks", with which the table's own name
 * ends but for its endings; plain or gzip. NULL after a message; *path is the name in either
 * case. */
static struct input *open_beside(const char *table_path, const char *name, const char **path,
                                 struct arena *arena, struct diag *diag)
{
    enum { LETTERS = sizeof "tracks" - 1 };
    const char *slash = strrchr(table_path, '/'), *base = slash != NULL ? slash + 1 : table_path;
    size_t length = strcspn(base, ".");
    const char *ending = base + length;
    *path = table_path;
    if (length < LETTERS || memcmp(ending - LETTERS, "tracks", LETTERS) != 0) {
        diag_fail(diag, DIAG_DATA,
                  "expected a table named NN_tracks.csv, to find NN_%s.csv beside it", name);
        return NULL;
    }
    *path = arena_format(arena, "%.*s%s%.*s", (int)(ending - LETTERS - table_path), table_path,
                         name, (int)packing_plain_length(ending), ending);
    struct diag fault = {0}, other = {0};
    struct input *input = input_open(*path, &fault);
    for (enum packing each = PACKING_GZIP; input == NULL && each <= PACKING_ZSTD; each++) {
        const char *packed = arena_format(arena, "%s%s", *path, packing_ending(each));
        input = input_open(packed, &other);
        *path = input != NULL ? packed : *path;
    }
    if (input == NULL)
        *diag = fault;
    return input;
}

/* Reads the file row by row; refuses one without rows. */
static int read_beside(struct table *table, const char *table_path, const char *name,
                       int (*take)(struct table *table, const struct csv_table *row,
                                   struct diag *diag),
                       struct diag *diag)
{
    const char *path;
    struct input *input = open_beside(table_path, name, &path, table->arena, diag);
    struct csv_table_rows *rows = input != NULL ? csv_table_open(input, NULL, diag) : NULL;
    const struct csv_table *row;
    int count = 0, result = 0;
    while (rows != NULL && result == 0 && (row = csv_table_next(rows, diag)) != NULL) {
        result = take(table, row, diag);
        count++;
    }
    if (diag->code == DIAG_OK && count == 0)
        diag_fail(diag, DIAG_DATA, "there is no row below the header");
    csv_table_close(rows);
    input_close(input);
    return diag->code == DIAG_OK ? 0 : diag_prefix(diag, "%s: ", path);
}

/* ---- opening ---- */

static int read_header(struct table *table, const char *path, struct diag *diag)
{
    table->lines = csv_table_open(table->input, &form, diag);
    if (table->lines == NULL)
        return -1;
    const struct csv_table *names = csv_table_names(table->lines);
    if (recorded_layouts_find(names, &table->fit, table->arena, diag) != 0)
        return -1;
    if (table->fit.layout->beside.id == NULL)
        return 0;
    if (read_beside(table, path, "recordingMeta", take_recording, diag) != 0)
        return -1;
    return read_beside(table, path, "tracksMeta", take_track, diag);
}

/* ---- rows ---- */

static int refuse(const struct table *table, size_t place, const char *what, struct diag *diag)
{
    const struct csv_table *rows = table->rows;
    return diag_fail(diag, DIAG_DATA, "row %zu, column \"%s\": %s%.80s%s",
                     rows->numbers[table->row], rows->header[place], what[0] == '"' ? "\"" : "",
                     csv_table_cell(rows, table->row, place), what);
}

static int read_cell(struct table *table, const struct recorded_column *column, size_t place,
                     struct recorded_cells *cells, struct diag *diag)
{
    const char *text = csv_table_cell(table->rows, table->row, place);
    double most_s = 9e9 / column->scale, value;
    if (column->kind == RECORDED_ALIKE && intern_word(&table->recordings, text, table->arena) > 0)
        return refuse(table, place, "\" is another recording; expected that of all rows", diag);
    if (column->kind == RECORDED_ALIKE)
        return 0;
    bool name = column->kind == RECORDED_NAME;
    if (name || column->kind == RECORDED_WORDS) {
        if (name && !recorded_row_name_fits(text))
            return refuse(table, place, "\"; expected 1 to 1024 printable ASCII characters", diag);
        memcpy((char *)cells + column->offset, &text, sizeof text);
        return 0;
    }
    bool time = column->kind == RECORDED_TIME;
    if (csv_table_number(table->rows, table->row, place, time ? -most_s : column->low,
                         time ? most_s : column->high, &value, diag) != 0)
        return -1;
    bool frames = column->kind == RECORDED_FRAMES;
    if ((frames || (time && column->scale < 1)) && value != floor(value))
        return refuse(table, place, " is not a whole number", diag);
    if (time)
        cells->row.time_ns = recorded_row_time_ns(value, column->scale);
    if (frames)
        cells->row.time_ns = (int64_t)round(value / table->rate_hz * 1e9);
    value = column->scale * (value + column->shift) + 0.0; /* never -0 */
    if (!time && !frames)
        memcpy((char *)cells + column->offset, &value, sizeof value);
    return 0;
}

static bool is_empty(const struct table *table, int place)
{
    return place == RECORDED_ABSENT ||
           *csv_table_cell(table->rows, table->row, (size_t)place) == '\0';
}

/* Takes class and direction of travel from the file of tracks. */
static int find_track(const struct table *table, const struct recorded_part *part,
                      struct recorded_row *row, struct diag *diag)
{
    uint32_t number;
    if (!intern_find(&table->tracks, row->id, strlen(row->id), &number))
        return refuse(table, (size_t)part->id, "\" is no track of tracksMeta", diag);
    row->class = table->track_list.items[number].class;
    row->direction_rad = table->track_list.items[number].direction_rad;
    return 0;
}

static int read_part(struct table *table, const struct recorded_part *part,
                     struct recorded_row *row, struct diag *diag)
{
    const struct recorded_column *columns = part->kind->columns;
    struct recorded_cells cells = {.row = recorded_row_unsaid};
    cells.row.place = table->rows->numbers[table->row];
    cells.row.class = part->kind->class;
    cells.row.ahead = part->kind->ahead;
    cells.row.passenger = part->kind != table->fit.layout->kinds;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        int at = part->at[i];
        bool may_be_empty = columns[i].need != RECORDED_NEEDED && columns[i].kind != RECORDED_ALIKE;
        bool skipped = at == RECORDED_ABSENT || (may_be_empty && is_empty(table, at));
        if (!skipped && read_cell(table, &columns[i], (size_t)at, &cells, diag) != 0)
            return -1;
    }
    if (table->fit.layout->beside.id != NULL && find_track(table, part, &cells.row, diag) != 0)
        return -1;
    if (table->fit.layout->complete != NULL)
        table->fit.layout->complete(&cells);
    *row = cells.row;
    return RECORDED_ROW;
}

/* A row is of the first kind whose id it has, else of the last; in a wide row all are there who
 * have an id. */
static int next_row(void *state, struct recorded_row *row, struct diag *diag)
{
    struct table *own = state;
    for (;;) {
        if (own->rows == NULL || own->part == own->fit.parts.count) {
            own->part = 0;
            if (own->rows == NULL || ++own->row == own->rows->rows) {
                own->rows = csv_table_next(own->lines, diag);
                own->row = 0;
            }
        }
        if (own->rows == NULL)
            return diag->code == DIAG_OK ? RECORDED_END : -1;
        const struct recorded_part *part = &own->fit.parts.items[own->part++];
        bool wide = own->fit.layout->wide, more = own->part < own->fit.parts.count;
        if (is_empty(own, part->id) && (wide || more))
            continue;
        if (!wide)
            own->part = own->fit.parts.count;
        return read_part(own, part, row, diag);
    }
}

static void close_table(void *state)
{
    struct table *table = state;
    csv_table_close(table->lines);
    input_close(table->input);
}

struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag)
{
    struct table *table = arena_get(arena, sizeof *table);
    table->input = input;
    table->arena = arena;
    if (read_header(table, path, diag) == 0) {
        table->format = table->fit.layout->format;
        table->format.place = "row";
        table->format.next = next_row;
        table->format.close = close_table;
        return (struct recorded_reader){&table->format, table};
    }
    size_t length;
    const char *head = input_head(input, &length);
    file_format_explain("table", head, length, diag);
    close_table(table);
    return (struct recorded_reader){0};
}
