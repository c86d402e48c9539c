#include "propagation/ground_return.h"

#include "base/elementary.h"

double ground_return_area_m2(double range_min_m, double range_max_m, double field_of_view_rad)
{
    return field_of_view_rad / 2 * (range_max_m - range_min_m) * (range_max_m + range_min_m);
}

double ground_return_range_m(double range_min_m, double range_max_m, double uniform)
{
    double square = range_min_m * range_min_m * (1 - uniform) + range_max_m * range_max_m * uniform;
    return elementary_min(elementary_max(sqrt(square), range_min_m), range_max_m);
}

double ground_return_range_rate_mps(struct vec2 sensor_mps, struct vec2 boresight,
                                    double azimuth_rad)
{
    return -vec2_dot_accurate(sensor_mps, vec2_turn(vec2_heading(azimuth_rad), boresight));
}
