#include "propagation/curved_surface.h"

#include <math.h>

#include "base/units.h"
#include "radar/radar_equation.h"

/* r R / (r + R), in a form that is finite for an infinite r. */
static double parallel_m(double radius_m, double range_m)
{
    return radius_m > 0 ? range_m / (1 + range_m / radius_m) : 0;
}

double curved_surface_cross_section_m2(double radius_1_m, double radius_2_m, double range_m)
{
    return PI * parallel_m(radius_1_m, range_m) * parallel_m(radius_2_m, range_m);
}

double curved_surface_ercs(double radius_1_m, double radius_2_m, double range_m)
{
    return radar_ercs(curved_surface_cross_section_m2(radius_1_m, radius_2_m, range_m));
}

double curved_surface_divergence(double radius_1_m, double radius_2_m, double cosine,
                                 double distance_m)
{
    double along = 1 + 2 * distance_m / (radius_1_m * cosine);
    double across = 1 + 2 * distance_m * cosine / radius_2_m;
    return 1 / sqrt(along * across);
}
