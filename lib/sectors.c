#include "sectors.h"

#include <math.h>

#define SLACK 1e-9

struct sector sector_of(struct vec2 centre_m, double radius_m)
{
    return (struct sector){centre_m, vec2_length(centre_m), radius_m};
}

bool sectors_overlap(const struct sector *front, const struct sector *target)
{
    double nearest_m = front->distance_m - front->radius_m;
    if (nearest_m > (target->distance_m + target->radius_m) * (1 + SLACK) + 1e-6)
        return false;
    if (!(nearest_m > 0 && target->distance_m > target->radius_m))
        return true;
    double front_sine = front->radius_m / front->distance_m;
    double target_sine = target->radius_m / target->distance_m;
    double together = sqrt((1 - front_sine * front_sine) * (1 - target_sine * target_sine)) -
                      front_sine * target_sine;
    return vec2_dot(front->centre_m, target->centre_m) >=
           front->distance_m * target->distance_m * (together - SLACK);
}
