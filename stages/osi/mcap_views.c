#include "mcap_views.h"
#include "export/record_schema.h"
#include "foxglove.h"
#include "frame/frame_text.h"
#include "osi_trace.h"

#include <protobuf-c/protobuf-c.h>

enum { OSI = 1, FRAMES, SCENE, FIXED_COUNT = SCENE }; /* channels that are of no sensor */

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

static struct mcap_schema json_of(const char *name, const char *schema)
{
    return (struct mcap_schema){name, "jsonschema", "json", schema, strlen(schema), none};
}

void mcap_views_begin(struct mcap_log *log)
{
    struct mcap_file *file = &log->file;
    struct mcap_schema osi = {"osi3.SensorData",     "protobuf",     "protobuf",
                              osi_trace_descriptors, osi_trace_size, of_osi};
    log->trace.end_s = OSI_TRACE_END_S;
    mcap_file_begin(file, "");
    mcap_file_add_metadata(file, "net.asam.osi.trace", of_file);
    mcap_file_add_channel(file, "/osi/SensorData", &osi);
    record_schema_add(&frame_record, false, &log->message);
    text_add(&log->message, "", 1);
    struct mcap_schema frames = json_of("glint.frame", log->message.bytes);
    struct mcap_schema scene = json_of("foxglove.SceneUpdate", foxglove_scene_schema);
    mcap_file_add_channel(file, "/frames", &frames);
    mcap_file_add_channel(file, "/scene", &scene);
    log->message.length = 0;
}

int mcap_views_add(struct mcap_log *log, struct diag *diag)
{
    const struct frame *frame = log->trace.frame;
    osi_trace_add(&log->trace, &log->message);
    mcap_log_add_message(log, OSI);
    if (frame_text_write(frame, &log->message, diag) != 0)
        return -1;
    log->message.length--; /* the newline */
    mcap_log_add_message(log, FRAMES);
    foxglove_add_scene(&log->trace, &log->message);
    mcap_log_add_message(log, SCENE);
    struct mcap_schema points = json_of("foxglove.PointCloud", foxglove_points_schema);
    return mcap_log_add_points(log, FIXED_COUNT, &points, foxglove_add_points, diag);
}
