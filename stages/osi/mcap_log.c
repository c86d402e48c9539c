#include "mcap_log.h"

void mcap_log_add_message(struct mcap_log *log, uint16_t channel)
{
    mcap_file_add_message(&log->file, channel, log->trace.time_ns, &log->message);
    log->message.length = 0;
}

static uint16_t channel_of(struct mcap_log *log, size_t fixed_count, const char *sensor,
                           const struct mcap_schema *schema, struct diag *diag)
{
    size_t channel = fixed_count + 1 + intern_word(&log->sensors, sensor, log->trace.arena);
    if (channel <= log->file.channels.count)
        return (uint16_t)channel;
    if (channel <= UINT16_MAX)
        return mcap_file_add_channel(
            &log->file, arena_format(log->trace.frame->arena, "/radar/%s", sensor), schema);
    diag_fail(diag, DIAG_DATA, "sensors: MCAP has room for %d channels", UINT16_MAX);
    return 0;
}

int mcap_log_add_points(struct mcap_log *log, size_t fixed_count, const struct mcap_schema *schema,
                        mcap_log_points *points, struct diag *diag)
{
    const struct frame *frame = log->trace.frame;
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *sensor = &frame->sensors.list.items[i];
        if (!sensor->measured)
            continue;
        uint16_t channel = channel_of(log, fixed_count, sensor->name, schema, diag);
        if (channel == 0)
            return -1;
        points(&log->trace, sensor, &log->message);
        mcap_log_add_message(log, channel);
    }
    return 0;
}
