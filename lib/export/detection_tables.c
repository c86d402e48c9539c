#include "export/detection_tables.h"

#include <inttypes.h>

#include "frame/frame_order.h"
#include "geometry/kinematics.h"

const char *const detection_tables_names[] = {
    [TABLE_DETECTIONS] = "detections", [TABLE_OBJECTS] = "objects",
    [TABLE_SCANS] = "scans",           [TABLE_CONTRIBUTORS] = "contributors",
    [TABLE_SIGHTINGS] = "sightings",   [TABLE_LOST] = "lost",
    [TABLE_FRAMES] = "frames",
};

/* What rows have beside the members of the frame. Each table takes its columns from this struct by
 * records of its own. */
struct row {
    int64_t frame_key, scan_key, object_key, detection_key;
    const char *scene, *ego;
    uint64_t seed;
    int64_t frame;
    double time_s, interval_s, measured_s;
    bool last;
    double origin_x_m, origin_y_m;
    const char *suite, *sensor;
    int64_t detections, detection, contributors, contributor;
    double sensor_x_m, sensor_y_m, sensor_yaw_rad, sensor_vx_mps, sensor_vy_mps;
    const char *class;
    int64_t radar_ghost_label;
};

/* The rows of each other table that belong to a frame. */
struct row_counts {
    int64_t of[TABLE_COUNT];
};

enum { NO_KEY = -1 };

#define WHOLE(member, help) FIELD_INTEGER_IN(struct row, member, -2, 0x1p53, help)
#define ROW_REAL(member, help) FIELD_REAL_IN(struct row, member, -1e11, 1e11, help)
#define WORD(member, help) FIELD_NAME_OF(struct row, member, help)
#define KEY(member, help)                                                                          \
    {                                                                                              \
        WHOLE(member, help), FIELD_OPTIONAL, .absent = NO_KEY                                      \
    }
#define WHEN                                                                                       \
    {WORD(scene, "unique in a set: source, ego, variant")},                                        \
        {WHOLE(frame, "number in the scene, from 0")},                                             \
    {                                                                                              \
        ROW_REAL(time_s, "end of the interval that the frame stands for")                          \
    }
#define RECORD(fields)                                                                             \
    {                                                                                              \
        FIELD_TABLE(struct row, fields, "row", "Columns of a table.")                              \
    }

static const struct field detection_fields[] = {
    KEY(detection_key, "number of this row"),
    KEY(scan_key, "row of scans"),
    KEY(frame_key, "row of frames"),
    {WHOLE(detection, "place in the sensor's list, from 0")},
    WHEN,
    {0},
};
static const struct record detection_record = RECORD(detection_fields);

static const struct field pose_fields[] = {
    {ROW_REAL(sensor_x_m, "place of the sensor at the measurement, from the frame's origin")},
    {ROW_REAL(sensor_y_m, "place of the sensor at the measurement, from the frame's origin")},
    {ROW_REAL(sensor_yaw_rad, "direction of its boresight")},
    {ROW_REAL(sensor_vx_mps, "velocity of the sensor")},
    {ROW_REAL(sensor_vy_mps, "velocity of the sensor")},
    {0},
};
static const struct record pose_record = RECORD(pose_fields);

static const struct field label_fields[] = {
    KEY(object_key, "row of objects"),
    {WORD(class, "class of the object"), FIELD_OPTIONAL},
    {WHOLE(contributors, "echoes in the label")},
    {WHOLE(radar_ghost_label, "as in the Radar Ghost data set")},
    {0},
};
static const struct record label_record = RECORD(label_fields);

static const struct field truth_fields[] = {
    KEY(object_key, "number of this row"),
    KEY(frame_key, "row of frames"),
    WHEN,
    {0},
};
static const struct record truth_record = RECORD(truth_fields);

static const struct field scan_fields[] = {
    KEY(scan_key, "number of this row"),
    KEY(frame_key, "row of frames"),
    WHEN,
    {0},
};
static const struct record scan_record = RECORD(scan_fields);

static const struct field frame_row_fields[] = {KEY(frame_key, "number of this row"), WHEN, {0}};
static const struct record frame_row_record = RECORD(frame_row_fields);

static const struct field of_frame_fields[] = {
    {FIELD_SEED_OF(struct row, seed, "seed of all random numbers")},
    {ROW_REAL(interval_s, "length of that interval")},
    {FIELD_FLAG_OF(struct row, last, "is this the scene's last frame?")},
    {WORD(ego, "id of the object that carries the sensors")},
    {ROW_REAL(origin_x_m, "origin of the frame's coordinates in those of the source")},
    {ROW_REAL(origin_y_m, "origin of the frame's coordinates in those of the source")},
    {WORD(suite, "name of the suite document")},
    {0},
};
static const struct record of_frame_record = RECORD(of_frame_fields);

#define ROWS_OF(table, name_)                                                                      \
    {                                                                                              \
        .name = (name_), .kind = FIELD_INTEGER, .low = 0, .high = 0x1p53,                          \
        .offset = offsetof(struct row_counts, of[table]),                                          \
        .help = "rows of " name_ " of this frame"                                                  \
    }
static const struct field row_counts_fields[] = {
    ROWS_OF(TABLE_OBJECTS, "objects"),
    ROWS_OF(TABLE_SCANS, "scans"),
    ROWS_OF(TABLE_DETECTIONS, "detections"),
    ROWS_OF(TABLE_CONTRIBUTORS, "contributors"),
    ROWS_OF(TABLE_SIGHTINGS, "sightings"),
    ROWS_OF(TABLE_LOST, "lost"),
    {0},
};
static const struct record row_counts_record = {FIELD_TABLE(
    struct row_counts, row_counts_fields, "row_counts", "Rows of other tables in a frame.")};

static const struct field measurement_fields[] = {
    {WORD(sensor, "name in the suite")},
    {ROW_REAL(measured_s, "instant of the measurement")},
    {WHOLE(detections, "targets of this scan")},
    {0},
};
static const struct record measurement_record = RECORD(measurement_fields);

static const struct field part_fields[] = {
    KEY(detection_key, "row of detections"),
    {WHOLE(contributor, "place in the label, from 0; the leader of the cell is the first")},
    KEY(object_key, "row of objects"),
    {0},
};
static const struct record part_record = RECORD(part_fields);

static const struct field of_scan_fields[] = {
    KEY(scan_key, "row of scans"),
    KEY(object_key, "row of objects"),
    {0},
};
static const struct record of_scan_record = RECORD(of_scan_fields);

static const char *const all[] = {NULL};
/* Columns that stand elsewhere in the row, or say the same for every row. */
static const char *const known_of_scan[] = {"name", "measured", "age_s", NULL};
/* Of the label's echo its names and its weight. */
static const char *const values[] = {
    "range_m", "azimuth_rad", "elevation_rad", "range_rate_mps", "ercs", "time_s", NULL};

/* The structs whose members make a row, in its order. */
static const struct {
    const struct record *record;
    const char *const *without;
} structs[TABLE_COUNT][DETECTION_TABLES_STRUCTS] = {
    [TABLE_DETECTIONS] = {{&detection_record, all},
                          {&target_record, all},
                          {&label_record, all},
                          {&contributor_record, values},
                          {&pose_record, all}},
    [TABLE_OBJECTS] = {{&truth_record, all}, {&object_record, all}},
    [TABLE_SCANS] = {{&scan_record, all},
                     {&of_frame_record, all},
                     {&measurement_record, all},
                     {&pose_record, all},
                     {&sensor_view_record, known_of_scan}},
    [TABLE_CONTRIBUTORS] = {{&part_record, all}, {&contributor_record, all}},
    [TABLE_SIGHTINGS] = {{&of_scan_record, all}, {&sighting_record, all}},
    [TABLE_LOST] = {{&of_scan_record, all}, {&lost_group_record, all}, {&lost_echo_record, all}},
    [TABLE_FRAMES] = {{&frame_row_record, all}, {&of_frame_record, all}, {&row_counts_record, all}},
};

const char *const detection_tables_primary[][2] = {
    [TABLE_DETECTIONS] = {"detection_key"},
    [TABLE_OBJECTS] = {"object_key"},
    [TABLE_SCANS] = {"scan_key"},
    [TABLE_CONTRIBUTORS] = {"detection_key", "contributor"},
    [TABLE_SIGHTINGS] = {"scan_key", "object"},
    [TABLE_LOST] = {NULL},
    [TABLE_FRAMES] = {"frame_key"},
};

void detection_tables_begin(struct detection_tables *tables, int64_t first_key, struct arena *arena)
{
    tables->frame_key = tables->scan_key = first_key;
    tables->object_key = tables->detection_key = first_key;
    tables->end_key = first_key + DETECTION_TABLES_KEYS;
    for (int table = 0; table < TABLE_COUNT; table++) {
        struct text *rows = tables->rows[table];
        for (int i = 0; i < DETECTION_TABLES_STRUCTS && structs[table][i].record != NULL; i++) {
            struct csv_columns *columns = &tables->columns[table][i];
            csv_columns_add(columns, structs[table][i].record, structs[table][i].without, arena);
            columns->zeros = structs[table][i].record == &sighting_record;
        }
        if (rows != NULL)
            detection_tables_write_head(tables, (enum table)table, rows);
    }
}

void detection_tables_write_head(const struct detection_tables *tables, enum table table,
                                 struct text *text)
{
    const struct csv_columns *columns = tables->columns[table];
    if (tables->names != NULL) {
        npy_columns_write_head(columns, DETECTION_TABLES_STRUCTS, tables->row_counts[table], text);
        return;
    }
    for (int i = 0; i < DETECTION_TABLES_STRUCTS; i++)
        csv_columns_write_names(&columns[i], text);
    csv_columns_end_row(text);
}

/* A frame whose rows are being written. */
struct writing {
    struct detection_tables *tables;
    const struct frame *frame;
    struct echo_id echo; /* that was looked for last, as echoes of one object stand together */
    const struct object *object; /* of that echo, or NULL */
    struct row row;
    struct row_counts rows; /* that have been written of the frame */
    bool has_pose;
};

#define STRUCTS(...) ((const void *[DETECTION_TABLES_STRUCTS]){__VA_ARGS__})

/* Appends a row, of which structs are NULL where its cells are empty. */
static void write_row(struct writing *writing, enum table table, const void *const *bases)
{
    struct text *rows = writing->tables->rows[table];
    const struct csv_columns *columns = writing->tables->columns[table];
    struct npy_names *names = writing->tables->names;
    for (int i = 0; i < DETECTION_TABLES_STRUCTS && columns[i].list.count > 0; i++)
        if (names != NULL)
            npy_columns_write(&columns[i], bases[i], names, rows);
        else
            csv_columns_write(&columns[i], bases[i], rows);
    if (names == NULL)
        csv_columns_end_row(rows);
    writing->tables->row_counts[table]++;
    writing->rows.of[table]++;
}

/* Finds the object of an echo and its key, which are NULL and none for the ground and for noise. */
static void find_object(struct writing *writing, const struct echo_id *echo)
{
    const struct frame *frame = writing->frame;
    if (writing->echo.object == NULL || !frame_same_object(&writing->echo, echo)) {
        writing->echo = *echo;
        writing->object = frame_object_of(frame, echo);
    }
    writing->row.object_key =
        writing->object == NULL
            ? NO_KEY
            : writing->tables->object_key + (writing->object - frame->objects.items);
}

static void write_objects(struct writing *writing)
{
    const struct frame *frame = writing->frame;
    for (size_t i = 0; i < frame->objects.count; i++) {
        writing->row.object_key = writing->tables->object_key + (int64_t)i;
        write_row(writing, TABLE_OBJECTS, STRUCTS(&writing->row, &frame->objects.items[i]));
    }
}

static void write_contributors(struct writing *writing, const struct target *target)
{
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *from = &target->contributors.items[i];
        find_object(writing, &from->id);
        writing->row.contributor = (int64_t)i;
        write_row(writing, TABLE_CONTRIBUTORS, STRUCTS(&writing->row, from));
    }
}

/* The first digit of a label of the Radar Ghost data set; classes that are not listed have none. */
static const struct {
    const char *class;
    int64_t digit;
} class_digits[] = {
    {"pedestrian", 1}, {"bicycle", 2},           {"car", 3}, {"van", 3},
    {"truck", 4},      {"articulated_truck", 4}, {"bus", 4}, {"motorcycle", 5},
};

/* The last two digits, by path: 1 or 2 for a last bounce on the object or on the mirror, and a bit
 * for the order: 1, 2 or 4 for one, two or three bounces. */
static const int64_t bounce_digits[] = {
    [PATH_DIRECT] = 11,           [PATH_WALL_OBJECT] = 12, [PATH_OBJECT_WALL] = 22,
    [PATH_WALL_OBJECT_WALL] = 24, [PATH_WHEEL] = 11,       [PATH_LIMB] = 11,
};

enum { LABEL_BACKGROUND = 0, LABEL_NOISE = -2, LABEL_MAIN = 100 };

static int64_t class_digit(const char *class)
{
    if (class == NULL)
        return 0;
    for (size_t i = 0; i < sizeof class_digits / sizeof *class_digits; i++)
        if (strcmp(class, class_digits[i].class) == 0)
            return class_digits[i].digit;
    return 0;
}

/* The label that the Radar Ghost data set would give (Kraus et al. 2021): class, main object,
 * bounce type and bounce order, a digit each. All objects count as its main one, because all ghosts
 * are told apart. */
static int64_t radar_ghost_label(enum path path, const char *class)
{
    if (path == PATH_FALSE_ALARM)
        return LABEL_NOISE;
    int64_t digit = path == PATH_CLUTTER ? 0 : class_digit(class);
    return digit == 0 ? LABEL_BACKGROUND : 1000 * digit + LABEL_MAIN + bounce_digits[path];
}

static void write_detection(struct writing *writing, const struct target *target)
{
    struct row *row = &writing->row;
    const struct contributor *from = frame_strongest(target);
    row->contributors = (int64_t)target->contributors.count;
    find_object(writing, &from->id);
    row->class = writing->object != NULL ? writing->object->class : NULL;
    row->radar_ghost_label = radar_ghost_label(from->id.path, row->class);
    write_row(writing, TABLE_DETECTIONS,
              STRUCTS(row, target, row, from, writing->has_pose ? row : NULL));
}

static void write_sightings(struct writing *writing, const struct sensor_view *sensor)
{
    const struct frame *frame = writing->frame;
    for (size_t i = 0; i < frame->visibility.count; i++) {
        const struct sighting *sighting = &frame->visibility.items[i];
        if (!frame_same_name(sighting->sensor, sensor->name))
            continue;
        find_object(writing, &(struct echo_id){.object = sighting->object});
        write_row(writing, TABLE_SIGHTINGS, STRUCTS(&writing->row, sighting));
    }
}

/* A sensor's lost echoes stand in groups of its name. */
static void write_lost(struct writing *writing, const struct sensor_view *sensor)
{
    const struct frame *frame = writing->frame;
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        if (!frame_same_name(group->sensor, sensor->name))
            continue;
        for (size_t j = 0; j < group->echoes.count; j++) {
            const struct lost_echo *echo = &group->echoes.items[j];
            find_object(writing, &echo->id);
            write_row(writing, TABLE_LOST, STRUCTS(&writing->row, group, echo));
        }
    }
}

static void take_pose(struct writing *writing, const struct sensor_view *sensor)
{
    const struct object *ego = frame_object(writing->frame, writing->frame->ego);
    struct row *row = &writing->row;
    writing->has_pose = ego != NULL;
    if (ego == NULL)
        return;
    struct motion motion = frame_motion(ego, sensor->age_s);
    struct sensor_pose pose = kinematics_sensor_pose(&motion, sensor->mount_x_m, sensor->mount_y_m,
                                                     sensor->mount_yaw_rad);
    row->sensor_x_m = pose.position_m.x;
    row->sensor_y_m = pose.position_m.y;
    row->sensor_yaw_rad = pose.yaw_rad;
    row->sensor_vx_mps = pose.velocity_mps.x;
    row->sensor_vy_mps = pose.velocity_mps.y;
}

static void write_scan(struct writing *writing, const struct sensor_view *sensor)
{
    struct row *row = &writing->row;
    const struct frame *frame = writing->frame;
    row->sensor = sensor->name;
    row->measured_s = frame->time_s - sensor->age_s;
    row->scan_key = writing->tables->scan_key;
    row->detections = 0;
    take_pose(writing, sensor);
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (!frame_same_name(target->sensor, sensor->name))
            continue;
        row->detection = row->detections++;
        row->detection_key = writing->tables->detection_key++;
        write_detection(writing, target);
        write_contributors(writing, target);
    }
    if (sensor->measured || row->detections > 0) {
        write_row(writing, TABLE_SCANS,
                  STRUCTS(row, row, row, writing->has_pose ? row : NULL, sensor));
        writing->tables->scan_key++;
    } else {
        row->scan_key = NO_KEY;
    }
    write_sightings(writing, sensor);
    write_lost(writing, sensor);
}

static struct row row_of(const struct frame *frame, int64_t frame_key)
{
    return (struct row){
        .frame_key = frame_key,
        .scene = frame->scene,
        .ego = frame->ego,
        .seed = frame->seed,
        .frame = frame->frame,
        .time_s = frame->time_s,
        .interval_s = frame->interval_s,
        .last = frame->last,
        .origin_x_m = frame->origin_x_m,
        .origin_y_m = frame->origin_y_m,
        .suite = frame->sensors.suite,
    };
}

static int check_keys(const struct detection_tables *tables, const struct frame *frame,
                      struct diag *diag)
{
    int64_t left = tables->end_key;
    if (tables->frame_key < left && tables->object_key + (int64_t)frame->objects.count <= left &&
        tables->scan_key + (int64_t)frame->sensors.list.count <= left &&
        tables->detection_key + (int64_t)frame->targets.count <= left)
        return 0;
    return diag_fail(diag, DIAG_DATA, "a table has more than %lld rows; expected parts of fewer",
                     (long long)DETECTION_TABLES_KEYS);
}

int detection_tables_add(struct detection_tables *tables, struct frame *frame, struct diag *diag)
{
    if (check_keys(tables, frame, diag) != 0)
        return -1;
    frame_order_objects(frame);
    struct writing writing = {
        .tables = tables,
        .frame = frame,
        .row = row_of(frame, tables->frame_key++),
    };
    write_objects(&writing);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        write_scan(&writing, &frame->sensors.list.items[i]);
    write_row(&writing, TABLE_FRAMES, STRUCTS(&writing.row, &writing.row, &writing.rows));
    tables->object_key += (int64_t)frame->objects.count;
    return 0;
}

void detection_tables_write_counts(const struct detection_tables *tables, struct text *text)
{
    text_format(text, "rows of tables\n");
    for (int i = 0; i < TABLE_COUNT; i++)
        text_format(text, "%9" PRId64 "  %s\n", tables->row_counts[i], detection_tables_names[i]);
}
