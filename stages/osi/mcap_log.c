#include "mcap_log.h"

void mcap_log_add_message(struct mcap_log *log, uint16_t channel)
{
    mcap_file_add_message(&log->file, channel, log->trace.time_ns, &log->message);
    log->message.length = 0;
}

uint16_t mcap_log_channel(struct mcap_log *log, size_t fixed_count, const char *sensor,
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
