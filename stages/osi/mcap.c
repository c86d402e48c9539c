/* MCAP: one indexed file with what viewers draw, the frames themselves, and messages of OSI. */
#include "export/record_schema.h"
#include "foxglove.h"
#include "frame/frame_text.h"
#include "mcap_file.h"
#include "run/stage.h"

#include <protobuf-c/protobuf-c.h>

struct mcap_stage {
    struct osi_trace trace; /* first: its option is the stage's */
    struct mcap_file file;
    struct intern sensors;
    struct text message;
};

enum { OSI = 1, FRAMES, SCENE, SENSORS }; /* channels; SENSORS is that of the first sensor */

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

static uint16_t add_json(struct mcap_file *file, const char *topic, const char *name,
                         const char *schema)
{
    return mcap_file_add_channel(
        file, topic,
        &(struct mcap_schema){name, "jsonschema", "json", schema, strlen(schema), none});
}

static int mcap_start(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    own->trace.arena = own->file.arena = runner_arena(runner);
    mcap_file_begin(&own->file, "net.asam.osi.trace", of_file);
    mcap_file_add_channel(&own->file, "/osi/SensorData",
                          &(struct mcap_schema){"osi3.SensorData", "protobuf", "protobuf",
                                                osi_trace_descriptors, osi_trace_size, of_osi});
    record_schema_add(&frame_record, false, &own->message);
    text_add(&own->message, "", 1);
    add_json(&own->file, "/frames", "glint.frame", own->message.bytes);
    add_json(&own->file, "/scene", "foxglove.SceneUpdate", foxglove_scene_schema);
    own->message.length = 0;
    return !runner_output_is_terminal(runner)
               ? 0
               : diag_fail(runner_diag(runner), DIAG_USAGE,
                           "standard output is a terminal; write the file: -o FILE");
}

static void add_message(struct mcap_stage *own, uint16_t channel)
{
    mcap_file_add_message(&own->file, channel, own->trace.time_ns, &own->message);
    own->message.length = 0;
}

/* Adds the points of a scan, and the channel of its sensor if it is the first. */
static int add_points(struct mcap_stage *own, const struct frame *frame,
                      const struct sensor_view *sensor, struct diag *diag)
{
    uint32_t channel = SENSORS + intern_word(&own->sensors, sensor->name, own->trace.arena);
    if (channel > UINT16_MAX)
        return diag_fail(diag, DIAG_DATA, "sensors: MCAP has room for %d channels", UINT16_MAX);
    if (channel > own->file.channels.count)
        add_json(&own->file, arena_format(frame->arena, "/radar/%s", sensor->name),
                 "foxglove.PointCloud", foxglove_points_schema);
    foxglove_add_points(&own->trace, frame, sensor, &own->message);
    add_message(own, (uint16_t)channel);
    return 0;
}

static int send(struct mcap_stage *own, struct runner *runner)
{
    int result = runner_write(runner, own->file.out.bytes, own->file.out.length);
    mcap_file_sent(&own->file);
    return result;
}

static int mcap_step(void *state, struct frame *frame, struct runner *runner)
{
    struct mcap_stage *own = state;
    struct diag *diag = runner_diag(runner);
    if (osi_trace_take(&own->trace, frame, diag) != 0 ||
        osi_trace_add(&own->trace, frame, &own->message, diag) != 0)
        return -1;
    add_message(own, OSI);
    if (frame_text_write(frame, &own->message, diag) != 0)
        return -1;
    own->message.length--; /* the newline */
    add_message(own, FRAMES);
    foxglove_add_scene(&own->trace, frame, &own->message);
    add_message(own, SCENE);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured &&
            add_points(own, frame, &frame->sensors.list.items[i], diag) != 0)
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

static const struct field mcap_fields[] = {OSI_TRACE_OPTION, {0}};

const struct stage stage_mcap = {
    .name = "mcap",
    .summary = "Write an MCAP file with points, boxes, labels, frames and messages of OSI.",
    .details =
        "Viewers draw the targets of each sensor (/radar/SENSOR) and the boxes of objects with "
        "their ids and classes (/scene). /frames has the frames as JSON with all labels, "
        "/osi/SensorData the messages that glint-osi writes. data/exports/README.md describes the "
        "file. It holds one scene; frames need --sections quality.",
    .options = STAGE_OPTIONS(struct mcap_stage, mcap_fields),
    .sink = true,
    .reads = PART_OBJECTS | PART_SENSORS | PART_TARGETS,
    .start = mcap_start,
    .step = mcap_step,
    .stop = mcap_stop,
    .release = mcap_release,
};
