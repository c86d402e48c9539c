/* How much of each object a sensor has in view and detects.
 *
 * A sensor that measured has a sighting of every object but the ego. Reflectors count in the order
 * of MODEL 2.5: those that the sensor looked for, of these those that send towards it and are in
 * range, of these those in view, and of these those that a body hides. Visibility is the share that
 * is not hidden, in the levels of nuScenes. Numbers of targets follow from the labels. */
#ifndef SIGHTINGS_H
#define SIGHTINGS_H

#include "text/field.h"

struct frame;

/* The levels of nuScenes: the share in view is in [0, 0.4), [0.4, 0.6), [0.6, 0.8), [0.8, 1]. */
enum sighting_level {
    SIGHTING_TO_40,
    SIGHTING_TO_60,
    SIGHTING_TO_80,
    SIGHTING_TO_100,
    SIGHTING_NONE, /* nothing of the object is in range and in view */
};

struct sighting {
    const char *sensor, *object;
    int64_t reflectors, in_range, in_view;
    int64_t blocked;
    double blocked_share; /* of those in view; 0 if there is none */
    enum sighting_level visibility;
    int64_t detections; /* targets with an echo of the object, where it is */
    int64_t merged;     /* of the detections, those with an echo of another object, or of clutter */
    int64_t ghosts;     /* targets with an echo of the object by way of a mirror */
    size_t last_detection, last_ghost; /* number from 1 of the target that was counted last */
};

extern const struct record sighting_record;

/* The level of a share in view in [0, 1]. */
enum sighting_level sightings_level(double share);

/* Sets share and visibility by the numbers of reflectors. */
void sightings_judge(struct sighting *sighting);

/* Counts the targets of every sighting anew. Both sections must be in canonical order. */
void sightings_count_targets(struct frame *frame);

/* The canonical order, by sensor and object, for sort_items. */
int sightings_order(const void *left, const void *right);

#endif
