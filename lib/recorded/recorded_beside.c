#include "recorded/recorded_beside.h"

#include <math.h>

#include "base/units.h"

struct reading {
    struct recorded_beside *beside;
    const struct recorded_beside_columns *columns;
    const struct csv_table *row;
    struct arena *arena;
    struct diag *diag;
};

/* The value of a column in the row. */
static int take_number(const struct reading *reading, const char *name, double low, double high,
                       double *value)
{
    size_t column;
    if (csv_table_column(reading->row, name, &column, reading->diag) != 0)
        return -1;
    return csv_table_number(reading->row, 0, column, low, high, value, reading->diag);
}

static const char *take_text(const struct reading *reading, const char *name)
{
    size_t column;
    if (csv_table_column(reading->row, name, &column, reading->diag) != 0)
        return NULL;
    const char *text = csv_table_cell(reading->row, 0, column);
    return arena_text(reading->arena, text, strlen(text));
}

static int take_recording(struct reading *reading)
{
    if (reading->beside->rate_hz != 0)
        return diag_fail(reading->diag, DIAG_DATA, "row %zu: a second recording; expected one",
                         reading->row->numbers[0]);
    return take_number(reading, "frameRate", 1, 1e6, &reading->beside->rate_hz);
}

static int take_track(struct reading *reading)
{
    const struct recorded_beside_columns *columns = reading->columns;
    struct recorded_beside *beside = reading->beside;
    const char *id = take_text(reading, columns->id), *class = take_text(reading, "class");
    double direction = 2;
    if (id == NULL || class == NULL)
        return -1;
    if (columns->direction != NULL && take_number(reading, columns->direction, 1, 2, &direction))
        return -1;
    if (intern_word(&beside->ids, id, reading->arena) < beside->tracks.count)
        return diag_fail(reading->diag, DIAG_DATA, "row %zu: %s %.80s is in a row above already",
                         reading->row->numbers[0], columns->id, id);
    *list_add(&beside->tracks, reading->arena) =
        (struct recorded_track){class, columns->direction == NULL ? (double)NAN
                                       : direction == 1           ? PI
                                                                  : 0};
    return 0;
}

/* Opens the file whose name has these letters in place of "tracks", with which the table's own name
 * ends but for its endings; plain or gzip. NULL after a message; *path is the name in either
 * case. */
static struct input *open_beside(const char *table_path, const char *name, const char **path,
                                 const struct reading *reading)
{
    enum { LETTERS = sizeof "tracks" - 1 };
    const char *slash = strrchr(table_path, '/'), *base = slash != NULL ? slash + 1 : table_path;
    size_t length = strcspn(base, "."), plain = strlen(base + length);
    const char *ending = base + length;
    *path = table_path;
    if (length < LETTERS || memcmp(ending - LETTERS, "tracks", LETTERS) != 0) {
        diag_fail(reading->diag, DIAG_DATA,
                  "expected a table named NN_tracks.csv, to find NN_%s.csv beside it", name);
        return NULL;
    }
    if (plain > 3 && strcmp(ending + plain - 3, ".gz") == 0)
        plain -= 3;
    *path = arena_format(reading->arena, "%.*s%s%.*s", (int)(ending - LETTERS - table_path),
                         table_path, name, (int)plain, ending);
    struct diag fault = {0};
    struct input *input = input_open(*path, &fault);
    if (input != NULL)
        return input;
    const char *packed = arena_format(reading->arena, "%s.gz", *path);
    input = input_open(packed, reading->diag);
    if (input == NULL)
        *reading->diag = fault;
    *path = input != NULL ? packed : *path;
    return input;
}

/* Reads the file row by row; returns how many rows there are, -1 after a message. */
static int read_rows(struct reading *reading, const char *table_path, const char *name,
                     int (*take)(struct reading *reading))
{
    struct diag *diag = reading->diag;
    const char *path;
    struct input *input = open_beside(table_path, name, &path, reading);
    struct csv_table_rows *rows = input != NULL ? csv_table_open(input, NULL, diag) : NULL;
    int count = 0;
    while (rows != NULL && count >= 0 && (reading->row = csv_table_next(rows, diag)) != NULL)
        count = take(reading) == 0 ? count + 1 : -1;
    if (diag->code == DIAG_OK && count == 0)
        diag_fail(diag, DIAG_DATA, "there is no row below the header");
    csv_table_close(rows);
    input_close(input);
    return diag->code == DIAG_OK ? count : diag_prefix(diag, "%s: ", path);
}

int recorded_beside_read(struct recorded_beside *beside,
                         const struct recorded_beside_columns *columns, const char *table_path,
                         struct arena *arena, struct diag *diag)
{
    struct reading reading = {.beside = beside, .columns = columns, .arena = arena, .diag = diag};
    return read_rows(&reading, table_path, "recordingMeta", take_recording) > 0 &&
                   read_rows(&reading, table_path, "tracksMeta", take_track) > 0
               ? 0
               : -1;
}
