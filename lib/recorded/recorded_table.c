#include "recorded/recorded_table.h"

#include <math.h>
#include <stdio.h>
#include <strings.h>

#include "text/field.h"
#include "text/file_format.h"

static const struct recorded_layout *const layouts[] = {
    &sumo_table_layout,  &sumo_table_plain_layout, &ind_table_layout,        &highd_table_layout,
    &ngsim_table_layout, &esmini_table_layout,     &interaction_table_layout};

static const struct csv_table_form form = {
    .names = ngsim_table_names, .preamble = "esmini ", .header = "Index "};

enum { LAYOUTS = sizeof layouts / sizeof layouts[0], ABSENT = -1, NAME_ROOM = 80 };

/* A kind of road user that the table has; in a wide table one road user. */
struct part {
    const struct recorded_kind *kind;
    int at[RECORDED_COLUMNS]; /* the places of its columns; ABSENT */
};

struct recorded_table {
    struct csv_table_rows *lines;
    struct input *input;
    const struct recorded_layout *layout;
    const struct csv_table *names;
    struct intern places;         /* of the columns, by their names */
    const struct csv_table *rows; /* of the last line, or NULL */
    size_t row;                   /* of those, which is read */
    LIST_OF(struct part) parts;
    size_t part; /* of the row, which is next */
    struct intern recordings;
    struct arena *arena;
    struct recorded_beside beside;
};

/* Where letters differ in case a column is found by looking at all of them. */
static int place_of(const struct recorded_table *table, const char *name)
{
    uint32_t place;
    if (intern_find(&table->places, name, strlen(name), &place))
        return (int)place;
    for (size_t i = 0; i < table->names->columns; i++)
        if (strcasecmp(table->names->header[i], name) == 0)
            return (int)i;
    return ABSENT;
}

static const struct recorded_layout *layout_of(const struct recorded_table *table)
{
    size_t i = 0;
    while (i + 1 < LAYOUTS && place_of(table, layouts[i]->mark) == ABSENT)
        i++;
    return layouts[i];
}

/* The name of a column; in a wide table that of a road user, "#1" or "#2" or ... */
static const char *name_of(const struct recorded_column *column, const char *user, char *room)
{
    if (user == NULL || column->kind == RECORDED_TIME)
        return column->name;
    snprintf(room, NAME_ROOM, "%s %s", user, column->name);
    return room;
}

/* Finds the columns of a kind. Those that stand together are needed once one of them is there, and
 * the first column of times where there is no other. */
static int find_columns(const struct recorded_table *table, struct part *part, const char *user,
                        struct diag *diag)
{
    const struct recorded_column *columns = part->kind->columns;
    bool together = false, timed = false;
    char room[NAME_ROOM];
    for (size_t i = 0; columns[i].name != NULL; i++) {
        int at = part->at[i] = place_of(table, name_of(&columns[i], user, room));
        together = together || (columns[i].need == RECORDED_TOGETHER && at != ABSENT);
        timed = timed || (columns[i].kind == RECORDED_TIME && at != ABSENT);
    }
    for (size_t i = 0; columns[i].name != NULL; i++) {
        bool needed = columns[i].kind == RECORDED_TIME       ? !timed
                      : columns[i].need == RECORDED_TOGETHER ? together
                                                             : columns[i].need == RECORDED_NEEDED;
        size_t ignored;
        if (needed && part->at[i] == ABSENT)
            return csv_table_column(table->names, name_of(&columns[i], user, room), &ignored, diag);
    }
    return 0;
}

static int add_part(struct recorded_table *table, const struct recorded_kind *kind,
                    const char *user, struct diag *diag)
{
    struct part *part = list_add(&table->parts, table->arena);
    part->kind = kind;
    return find_columns(table, part, user, diag);
}

/* Whoever has a column, whatever the numbers are, or else "#1", which is refused. */
static int find_users(struct recorded_table *table, struct diag *diag)
{
    const struct recorded_kind *kind = table->layout->kinds;
    struct intern users = {0};
    for (size_t i = 0; i < table->names->columns; i++) {
        const char *name = table->names->header[i];
        size_t length = strcspn(name, " ");
        if (*name != '#' || length == 1 || strspn(name + 1, "0123456789") != length - 1)
            continue;
        uint32_t user = intern_number(&users, name, length, table->arena);
        if (user == table->parts.count &&
            add_part(table, kind, intern_text(&users, user), diag) != 0)
            return -1;
    }
    return table->parts.count > 0 ? 0 : add_part(table, kind, "#1", diag);
}

/* Of a kind without a column of ids there is nobody, unless all lack it: then the first is
 * refused. */
static int find_kinds(struct recorded_table *table, struct diag *diag)
{
    const struct recorded_kind *kinds = table->layout->kinds, *kind = kinds;
    do {
        if (place_of(table, kind->columns->name) != ABSENT &&
            add_part(table, kind, NULL, diag) != 0)
            return -1;
    } while (++kind < kinds + RECORDED_KINDS && kind->columns != NULL);
    return table->parts.count > 0 ? 0 : add_part(table, kinds, NULL, diag);
}

static int read_header(struct recorded_table *table, const char *path, struct diag *diag)
{
    struct arena *arena = table->arena;
    table->lines = csv_table_open(table->input, &form, diag);
    if (table->lines == NULL)
        return -1;
    table->names = csv_table_names(table->lines);
    for (size_t i = 0; i < table->names->columns; i++)
        intern_word(&table->places, table->names->header[i], arena);
    table->layout = layout_of(table);
    if ((table->layout->wide ? find_users : find_kinds)(table, diag) != 0)
        return -1;
    const struct recorded_beside_columns *beside = &table->layout->beside;
    return beside->id == NULL ? 0 : recorded_beside_read(&table->beside, beside, path, arena, diag);
}

struct recorded_reader recorded_table_open(struct input *input, const char *path,
                                           struct arena *arena, struct diag *diag)
{
    struct recorded_table *table = arena_get(arena, sizeof *table);
    table->input = input;
    table->arena = arena;
    if (read_header(table, path, diag) == 0)
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

static int read_cell(struct recorded_table *table, const struct recorded_column *column,
                     size_t place, struct recorded_cells *cells, struct diag *diag)
{
    const char *text = csv_table_cell(table->rows, table->row, place);
    double most_s = 9e9 / column->scale, value;
    if (column->kind == RECORDED_ALIKE && intern_word(&table->recordings, text, table->arena) > 0)
        return refuse(table, place, "\" is another recording; expected that of all rows", diag);
    if (column->kind == RECORDED_ALIKE)
        return 0;
    if (column->kind == RECORDED_TEXT) {
        if (!recorded_row_name_fits(text))
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
        cells->row.time_ns = (int64_t)round(value / table->beside.rate_hz * 1e9);
    value = column->scale * (value + column->shift) + 0.0; /* never -0 */
    if (!time && !frames)
        memcpy((char *)cells + column->offset, &value, sizeof value);
    return 0;
}

static bool is_empty(const struct recorded_table *table, int place)
{
    return place == ABSENT || *csv_table_cell(table->rows, table->row, (size_t)place) == '\0';
}

/* Who the track is, as the file beside the table says. */
static int find_track(const struct recorded_table *table, const struct part *part,
                      struct recorded_row *row, struct diag *diag)
{
    uint32_t number;
    const struct recorded_beside *beside = &table->beside;
    if (!intern_find(&beside->ids, row->id, strlen(row->id), &number))
        return refuse(table, (size_t)part->at[0], "\" is no track of tracksMeta", diag);
    row->class = beside->tracks.items[number].class;
    row->direction_rad = beside->tracks.items[number].direction_rad;
    return 0;
}

static int read_part(struct recorded_table *table, const struct part *part,
                     struct recorded_row *row, struct diag *diag)
{
    const struct recorded_column *columns = part->kind->columns;
    struct recorded_cells cells = {.row = recorded_row_unsaid};
    cells.row.place = table->rows->numbers[table->row];
    cells.row.class = part->kind->class;
    cells.row.ahead = part->kind->ahead;
    cells.row.passenger = part->kind != table->layout->kinds;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        int at = part->at[i];
        bool skipped = columns[i].kind == RECORDED_TIME
                           ? at == ABSENT
                           : columns[i].need != RECORDED_NEEDED && is_empty(table, at) &&
                                 (at == ABSENT || columns[i].kind != RECORDED_ALIKE);
        if (!skipped && read_cell(table, &columns[i], (size_t)at, &cells, diag) != 0)
            return -1;
    }
    if (table->layout->beside.id != NULL && find_track(table, part, &cells.row, diag) != 0)
        return -1;
    if (table->layout->complete != NULL)
        table->layout->complete(&cells);
    *row = cells.row;
    return RECORDED_ROW;
}

/* A row is of the first kind whose id it has, else of the last; in a wide row all are there who
 * have an id. */
int recorded_table_next(void *table, struct recorded_row *row, struct diag *diag)
{
    struct recorded_table *own = table;
    for (;;) {
        if (own->rows == NULL || own->part == own->parts.count) {
            own->part = 0;
            if (own->rows == NULL || ++own->row == own->rows->rows) {
                own->rows = csv_table_next(own->lines, diag);
                own->row = 0;
            }
        }
        if (own->rows == NULL)
            return diag->code == DIAG_OK ? RECORDED_END : -1;
        const struct part *part = &own->parts.items[own->part++];
        bool wide = own->layout->wide, more = own->part < own->parts.count;
        if (is_empty(own, part->at[0]) && (wide || more))
            continue;
        if (!wide)
            own->part = own->parts.count;
        return read_part(own, part, row, diag);
    }
}
