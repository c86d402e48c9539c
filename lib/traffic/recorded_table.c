#include "traffic/recorded_table.h"

#include <math.h>

#include "text/field.h"
#include "text/file_format.h"

static const struct recorded_layout *const layouts[] = {
    &sumo_table_layout, &sumo_table_plain_layout, &ind_table_layout, &highd_table_layout,
    &interaction_table_layout};

enum { LAYOUTS = sizeof layouts / sizeof layouts[0], ABSENT = -1 };

struct recorded_table {
    struct csv_table_rows *lines;
    struct input *input;
    const struct recorded_layout *layout;
    const struct csv_table *rows;               /* of the last line, or NULL */
    size_t row;                                 /* of those, which is read */
    struct recorded_kind kinds[RECORDED_KINDS]; /* that the table has */
    size_t kind_count;
    struct recorded_beside beside;
    int at[RECORDED_KINDS][RECORDED_COLUMNS]; /* the places of their columns; ABSENT */
};

static int place_of(const struct csv_table *names, const char *name)
{
    for (size_t i = 0; i < names->columns; i++)
        if (strcmp(names->header[i], name) == 0)
            return (int)i;
    return ABSENT;
}

static const struct recorded_layout *layout_of(const struct csv_table *names)
{
    size_t i = 0;
    while (i + 1 < LAYOUTS && place_of(names, layouts[i]->mark) == ABSENT)
        i++;
    return layouts[i];
}

/* Finds the columns of a kind. Those that stand together are needed once one of them is there, and
 * the first column of times where there is no other. */
static int find_columns(const struct csv_table *names, const struct recorded_column *columns,
                        int *at, struct diag *diag)
{
    bool together = false, timed = false;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        at[i] = place_of(names, columns[i].name);
        together = together || (columns[i].need == RECORDED_TOGETHER && at[i] != ABSENT);
        timed = timed || (columns[i].kind == RECORDED_TIME && at[i] != ABSENT);
    }
    for (size_t i = 0; columns[i].name != NULL; i++) {
        bool needed = columns[i].kind == RECORDED_TIME       ? !timed
                      : columns[i].need == RECORDED_TOGETHER ? together
                                                             : columns[i].need == RECORDED_NEEDED;
        size_t ignored;
        if (needed && at[i] == ABSENT)
            return csv_table_column(names, columns[i].name, &ignored, diag);
    }
    return 0;
}

/* Of a kind without a column of ids there is nobody, unless it is the only one. */
static int find_kinds(struct recorded_table *table, struct diag *diag)
{
    const struct csv_table *names = csv_table_names(table->lines);
    const struct recorded_kind *kinds = table->layout->kinds;
    for (size_t i = 0; i < RECORDED_KINDS && kinds[i].columns != NULL; i++)
        if (place_of(names, kinds[i].columns[0].name) != ABSENT) {
            size_t kind = table->kind_count++;
            table->kinds[kind] = kinds[i];
            if (find_columns(names, kinds[i].columns, table->at[kind], diag) != 0)
                return -1;
        }
    if (table->kind_count > 0 || kinds[0].columns == NULL)
        return 0;
    return find_columns(names, kinds[0].columns, table->at[0], diag);
}

static int read_header(struct recorded_table *table, const char *path, struct arena *arena,
                       struct diag *diag)
{
    table->lines = csv_table_open(table->input, diag);
    if (table->lines == NULL)
        return -1;
    table->layout = layout_of(csv_table_names(table->lines));
    const struct recorded_beside_columns *beside = &table->layout->beside;
    if (find_kinds(table, diag) != 0)
        return -1;
    return beside->id == NULL ? 0 : recorded_beside_read(&table->beside, beside, path, arena, diag);
}

struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag)
{
    struct recorded_table *table = arena_get(arena, sizeof *table);
    table->input = input;
    if (read_header(table, path, arena, diag) == 0)
        return (struct recorded_reader){&table->layout->format, table};
    size_t length;
    const char *head = input_head(input, &length);
    file_format_explain("table", head, length, diag);
    recorded_table_close(table);
    return (struct recorded_reader){0};
}

void recorded_table_close(void *table)
{
    struct recorded_table *own = table;
    csv_table_close(own->lines);
    input_close(own->input);
}

static int refuse(const struct recorded_table *table, size_t place, const char *what,
                  struct diag *diag)
{
    const struct csv_table *rows = table->rows;
    return diag_fail(diag, DIAG_DATA, "row %zu, column \"%s\": %s%.80s%s",
                     rows->numbers[table->row], rows->header[place], what[0] == '"' ? "\"" : "",
                     csv_table_cell(rows, table->row, place), what);
}

static int read_cell(const struct recorded_table *table, const struct recorded_column *column,
                     size_t place, struct recorded_row *row, struct diag *diag)
{
    const char *text = csv_table_cell(table->rows, table->row, place);
    double most_s = 9e9 / column->scale, value;
    if (column->kind == RECORDED_TEXT) {
        if (!recorded_row_name_fits(text))
            return refuse(table, place, "\"; expected 1 to 1024 printable ASCII characters", diag);
        memcpy((char *)row + column->offset, &text, sizeof text);
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
        row->time_ns = recorded_row_time_ns(value, column->scale);
    if (frames)
        row->time_ns = (int64_t)round(value / table->beside.rate_hz * 1e9);
    value = column->scale * (value + column->shift) + 0.0; /* never -0 */
    if (!time && !frames)
        memcpy((char *)row + column->offset, &value, sizeof value);
    return 0;
}

static bool is_empty(const struct recorded_table *table, int place)
{
    return place == ABSENT || *csv_table_cell(table->rows, table->row, (size_t)place) == '\0';
}

/* Who the track is, as the file beside the table says. */
static int find_track(const struct recorded_table *table, struct recorded_row *row,
                      struct diag *diag)
{
    uint32_t number;
    const struct recorded_beside *beside = &table->beside;
    if (!intern_find(&beside->ids, row->id, strlen(row->id), &number))
        return refuse(table, (size_t)table->at[0][0], "\" is no track of tracksMeta", diag);
    row->class = beside->tracks.items[number].class;
    row->direction_rad = beside->tracks.items[number].direction_rad;
    return 0;
}

/* The row is of the first kind whose id it has, else of the last. */
static int read_row(const struct recorded_table *table, struct recorded_row *row, struct diag *diag)
{
    size_t kind = 0;
    while (kind + 1 < table->kind_count && is_empty(table, table->at[kind][0]))
        kind++;
    const struct recorded_column *columns = table->kinds[kind].columns;
    const int *at = table->at[kind];
    *row = recorded_row_unsaid;
    row->place = table->rows->numbers[table->row];
    row->class = table->kinds[kind].class;
    row->ahead = table->kinds[kind].ahead;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        bool skipped = columns[i].kind == RECORDED_TIME
                           ? at[i] == ABSENT
                           : columns[i].need != RECORDED_NEEDED && is_empty(table, at[i]);
        if (!skipped && read_cell(table, &columns[i], (size_t)at[i], row, diag) != 0)
            return -1;
    }
    if (table->layout->beside.id != NULL && find_track(table, row, diag) != 0)
        return -1;
    if (table->layout->complete != NULL)
        table->layout->complete(row);
    return RECORDED_ROW;
}

int recorded_table_next(void *table, struct recorded_row *row, struct diag *diag)
{
    struct recorded_table *own = table;
    if (own->rows != NULL)
        own->row++;
    if (own->rows == NULL || own->row == own->rows->rows) {
        own->rows = csv_table_next(own->lines, diag);
        own->row = 0;
    }
    if (own->rows == NULL)
        return diag->code == DIAG_OK ? RECORDED_END : -1;
    return read_row(own, row, diag);
}
