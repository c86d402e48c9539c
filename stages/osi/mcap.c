/* MCAP: one indexed file for viewers, with the frames themselves and messages of OSI, or for ROS 2.
 */
#include "export/record_schema.h"
#include "foxglove.h"
#include "frame/frame_text.h"
#include "mcap_file.h"
#include "osi_trace.h"
#include "ros.h"
#include "run/stage.h"

#include <protobuf-c/protobuf-c.h>

enum { RECENT = 64 };

struct recent {
    uint64_t times_ns[RECENT];
    size_t count; /* of all that were noted */
};

struct mcap_stage {
    struct trace trace; /* first: its option is the stage's */
    bool ros2;
    struct mcap_file file;
    size_t shared; /* channels that are of no sensor */
    struct intern sensors;
    struct vec2 origin_m; /* of the first frame */
    struct recent poses;  /* of which transforms were sent */
    struct text message;
};

enum { OSI = 1, FRAMES, SCENE };      /* channels of a file for viewers, before those of sensors */
enum { TRANSFORMS = 1, ROS_OBJECTS }; /* channels of a file for ROS 2 */

/* The interface of OSI as a FileDescriptorSet (Makefile). */
extern const char osi_trace_descriptors[];
extern const unsigned osi_trace_size;

#define VERSION "3.8.0"

static const char *const none[] = {NULL};
static const char *const of_file[] = {"version",
                                      VERSION,
                                      "min_osi_version",
                                      VERSION,
                                      "max_osi_version",
                                      VERSION,
                                      "min_protobuf_version",
                                      PROTOBUF_C_VERSION,
                                      "max_protobuf_version",
                                      PROTOBUF_C_VERSION,
                                      "description",
                                      "radial_velocity is positive towards the sensor",
                                      NULL};
static const char *const of_osi[] = {"net.asam.osi.trace.channel.osi_version", VERSION,
                                     "net.asam.osi.trace.channel.protobuf_version",
                                     PROTOBUF_C_VERSION, NULL};
/* rosbag2 plays topics with its default quality of service. */
static const char *const of_ros[] = {"offered_qos_profiles", "", NULL};

/* ---- channels ---- */

static void add_json(struct mcap_file *file, const char *topic, const char *name,
                     const char *schema)
{
    mcap_file_add_channel(
        file, topic,
        &(struct mcap_schema){name, "jsonschema", "json", schema, strlen(schema), none});
}

static void add_ros(struct mcap_file *file, const char *topic, const char *name,
                    const char *definition)
{
    mcap_file_add_channel(
        file, topic,
        &(struct mcap_schema){name, "ros2msg", "cdr", definition, strlen(definition), of_ros});
}

static void begin_views(struct mcap_stage *own)
{
    own->trace.end_s = OSI_TRACE_END_S;
    mcap_file_begin(&own->file, "");
    mcap_file_add_metadata(&own->file, "net.asam.osi.trace", of_file);
    mcap_file_add_channel(&own->file, "/osi/SensorData",
                          &(struct mcap_schema){"osi3.SensorData", "protobuf", "protobuf",
                                                osi_trace_descriptors, osi_trace_size, of_osi});
    record_schema_add(&frame_record, false, &own->message);
    text_add(&own->message, "", 1);
    add_json(&own->file, "/frames", "glint.frame", own->message.bytes);
    add_json(&own->file, "/scene", "foxglove.SceneUpdate", foxglove_scene_schema);
    own->message.length = 0;
}

static void begin_ros(struct mcap_stage *own)
{
    own->trace.begin_s = ROS_BEGIN_S;
    own->trace.end_s = ROS_END_S;
    mcap_file_begin(&own->file, "ros2");
    add_ros(&own->file, "/tf", "tf2_msgs/msg/TFMessage", ros_transforms);
    add_ros(&own->file, "/objects", "visualization_msgs/msg/MarkerArray", ros_markers);
}

static int mcap_start(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    own->trace.arena = own->file.arena = runner_arena(runner);
    if (own->ros2)
        begin_ros(own);
    else
        begin_views(own);
    own->shared = own->file.channels.count;
    return !runner_output_is_terminal(runner)
               ? 0
               : diag_fail(runner_diag(runner), DIAG_USAGE,
                           "standard output is a terminal; write the file: -o FILE");
}

/* The channel of a sensor, which is added for its first scan; 0 after a message. */
static uint16_t channel_of(struct mcap_stage *own, const char *sensor, struct diag *diag)
{
    size_t channel = own->shared + 1 + intern_word(&own->sensors, sensor, own->trace.arena);
    const char *topic = arena_format(own->trace.frame->arena, "/radar/%s", sensor);
    if (channel <= own->file.channels.count)
        return (uint16_t)channel;
    if (channel > UINT16_MAX)
        diag_fail(diag, DIAG_DATA, "sensors: MCAP has room for %d channels", UINT16_MAX);
    else if (!own->ros2)
        add_json(&own->file, topic, "foxglove.PointCloud", foxglove_points_schema);
    else if (ros_takes_name(sensor))
        add_ros(&own->file, topic, "sensor_msgs/msg/PointCloud2", ros_point_cloud);
    else
        diag_fail(
            diag, DIAG_DATA,
            "sensors: \"%s\" is no name in ROS 2; expected at most 200 letters, digits and _, "
            "no digit first",
            sensor);
    return channel == own->file.channels.count ? (uint16_t)channel : 0;
}

/* ---- messages ---- */

static void add_message(struct mcap_stage *own, uint16_t channel)
{
    mcap_file_add_message(&own->file, channel, own->trace.time_ns, &own->message);
    own->message.length = 0;
}

static int add_views(struct mcap_stage *own, struct diag *diag)
{
    osi_trace_add(&own->trace, &own->message);
    add_message(own, OSI);
    if (frame_text_write(own->trace.frame, &own->message, diag) != 0)
        return -1;
    own->message.length--; /* the newline */
    add_message(own, FRAMES);
    foxglove_add_scene(&own->trace, &own->message);
    add_message(own, SCENE);
    return 0;
}

/* Notes that the ego's pose at a time was sent. Returns false if it was before: tf2 complains of a
 * stamp that comes twice. */
static bool is_new(struct recent *sent, uint64_t time_ns)
{
    for (size_t i = 0; i < RECENT && i < sent->count; i++)
        if (sent->times_ns[i] == time_ns)
            return false;
    sent->times_ns[sent->count++ % RECENT] = time_ns;
    return true;
}

static void add_pose(struct mcap_stage *own, double age_s)
{
    uint64_t time_ns = trace_ns(&own->trace, own->trace.frame->time_s - age_s);
    if (!is_new(&own->poses, time_ns))
        return;
    ros_add_transforms(&own->trace, age_s, &own->message);
    add_message(own, TRANSFORMS);
}

/* Each scan has the pose of its own time. */
static void add_ros_scene(struct mcap_stage *own)
{
    const struct frame *frame = own->trace.frame;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured)
            add_pose(own, frame->sensors.list.items[i].age_s);
    add_pose(own, 0);
    ros_add_boxes(&own->trace, &own->message);
    add_message(own, ROS_OBJECTS);
}

static int add_scan(struct mcap_stage *own, const struct sensor_view *sensor, struct diag *diag)
{
    uint16_t channel = channel_of(own, sensor->name, diag);
    if (channel == 0)
        return -1;
    if (own->ros2)
        ros_add_points(&own->trace, sensor, &own->message);
    else
        foxglove_add_points(&own->trace, sensor, &own->message);
    add_message(own, channel);
    return 0;
}

static int send(struct mcap_stage *own, struct runner *runner)
{
    int result = runner_write(runner, own->file.out.bytes, own->file.out.length);
    mcap_file_sent(&own->file);
    return result;
}

/* Viewers and tf2 have one system of coordinates for all frames. */
static int check_origin(struct mcap_stage *own, struct diag *diag)
{
    struct vec2 origin_m = {own->trace.frame->origin_x_m, own->trace.frame->origin_y_m};
    if (own->file.messages == 0)
        own->origin_m = origin_m;
    if (vec2_same(origin_m, own->origin_m))
        return 0;
    return diag_fail(diag, DIAG_DATA,
                     "origin_x_m, origin_y_m: (%.12g, %.12g) after (%.12g, %.12g); expected one "
                     "origin in a scene",
                     origin_m.x, origin_m.y, own->origin_m.x, own->origin_m.y);
}

static int mcap_step(void *state, struct frame *frame, struct runner *runner)
{
    struct mcap_stage *own = state;
    struct diag *diag = runner_diag(runner);
    if (trace_take(&own->trace, frame, diag) != 0 || check_origin(own, diag) != 0)
        return -1;
    if (own->ros2)
        add_ros_scene(own);
    else if (add_views(own, diag) != 0)
        return -1;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured &&
            add_scan(own, &frame->sensors.list.items[i], diag) != 0)
            return -1;
    return send(own, runner);
}

static int mcap_stop(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    mcap_file_end(&own->file);
    return send(own, runner);
}

static void mcap_release(void *state)
{
    struct mcap_stage *own = state;
    mcap_file_free(&own->file);
    text_free(&own->message);
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
