#include "documents/suite_file.h"

#include <stdio.h>

#include "base/hash.h"
#include "base/intern.h"
#include "base/units.h"
#include "documents/consistency.h"
#include "text/csv_table.h"
#include "text/document.h"
#include "text/path.h"
#include "text/record_write.h"

/* The path of a table by its name in a document, which is relative to the document. */
static const char *path_beside(const char *document, const char *table, struct arena *arena)
{
    const char *slash = strrchr(document, '/');
    if (table[0] == '/' || slash == NULL)
        return table;
    return arena_format(arena, "%.*s%s", (int)(slash + 1 - document), document, table);
}

static int columns_of(const struct csv_table *table, const char *const *names, size_t count,
                      size_t *columns, struct diag *diag)
{
    for (size_t i = 0; i < count; i++)
        if (csv_table_column(table, names[i], &columns[i], diag) != 0)
            return -1;
    return 0;
}

/* Levels over a column that ascends; NULL after a message. */
static struct receiver_curve_row *read_levels(const struct text *bytes, const char *over,
                                              double least, double most, size_t *count,
                                              struct arena *arena, struct diag *diag)
{
    const char *names[] = {over, "level_db"};
    struct csv_table table;
    size_t column[2];
    if (csv_table_parse(bytes, &table, arena, diag) != 0 ||
        columns_of(&table, names, 2, column, diag) != 0)
        return NULL;
    struct receiver_curve_row *rows = arena_get(arena, table.rows * sizeof *rows);
    for (size_t i = 0; i < table.rows; i++) {
        if (csv_table_number(&table, i, column[0], least, most, &rows[i].at, diag) != 0 ||
            csv_table_number(&table, i, column[1], -1e3, 1e3, &rows[i].level_db, diag) != 0)
            return NULL;
        if (i > 0 && rows[i].at <= rows[i - 1].at) {
            diag_fail(diag, DIAG_CONFIG, "row %zu: %s must ascend", table.numbers[i], over);
            return NULL;
        }
    }
    *count = table.rows;
    if (table.rows >= 2)
        return rows;
    diag_fail(diag, DIAG_CONFIG, "rows: %zu; expected at least 2", table.rows);
    return NULL;
}

/* A table that a suite names: a curve over an angle, which must reach this far to either side, or
 * what `read` reads. */
struct table {
    const char *member, *name, *over;
    double reach_rad;
    struct receiver_curve *curve;
    int (*read)(const struct text *, struct sensor *, struct arena *, struct diag *);
};

static int read_range_curve(const struct text *bytes, struct sensor *sensor, struct arena *arena,
                            struct diag *diag)
{
    size_t count;
    const struct receiver_curve_row *levels =
        read_levels(bytes, "range_m", 1e-6, 1e6, &count, arena, diag);
    if (levels == NULL)
        return -1;
    struct radar_row *rows = arena_get(arena, count * sizeof *rows);
    for (size_t i = 0; i < count; i++)
        rows[i] = (struct radar_row){levels[i].at,
                                     units_amplitude_from_db(levels[i].level_db) / radar_ercs(1)};
    sensor->amplitude_law.rows = rows;
    sensor->amplitude_law.row_count = count;
    return 0;
}

static int read_angle_curve(const struct text *bytes, const struct table *table,
                            struct arena *arena, struct diag *diag)
{
    struct receiver_curve *curve = table->curve;
    curve->rows = read_levels(bytes, table->over, -PI / 2, PI / 2, &curve->count, arena, diag);
    if (curve->rows == NULL)
        return -1;
    curve->ahead_db = receiver_curve_level_db(curve, 0);
    double first = curve->rows[0].at, last = curve->rows[curve->count - 1].at;
    if (first <= -table->reach_rad && last >= table->reach_rad)
        return 0;
    return diag_fail(diag, DIAG_CONFIG, "%s: from %g to %g; expected at least from %g to %g%s",
                     table->over, first, last, 0 - table->reach_rad, table->reach_rad,
                     table->reach_rad > 0 ? ", the field of view" : "");
}

static int read_pattern(const struct text *bytes, struct sensor *sensor, struct arena *arena,
                        struct diag *diag)
{
    static const char *const names[] = {"azimuth_rad", "sum", "delta"};
    struct csv_table table;
    size_t column[3];
    if (csv_table_parse(bytes, &table, arena, diag) != 0 ||
        columns_of(&table, names, 3, column, diag) != 0)
        return -1;
    struct antenna_row *rows = arena_get(arena, table.rows * sizeof *rows);
    for (size_t i = 0; i < table.rows; i++)
        if (csv_table_number(&table, i, column[0], -2, 2, &rows[i].azimuth_rad, diag) != 0 ||
            csv_table_number(&table, i, column[1], 0, 1e300, &rows[i].sum, diag) != 0 ||
            csv_table_number(&table, i, column[2], -1e300, 1e300, &rows[i].delta, diag) != 0)
            return -1;
    size_t row = 0;
    const char *fault = antenna_table_fault(rows, table.rows, &row);
    if (fault != NULL)
        return diag_fail(diag, DIAG_CONFIG, "row %zu: %s",
                         row < table.rows ? table.numbers[row] : table.rows + 2, fault);
    sensor->antenna.rows = rows;
    sensor->antenna.row_count = table.rows;
    return 0;
}

static int add_table(const struct table *table, const char *suite_path, struct sensor *sensor,
                     struct arena *arena, struct diag *diag)
{
    if (table->name == NULL)
        return 0;
    const char *path = path_beside(suite_path, table->name, arena);
    struct text bytes = {0};
    int result = document_bytes(path, &bytes, diag);
    if (result == 0) {
        result = table->read != NULL ? table->read(&bytes, sensor, arena, diag)
                                     : read_angle_curve(&bytes, table, arena, diag);
        if (result != 0)
            diag_prefix(diag, "%s: ", path);
    }
    text_free(&bytes);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", table->member);
}

static int add_tables(const char *suite_path, struct sensor *sensor, struct arena *arena,
                      struct diag *diag)
{
    double border_rad = antenna_border_rad(sensor->field_of_view_rad);
    const struct table tables[] = {
        {"range_curve", sensor->range_curve, .read = read_range_curve},
        {"azimuth_curve", sensor->azimuth_curve, "azimuth_rad", border_rad, &sensor->antenna.curve,
         NULL},
        {"elevation_curve", sensor->elevation_curve, "elevation_rad", 0, &sensor->elevation_levels,
         NULL},
        {"azimuth_floor_curve", sensor->azimuth_floor_curve, "azimuth_rad", 0,
         &sensor->floor_levels, NULL},
        {"antenna_table", sensor->antenna_table, .read = read_pattern},
    };
    int result = 0;
    for (size_t i = 0; result == 0 && i < sizeof tables / sizeof tables[0]; i++)
        result = add_table(&tables[i], suite_path, sensor, arena, diag);
    return result;
}

static void add_levels(const struct receiver_curve *curve, struct text *values)
{
    for (size_t i = 0; i < curve->count; i++)
        text_format(values, "%.17g,%.17g\n", curve->rows[i].at, curve->rows[i].level_db);
    text_add_word(values, "\n");
}

/* The members of a sensor, and the rows of its tables instead of their names. */
static void add_sensor(const struct sensor *sensor, struct text *values)
{
    struct sensor plain = *sensor;
    const struct radar_row *range = sensor->amplitude_law.rows;
    const struct antenna_row *antenna = sensor->antenna.rows;
    plain.range_curve = plain.azimuth_curve = plain.elevation_curve = NULL;
    plain.azimuth_floor_curve = plain.antenna_table = NULL;
    record_write(&sensor_record, &plain, NULL, values);
    for (size_t i = 0; i < sensor->amplitude_law.row_count; i++)
        text_format(values, "%.17g,%.17g\n", range[i].range_m, range[i].amplitude);
    for (size_t i = 0; i < sensor->antenna.row_count; i++)
        text_format(values, "%.17g,%.17g,%.17g\n", antenna[i].azimuth_rad, antenna[i].sum,
                    antenna[i].delta);
    add_levels(&sensor->antenna.curve, values);
    add_levels(&sensor->elevation_levels, values);
    add_levels(&sensor->floor_levels, values);
}

/* A hash of the values, so that neither spelling, nor texts for people, nor what objects are
 * extracted with change it. */
static void set_digest(struct suite *suite)
{
    struct text values = {0};
    struct suite nameless = *suite;
    nameless.origin = "";
    nameless.vehicles = NULL;
    nameless.assumed.count = nameless.sensors.count = 0;
    record_write(&suite_record, &nameless, NULL, &values);
    for (size_t i = 0; i < suite->sensors.count; i++)
        add_sensor(&suite->sensors.items[i], &values);
    uint64_t digest = hash_bytes(HASH_START, values.bytes, values.length);
    snprintf(suite->digest, sizeof suite->digest, "%016llx", (unsigned long long)digest);
    text_free(&values);
}

static int complete_suite(struct suite *suite, const char *path, const char *beside,
                          struct arena *arena, struct diag *diag)
{
    if (suite->sensors.count == 0)
        return diag_fail(diag, DIAG_CONFIG, "%s: sensors: none; expected at least one", path);
    struct intern names = intern_begin(suite->sensors.count, arena);
    for (size_t i = 0; i < suite->sensors.count; i++) {
        struct sensor *sensor = &suite->sensors.items[i];
        if (intern_word(&names, sensor->name, arena) < i)
            return diag_fail(diag, DIAG_CONFIG, "%s: sensors[%zu].name: \"%s\" stands twice", path,
                             i, sensor->name);
        if (consistency_members(sensor, diag) != 0)
            return diag_prefix(diag, "%s: sensors[%zu].", path, i);
        suite_derive(sensor);
        if (add_tables(beside, sensor, arena, diag) != 0)
            return diag_prefix(diag, "%s: sensors[%zu].", path, i);
        if (consistency_check(sensor, i, diag) != 0)
            return diag_prefix(diag, "%s: ", path);
    }
    set_digest(suite);
    return 0;
}

/* "my-radar" of "./my-radar.json": frames carry no paths. */
static const char *plain_name(const char *given, struct arena *arena)
{
    const char *slash = strrchr(given, '/'), *begin = slash != NULL ? slash + 1 : given;
    const char *ending = strstr(begin, ".json");
    return arena_text(arena, begin,
                      ending != NULL && ending > begin ? (size_t)(ending - begin) : strlen(begin));
}

/* ---- suites that extend others ---- */

/* A suite's document, with the members that it has from others. */
struct whole {
    const char *line;
    const char *beside; /* what the paths of its tables are relative to; "": the working folder */
};

/* A document that is being read, and the one that extends it; NULL: none. */
struct reading {
    const char *path;
    const struct reading *of;
};

static int read_whole(const struct reading *reading, struct whole *whole, struct arena *arena,
                      struct diag *diag);

/* The document with paths of tables from the working folder. */
static const char *moved(const struct whole *whole, struct arena *arena)
{
    static const char *const tables[] = {"range_curve",         "azimuth_curve", "elevation_curve",
                                         "azimuth_floor_curve", "antenna_table", NULL};
    return document_moved(whole->line, tables, path_beside(whole->beside, "", arena), arena);
}

static bool is_in_circle(const char *path, const struct reading *reading)
{
    while (reading != NULL && !path_same_file(path, reading->path))
        reading = reading->of;
    return reading != NULL;
}

/* Puts the members of the base around those of the suite. The base must be a suite by itself. */
static int extend(const char *base_name, const struct reading *reading, struct whole *whole,
                  struct arena *arena, struct diag *diag)
{
    const char *word = base_name;
    if (document_is_path(base_name))
        word = path_beside(reading->path, base_name, arena);
    const char *path = document_find_file(NULL, "sensors", word, ".json", arena, diag);
    if (path == NULL)
        return -1;
    if (is_in_circle(path, reading))
        return diag_fail(diag, DIAG_CONFIG,
                         "\"%s\"; expected a suite that does not extend this one", base_name);
    struct suite *alone = arena_get(arena, sizeof *alone);
    struct whole base;
    if (read_whole(&(struct reading){path, reading}, &base, arena, diag) != 0 ||
        document_take(path, base.line, &suite_record, alone, arena, diag) != 0)
        return -1;
    whole->line = document_extended(moved(&base, arena), moved(whole, arena), arena);
    whole->beside = "";
    return 0;
}

static int read_whole(const struct reading *reading, struct whole *whole, struct arena *arena,
                      struct diag *diag)
{
    const char *path = reading->path;
    struct text bytes = {0};
    *whole = (struct whole){.beside = path};
    if (document_bytes(path, &bytes, diag) == 0)
        whole->line = document_line(path, &bytes, suite_record.name, arena, diag);
    text_free(&bytes);
    if (whole->line == NULL)
        return -1;
    const char *base = document_base(whole->line, arena, diag);
    if (base == NULL)
        return diag->code == DIAG_OK ? 0 : diag_prefix(diag, "%s: ", path);
    if (extend(base, reading, whole, arena, diag) != 0)
        return diag_prefix(diag, "%s: extends: ", path);
    return 0;
}

const struct suite *suite_file_load(const char *name, struct arena *arena, struct diag *diag)
{
    const char *path = document_find_file(NULL, "sensors", name, ".json", arena, diag);
    if (path == NULL)
        return NULL;
    struct suite *suite = arena_get(arena, sizeof *suite);
    struct whole whole;
    int result = read_whole(&(struct reading){path, NULL}, &whole, arena, diag);
    if (result == 0)
        result = document_take(path, whole.line, &suite_record, suite, arena, diag);
    if (result == 0)
        result = complete_suite(suite, path, whole.beside, arena, diag);
    suite->given = arena_text(arena, name, strlen(name));
    suite->name = plain_name(name, arena);
    if (result != 0 && diag->code != DIAG_MEMORY)
        diag->code = DIAG_CONFIG;
    return result == 0 ? suite : NULL;
}
