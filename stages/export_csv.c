/* Targets as CSV: one row for each, with the strongest of its contributors. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "run/stage.h"
#include "text/csv_table.h"

struct export_csv {
    bool has_header; /* it has been written */
};

enum { CELL_ROOM = 2 * FIELD_NAME_SIZE + 2 };

static const char header[] = "scene,frame,time_s,sensor,range_m,azimuth_rad,range_rate_mps,"
                             "amplitude_db,contributors,object,reflector,path,weight\n";

/* The cells of a row that are about a target. A scan without targets leaves them empty. */
enum { TARGET_CELLS = 9 };

/* A row that is being written. */
struct row {
    struct runner *runner;
    int cells;  /* written so far */
    int result; /* -1 after a write that failed; nothing is written then */
};

static void add(struct row *row, const char *bytes, size_t length)
{
    if (row->result == 0 && row->cells++ > 0)
        row->result = runner_write(row->runner, ",", 1);
    if (row->result == 0)
        row->result = runner_write(row->runner, bytes, length);
}

static void add_word(struct row *row, const char *word)
{
    char cell[CELL_ROOM];
    add(row, cell, csv_table_quote(word, cell, sizeof cell));
}

static void add_real(struct row *row, double value)
{
    char digits[NUMBER_SIZE];
    add(row, digits, number_write(value, digits));
}

static void add_integer(struct row *row, int64_t value)
{
    char digits[NUMBER_SIZE];
    add(row, digits, (size_t)snprintf(digits, sizeof digits, "%" PRId64, value));
}

static const struct contributor *strongest(const struct target *target)
{
    const struct contributor *best = target->contributors.items;
    for (size_t i = 1; i < target->contributors.count; i++)
        if (target->contributors.items[i].weight > best->weight)
            best = &target->contributors.items[i];
    return best;
}

static void add_target(struct row *row, const struct target *target)
{
    const struct contributor *from = strongest(target);
    add_real(row, target->range_m);
    add_real(row, target->azimuth_rad);
    add_real(row, target->range_rate_mps);
    add_real(row, target->amplitude_db);
    add_integer(row, (int64_t)target->contributors.count);
    add_word(row, from->id.object);
    add_word(row, from->id.reflector);
    add_word(row, frame_path_name(from->id.path));
    add_real(row, from->weight);
}

static int write_row(struct runner *runner, const struct frame *frame, const char *sensor,
                     const struct target *target)
{
    struct row row = {.runner = runner};
    add_word(&row, frame->scene);
    add_integer(&row, frame->frame);
    add_real(&row, frame->time_s);
    add_word(&row, sensor);
    if (target != NULL)
        add_target(&row, target);
    for (int i = 0; target == NULL && i < TARGET_CELLS; i++)
        add(&row, "", 0);
    return row.result == 0 ? runner_write(runner, "\n", 1) : -1;
}

static int write_scan(struct runner *runner, const struct frame *frame,
                      const struct sensor_view *sensor)
{
    bool empty = true;
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (strcmp(target->sensor, sensor->name) != 0)
            continue;
        empty = false;
        if (write_row(runner, frame, sensor->name, target) != 0)
            return -1;
    }
    return empty && sensor->measured ? write_row(runner, frame, sensor->name, NULL) : 0;
}

static int export_csv_step(void *state, struct frame *frame, struct runner *runner)
{
    struct export_csv *export = state;
    if (!export->has_header && runner_write(runner, header, sizeof header - 1) != 0)
        return -1;
    export->has_header = true;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (write_scan(runner, frame, &frame->sensors.list.items[i]) != 0)
            return -1;
    return 0;
}

static const struct record export_csv_record = {
    .name = "stage", .size = sizeof(struct export_csv), .fields = field_none};

const struct stage stage_export_csv = {
    .name = "export-csv",
    .summary = "Write targets as CSV, one row each, with the strongest contributor.",
    .details =
        "A scan without targets is one row whose cells after the sensor's name are empty, so\n"
        "that scans in which nothing was detected can be counted.",
    .options = &export_csv_record,
    .sink = true,
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .step = export_csv_step,
};
