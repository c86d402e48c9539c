/* A bag of ROS 2, frame by frame.
 *
 *     /tf          transforms at the times of frames and of scans
 *     /objects     boxes of objects
 *     /radar/NAME  points of each scan */
#pragma once

#include "mcap_log.h"

enum { MCAP_ROS_RECENT = 64 };

/* The times of the latest transforms. */
struct mcap_ros_times {
    uint64_t ns[MCAP_ROS_RECENT];
    size_t count; /* of all transforms */
};

void mcap_ros_begin(struct mcap_log *log);

/* Adds the messages of the trace's frame; sent is zeroed before the first one. Refuses a sensor
 * whose name is none in ROS 2. */
int mcap_ros_add(struct mcap_log *log, struct mcap_ros_times *sent, struct diag *diag);
