/* Rows of a CSV table of recorded traffic. */
#include <ctype.h>
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

enum { ABSENT = -1, NAME_ROOM = 80 };

/* A kind of road user that the table has; in a wide table one road user. */
struct part {
    const struct recorded_kind *kind;
    const char *user;         /* "#1" or "#2" or ... in a wide table, else NULL */
    int id;                   /* the place of its id; ABSENT */
    int at[RECORDED_COLUMNS]; /* the places of its columns; ABSENT: not read */
};

/* A layout, the parts that the table has of it, and the number of needed values that these parts
 * have and lack. */
struct fit {
    const struct recorded_layout *layout;
    LIST_OF(struct part) parts;
    size_t found, lacking;
};

/* A row of the file of tracks. */
struct track {
    const char *class;
    double direction_rad; /* of travel; NAN: not said */
};

struct table {
    struct recorded_format format;
    struct csv_table_rows *lines;
    struct input *input;
    struct fit fit;
    const struct csv_table *names;
    struct intern places;         /* of the columns, by their names */
    struct intern folded;         /* names in lower case */
    LIST_OF(int) folded_places;   /* the first column of each, by the number of the name */
    const struct csv_table *rows; /* of the last line, or NULL */
    size_t row;                   /* of those, which is read */
    size_t part;                  /* of the row, which is next */
    struct intern recordings;
    struct arena *arena;
    double rate_hz; /* of the file of the recording, and from that of the tracks: */
    struct intern tracks;
    LIST_OF(struct track) track_list; /* by the number of the id */
};

static void fold(const char *name, char *room)
{
    size_t length = 0;
    for (; name[length] != '\0' && length + 1 < NAME_ROOM; length++)
        room[length] = (char)tolower((unsigned char)name[length]);
    room[length] = '\0';
}

/* Names the places of all columns. */
static void name_places(struct table *table)
{
    char room[NAME_ROOM];
    for (size_t i = 0; i < table->names->columns; i++) {
        const char *name = table->names->header[i];
        intern_word(&table->places, name, table->arena);
        fold(name, room);
        if (intern_word(&table->folded, room, table->arena) == table->folded_places.count)
            *list_add(&table->folded_places, table->arena) = (int)i;
    }
}

/* The place of a column, else of one whose letters differ in case alone. */
static int place_of(const struct table *table, const char *name)
{
    char room[NAME_ROOM];
    uint32_t place;
    if (intern_find(&table->places, name, strlen(name), &place))
        return (int)place;
    fold(name, room);
    bool known = intern_find(&table->folded, room, strlen(room), &place);
    return known ? table->folded_places.items[place] : ABSENT;
}

/* ---- the layout ---- */

/* The name of a column; in a wide table that of a road user. */
static const char *name_of(const struct recorded_column *column, const char *user, char *room)
{
    if (user == NULL || column->kind == RECORDED_TIME)
        return column->name;
    snprintf(room, NAME_ROOM, "%s %s", user, column->name);
    return room;
}

static bool same_value(const struct recorded_column *a, const struct recorded_column *b)
{
    return a->kind == b->kind && a->offset == b->offset;
}

/* Finds the columns of a kind, of each value the first spelling. */
static struct part part_of(const struct table *table, const struct recorded_kind *kind,
                           const char *user)
{
    const struct recorded_column *columns = kind->columns;
    struct part part = {.kind = kind, .user = user, .id = ABSENT};
    char room[NAME_ROOM];
    bool found = false;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        found = found && same_value(&columns[i - 1], &columns[i]);
        part.at[i] = found ? ABSENT : place_of(table, name_of(&columns[i], user, room));
        found = found || part.at[i] != ABSENT;
        if (part.id == ABSENT && same_value(columns, &columns[i]))
            part.id = part.at[i];
    }
    return part;
}

/* Values that stand together are needed once one of them is there. */
static bool is_needed(const struct part *part, const struct recorded_column *column)
{
    const struct recorded_column *columns = part->kind->columns;
    bool together = false;
    for (size_t i = 0; columns[i].name != NULL; i++)
        together = together || (columns[i].need == RECORDED_TOGETHER && part->at[i] != ABSENT);
    return column->need == RECORDED_NEEDED || (column->need == RECORDED_TOGETHER && together);
}

/* Adds the names of columns of which one is lacking. */
static void add_names(const struct part *part, size_t from, size_t end, struct text *names)
{
    char room[NAME_ROOM];
    for (size_t i = from; i < end; i++) {
        const char *between = names->length > 0 ? ", " : "";
        text_format(names, "%s\"%s\"", i > from ? " or " : between,
                    name_of(&part->kind->columns[i], part->user, room));
    }
}

/* Counts the needed values, and adds the names of lacking columns to the text, if there is one. */
static void count_values(struct fit *fit, const struct part *part, struct text *names)
{
    const struct recorded_column *columns = part->kind->columns;
    for (size_t i = 0, end; columns[i].name != NULL; i = end) {
        bool found = false;
        for (end = i; columns[end].name != NULL && same_value(&columns[i], &columns[end]); end++)
            found = found || part->at[end] != ABSENT;
        if (!is_needed(part, &columns[i]))
            continue;
        fit->found += found;
        fit->lacking += !found;
        if (names != NULL && !found)
            add_names(part, i, end, names);
    }
}

/* Adds every road user that a column names, whatever its number is; without any, "#1". */
static void add_users(struct table *table, struct fit *fit)
{
    struct intern users = {0};
    for (size_t i = 0; i < table->names->columns; i++) {
        const char *name = table->names->header[i];
        size_t length = strcspn(name, " ");
        if (*name == '#' && length > 1 && strspn(name + 1, "0123456789") == length - 1)
            intern_number(&users, name, length, table->arena);
    }
    if (users.list.count == 0)
        intern_word(&users, "#1", table->arena);
    for (uint32_t i = 0; i < users.list.count; i++)
        *list_add(&fit->parts, table->arena) =
            part_of(table, fit->layout->kinds, intern_text(&users, i));
}

/* Adds the kinds that have a column of ids; without any, the first. */
static void add_kinds(struct table *table, struct fit *fit)
{
    const struct recorded_kind *kinds = fit->layout->kinds;
    for (size_t i = 0; i < RECORDED_KINDS && kinds[i].columns != NULL; i++) {
        struct part part = part_of(table, &kinds[i], NULL);
        if (part.id != ABSENT)
            *list_add(&fit->parts, table->arena) = part;
    }
    if (fit->parts.count == 0)
        *list_add(&fit->parts, table->arena) = part_of(table, kinds, NULL);
}

static struct fit fit_of(struct table *table, const struct recorded_layout *layout)
{
    struct fit fit = {.layout = layout};
    if (layout->wide)
        add_users(table, &fit);
    else
        add_kinds(table, &fit);
    for (size_t i = 0; i < fit.parts.count; i++)
        count_values(&fit, &fit.parts.items[i], NULL);
    return fit;
}

/* Names the nearest layout with what it lacks, and the header. */
static int refuse_header(const struct table *table, struct diag *diag)
{
    enum { MOST = 600 };
    struct fit counted = {0};
    struct text lacking = {0}, header = {0};
    for (size_t i = 0; i < table->fit.parts.count; i++)
        count_values(&counted, &table->fit.parts.items[i], &lacking);
    for (size_t i = 0; i < table->names->columns; i++)
        text_format(&header, "%s%s", i > 0 ? ", " : "", table->names->header[i]);
    int names = (int)(lacking.length < MOST ? lacking.length : MOST);
    int length = (int)(header.length < MOST ? header.length : MOST);
    if (counted.found == 0)
        diag_fail(diag, DIAG_DATA, "no column is one that a layout needs; the header is: %.*s",
                  length, header.bytes);
    else
        diag_fail(diag, DIAG_DATA,
                  "column%s %.*s %s missing for %s, the nearest layout; the header is: %.*s",
                  counted.lacking > 1 ? "s" : "", names, lacking.bytes,
                  counted.lacking > 1 ? "are" : "is", table->fit.layout->format.name, length,
                  header.bytes);
    text_free(&lacking);
    text_free(&header);
    return -1;
}

/* Finds the layout of whose needed values the table has the largest share, and of equal shares the
 * most; refuses the table if it lacks any. */
static int find_layout(struct table *table, struct diag *diag)
{
    struct fit *best = &table->fit;
    for (size_t i = 0; i < RECORDED_LAYOUTS; i++) {
        struct fit fit = fit_of(table, &recorded_layouts[i]);
        size_t own = fit.found * (best->found + best->lacking);
        size_t least = best->found * (fit.found + fit.lacking);
        if (i == 0 || own > least || (own == least && fit.found > best->found))
            *best = fit;
    }
    return best->lacking == 0 ? 0 : refuse_header(table, diag);
}

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
    table->names = csv_table_names(table->lines);
    name_places(table);
    if (find_layout(table, diag) != 0)
        return -1;
    return table->fit.layout->beside.id == NULL ||
                   (read_beside(table, path, "recordingMeta", take_recording, diag) == 0 &&
                    read_beside(table, path, "tracksMeta", take_track, diag) == 0)
               ? 0
               : -1;
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
    return place == ABSENT || *csv_table_cell(table->rows, table->row, (size_t)place) == '\0';
}

/* Takes class and direction of travel from the file of tracks. */
static int find_track(const struct table *table, const struct part *part, struct recorded_row *row,
                      struct diag *diag)
{
    uint32_t number;
    if (!intern_find(&table->tracks, row->id, strlen(row->id), &number))
        return refuse(table, (size_t)part->id, "\" is no track of tracksMeta", diag);
    row->class = table->track_list.items[number].class;
    row->direction_rad = table->track_list.items[number].direction_rad;
    return 0;
}

static int read_part(struct table *table, const struct part *part, struct recorded_row *row,
                     struct diag *diag)
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
        bool skipped = at == ABSENT || (may_be_empty && is_empty(table, at));
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
        const struct part *part = &own->fit.parts.items[own->part++];
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
