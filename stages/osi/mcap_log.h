/* A file of MCAP that is filled frame by frame.
 *
 * Its first channels are fixed, and belong to no sensor. Behind them each sensor has a channel of
 * its own, from its first scan on. */
#pragma once

#include "mcap_file.h"
#include "trace.h"

/* Zeroed before the first frame, but for the trace and the arena of the file. */
struct mcap_log {
    struct trace trace; /* first: its option is the stage's */
    struct mcap_file file;
    struct intern sensors; /* that have a channel, in the order of their channels */
    struct text message;   /* the next one */
};

/* Adds the message at the time of the trace's frame, and empties it. */
void mcap_log_add_message(struct mcap_log *log, uint16_t channel);

/* Adds a message of points for each sensor that measured, whose bytes `points` appends, to the
 * sensor's channel, behind so many fixed ones. A sensor without a channel gets one, with the topic
 * /radar/NAME and this schema. 0, or -1 after a message: MCAP has no room for it. */
typedef void mcap_log_points(struct trace *trace, const struct sensor_view *sensor,
                             struct text *text);
int mcap_log_add_points(struct mcap_log *log, size_t fixed_count, const struct mcap_schema *schema,
                        mcap_log_points *points, struct diag *diag);
