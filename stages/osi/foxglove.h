/* Messages of Foxglove's viewers: points and boxes.
 *
 * They are JSON by the schemas foxglove_*_schema.json. Places are those of frames, in "world";
 * times are those of the trace. */
#pragma once

#include "base/text.h"
#include "trace.h"

/* Files of this folder as texts without line breaks (Makefile): schemas, and patterns with
 * # for a number, % for a whole number and @ for a string. */
extern const char foxglove_points_schema[], foxglove_points[];
extern const char foxglove_scene_schema[], foxglove_entity[];

/* Appends the targets of a sensor that measured as a PointCloud, with the pose of the sensor. The
 * object of a point is the number of the strongest contributor's; 0: none. */
void foxglove_add_points(struct trace *trace, const struct sensor_view *sensor, struct text *text);

/* Appends a SceneUpdate with the boxes of all objects, their ids and classes. */
void foxglove_add_scene(struct trace *trace, struct text *text);
