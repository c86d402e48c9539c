/* How much of each object a sensor sees and detects.
 *
 * A sensor that measured has a sighting of every object but the ego. Reflectors count in the order
 * of MODEL 2.5: of those that the sensor looked for, those that send towards it and are in range,
 * of these those in view, and of these those that a body hides. */
#pragma once

#include "text/field.h"

struct frame;

struct sighting {
    const char *sensor, *object;
    int64_t reflectors, in_range, in_view, blocked;
    double blocked_share; /* of those in view; 0 if there is none */
    int visibility;       /* level of nuScenes: 0 to 3 for a share in view below 0.4, 0.6, 0.8 or up
                           * to 1; 4: nothing of the object is in range and in view */
    int64_t detections;   /* targets with an echo of the object, where it is */
    int64_t merged;       /* of the detections, those with an echo of something else */
    int64_t ghosts;       /* targets with an echo of the object by way of a mirror */
    size_t last_detection, last_ghost; /* number from 1 of the target that was counted last */
};

extern const struct record sighting_record;

/* Sets share and visibility by the numbers of reflectors. */
void sightings_judge(struct sighting *sighting);

/* Counts the targets of every sighting anew. The sightings must be in canonical order. */
void sightings_count_targets(struct frame *frame);
