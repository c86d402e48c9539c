#include "geometry/slant.h"

#include "base/elementary.h"

#define LN_2 0.693147180559945309417

struct slant slant_of(double distance_m, double height_m)
{
    double range_m = elementary_hypot(distance_m, height_m);
    if (range_m == 0)
        return (struct slant){0, 0, 1};
    return (struct slant){range_m, height_m / range_m, distance_m / range_m};
}

double slant_azimuth_rad(struct slant elevation, double azimuth_rad)
{
    if (elevation.sine == 0)
        return azimuth_rad;
    struct elementary_sincos azimuth = elementary_sincos(azimuth_rad);
    double along = elementary_hypot(azimuth.cos, azimuth.sin * elevation.sine);
    return elementary_atan2(azimuth.sin * elevation.cosine, copysign(along, azimuth.cos));
}

double slant_amplitude_factor(struct slant elevation, double half_width_rad)
{
    double widths = elementary_atan2(elevation.sine, elevation.cosine) / half_width_rad;
    return elementary_exp(-LN_2 * widths * widths);
}
