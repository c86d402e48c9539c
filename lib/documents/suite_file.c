#include "documents/suite_file.h"

#include <stdio.h>

#include "base/hash.h"
#include "base/intern.h"
#include "documents/consistency.h"
#include "text/csv_table.h"
#include "text/document.h"

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

static int read_amplitudes(const struct text *bytes, struct sensor *sensor, struct arena *arena,
                           struct diag *diag)
{
    static const char *const names[] = {"range_m", "amplitude"};
    struct csv_table table;
    size_t column[2];
    if (csv_table_parse(bytes, &table, arena, diag) != 0 ||
        columns_of(&table, names, 2, column, diag) != 0)
        return -1;
    struct radar_row *rows = arena_get(arena, table.rows * sizeof *rows);
    for (size_t i = 0; i < table.rows; i++) {
        if (csv_table_number(&table, i, column[0], 1e-6, 1e6, &rows[i].range_m, diag) != 0 ||
            csv_table_number(&table, i, column[1], 1e-300, 1e300, &rows[i].amplitude, diag) != 0)
            return -1;
        if (i > 0 && rows[i].range_m <= rows[i - 1].range_m)
            return diag_fail(diag, DIAG_CONFIG, "row %zu: range_m must ascend", table.numbers[i]);
    }
    if (table.rows < 2)
        return diag_fail(diag, DIAG_CONFIG, "rows: %zu; expected at least 2", table.rows);
    sensor->amplitude_law.rows = rows;
    sensor->amplitude_law.row_count = table.rows;
    return 0;
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

/* Reads one table that the suite names and adds its bytes to the digest. */
static int
add_table(const char *member, const char *suite_path, const char *name, struct sensor *sensor,
          int (*read_table)(const struct text *, struct sensor *, struct arena *, struct diag *),
          uint64_t *digest, struct arena *arena, struct diag *diag)
{
    if (name == NULL)
        return 0;
    const char *path = path_beside(suite_path, name, arena);
    struct text bytes = {0};
    int result = document_bytes(path, &bytes, diag);
    if (result == 0) {
        *digest = hash_bytes(*digest, bytes.bytes, bytes.length);
        result = read_table(&bytes, sensor, arena, diag);
        if (result != 0)
            diag_prefix(diag, "%s: ", path);
    }
    text_free(&bytes);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", member);
}

static int add_tables(const char *suite_path, struct sensor *sensor, uint64_t *digest,
                      struct arena *arena, struct diag *diag)
{
    return add_table("amplitude_table", suite_path, sensor->amplitude_table, sensor,
                     read_amplitudes, digest, arena, diag) == 0
               ? add_table("antenna_table", suite_path, sensor->antenna_table, sensor, read_pattern,
                           digest, arena, diag)
               : -1;
}

static int complete_suite(struct suite *suite, const char *path, const struct text *document,
                          struct arena *arena, struct diag *diag)
{
    uint64_t digest = hash_bytes(HASH_START, document->bytes, document->length);
    if (suite->sensors.count == 0)
        return diag_fail(diag, DIAG_CONFIG, "%s: sensors: none; expected at least one", path);
    struct intern names = intern_begin(suite->sensors.count, arena);
    for (size_t i = 0; i < suite->sensors.count; i++) {
        struct sensor *sensor = &suite->sensors.items[i];
        if (intern_word(&names, sensor->name, arena) < i)
            return diag_fail(diag, DIAG_CONFIG, "%s: sensors[%zu].name: \"%s\" stands twice", path,
                             i, sensor->name);
        if (suite_check(sensor, diag) != 0)
            return diag_prefix(diag, "%s: sensors[%zu].", path, i);
        suite_derive(sensor);
        if (add_tables(path, sensor, &digest, arena, diag) != 0)
            return diag_prefix(diag, "%s: sensors[%zu].", path, i);
        if (consistency_check(sensor, i, diag) != 0)
            return diag_prefix(diag, "%s: ", path);
        sensor->prior = suite->prior;
    }
    snprintf(suite->digest, sizeof suite->digest, "%016llx", (unsigned long long)digest);
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

const struct suite *suite_file_load(const char *name, struct arena *arena, struct diag *diag)
{
    const char *path = document_find_file(NULL, "sensors", name, ".json", arena, diag);
    if (path == NULL)
        return NULL;
    struct suite *suite = arena_get(arena, sizeof *suite);
    struct text bytes = {0};
    int result = document_bytes(path, &bytes, diag);
    if (result == 0)
        result = document_parse(path, &bytes, &suite_record, suite, arena, diag);
    if (result == 0)
        result = complete_suite(suite, path, &bytes, arena, diag);
    text_free(&bytes);
    suite->given = arena_text(arena, name, strlen(name));
    suite->name = plain_name(name, arena);
    if (result != 0 && diag->code != DIAG_MEMORY)
        diag->code = DIAG_CONFIG;
    return result == 0 ? suite : NULL;
}
