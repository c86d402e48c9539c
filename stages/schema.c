/* The JSON Schemas of the frame and of every document, printed from the tables of fields. */
#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "export/detection_tables.h"
#include "frame/frame.h"
#include "run/cost.h"
#include "run/tool.h"
#include "score/ensemble.h"
#include "score/score.h"
#include "score/track_score.h"
#include "text/document.h"
#include "text/output.h"
#include "traffic/scenario.h"

struct schema_state {
    const char *folder;
};

static const struct {
    const char *name;
    const struct record *record;
} schemas[] = {
    {"cost", &cost_record},
    {"frame", &frame_record},
    {"scenario", &scenario_record},
    {"score", &score_line_record},
    {"score-ensemble", &ensemble_score_record},
    {"score-summary", &score_summary_record},
    {"score-tracks", &score_track_line_record},
    {"score-tracks-summary", &score_track_summary_record},
    {"sensors", &suite_record},
    {"tables", NULL}, /* the columns of glint-tables */
    {"tracks", &track_list_record},
    {"vehicle", &vehicle_record},
};

static void write_record(const struct record *record, bool varied, int depth, struct text *text);

static void indent(int depth, struct text *text)
{
    text_format(text, "\n%*s", 2 * depth, "");
}

static void write_text_member(const char *key, const char *value, struct text *text)
{
    text_format(text, "\"%s\": ", key);
    text_add_json(text, value, strlen(value));
}

static void write_choices(const char *keyword, const struct field *field, struct text *text)
{
    text_format(text, "\"%s\": [", keyword);
    for (int i = 0; field->choices[i] != NULL; i++)
        text_format(text, "%s\"%s\"", i > 0 ? ", " : "", field->choices[i]);
    text_add_word(text, "]");
}

static void write_name(const struct field *field, struct text *text)
{
    text_format(text, "\"type\": %s, \"minLength\": 1, \"maxLength\": %d",
                field->or_number ? "[\"string\", \"integer\"]" : "\"string\"", FIELD_NAME_SIZE);
    if (field->choices == NULL)
        return;
    text_add_word(text, ", \"pattern\": \"^[a-z_]+$\", ");
    write_choices("examples", field, text);
}

/* Types that are the same for every field of a kind. */
static const char *const types[] = {
    [FIELD_FLAG] = "\"type\": \"boolean\"",
    [FIELD_SET] = "\"type\": \"array\", \"uniqueItems\": true, \"items\": {",
    [FIELD_SEED] = "\"type\": \"string\", \"pattern\": \"^[0-9]{1,20}$\"",
    [FIELD_NAMES] = "\"type\": \"array\", \"items\": {\"type\": \"string\"}",
    [FIELD_LIST] = "\"type\": \"array\", \"items\": {",
    [FIELD_NOTES] = "\"type\": \"object\", \"additionalProperties\": {\"type\": \"string\"}",
    [FIELD_RAW] = "",
};

static void write_type(const struct field *field, bool varied, int depth, struct text *text)
{
    bool real = field->kind == FIELD_REAL;
    if (field->kind < sizeof types / sizeof types[0] && types[field->kind] != NULL)
        text_add_word(text, types[field->kind]);
    if (real || field->kind == FIELD_INTEGER)
        text_format(text, "\"type\": \"%s\", \"minimum\": %.17g, \"maximum\": %.17g",
                    real ? "number" : "integer", field->low, field->high);
    if (field->kind == FIELD_NAME)
        write_name(field, text);
    if (field->kind == FIELD_CHOICE || field->kind == FIELD_SET)
        write_choices("enum", field, text);
    if (field->kind == FIELD_LIST && varied)
        text_add_word(text, "\"anyOf\": [{");
    if (field->kind == FIELD_RECORD || field->kind == FIELD_LIST)
        write_record(field->record, varied, depth + (field->kind == FIELD_LIST), text);
    if (field->kind == FIELD_LIST) {
        indent(depth, text);
        text_add_word(text, varied ? "}, {\"$ref\": \"#/$defs/drawn\"}]" : "");
    }
    text_add_word(text, field->kind == FIELD_SET || field->kind == FIELD_LIST ? "}" : "");
}

static void write_required(const struct record *record, struct text *text)
{
    const char *separator = "";
    text_add_word(text, "\"required\": [");
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (!field->optional) {
            text_format(text, "%s\"%s\"", separator, field->name);
            separator = ", ";
        }
    text_add_word(text, "],");
}

static void write_member(const struct field *field, bool varied, int depth, struct text *text)
{
    bool number = field->kind == FIELD_REAL || field->kind == FIELD_INTEGER;
    text_format(text, "\"%s\": {", field->name);
    /* A record's schema has a description of its own. */
    write_text_member(field->kind == FIELD_RECORD ? "$comment" : "description", field->help, text);
    if (varied)
        text_add_word(text, ", \"anyOf\": [{");
    else if (field->kind != FIELD_RAW)
        text_add_word(text, field->kind == FIELD_RECORD ? "," : ", ");
    write_type(field, varied, depth + 1, text);
    if (varied)
        text_format(text, "}, {\"$ref\": \"#/$defs/%s\"}]", number ? "drawn_number" : "drawn");
    text_add_word(text, "}");
}

/* Writes the members of a schema object; its braces are the caller's. */
static void write_record(const struct record *record, bool varied, int depth, struct text *text)
{
    indent(depth, text);
    write_text_member("title", record->name, text);
    text_add_word(text, ",");
    indent(depth, text);
    write_text_member("description", record->help, text);
    text_add_word(text, ", \"type\": \"object\", \"additionalProperties\": false,");
    indent(depth, text);
    write_required(record, text);
    indent(depth, text);
    text_add_word(text, "\"properties\": {");
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if (field != record->fields)
            text_add_word(text, ",");
        indent(depth + 1, text);
        write_member(field, varied, depth + 1, text);
    }
    indent(depth, text);
    text_add_word(text, "}");
}

static void write_schema(const struct record *record, struct text *text)
{
    bool varied = record == &scenario_record; /* its values may be drawn */
    text_add_word(text, "{");
    indent(1, text);
    write_text_member("$schema", "https://json-schema.org/draft/2020-12/schema", text);
    text_add_word(text, ",");
    write_record(record, varied, 1, text);
    text_add_word(text, varied ? document_drawn_schema : "");
    text_add_word(text, "\n}\n");
}

static int schema_run(void *state, struct runner *runner)
{
    const struct schema_state *own = state;
    for (size_t i = 0; i < sizeof schemas / sizeof schemas[0]; i++) {
        const char *name = arena_format(runner_arena(runner), "%s.json", schemas[i].name);
        struct output *output = runner_output_in(runner, own->folder, name);
        if (output == NULL)
            return -1;
        if (schemas[i].record != NULL)
            write_schema(schemas[i].record, output_text(output));
        else
            detection_tables_write_schema(output_text(output));
        if (output_send(output, runner_diag(runner)) != 0)
            return -1;
    }
    return 0;
}

static const struct field schema_options[] = {
    {FIELD_NAME_OF(struct schema_state, folder,
                   "the folder that gets frame.json, sensors.json and so on")},
    {0},
};

const struct stage stage_schema = {
    .name = "schema",
    .summary = "Write the JSON Schemas of the frame and of every document.",
    .details = "They are printed from the tables that the readers use (JSON Schema 2020-12).\n"
               "The columns of glint-tables are in tables.json, as Frictionless Table Schemas.",
    .options = STAGE_OPTIONS(struct schema_state, schema_options),
    .operand = "DIR",
    .into_folder = true,
    .run = schema_run,
};
