#include "run/schema.h"

#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "frame/frame.h"
#include "run/cost.h"
#include "score/ensemble.h"
#include "score/score.h"
#include "score/track_score.h"
#include "traffic/scenario.h"

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
    {"tracks", &track_list_record},
    {"vehicle", &vehicle_record},
};

enum { SCHEMAS = sizeof schemas / sizeof schemas[0] };

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

static void write_type(const struct field *field, bool varied, int depth, struct text *text)
{
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        text_format(text, "\"type\": \"%s\", \"minimum\": %.17g, \"maximum\": %.17g",
                    field->kind == FIELD_REAL ? "number" : "integer", field->low, field->high);
        break;
    case FIELD_FLAG:
        text_add_word(text, "\"type\": \"boolean\"");
        break;
    case FIELD_NAME:
        write_name(field, text);
        break;
    case FIELD_CHOICE:
        write_choices("enum", field, text);
        break;
    case FIELD_SET:
        text_add_word(text, "\"type\": \"array\", \"uniqueItems\": true, \"items\": {");
        write_choices("enum", field, text);
        text_add_word(text, "}");
        break;
    case FIELD_SEED:
        text_add_word(text, "\"type\": \"string\", \"pattern\": \"^[0-9]{1,20}$\"");
        break;
    case FIELD_NAMES:
        text_add_word(text, "\"type\": \"array\", \"items\": {\"type\": \"string\"}");
        break;
    case FIELD_RECORD:
        write_record(field->record, varied, depth, text);
        break;
    case FIELD_LIST:
        text_add_word(text, "\"type\": \"array\", \"items\": {");
        text_add_word(text, varied ? "\"anyOf\": [{" : "");
        write_record(field->record, varied, depth + 1, text);
        indent(depth, text);
        text_add_word(text, varied ? "}, {\"$ref\": \"#/$defs/drawn\"}]}" : "}");
        break;
    case FIELD_NOTES:
        text_add_word(text,
                      "\"type\": \"object\", \"additionalProperties\": {\"type\": \"string\"}");
        break;
    case FIELD_RAW:
        break;
    }
}

static void write_required(const struct record *record, struct text *text)
{
    const char *separator = "\"required\": [";
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (!field->optional) {
            text_format(text, "%s\"%s\"", separator, field->name);
            separator = ", ";
        }
    text_add_word(text, *separator == ',' ? "]," : "\"required\": [],");
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

/* What may stand for a value: a law, and what it draws from. */
static void write_laws(struct text *text)
{
    static const char pair[] =
        "{\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 2, "
        "\"maxItems\": 2}";
    static const struct {
        const char *name, *laws;
    } drawn[] = {{"drawn", "choice"}, {"drawn_number", "uniform, normal or choice"}};
    text_add_word(text, ",\n  \"$defs\": {");
    for (int i = 0; i < 2; i++) {
        text_format(text,
                    "%s\n    \"%s\": {\"description\": \"%s\", \"type\": \"object\", "
                    "\"minProperties\": 1, \"maxProperties\": 1, "
                    "\"additionalProperties\": false, \"properties\": {\n      "
                    "\"choice\": {\"type\": \"array\", \"minItems\": 1}",
                    i > 0 ? "," : "", drawn[i].name, drawn[i].laws);
        if (i == 1)
            text_format(text, ", \"uniform\": %s, \"normal\": %s", pair, pair);
        text_add_word(text, "}}");
    }
    text_add_word(text, "\n  }");
}

const char *schema_name(size_t index)
{
    return index < SCHEMAS ? schemas[index].name : NULL;
}

void schema_write(size_t index, struct text *text)
{
    text_add_word(text, "{");
    indent(1, text);
    write_text_member("$schema", "https://json-schema.org/draft/2020-12/schema", text);
    text_add_word(text, ",");
    bool varied = schemas[index].record == &scenario_record; /* by document_draw */
    write_record(schemas[index].record, varied, 1, text);
    if (varied)
        write_laws(text);
    text_add_word(text, "\n}\n");
}
