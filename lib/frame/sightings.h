/* How much of each object a sensor sees and detects.
 *
 * A sensor that measured has a sighting of every object but the ego. Its counts of reflectors
 * narrow down as in MODEL 2.5: all reflectors of the object, then the ones that send towards the
 * sensor from within its range, then the ones in its field of view, then the hidden ones. */
#pragma once

#include "text/field.h"

struct frame;

struct sighting {
    const char *sensor, *object;
    int64_t reflectors, in_range, in_view, blocked;
    double blocked_share; /* blocked over in_view; 0 if in_view is 0 */
    int visibility; /* level of nuScenes by the share that is not hidden: 0 below 0.4, 1 below 0.6,
                     * 2 below 0.8, else 3; 4: in_view is 0 */
    int64_t detections; /* targets with a contributor of the object on a path without mirrors */
    int64_t merged;     /* detections that also have a contributor of another object */
    int64_t ghosts;     /* targets with a contributor of the object on a path by a mirror */
    size_t last_detection, last_ghost; /* number from 1 of the target that was counted last */
};

extern const struct record sighting_record;

/* Sets blocked_share and visibility. */
void sightings_judge(struct sighting *sighting);

/* Counts detections, merged and ghosts anew. The sightings must be in canonical order. */
void sightings_count_targets(struct frame *frame);
