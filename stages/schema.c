/* The JSON Schemas of the frame and of every document, as files of a folder. */
#include "run/schema.h"
#include "run/tool.h"
#include "text/field.h"
#include "text/output.h"

struct schema_state {
    const char *folder;
};

static int write_schema(const struct schema_state *own, size_t index, struct runner *runner)
{
    struct text text = {0};
    text_format(&text, "%s.json", schema_name(index));
    text_add(&text, "", 1);
    struct output *output = runner_output_in(runner, own->folder, text.bytes);
    text.length = 0;
    schema_write(index, &text);
    int result =
        output == NULL ? -1 : output_write(output, text.bytes, text.length, runner_diag(runner));
    text_free(&text);
    return result;
}

static int schema_run(void *state, struct runner *runner)
{
    for (size_t i = 0; schema_name(i) != NULL; i++)
        if (write_schema(state, i, runner) != 0)
            return -1;
    return 0;
}

static const struct field schema_options[] = {
    {FIELD_NAME_OF(struct schema_state, folder, "a folder, which gets NAME.json for each of them")},
    {0},
};

const struct tool tool_schema = {
    .name = "schema",
    .summary = "Write the JSON Schemas of the frame and of every document.",
    .details = "They are printed from the tables that the readers use (JSON Schema 2020-12).",
    .options = STAGE_OPTIONS(struct schema_state, schema_options),
    .operand = "DIR",
    .into_folder = true,
    .run = schema_run,
};
