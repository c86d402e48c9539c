/* A heuristic in place of lib/sectors.c: bearings 5 degrees apart are clear of each other. */
#include "planted.h"
#include "sectors.h"

#include "units.h"
#include <math.h>

void planted_begin(void)
{
}

struct sector sector_of(struct vec2 centre_m, double radius_m)
{
    return (struct sector){centre_m, vec2_length(centre_m), radius_m};
}

bool sectors_overlap(const struct sector *front, const struct sector *target)
{
    return vec2_dot(front->centre_m, target->centre_m) >=
           cos(5 * PI / 180) * front->distance_m * target->distance_m;
}
