/* A stream as tables: detections, objects, scans, contributors, sightings, lost echoes, frames. */
#include "export/detection_tables.h"
#include "run/tool.h"
#include "text/output.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

struct tables_state {
    const char *folder;
    bool plain;
    int64_t part;
    struct output *outputs[TABLE_COUNT];
    struct detection_tables tables;
};

static int make_folder(const char *folder, struct diag *diag)
{
    if (mkdir(folder, 0777) == 0 || errno == EEXIST)
        return 0;
    return diag_fail(diag, DIAG_CANNOT_CREATE, "DIR: %s: %s", folder, strerror(errno));
}

/* Refuses a folder that has a table of the other kind, packed or plain, as readers take both. */
static int open_outputs(struct tables_state *own, struct runner *runner)
{
    if (make_folder(own->folder, runner_diag(runner)) != 0)
        return -1;
    for (int i = 0; i < TABLE_COUNT; i++) {
        const char *plain = arena_format(runner_arena(runner), "%s.csv", detection_tables_names[i]);
        const char *packed = arena_format(runner_arena(runner), "%s.gz", plain);
        const char *other =
            arena_format(runner_arena(runner), "%s/%s", own->folder, own->plain ? packed : plain);
        if (access(other, F_OK) == 0)
            return diag_fail(runner_diag(runner), DIAG_CANNOT_CREATE,
                             "%s: a table of another run; remove it, or name another folder",
                             other);
        own->outputs[i] = runner_output_in(runner, own->folder, own->plain ? plain : packed);
        if (own->outputs[i] == NULL)
            return -1;
        own->tables.rows[i] = output_text(own->outputs[i]);
    }
    return 0;
}

static int send_rows(struct tables_state *own, struct runner *runner)
{
    for (int i = 0; i < TABLE_COUNT; i++)
        if (output_send(own->outputs[i], runner_diag(runner)) != 0)
            return -1;
    return 0;
}

static int tables_run(void *state, struct runner *runner)
{
    struct tables_state *own = state;
    struct frame *frame;
    int more = open_outputs(own, runner) == 0 ? 1 : -1;
    if (more > 0)
        detection_tables_begin(&own->tables, own->part * DETECTION_TABLES_KEYS,
                               runner_arena(runner));
    while (more > 0 && (more = runner_frame(runner, &frame)) > 0)
        if (detection_tables_add(&own->tables, frame, runner_diag(runner)) != 0 ||
            send_rows(own, runner) != 0)
            more = -1;
    return more;
}

static const struct field tables_options[] = {
    {FIELD_NAME_OF(struct tables_state, folder,
                   "the folder for the seven tables; it is made if it does not exist")},
    {OPTIONAL_FLAG(struct tables_state, plain, "write .csv instead of .csv.gz")},
    {OPTIONAL_INTEGER(struct tables_state, part, 0, 9e6,
                      "number of this part of a set; its keys begin at 1e9 times the number")},
    {0},
};

const struct stage stage_tables = {
    .name = "tables",
    .summary = "Write tables of targets, labels, objects, scans, sightings, losses and frames.",
    .details =
        "The files are detections.csv.gz, objects.csv.gz and so on. Columns are the members of the "
        "frame, with the same names and units. Columns that end in _key are whole numbers that "
        "join the rows of two tables. The parts of one set need different keys: --part gives each "
        "part its own. schemas/README.md describes the tables. A folder that has a table of the "
        "other kind, packed (.csv.gz) or plain (.csv), is refused, as readers take both.",
    .options = STAGE_OPTIONS(struct tables_state, tables_options),
    .operand = "DIR",
    .into_folder = true,
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .run = tables_run,
};
