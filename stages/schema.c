/* The JSON Schemas of the frame and of every document, printed from the tables of fields. */
#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "export/record_schema.h"
#include "frame/frame.h"
#include "run/cost_table.h"
#include "run/tool.h"
#include "score/ensemble.h"
#include "score/score.h"
#include "score/track_score.h"
#include "text/output.h"
#include "traffic/scenario.h"

struct schema_state {
    const char *folder;
};

static const struct {
    const char *name;
    const struct record *record;
    enum record_schema_kind kind;
} schemas[] = {
    {"cost", &cost_table_record, SCHEMA_PLAIN},
    {"frame", &frame_record, SCHEMA_PLAIN},
    {"scenario", &scenario_record, SCHEMA_DRAWN},
    {"score", &score_line_record, SCHEMA_PLAIN},
    {"score-ensemble", &ensemble_score_record, SCHEMA_PLAIN},
    {"score-summary", &score_summary_record, SCHEMA_PLAIN},
    {"score-tracks", &score_track_line_record, SCHEMA_PLAIN},
    {"score-tracks-summary", &score_track_summary_record, SCHEMA_PLAIN},
    {"sensors", &suite_record, SCHEMA_PLAIN},
    {"sensors-extending", &suite_record, SCHEMA_EXTENDING},
    {"tables", NULL, SCHEMA_PLAIN}, /* the columns of glint-tables */
    {"tracks", &track_list_record, SCHEMA_PLAIN},
    {"vehicle", &vehicle_record, SCHEMA_PLAIN},
};

static int schema_run(void *state, struct runner *runner)
{
    const struct schema_state *own = state;
    for (size_t i = 0; i < sizeof schemas / sizeof schemas[0]; i++) {
        const char *name = arena_format(runner_arena(runner), "%s.json", schemas[i].name);
        struct output *output = runner_output_in(runner, own->folder, name);
        if (output == NULL)
            return -1;
        const struct record *record = schemas[i].record;
        if (record == NULL)
            record_schema_add_tables(output_text(output));
        else
            record_schema_add(record, schemas[i].kind, output_text(output));
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
