/* A stream as tables: detections, objects, scans, contributors, sightings, lost echoes, frames. */
#include "export/detection_tables.h"
#include "export/stream_counts.h"
#include "frame/frame_text.h"
#include "run/tool.h"
#include "text/output.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

struct tables_state {
    const char *folder;
    const char *copy; /* file for a copy of the frames; NULL: no copy */
    bool plain, zstd, npy, without_objects, counts, made; /* made: by this run, the folder */
    int64_t part;
    struct output *outputs[TABLE_COUNT], *copied, *named;
    struct detection_tables tables;
    struct npy_names names;
    struct stream_counts counted;
};

static const char *ending_of(const struct tables_state *own)
{
    if (own->npy)
        return ".npy";
    if (own->plain)
        return ".csv";
    return own->zstd ? ".csv.zst" : ".csv.gz";
}

/* Refuses a folder that has a table of CSV of another kind, as readers take all of them. */
static int refuse_other(const char *name, const struct tables_state *own, struct runner *runner)
{
    static const char *const endings[] = {".csv", ".csv.gz", ".csv.zst", NULL};
    for (int i = 0; endings[i] != NULL; i++) {
        const char *other =
            arena_format(runner_arena(runner), "%s/%s%s", own->folder, name, endings[i]);
        if (strcmp(ending_of(own), endings[i]) != 0 && access(other, F_OK) == 0)
            return diag_fail(runner_diag(runner), DIAG_CANNOT_CREATE,
                             "%s: a table of another run; remove it, or name another folder",
                             other);
    }
    return 0;
}

static int open_names(struct tables_state *own, struct runner *runner)
{
    own->names = npy_columns_begin(runner_arena(runner));
    own->tables.names = &own->names;
    own->named = runner_output_in(runner, own->folder, "names.json");
    return own->named != NULL ? 0 : -1;
}

static int open_outputs(struct tables_state *own, struct runner *runner)
{
    own->made = mkdir(own->folder, 0777) == 0;
    if (!own->made && errno != EEXIST)
        return diag_fail(runner_diag(runner), DIAG_CANNOT_CREATE, "DIR: %s: %s", own->folder,
                         strerror(errno));
    for (int i = 0; i < TABLE_COUNT; i++) {
        const char *name = detection_tables_names[i];
        if (!own->npy && refuse_other(name, own, runner) != 0)
            return -1;
        own->outputs[i] = runner_output_in(
            runner, own->folder, arena_format(runner_arena(runner), "%s%s", name, ending_of(own)));
        if (own->outputs[i] == NULL)
            return -1;
        own->tables.rows[i] = output_text(own->outputs[i]);
    }
    if (own->npy && open_names(own, runner) != 0)
        return -1;
    detection_tables_begin(&own->tables, own->part * DETECTION_TABLES_KEYS, runner_arena(runner));
    return 0;
}

static int open_copy_and_counts(struct tables_state *own, struct runner *runner)
{
    own->counted.arena = runner_arena(runner);
    if (own->plain + own->zstd + own->npy > 1)
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--plain, --zstd, --npy: expected one of them");
    if (own->without_objects && own->copy == NULL)
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--without-objects: is for a copy; expected --copy FILE, too");
    if (own->counts && runner_output(runner) == NULL)
        return -1;
    if (own->copy != NULL && (own->copied = runner_output_beside(runner, own->copy)) == NULL)
        return diag_prefix(runner_diag(runner), "--copy: ");
    return 0;
}

static int send_rows(struct tables_state *own, struct runner *runner)
{
    for (int i = 0; i < TABLE_COUNT; i++)
        if (output_send(own->outputs[i], runner_diag(runner)) != 0)
            return -1;
    return 0;
}

static int copy_frame(struct tables_state *own, struct frame *frame, struct diag *diag)
{
    if (own->without_objects) {
        frame->sections &= ~(unsigned)CARRY_OBJECTS;
        frame_drop(frame, PART_OBJECTS);
    }
    return frame_text_write(frame, output_text(own->copied), diag) == 0
               ? output_send(own->copied, diag)
               : -1;
}

static int add_frame(struct tables_state *own, struct frame *frame, struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    if (detection_tables_add(&own->tables, frame, diag) != 0 || send_rows(own, runner) != 0)
        return -1;
    if (own->counts && stream_counts_add(&own->counted, frame, diag) != 0)
        return -1;
    return own->copied != NULL ? copy_frame(own, frame, diag) : 0;
}

/* Writes the numbers of rows into the arrays, and the names beside them. */
static int end_arrays(struct tables_state *own, struct runner *runner)
{
    struct text head = {0};
    int result = 0;
    for (int i = 0; i < TABLE_COUNT && result == 0; i++) {
        head.length = 0;
        detection_tables_write_head(&own->tables, (enum table)i, &head);
        result = output_write_head(own->outputs[i], head.bytes, head.length, runner_diag(runner));
    }
    text_free(&head);
    npy_columns_write_names(&own->names, output_text(own->named));
    return result;
}

static int write_counts(struct tables_state *own, struct runner *runner)
{
    struct text text = {0};
    stream_counts_write(&own->counted, &text);
    detection_tables_write_counts(&own->tables, &text);
    return runner_write_fitted(runner, &text);
}

static int tables_run(void *state, struct runner *runner)
{
    struct tables_state *own = state;
    struct frame *frame;
    int more = open_copy_and_counts(own, runner) == 0 && open_outputs(own, runner) == 0 ? 1 : -1;
    while (more > 0 && (more = runner_frame_ascending(runner, &frame)) > 0)
        if (add_frame(own, frame, runner) != 0)
            more = -1;
    if (more == 0 && own->npy)
        more = end_arrays(own, runner);
    return more == 0 && own->counts ? write_counts(own, runner) : more;
}

static void tables_release(void *state)
{
    struct tables_state *own = state;
    arena_free(&own->counted.open_names);
    npy_columns_end(&own->names);
    if (own->made)
        rmdir(own->folder); /* which fails if it has tables */
}

static const struct field tables_options[] = {
    {FIELD_NAME_OF(struct tables_state, folder,
                   "the folder for the seven tables; it is made if it does not exist")},
    {OPTIONAL_FLAG(struct tables_state, plain, "write .csv instead of .csv.gz")},
    {OPTIONAL_FLAG(struct tables_state, npy, "write arrays of NumPy, .npy, and names.json")},
    {OPTIONAL_FLAG(struct tables_state, zstd, "write .csv.zst instead of .csv.gz")},
    {OPTIONAL_NAME(struct tables_state, copy, "also write the frames to this file"),
     .word = "FILE"},
    {OPTIONAL_FLAG(struct tables_state, without_objects, "leave the objects out of the copy")},
    {OPTIONAL_FLAG(struct tables_state, counts,
                   "print counts as glint-summary does, and of the tables' rows")},
    {OPTIONAL_INTEGER(struct tables_state, part, 0, 9e6,
                      "number of this part of a set; its keys begin at 1e9 times the number")},
    {0},
};

const struct stage stage_tables = {
    .name = "tables",
    .summary = "Write tables of targets, labels, objects, scans, sightings, losses and frames.",
    .details =
        "The files are detections.csv.gz, objects.csv.gz and so on; schemas/README.md describes "
        "them. Columns are the members of the frame, with the same names and units; those that end "
        "in _key are whole numbers that join the rows of two tables. The parts of a set need "
        "different keys, by --part. --npy writes arrays of NumPy, in which text is the place of a "
        "name in names.json. Readers take tables plain and packed (.csv, .csv.gz, .csv.zst), so a "
        "folder with tables of another kind is refused; arrays may lie beside them. Old tables are "
        "removed before the first new one is written; if a run is killed then, run it again.",
    .options = STAGE_OPTIONS(struct tables_state, tables_options),
    .operand = "DIR",
    .into_folder = true,
    .reads = PART_SENSORS | PART_TARGETS,
    .run = tables_run,
    .release = tables_release,
};
