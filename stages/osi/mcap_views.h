/* A file of MCAP for viewers, frame by frame.
 *
 *     /osi/SensorData  messages of OSI, with their descriptors
 *     /frames          the lines, and their schema
 *     /scene           boxes of objects, for viewers
 *     /radar/NAME      points of each scan, for viewers */
#pragma once

#include "mcap_log.h"

void mcap_views_begin(struct mcap_log *log);

/* Adds the messages of the trace's frame. */
int mcap_views_add(struct mcap_log *log, struct diag *diag);
