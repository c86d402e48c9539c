#include "export/table_schema.h"

#include "export/detection_tables.h"

/* A value of each kind of field is of this type. */
static const struct {
    const char *json, *sql;
} types[] = {
    [FIELD_REAL] = {"number", "DOUBLE"},    [FIELD_INTEGER] = {"integer", "BIGINT"},
    [FIELD_FLAG] = {"boolean", "BOOLEAN"},  [FIELD_NAME] = {"string", "VARCHAR"},
    [FIELD_CHOICE] = {"string", "VARCHAR"}, [FIELD_SEED] = {"integer", "UBIGINT"},
    [FIELD_SET] = {"string", "VARCHAR"},
};

/* The table whose rows each key numbers. */
static const struct {
    const char *key;
    enum table table;
} keys[] = {
    {"detection_key", TABLE_DETECTIONS}, {"object_key", TABLE_OBJECTS}, {"scan_key", TABLE_SCANS}};

enum { KEYS = sizeof keys / sizeof keys[0] };

typedef void write_column(enum table table, const struct csv_column *column, bool first,
                          struct text *text);

static void for_columns(enum table table, write_column *write, struct text *text)
{
    struct arena arena = {0};
    struct detection_tables tables = {0};
    detection_tables_begin(&tables, 0, &arena);
    for (int i = 0; i < DETECTION_TABLES_STRUCTS; i++)
        for (size_t j = 0; j < tables.columns[table][i].list.count; j++)
            write(table, &tables.columns[table][i].list.items[j], i == 0 && j == 0, text);
    arena_free(&arena);
}

static void write_member(const char *name, const char *value, struct text *text)
{
    text_format(text, ", \"%s\": ", name);
    text_add_json(text, value, strlen(value));
}

static void write_json_column(enum table table, const struct csv_column *column, bool first,
                              struct text *text)
{
    (void)table;
    const struct field *field = column->field;
    text_format(text, "%s\n    {\"name\": \"%s\", \"type\": \"%s\"", first ? "" : ",", column->name,
                types[field->kind].json);
    if (*field_unit(field->name) != '\0')
        write_member("unit", field_unit(field->name), text);
    write_member("description", field->help, text);
    text_add_word(text, "}");
}

static void write_own_key(enum table table, struct text *text)
{
    for (int i = 0; i < KEYS; i++)
        if (keys[i].table == table)
            text_format(text, "   \"primaryKey\": \"%s\",\n", keys[i].key);
}

static void write_foreign_key(enum table table, const struct csv_column *column, bool first,
                              struct text *text)
{
    (void)first;
    for (int i = 0; i < KEYS; i++)
        if (keys[i].table != table && strcmp(column->name, keys[i].key) == 0)
            text_format(text,
                        "%s\n    {\"fields\": \"%s\", \"reference\": {\"resource\": \"%s\", "
                        "\"fields\": \"%s\"}}",
                        text->bytes[text->length - 1] == '[' ? "" : ",", keys[i].key,
                        detection_tables_names[keys[i].table], keys[i].key);
}

static void write_json_table(enum table table, struct text *text)
{
    text_format(text, "  \"%s\": {\"fields\": [", detection_tables_names[table]);
    for_columns(table, write_json_column, text);
    text_add_word(text, "],\n");
    write_own_key(table, text);
    text_add_word(text, "   \"foreignKeys\": [");
    for_columns(table, write_foreign_key, text);
    text_format(text, "]}%s\n", table + 1 < TABLE_COUNT ? "," : "");
}

void table_schema_write_json(struct text *text)
{
    text_add_word(text, "{\n");
    for (int table = 0; table < TABLE_COUNT; table++)
        write_json_table((enum table)table, text);
    text_add_word(text, "}\n");
}

/* Times and origins need more digits than single precision has. */
static bool is_long(const struct field *field)
{
    return strcmp(field_unit(field->name), "s") == 0 || strncmp(field->name, "origin", 6) == 0;
}

static void write_sql_column(enum table table, const struct csv_column *column, bool first,
                             struct text *text)
{
    (void)table;
    const struct field *field = column->field;
    text_format(text, "%s\n    \"%s\": ", first ? "" : ",", column->name);
    if (field->kind == FIELD_REAL && !is_long(field))
        text_add_word(text, "reals");
    else
        text_format(text, "'%s'", types[field->kind].sql);
}

void table_schema_write_sql(struct text *text)
{
    text_add_word(
        text,
        "-- The tables of glint-tables for DuckDB: FROM detections('FOLDER'). Real\n"
        "-- numbers are in double precision, or FROM detections('FOLDER', reals := 'FLOAT').\n");
    for (int table = 0; table < TABLE_COUNT; table++) {
        const char *name = detection_tables_names[table];
        text_format(text,
                    "\nCREATE OR REPLACE MACRO %s(folder, reals := 'DOUBLE') AS TABLE\n"
                    "FROM read_csv(folder || '/%s.csv*', header = true, columns = {",
                    name, name);
        for_columns((enum table)table, write_sql_column, text);
        text_add_word(text, "});\n");
    }
}
