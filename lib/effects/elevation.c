#include "elevation.h"

#include <math.h>

#include "elementary.h"

#define LN_2 0.693147180559945309417

struct elevation elevation_of(double distance_m, double height_m)
{
    double range_m = elementary_hypot(distance_m, height_m);
    if (range_m == 0)
        return (struct elevation){0, 0, 1};
    return (struct elevation){range_m, height_m / range_m, distance_m / range_m};
}

double elevation_azimuth_rad(struct elevation elevation, double azimuth_rad)
{
    if (elevation.sine == 0)
        return azimuth_rad;
    struct elementary_sincos azimuth = elementary_sincos(azimuth_rad);
    double along = elementary_hypot(azimuth.cos, azimuth.sin * elevation.sine);
    return elementary_atan2(azimuth.sin * elevation.cosine, copysign(along, azimuth.cos));
}

double elevation_amplitude_factor(struct elevation elevation, double half_width_rad)
{
    double widths = elementary_atan2(elevation.sine, elevation.cosine) / half_width_rad;
    return elementary_exp(-LN_2 * widths * widths);
}
