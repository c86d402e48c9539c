#include "export/record_schema.h"

#include <stdlib.h>

#include <jansson.h>

#include "export/detection_tables.h"
#include "text/document.h"
#include "text/variation.h"

static json_t *schema_of(const struct record *record, enum record_schema_kind kind);

static json_t *names_of(const char *const *names)
{
    json_t *list = json_array();
    for (; *names != NULL; names++)
        json_array_append_new(list, json_string(*names));
    return list;
}

static json_t *bound(double value)
{
    return fabs(value) <= 0x1p53 && value == floor(value) ? json_integer((json_int_t)value)
                                                          : json_real(value);
}

/* The value, or a distribution of it: "drawn" or "drawn_number". */
static json_t *or_drawn(json_t *value, const char *distribution)
{
    json_t *other = json_sprintf("#/$defs/%s", distribution);
    return json_pack("{s:[o,{s:o}]}", "anyOf", value, "$ref", other);
}

static json_t *or_null(json_t *value)
{
    return json_pack("{s:[o,{s:s}]}", "anyOf", value, "type", "null");
}

static json_t *name_schema(const struct field *field)
{
    bool known = field->choices != NULL;
    return json_pack(
        "{s:o,s:i,s:i,s:s*,s:o*}", "type",
        field->or_number ? json_pack("[s,s]", "string", "integer") : json_string("string"),
        "minLength", 1, "maxLength", FIELD_NAME_SIZE, "pattern", known ? "^[a-z_]+$" : NULL,
        "examples", known ? names_of(field->choices) : NULL);
}

static json_t *value_schema(const struct field *field, enum record_schema_kind kind)
{
    json_t *items;
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        return json_pack("{s:s,s:o,s:o}", "type", field->kind == FIELD_REAL ? "number" : "integer",
                         "minimum", bound(field->low), "maximum", bound(field->high));
    case FIELD_FLAG:
        return json_pack("{s:s}", "type", "boolean");
    case FIELD_NAME:
        return name_schema(field);
    case FIELD_CHOICE:
        return json_pack("{s:o}", "enum", names_of(field->choices));
    case FIELD_SEED:
        return json_pack("{s:s,s:s}", "type", "string", "pattern", "^[0-9]{1,20}$");
    case FIELD_SET:
        return json_pack("{s:s,s:b,s:{s:o}}", "type", "array", "uniqueItems", true, "items", "enum",
                         names_of(field->choices));
    case FIELD_NAMES:
        return json_pack("{s:s,s:{s:s}}", "type", "array", "items", "type", "string");
    case FIELD_RECORD:
        return schema_of(field->record, kind);
    case FIELD_LIST:
        items = schema_of(field->record, kind);
        return json_pack("{s:s,s:o}", "type", "array", "items",
                         kind == SCHEMA_DRAWN ? or_drawn(items, "drawn") : items);
    case FIELD_NOTES:
        items = json_pack("{s:s}", "type", "string");
        return json_pack("{s:s,s:o}", "type", "object", "additionalProperties",
                         kind == SCHEMA_EXTENDING ? or_null(items) : items);
    case FIELD_RAW:
        break;
    }
    return json_object();
}

/* A record's schema has a description of its own. */
static json_t *member_schema(const struct field *field, enum record_schema_kind kind)
{
    bool number = field->kind == FIELD_REAL || field->kind == FIELD_INTEGER;
    json_t *value = value_schema(field, kind);
    if (kind == SCHEMA_DRAWN)
        value = or_drawn(value, number ? "drawn_number" : "drawn");
    if (kind == SCHEMA_EXTENDING && field->optional)
        value = or_null(value);
    json_t *schema =
        json_pack("{s:s}", field->kind == FIELD_RECORD ? "$comment" : "description", field->help);
    json_object_update_new(schema, value);
    return schema;
}

static json_t *schema_of(const struct record *record, enum record_schema_kind kind)
{
    json_t *required = json_array(), *properties = json_object();
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if (!field->optional && field != record->inherited && kind != SCHEMA_EXTENDING)
            json_array_append_new(required, json_string(field->name));
        json_object_set_new(properties, field->name, member_schema(field, kind));
    }
    return json_pack("{s:s,s:s,s:s,s:b,s:o,s:o}", "title", record->name, "description",
                     record->help, "type", "object", "additionalProperties", false, "required",
                     required, "properties", properties);
}

/* The member that an extending document has beside those of its record. */
static void add_base(json_t *schema)
{
    json_t *base = json_pack("{s:s,s:s}", "description",
                             "the document whose members hold where this one has none: its name, "
                             "or its path from here",
                             "type", "string");
    json_object_set_new(json_object_get(schema, "properties"), "extends", base);
    json_array_append_new(json_object_get(schema, "required"), json_string("extends"));
}

static void print(json_t *tree, struct text *text)
{
    char *printed = json_dumps(tree, JSON_INDENT(2));
    text_format(text, "%s\n", printed);
    free(printed);
    json_decref(tree);
}

void record_schema_add(const struct record *record, enum record_schema_kind kind, struct text *text)
{
    json_t *schema = json_pack("{s:s}", "$schema", "https://json-schema.org/draft/2020-12/schema");
    json_object_update_new(schema, schema_of(record, kind));
    if (kind == SCHEMA_EXTENDING)
        add_base(schema);
    if (kind == SCHEMA_DRAWN)
        json_object_set_new(schema, "$defs", json_loads(variation_schema, 0, NULL));
    print(schema, text);
}

static json_t *column_schema(const struct csv_column *column)
{
    static const char *const types[] = {
        [FIELD_REAL] = "number", [FIELD_INTEGER] = "integer", [FIELD_FLAG] = "boolean",
        [FIELD_NAME] = "string", [FIELD_CHOICE] = "string",   [FIELD_SEED] = "integer",
        [FIELD_SET] = "string"};
    const struct field *field = column->field;
    const char *unit = field_unit(field->name);
    return json_pack(
        "{s:s,s:s,s:s*,s:s,s:o*}", "name", column->name, "type", types[field->kind], "unit",
        *unit != '\0' ? unit : NULL, "description", field->help, "constraints",
        field->kind == FIELD_CHOICE ? json_pack("{s:o}", "enum", names_of(field->choices)) : NULL);
}

/* A column NAME_key joins the table NAMEs, unless it numbers the rows of its own table. */
static json_t *table_schema(const struct detection_tables *tables, enum table table)
{
    const char *const *primary = detection_tables_primary[table];
    const char *own = primary[0] != NULL && primary[1] == NULL ? primary[0] : "";
    json_t *columns = json_array(), *joins = json_array();
    for (int i = 0; i < DETECTION_TABLES_STRUCTS; i++)
        for (size_t j = 0; j < tables->columns[table][i].list.count; j++) {
            const struct csv_column *column = &tables->columns[table][i].list.items[j];
            const char *name = column->name, *key = strstr(name, "_key");
            json_array_append_new(columns, column_schema(column));
            if (key != NULL && strcmp(name, own) != 0)
                json_array_append_new(
                    joins,
                    json_pack("{s:s,s:{s:o,s:s}}", "fields", name, "reference", "resource",
                              json_sprintf("%.*ss", (int)(key - name), name), "fields", name));
        }
    json_t *schema = json_pack("{s:o,s:o*}", "fields", columns, "primaryKey",
                               primary[1] != NULL ? json_pack("[s,s]", primary[0], primary[1])
                                                  : json_string(primary[0]));
    if (json_array_size(joins) > 0)
        json_object_set(schema, "foreignKeys", joins);
    json_decref(joins);
    return schema;
}

void record_schema_add_tables(struct text *text)
{
    struct arena arena = {0};
    struct detection_tables tables = {0};
    detection_tables_begin(&tables, 0, &arena);
    json_t *schemas = json_object();
    for (enum table table = 0; table < TABLE_COUNT; table++)
        json_object_set_new(schemas, detection_tables_names[table], table_schema(&tables, table));
    print(schemas, text);
    arena_free(&arena);
}
