/* Messages of ROS 2: points, transforms and boxes.
 *
 *     sensor_msgs/msg/PointCloud2         the targets of a scan, in the axes of its sensor: x along
 *                                         the boresight, y to the left, z up
 *     tf2_msgs/msg/TFMessage              map to base_link, the middle of the ego's rear axle on
 *                                         the road, and base_link to radar_NAME for each sensor
 *     visualization_msgs/msg/MarkerArray  a box and a text for each object, in map
 *
 * They are CDR, little-endian, as is the data of points. map is the frame's own system of
 * coordinates, with z = 0 on the road. A point is float32 values, NaN where they are not known,
 * and then uint32 labels:
 *
 *     x y z                                        m
 *     radial_speed                                 m/s, positive where the point recedes
 *     power rcs snr                                dB, dBsm, dB
 *     azimuth_angle elevation_angle range          rad, positive to the left and up; m
 *     range_std azimuth_std elevation_std          standard deviations: m, rad, rad
 *     range_rate_std                               m/s
 *     ground_relative_radial_velocity              m/s, without the sensor's own motion
 *     object path contributors                     scan_point.h */
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

/* Appends the targets of a sensor that measured, stamped with the time that the scan shows. */
void ros_add_points(struct trace *trace, const struct sensor_view *sensor, struct text *text);

/* Appends the pose of the ego age_s before the frame's time, as its scans of that age have it: at
 * constant speed and turn rate. With it come the mounts of the sensors of these scans, or of all
 * sensors at the frame's time. */
void ros_add_transforms(const struct trace *trace, double age_s, struct text *text);

/* Appends markers, stamped with the frame's time, that replace all earlier ones. The id of both
 * markers of an object is its number in the trace, which points have as their object. */
void ros_add_boxes(struct trace *trace, struct text *text);
