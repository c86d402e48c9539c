#include "geometry/knife_edge.h"

#include "base/elementary.h"
#include "base/units.h"

#define LIT (-0.78)
#define TEN_TO_MINUS_069 0.204173794466952965

/* d1 d2/(d1 + d2), without underflow. */
static double reduced_distance_m(double sensor_side_m, double reflector_side_m)
{
    double near = elementary_max(elementary_min(sensor_side_m, reflector_side_m), 0.1);
    double far = elementary_max(elementary_max(sensor_side_m, reflector_side_m), 0.1);
    return near / (near / far + 1);
}

/* The argument of the logarithm in J. */
static double steepness(double parameter)
{
    return elementary_hypot(parameter - 0.1, 1) + (parameter - 0.1);
}

double knife_edge_parameter(double depth_m, double sensor_side_m, double reflector_side_m,
                            double wavelength_m)
{
    return depth_m * sqrt(2 / wavelength_m / reduced_distance_m(sensor_side_m, reflector_side_m));
}

double knife_edge_amplitude_factor(double parameter)
{
    if (!(parameter > LIT))
        return 1;
    return TEN_TO_MINUS_069 / steepness(parameter) / steepness(parameter);
}

/* d1 d2/(d1 + d2) is largest half way, and each distance may have grown by 0.1 m. */
double knife_edge_reach_m(double range_m, double wavelength_m)
{
    return sqrt(wavelength_m * (range_m + 0.2) / 4);
}
