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
                             "amplitude_db,contributors,object,reflector,path,weight,"
                             "radar_ghost_label\n";

/* The cells of a row that are about a target. A scan without targets leaves them empty. */
enum { TARGET_CELLS = 10 };

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

/* The first digit of a label of the Radar Ghost data set; classes that are not listed have none. */
static const struct {
    const char *class;
    int64_t digit;
} class_digits[] = {
    {"pedestrian", 1}, {"bicycle", 2},           {"car", 3}, {"van", 3},
    {"truck", 4},      {"articulated_truck", 4}, {"bus", 4}, {"motorcycle", 5},
};

/* Its last two digits, by path: 1 or 2 for a last bounce on the object or on the mirror, and a bit
 * for the order: 1, 2 or 4 for one, two or three bounces. */
static const int64_t bounce_digits[] = {
    [PATH_DIRECT] = 11,           [PATH_WALL_OBJECT] = 12, [PATH_OBJECT_WALL] = 22,
    [PATH_WALL_OBJECT_WALL] = 24, [PATH_WHEEL] = 11,       [PATH_LIMB] = 11,
};

enum { LABEL_BACKGROUND = 0, LABEL_NOISE = -2, LABEL_MAIN = 100 };

static int64_t class_digit(const struct object *object)
{
    for (size_t i = 0; object != NULL && i < sizeof class_digits / sizeof *class_digits; i++)
        if (strcmp(object->class, class_digits[i].class) == 0)
            return class_digits[i].digit;
    return 0;
}

/* The label that the Radar Ghost data set would give. All objects count as its main one, because
 * all ghosts are told apart. */
static int64_t radar_ghost_label(const struct frame *frame, const struct echo_id *id)
{
    if (id->path == PATH_FALSE_ALARM)
        return LABEL_NOISE;
    int64_t digit = id->path == PATH_CLUTTER ? 0 : class_digit(frame_object(frame, id->object));
    return digit == 0 ? LABEL_BACKGROUND : 1000 * digit + LABEL_MAIN + bounce_digits[id->path];
}

static const struct contributor *strongest(const struct target *target)
{
    const struct contributor *best = target->contributors.items;
    for (size_t i = 1; i < target->contributors.count; i++)
        if (target->contributors.items[i].weight > best->weight)
            best = &target->contributors.items[i];
    return best;
}

static void add_target(struct row *row, const struct frame *frame, const struct target *target)
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
    add_integer(row, radar_ghost_label(frame, &from->id));
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
        add_target(&row, frame, target);
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

const struct stage stage_export_csv = {
    .name = "export-csv",
    .summary = "Write targets as CSV, one row each, with the strongest contributor.",
    .details =
        "A scan without targets is one row whose cells after the sensor's name are empty, so\n"
        "that scans in which nothing was detected can be counted.",
    .options = STAGE_OPTIONS(struct export_csv, field_none),
    .sink = true,
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .step = export_csv_step,
};
