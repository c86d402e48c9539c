#include "ros.h"
#include "base/elementary.h"
#include "cdr.h"
#include "scan_point.h"

static const char map[] = "map", base_link[] = "base_link";

bool ros_takes_name(const char *sensor)
{
    enum { MOST = 200 }; /* of the 247 bytes of a topic */
    static const char digits[] = "0123456789";
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
    size_t length = strlen(sensor);
    return length <= MOST && strchr(digits, sensor[0]) == NULL && strspn(sensor, letters) == length;
}

static const char *frame_of(const struct frame *frame, const struct sensor_view *sensor)
{
    return arena_format(frame->arena, "radar_%s", sensor->name);
}

static void add_header(struct cdr *cdr, uint64_t time_ns, const char *system)
{
    cdr_add_int32(cdr, (int32_t)(time_ns / TRACE_SECOND_NS));
    cdr_add_uint32(cdr, (uint32_t)(time_ns % TRACE_SECOND_NS));
    cdr_add_string(cdr, system);
}

static void add_reals(struct cdr *cdr, const double *reals, size_t count)
{
    for (size_t i = 0; i < count; i++)
        cdr_add_float64(cdr, reals[i]);
}

/* A place, and a turn about z as a quaternion x, y, z, w. */
static void add_pose(struct cdr *cdr, struct vec2 place_m, double z_m, double yaw_rad)
{
    const double pose[] = {
        place_m.x, place_m.y, z_m, 0, 0, elementary_sin(yaw_rad / 2), elementary_cos(yaw_rad / 2)};
    add_reals(cdr, pose, sizeof pose / sizeof *pose);
}

/* ---- points ---- */

enum datatype { UINT32 = 6, FLOAT32 = 7 };

static const char *const names_of_reals[] = {"x",
                                             "y",
                                             "z",
                                             "radial_speed",
                                             "power",
                                             "rcs",
                                             "snr",
                                             "azimuth_angle",
                                             "elevation_angle",
                                             "range",
                                             "range_std",
                                             "azimuth_std",
                                             "elevation_std",
                                             "range_rate_std",
                                             "ground_relative_radial_velocity"};
static const char *const names_of_labels[] = {"object", "path", "contributors"};

enum {
    REALS = sizeof names_of_reals / sizeof *names_of_reals,
    LABELS = sizeof names_of_labels / sizeof *names_of_labels,
    POINT_STEP = 4 * (REALS + LABELS),
};

static void add_fields(struct cdr *cdr)
{
    cdr_add_uint32(cdr, REALS + LABELS);
    for (uint32_t i = 0; i < REALS + LABELS; i++) {
        bool real = i < REALS;
        cdr_add_string(cdr, real ? names_of_reals[i] : names_of_labels[i - REALS]);
        cdr_add_uint32(cdr, 4 * i); /* offset */
        cdr_add_uint8(cdr, real ? FLOAT32 : UINT32);
        cdr_add_uint32(cdr, 1); /* count */
    }
}

static double known(bool present, double value)
{
    return present ? value : (double)NAN;
}

/* Returns true if all of the target's values are known. */
static bool add_point(struct cdr *cdr, const struct target *target, struct scan_point point)
{
    const struct quality *quality = &target->quality;
    unsigned has = quality->present;
    bool elevation = (target->present & VALUE_ELEVATION) != 0, all_known = true;
    const double reals[REALS] = {
        point.place_m.x,
        point.place_m.y,
        point.up_m,
        target->range_rate_mps,
        target->amplitude_db,
        known(has & QUALITY_RCS, quality->rcs_dbsm),
        known(has & QUALITY_NOISE, quality->snr_db),
        scan_point_azimuth_rad(target),
        known(elevation, target->elevation_rad),
        target->range_m,
        known(has & QUALITY_ERRORS, quality->range_sd_m),
        known(has & QUALITY_ERRORS, quality->azimuth_sd_rad),
        known(has & QUALITY_ELEVATION, quality->elevation_sd_rad),
        known(has & QUALITY_ERRORS, quality->range_rate_sd_mps),
        known(has & QUALITY_EGO, quality->range_rate_over_ground_mps),
    };
    for (int i = 0; i < REALS; i++) {
        all_known = all_known && isfinite((float)reals[i]);
        cdr_add_float32(cdr, (float)reals[i]);
    }
    cdr_add_uint32(cdr, point.object);
    cdr_add_uint32(cdr, point.path);
    cdr_add_uint32(cdr, point.contributors);
    return all_known;
}

static uint32_t count_targets(const struct frame *frame, const char *sensor)
{
    uint32_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++)
        count += frame_same_name(frame->targets.items[i].sensor, sensor);
    return count;
}

void ros_add_points(struct trace *trace, const struct sensor_view *sensor, struct text *text)
{
    const struct frame *frame = trace->frame;
    uint32_t count = count_targets(frame, sensor->name);
    struct cdr cdr = cdr_begin(text);
    bool dense = true;
    add_header(&cdr, trace_ns(trace, frame->time_s - sensor->age_s), frame_of(frame, sensor));
    cdr_add_uint32(&cdr, 1);     /* height */
    cdr_add_uint32(&cdr, count); /* width */
    add_fields(&cdr);
    cdr_add_uint8(&cdr, false); /* not big-endian */
    cdr_add_uint32(&cdr, POINT_STEP);
    cdr_add_uint32(&cdr, POINT_STEP * count); /* row_step */
    cdr_add_uint32(&cdr, POINT_STEP * count); /* bytes that follow */
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (frame_same_name(target->sensor, sensor->name))
            dense &= add_point(&cdr, target, scan_point_of(trace, target));
    }
    cdr_add_uint8(&cdr, dense);
}

/* ---- transforms ---- */

static void add_transform(struct cdr *cdr, uint64_t time_ns, const char *parent, const char *child)
{
    add_header(cdr, time_ns, parent);
    cdr_add_string(cdr, child);
}

/* At the time of a scan only the mounts of its sensors are needed. */
static bool shows_mount(const struct trace *trace, const struct sensor_view *sensor,
                        uint64_t time_ns)
{
    if (time_ns == trace->time_ns)
        return true;
    return sensor->measured && trace_ns(trace, trace->frame->time_s - sensor->age_s) == time_ns;
}

static uint32_t count_mounts(const struct trace *trace, uint64_t time_ns)
{
    uint32_t count = 0;
    for (size_t i = 0; i < trace->frame->sensors.list.count; i++)
        count += shows_mount(trace, &trace->frame->sensors.list.items[i], time_ns);
    return count;
}

void ros_add_transforms(const struct trace *trace, double age_s, struct text *text)
{
    const struct frame *frame = trace->frame;
    const struct object *ego = frame_object(frame, frame->ego);
    const struct motion motion = frame_motion(ego, age_s);
    double axle_x_m = frame_rear_axle_x_m(frame, ego);
    struct vec2 axle_m = vec2_scale(axle_x_m, vec2_heading(motion.yaw_rad));
    uint64_t time_ns = trace_ns(trace, frame->time_s - age_s);
    struct cdr cdr = cdr_begin(text);
    cdr_add_uint32(&cdr, 1 + count_mounts(trace, time_ns));
    add_transform(&cdr, time_ns, map, base_link);
    add_pose(&cdr, vec2_add(motion.position_m, axle_m), 0, motion.yaw_rad);
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *sensor = &frame->sensors.list.items[i];
        struct vec2 mount_m = {sensor->mount_x_m - axle_x_m, sensor->mount_y_m};
        if (!shows_mount(trace, sensor, time_ns))
            continue;
        add_transform(&cdr, time_ns, base_link, frame_of(frame, sensor));
        add_pose(&cdr, mount_m, sensor->mount_z_m, sensor->mount_yaw_rad);
    }
}

/* ---- boxes ---- */

enum marker_type { CUBE = 1, TEXT = 9 };
enum marker_action { ADD, DELETE_ALL = 3 };

struct marker {
    const char *group;
    uint32_t id;
    enum marker_type type;
    enum marker_action action;
    struct vec2 place_m;
    double z_m, yaw_rad;
    double size_m[3];
    float colour[4]; /* red, green, blue, opacity: from 0 to 1 */
    const char *text;
};

static void add_marker(struct cdr *cdr, uint64_t time_ns, const struct marker *marker)
{
    add_header(cdr, time_ns, map);
    cdr_add_string(cdr, marker->group);
    cdr_add_int32(cdr, (int32_t)marker->id);
    cdr_add_int32(cdr, (int32_t)marker->type);
    cdr_add_int32(cdr, (int32_t)marker->action);
    add_pose(cdr, marker->place_m, marker->z_m, marker->yaw_rad);
    add_reals(cdr, marker->size_m, 3);
    for (int i = 0; i < 4; i++)
        cdr_add_float32(cdr, marker->colour[i]);
    cdr_add_int32(cdr, 0); /* lifetime in s and ns: without an end */
    cdr_add_uint32(cdr, 0);
    cdr_add_uint8(cdr, false); /* frame_locked */
    cdr_add_uint32(cdr, 0);    /* points */
    cdr_add_uint32(cdr, 0);    /* colors */
    cdr_add_string(cdr, "");   /* texture_resource */
    add_header(cdr, 0, "");    /* texture: a header, a format and bytes */
    cdr_add_string(cdr, "");
    cdr_add_uint32(cdr, 0);
    cdr_add_uint32(cdr, 0); /* uv_coordinates */
    cdr_add_string(cdr, marker->text);
    cdr_add_string(cdr, ""); /* mesh_resource */
    cdr_add_string(cdr, ""); /* mesh_file: a name and bytes */
    cdr_add_uint32(cdr, 0);
    cdr_add_uint8(cdr, false); /* mesh_use_embedded_materials */
}

static void add_box(struct cdr *cdr, const struct trace *trace, const struct object *object,
                    uint32_t id)
{
    const double above_m = 0.5, letter_m = 0.8;
    struct vec2 place_m = {object->x_m, object->y_m};
    struct marker box = {
        .group = "boxes",
        .id = id,
        .type = CUBE,
        .place_m = place_m,
        .z_m = object->height_m / 2,
        .yaw_rad = object->yaw_rad,
        .size_m = {object->length_m, object->width_m, object->height_m},
        .colour = {0.3F, 0.6F, 1, 0.4F},
        .text = "",
    };
    struct marker label = {
        .group = "labels",
        .id = id,
        .type = TEXT,
        .place_m = place_m,
        .z_m = object->height_m + above_m,
        .size_m = {0, 0, letter_m},
        .colour = {1, 1, 1, 1},
        .text = arena_format(trace->frame->arena, "%s (%s)", object->id, object->class),
    };
    add_marker(cdr, trace->time_ns, &box);
    add_marker(cdr, trace->time_ns, &label);
}

void ros_add_boxes(struct trace *trace, struct text *text)
{
    const struct frame *frame = trace->frame;
    const struct marker all = {.group = "", .type = CUBE, .action = DELETE_ALL, .text = ""};
    struct cdr cdr = cdr_begin(text);
    cdr_add_uint32(&cdr, 1 + 2 * (uint32_t)frame->objects.count);
    add_marker(&cdr, trace->time_ns, &all);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        add_box(&cdr, trace, object, trace_object(trace, object->id));
    }
}
