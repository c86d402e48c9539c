#include "scratch.h"

#include <jansson.h>

#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "frame/frame.h"
#include "run/chain.h"
#include "run/stage.h"
#include "traffic/scenario.h"

/* The files that glint-schema writes; a folder with another one cannot be removed. */
static const char *const written[] = {
    "cost",           "frame",
    "scenario",       "score",
    "score-ensemble", "score-summary",
    "score-tracks",   "score-tracks-summary",
    "sensors",        "sensors-extending",
    "tables",         "tracks",
    "vehicle",
};

/* The schema of that name, as glint-schema writes it into the scratch folder. */
static json_t *schema_of(const char *name, const struct scratch *scratch)
{
    char path[128];
    json_error_t error;
    snprintf(path, sizeof path, "%s/%s.json", scratch->directory, name);
    json_t *tree = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (tree == NULL)
        fail_msg("%s:%d: %s", path, error.line, error.text);
    return tree;
}

static const char *word(const json_t *tree, const char *key)
{
    const char *value = json_string_value(json_object_get(tree, key));
    return value != NULL ? value : "";
}

static double bound(const json_t *tree, const char *key)
{
    const json_t *value = json_object_get(tree, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static void assert_describes(const json_t *schema, const struct record *record);

/* Where a distribution may stand for a value, the first alternative describes the value. */
static const json_t *value_of(const json_t *property, const struct field *field)
{
    const json_t *anyof = json_object_get(property, "anyOf");
    if (anyof == NULL)
        return property;
    bool number = field->kind == FIELD_REAL || field->kind == FIELD_INTEGER;
    assert_int_equal(json_array_size(anyof), 2);
    assert_string_equal(word(json_array_get(anyof, 1), "$ref"),
                        number ? "#/$defs/drawn_number" : "#/$defs/drawn");
    return json_array_get(anyof, 0);
}

static void assert_describes_member(const json_t *described, const struct field *field)
{
    const json_t *property = value_of(described, field);
    static const char *const types[] = {
        [FIELD_REAL] = "number", [FIELD_INTEGER] = "integer", [FIELD_FLAG] = "boolean",
        [FIELD_NAME] = "string", [FIELD_CHOICE] = "",         [FIELD_SEED] = "string",
        [FIELD_NAMES] = "array", [FIELD_RECORD] = "object",   [FIELD_LIST] = "array",
        [FIELD_RAW] = "",        [FIELD_NOTES] = "object",    [FIELD_SET] = "array",
    };
    assert_string_equal(word(property, "type"), types[field->kind]);
    assert_string_equal(word(described, field->kind == FIELD_RECORD ? "$comment" : "description"),
                        field->help);
    json_t *choices = json_object_get(property, "enum");
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        assert_close(bound(property, "minimum"), field->low, 0);
        assert_close(bound(property, "maximum"), field->high, 0);
        break;
    case FIELD_NAME:
        assert_close(bound(property, "minLength"), 1, 0);
        assert_close(bound(property, "maxLength"), FIELD_NAME_SIZE, 0);
        break;
    case FIELD_SET:
        choices = json_object_get(json_object_get(property, "items"), "enum");
        assert_true(json_is_true(json_object_get(property, "uniqueItems")));
        /* fall through */
    case FIELD_CHOICE:
        for (size_t i = 0; i <= json_array_size(choices); i++) {
            const char *choice = json_string_value(json_array_get(choices, i));
            assert_true((choice == NULL) == (field->choices[i] == NULL));
            if (choice != NULL)
                assert_string_equal(choice, field->choices[i]);
        }
        break;
    case FIELD_RECORD:
        assert_describes(property, field->record);
        break;
    case FIELD_LIST:
        assert_describes(
            value_of(json_object_get(property, "items"), &(struct field){.kind = FIELD_RECORD}),
            field->record);
        break;
    case FIELD_NAMES:
        assert_string_equal(word(json_object_get(property, "items"), "type"), "string");
        break;
    case FIELD_NOTES:
        assert_string_equal(word(json_object_get(property, "additionalProperties"), "type"),
                            "string");
        break;
    default:
        break;
    }
}

static bool is_required(const json_t *schema, const char *name)
{
    const json_t *required = json_object_get(schema, "required");
    assert_true(json_is_array(required));
    for (size_t i = 0; i < json_array_size(required); i++)
        if (strcmp(json_string_value(json_array_get(required, i)), name) == 0)
            return true;
    return false;
}

static void assert_describes(const json_t *schema, const struct record *record)
{
    assert_string_equal(word(schema, "title"), record->name);
    assert_string_equal(word(schema, "description"), record->help);
    assert_true(json_is_false(json_object_get(schema, "additionalProperties")));
    const json_t *properties = json_object_get(schema, "properties");
    size_t count = 0, required = 0;
    for (const struct field *field = record->fields; field->name != NULL; field++, count++) {
        const json_t *property = json_object_get(properties, field->name);
        if (property == NULL)
            fail_msg("%s.%s is missing", record->name, field->name);
        bool always = !field->optional && field != record->inherited;
        assert_int_equal(is_required(schema, field->name), always);
        required += always;
        assert_describes_member(property, field);
    }
    assert_int_equal(json_object_size(properties), count);
    assert_int_equal(json_array_size(json_object_get(schema, "required")), required);
}

static int write_schemas(void **state)
{
    make_scratch(state);
    const struct scratch *scratch = *state;
    char *words[] = {(char[]){"glint-schema"}, (char *)scratch->directory, NULL};
    return chain_main(stage_by_name("schema"), 2, words);
}

/* The schema of a sensor in that of a suite. */
static const json_t *item_of(const json_t *suite)
{
    const json_t *sensors = json_object_get(json_object_get(suite, "properties"), "sensors");
    return json_object_get(sensors, "items");
}

FIXTURE(write_schemas, remove_scratch);

TEST_OF(scratch, every_schema_says_what_its_field_table_says)
{
    static const struct {
        const char *name;
        const struct record *record;
    } schemas[] = {{"frame", &frame_record},
                   {"scenario", &scenario_record},
                   {"sensors", &suite_record},
                   {"vehicle", &vehicle_record}};
    for (size_t i = 0; i < COUNT(schemas); i++) {
        json_t *schema = schema_of(schemas[i].name, scratch);
        assert_string_equal(word(schema, "$schema"),
                            "https://json-schema.org/draft/2020-12/schema");
        assert_describes(schema, schemas[i].record);
        json_decref(schema);
    }
}

/* The members are those of a whole suite; the optional ones may be null. */
TEST_OF(scratch, a_suite_that_extends_another_needs_nothing_but_its_name)
{
    json_t *schema = schema_of("sensors-extending", scratch),
           *whole = schema_of("sensors", scratch);
    const json_t *required = json_object_get(schema, "required");
    assert_int_equal(json_array_size(required), 1);
    assert_string_equal(json_string_value(json_array_get(required, 0)), "extends");
    const json_t *sensor = item_of(schema), *whole_sensor = item_of(whole);
    assert_int_equal(json_array_size(json_object_get(sensor, "required")), 0);
    const char *name;
    json_t *member;
    json_object_foreach(json_object_get(whole_sensor, "properties"), name, member)
    {
        const json_t *there = json_object_get(json_object_get(sensor, "properties"), name);
        assert_non_null(there);
        const json_t *or_null = json_array_get(json_object_get(there, "anyOf"), 1);
        bool must_be = is_required(whole_sensor, name);
        assert_string_equal(word(or_null, "type"), must_be ? "" : "null");
    }
    json_decref(schema);
    json_decref(whole);
}

/* `make schemas` writes them; they are kept so that a change shows. */
TEST_OF(scratch, the_files_in_schemas_are_up_to_date)
{
    assert_int_equal(scratch_count(scratch), COUNT(written));
    for (size_t i = 0; i < COUNT(written); i++) {
        char path[64];
        snprintf(path, sizeof path, "schemas/%s.json", written[i]);
        json_t *file = json_load_file(path, 0, NULL), *printed = schema_of(written[i], scratch);
        assert_non_null(file);
        if (!json_equal(file, printed))
            fail_msg("%s is out of date; run make schemas", path);
        json_decref(file);
        json_decref(printed);
    }
}
