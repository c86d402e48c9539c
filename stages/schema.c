/* The JSON Schemas of the frame and of every document, as files of a folder. */
#include "run/schema.h"
#include "export/detection_tables.h"
#include "run/tool.h"
#include "text/field.h"
#include "text/output.h"

struct schema_state {
    const char *folder;
};

static int write_file(const struct schema_state *own, const char *name, struct text *text,
                      struct runner *runner)
{
    struct output *output = runner_output_in(runner, own->folder, name);
    int result =
        output == NULL ? -1 : output_write(output, text->bytes, text->length, runner_diag(runner));
    text_free(text);
    return result;
}

static int schema_run(void *state, struct runner *runner)
{
    struct text text = {0};
    int result = 0;
    for (size_t i = 0; schema_name(i) != NULL && result == 0; i++) {
        schema_write(i, &text);
        result = write_file(state, arena_format(runner_arena(runner), "%s.json", schema_name(i)),
                            &text, runner);
    }
    if (result != 0)
        return -1;
    detection_tables_write_schema(&text);
    return write_file(state, "tables.json", &text, runner);
}

static const struct field schema_options[] = {
    {FIELD_NAME_OF(struct schema_state, folder,
                   "the folder that gets frame.json, sensors.json and so on")},
    {0},
};

const struct tool tool_schema = {
    .name = "schema",
    .summary = "Write the JSON Schemas of the frame and of every document.",
    .details = "They are printed from the tables that the readers use (JSON Schema 2020-12).\n"
               "The columns of glint-tables are in tables.json, as Frictionless Table Schemas.",
    .options = STAGE_OPTIONS(struct schema_state, schema_options),
    .operand = "DIR",
    .into_folder = true,
    .run = schema_run,
};
