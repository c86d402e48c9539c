/* Messages of ROS 2: points, transforms and boxes.
 *
 *     sensor_msgs/msg/PointCloud2         the targets of a scan, in the axes of its sensor: x along
 *                                         the boresight, y to the left, z up
 *     tf2_msgs/msg/TFMessage              map to base_link, the middle of the ego's rear axle on
 *                                         the road, and base_link to radar_NAME for each sensor
 *     visualization_msgs/msg/MarkerArray  a box and a text for each object, in map
 *
 * map is the frame's own system of coordinates, with z = 0 on the road. Units are m, rad, m/s and
 * dB. Stamps are times of the trace: of a cloud that of its scan, else that of the frame. */
#pragma once

#include "base/text.h"
#include "trace.h"

/* The last second of a stamp, and the first one: to tf2 a stamp of 0 means the latest. */
#define ROS_END_S 2147483647.0
#define ROS_BEGIN_S 1.0

/* The definitions of these messages, and of those in them (ros_*.msg). */
extern const char ros_point_cloud[], ros_transforms[], ros_markers[];

/* True if a topic and a frame of coordinates can be named after the sensor: letters, digits and
 * underscores, no digit first. */
bool ros_takes_name(const char *sensor);

/* Appends the targets of a sensor that measured. All values are float32 but the last three, which
 * are uint32; a value that the target does not have is NaN. */
void ros_add_points(struct trace *trace, const struct sensor_view *sensor, struct text *text);

/* Appends the pose of the ego age_s before the frame's time, as its scans of that age have it: at
 * constant speed and turn rate. With it come the mounts of the sensors of these scans, or of all
 * sensors at the frame's time. */
void ros_add_transforms(const struct trace *trace, double age_s, struct text *text);

/* Appends markers that replace all earlier ones. The id of both markers of an object is its number
 * in the trace, which points have as their object. */
void ros_add_boxes(struct trace *trace, struct text *text);
