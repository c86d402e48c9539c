/* MCAP: one indexed file for viewers, with the frames themselves and messages of OSI, or for ROS 2.
 */
#include "base/intern.h"
#include "mcap_ros.h"
#include "mcap_views.h"
#include "run/stage.h"

struct mcap_stage {
    struct mcap_log log; /* first: its option is the stage's */
    bool ros2;
    struct mcap_ros_times transforms;
    struct vec2 origin_m; /* of the first frame */
    size_t points, flat;  /* how many so far, and how many of them have no elevation */
    struct intern low;    /* names of sensors whose height is not known */
};

static int mcap_start(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    own->log.trace.arena = own->log.file.arena = runner_arena(runner);
    if (own->ros2)
        mcap_ros_begin(&own->log);
    else
        mcap_views_begin(&own->log);
    return !runner_output_is_terminal(runner)
               ? 0
               : diag_fail(runner_diag(runner), DIAG_USAGE,
                           "standard output is a terminal; write the file: -o FILE");
}

/* Viewers and tf2 have one system of coordinates for all frames. */
static int check_origin(struct mcap_stage *own, struct diag *diag)
{
    struct vec2 origin_m = {own->log.trace.frame->origin_x_m, own->log.trace.frame->origin_y_m};
    if (own->log.file.messages == 0)
        own->origin_m = origin_m;
    if (vec2_same(origin_m, own->origin_m))
        return 0;
    return diag_fail(diag, DIAG_DATA,
                     "origin_x_m, origin_y_m: (%.12g, %.12g) after (%.12g, %.12g); expected one "
                     "origin in a scene",
                     origin_m.x, origin_m.y, own->origin_m.x, own->origin_m.y);
}

/* Notes what stands for something that nobody measured. */
static void note_constants(struct mcap_stage *own, const struct frame *frame, struct arena *lasting)
{
    own->points += frame->targets.count;
    for (size_t i = 0; i < frame->targets.count; i++)
        own->flat += (frame->targets.items[i].present & VALUE_ELEVATION) == 0;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].mount_z_m == 0)
            intern_word(&own->low, frame->sensors.list.items[i].name, lasting);
}

static int add_frame(struct mcap_stage *own, struct diag *diag)
{
    if (own->ros2)
        return mcap_ros_add(&own->log, &own->transforms, diag);
    return mcap_views_add(&own->log, diag);
}

static int send(struct mcap_file *file, struct runner *runner)
{
    int result = runner_write(runner, file->out.bytes, file->out.length);
    mcap_file_sent(file);
    return result;
}

static int mcap_step(void *state, struct frame *frame, struct runner *runner)
{
    struct mcap_stage *own = state;
    struct diag *diag = runner_diag(runner);
    if (trace_take(&own->log.trace, frame, diag) != 0 || check_origin(own, diag) != 0 ||
        add_frame(own, diag) != 0)
        return -1;
    note_constants(own, frame, runner_arena(runner));
    return send(&own->log.file, runner);
}

static void tell_constants(const struct mcap_stage *own, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    if (own->flat > 0)
        runner_notice(runner,
                      arena_format(arena,
                                   "z is 0 in %zu of %zu points: their radars measure no elevation",
                                   own->flat, own->points));
    if (own->low.list.count == 0)
        return;
    const char *names = intern_text(&own->low, 0);
    for (uint32_t i = 1; i < own->low.list.count; i++)
        names = arena_format(arena, "%s, %s", names, intern_text(&own->low, i));
    runner_notice(runner,
                  arena_format(arena,
                               "0 m is taken as the height of radars that have no mount_z_m: %s",
                               names));
}

static int mcap_stop(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    tell_constants(own, runner);
    mcap_file_end(&own->log.file);
    return send(&own->log.file, runner);
}

static void mcap_release(void *state)
{
    struct mcap_stage *own = state;
    mcap_file_free(&own->log.file);
    text_free(&own->log.message);
}

static const struct field mcap_fields[] = {
    TRACE_OPTION,
    {OPTIONAL_FLAG(struct mcap_stage, ros2,
                   "for ROS 2: points, transforms and boxes; times then begin at 1 s or later")},
    {0},
};

const struct stage stage_mcap = {
    .name = "mcap",
    .summary = "Write an MCAP file with points, boxes, labels, frames and messages of OSI.",
    .details =
        "Viewers draw the targets of each sensor (/radar/SENSOR) and the boxes of objects with "
        "their ids and classes (/scene). /frames has the frames as JSON with all labels, "
        "/osi/SensorData the messages that glint-osi writes. With --ros2 the file is a bag of "
        "ROS 2: a PointCloud2 of each sensor (/radar/SENSOR), /tf, and a MarkerArray of the "
        "objects (/objects). data/exports/README.md describes both. A file holds one scene; "
        "frames need --sections quality.",
    .options = STAGE_OPTIONS(struct mcap_stage, mcap_fields),
    .sink = true,
    .reads = PART_OBJECTS | PART_SENSORS | PART_TARGETS,
    .start = mcap_start,
    .step = mcap_step,
    .stop = mcap_stop,
    .release = mcap_release,
};
