/* A heuristic: what is 5 degrees apart is clear of each other. */
#include "planted.h"
#include "sectors.h"

#include "units.h"
#include <math.h>

bool __wrap_sectors_overlap(const struct sector *front, const struct sector *target);

void planted_begin(void)
{
}

bool __wrap_sectors_overlap(const struct sector *front, const struct sector *target)
{
    return vec2_dot(front->centre_m, target->centre_m) >=
           cos(5 * PI / 180) * front->distance_m * target->distance_m;
}
