/* MCAP: one indexed file with what viewers draw, the frames themselves, and messages of OSI. */
#include "export/mcap.h"
#include "export/foxglove.h"
#include "export/osi_trace.h"
#include "export/record_schema.h"
#include "frame/frame_text.h"
/* needs: libprotobuf-c */
#include "run/stage.h"

#include <protobuf-c/protobuf-c.h>

struct mcap_stage {
    struct osi_trace trace; /* first: its option is the stage's */
    bool without_osi;
    struct mcap file;
    struct foxglove foxglove;
    struct intern sensors;
    uint16_t frames, scene, osi, sensor; /* channels; that of the first sensor */
    uint16_t points;                     /* schema */
    struct text message;
};

/* The interface of OSI as a FileDescriptorSet, which make prints. */
extern const char osi_trace_descriptors[];
extern const unsigned osi_trace_size;

#define OSI "3.8.0"

static const char *const of_nothing[] = {NULL};
static const char *const of_trace[] = {"version",
                                       OSI,
                                       "min_osi_version",
                                       OSI,
                                       "max_osi_version",
                                       OSI,
                                       "min_protobuf_version",
                                       PROTOBUF_C_VERSION,
                                       "max_protobuf_version",
                                       PROTOBUF_C_VERSION,
                                       "description",
                                       "radial_velocity is positive towards the sensor",
                                       NULL};
static const char *const of_channel[] = {"net.asam.osi.trace.channel.osi_version", OSI,
                                         "net.asam.osi.trace.channel.protobuf_version",
                                         PROTOBUF_C_VERSION, NULL};

static uint16_t add_json_channel(struct mcap *file, const char *topic, const char *schema_name,
                                 const char *schema)
{
    return mcap_add_channel(
        file, mcap_add_schema(file, schema_name, "jsonschema", schema, strlen(schema)), topic,
        "json", of_nothing);
}

static int mcap_start(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    struct mcap *file = &own->file;
    struct text schema = {0};
    own->trace.arena = own->foxglove.arena = file->arena = runner_arena(runner);
    mcap_begin(file, own->without_osi ? "glint" : "net.asam.osi.trace",
               own->without_osi ? of_nothing : of_trace);
    record_schema_add(&frame_record, false, &schema);
    own->frames = add_json_channel(file, "/frames", "glint.frame",
                                   arena_text(file->arena, schema.bytes, schema.length));
    own->scene = add_json_channel(file, "/scene", "foxglove.SceneUpdate", foxglove_scene_update);
    own->points = mcap_add_schema(file, "foxglove.PointCloud", "jsonschema", foxglove_point_cloud,
                                  strlen(foxglove_point_cloud));
    if (!own->without_osi)
        own->osi = mcap_add_channel(file,
                                    mcap_add_schema(file, "osi3.SensorData", "protobuf",
                                                    osi_trace_descriptors, osi_trace_size),
                                    "/osi/SensorData", "protobuf", of_channel);
    own->sensor = (uint16_t)(file->channels.count + 1);
    text_free(&schema);
    return 0;
}

static void add_message(struct mcap_stage *own, uint16_t channel)
{
    mcap_add_message(&own->file, channel, own->trace.time_ns, own->message.bytes,
                     own->message.length);
    own->message.length = 0;
}

/* Adds the points of a scan, and the channel of its sensor if they are the first. */
static int add_points(struct mcap_stage *own, const struct frame *frame,
                      const struct sensor_view *sensor, struct diag *diag)
{
    struct mcap *file = &own->file;
    uint32_t channel = own->sensor + intern_word(&own->sensors, sensor->name, file->arena);
    if (channel > UINT16_MAX)
        return diag_fail(diag, DIAG_DATA, "sensors: a file of MCAP has at most %d channels",
                         UINT16_MAX);
    if (channel > file->channels.count)
        mcap_add_channel(file, own->points, arena_format(frame->arena, "/radar/%s", sensor->name),
                         "json", of_nothing);
    foxglove_add_points(&own->foxglove, frame, sensor,
                        osi_trace_ns(&own->trace, frame->time_s - sensor->age_s), &own->message);
    add_message(own, (uint16_t)channel);
    return 0;
}

static int send(struct mcap_stage *own, struct runner *runner)
{
    int result = runner_write(runner, own->file.out.bytes, own->file.out.length);
    mcap_sent(&own->file);
    return result;
}

static int mcap_step(void *state, struct frame *frame, struct runner *runner)
{
    struct mcap_stage *own = state;
    struct diag *diag = runner_diag(runner);
    if (osi_trace_take(&own->trace, frame, diag) != 0 ||
        frame_text_write(frame, &own->message, diag) != 0)
        return -1;
    own->message.length--; /* the newline */
    add_message(own, own->frames);
    foxglove_add_scene(&own->foxglove, frame, own->trace.time_ns, &own->message);
    add_message(own, own->scene);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured &&
            add_points(own, frame, &frame->sensors.list.items[i], diag) != 0)
            return -1;
    if (!own->without_osi) {
        if (osi_trace_add(&own->trace, frame, &own->message, diag) != 0)
            return -1;
        add_message(own, own->osi);
    }
    return send(own, runner);
}

static int mcap_stop(void *state, struct runner *runner)
{
    struct mcap_stage *own = state;
    mcap_end(&own->file);
    return send(own, runner);
}

static void mcap_release(void *state)
{
    struct mcap_stage *own = state;
    mcap_free(&own->file);
    text_free(&own->message);
}

static const struct field mcap_fields[] = {
    OSI_TRACE_OPTION,
    {OPTIONAL_FLAG(struct mcap_stage, without_osi,
                   "write no messages of OSI, for which targets need quality")},
    {0},
};

const struct stage stage_mcap = {
    .name = "mcap",
    .summary = "Write an MCAP file with points, boxes, labels, frames and messages of OSI.",
    .details = "",
    .options = STAGE_OPTIONS(struct mcap_stage, mcap_fields),
    .sink = true,
    .reads = SECTION_OBJECTS | SECTION_SENSORS | SECTION_TARGETS,
    .start = mcap_start,
    .step = mcap_step,
    .stop = mcap_stop,
    .release = mcap_release,
};
