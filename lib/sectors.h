/* Can one thing stand in the way to another? Answered from circles around both, as the sensor sees
 * them: the reason for which auto may leave out occlusion (NUMERICS C3). */
#ifndef SECTORS_H
#define SECTORS_H

#include <stdbool.h>

#include "vec2.h"

/* A circle around a body. */
struct sector {
    struct vec2 centre_m; /* from the sensor */
    double distance_m;    /* of the centre */
    double radius_m;
};

struct sector sector_of(struct vec2 centre_m, double radius_m);

/* False only if no sight line from the sensor to a place within target's circle touches front's:
 * front begins behind the end of target, or the two lie farther apart than half of the angles they
 * cover. A slack of 1e-9 covers the rounding of the test, so that it errs towards true, as it does
 * for circles around the sensor. */
bool sectors_overlap(const struct sector *front, const struct sector *target);

#endif
