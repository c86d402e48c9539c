/* Targets as CSV: the table of detections (detection_tables.h), by itself. */
#include "export/detection_tables.h"
#include "run/stage.h"

struct export_csv {
    struct detection_tables tables;
    struct text rows;
};

static int send_rows(struct export_csv *export, struct runner *runner)
{
    int result = runner_write(runner, export->rows.bytes, export->rows.length);
    export->rows.length = 0;
    return result;
}

static int export_csv_start(void *state, struct runner *runner)
{
    struct export_csv *export = state;
    export->tables.rows[TABLE_DETECTIONS] = &export->rows;
    detection_tables_begin(&export->tables, 0, runner_arena(runner));
    return 0;
}

static int export_csv_step(void *state, struct frame *frame, struct runner *runner)
{
    struct export_csv *export = state;
    if (detection_tables_add(&export->tables, frame, runner_diag(runner)) != 0)
        return -1;
    return send_rows(export, runner);
}

/* A stream without frames has the names of the columns too. */
static int export_csv_stop(void *state, struct runner *runner)
{
    return send_rows(state, runner);
}

static void export_csv_release(void *state)
{
    struct export_csv *export = state;
    text_free(&export->rows);
}

const struct stage stage_export_csv = {
    .name = "export-csv",
    .summary = "Write targets as CSV, one row each, with their labels.",
    .details =
        "The table is the one of detections that glint-tables writes beside six others. A scan "
        "without targets has no row here; it has one in the table of scans.",
    .options = STAGE_OPTIONS(struct export_csv, field_none),
    .sink = true,
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .start = export_csv_start,
    .step = export_csv_step,
    .stop = export_csv_stop,
    .release = export_csv_release,
};
