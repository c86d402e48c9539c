/* Messages of Foxglove's viewers: point clouds, boxes and labels.
 *
 * They are JSON by the schemas foxglove_*.json. Places are those of frames, in "world". Objects
 * have numbers from 1 on, in the order in which they first appear. foxglove.c is linked with
 * glint-mcap alone. */
#pragma once

#include "base/intern.h"
#include "base/text.h"
#include "frame/frame.h"

struct foxglove {
    struct arena *arena;
    struct intern objects;
};

/* The schemas as texts, which make prints. */
extern const char foxglove_point_cloud[], foxglove_scene_update[];

/* Appends the targets of a sensor that measured as a PointCloud, with the pose of the sensor. The
 * object of a point is that of the strongest contributor; 0: none. */
void foxglove_add_points(struct foxglove *own, const struct frame *frame,
                         const struct sensor_view *sensor, uint64_t time_ns, struct text *text);

/* Appends a SceneUpdate with the boxes of all objects, and the labels of all targets. */
void foxglove_add_scene(struct foxglove *own, const struct frame *frame, uint64_t time_ns,
                        struct text *text);
