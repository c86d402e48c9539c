#include "ghost.h"

#include <math.h>

#include "elementary.h"
#include "radar_equation.h"
#include "units.h"

/* One way direct and one way by the wall. */
static struct ghost one_way(double reflection, const struct sight *direct,
                            const struct sight *image, double azimuth_rad)
{
    double range_m = (direct->range_m + image->range_m) / 2;
    return (struct ghost){
        .sight = {range_m, azimuth_rad, (direct->range_rate_mps + image->range_rate_mps) / 2},
        .ercs_factor = reflection * (range_m / direct->range_m) * (range_m / image->range_m),
    };
}

struct ghost ghost_out(double reflection, const struct sight *direct, const struct sight *image)
{
    return one_way(reflection, direct, image, direct->azimuth_rad);
}

struct ghost ghost_back(double reflection, const struct sight *direct, const struct sight *image)
{
    return one_way(reflection, direct, image, image->azimuth_rad);
}

struct ghost ghost_both(double reflection, const struct sight *image)
{
    return (struct ghost){.sight = *image, .ercs_factor = reflection * reflection};
}

/* size / unit, at most 1; a size of 0 is 0 whatever the unit. */
static double bounded_ratio(double size, double unit)
{
    return size < unit ? size / unit : size > 0;
}

struct ghost ghost_behind(double reflection, double ercs, const struct sight *direct,
                          const struct mirror_image *object, const struct mirror_image *image)
{
    struct vec2 apart_m = vec2_sub(object->place_m, image->place_m);
    struct vec2 apart_mps = vec2_sub(object->velocity_mps, image->velocity_mps);
    double distance_m = vec2_length(apart_m) / 2;
    double recession_mps =
        distance_m > 0 ? vec2_dot_accurate(apart_mps, apart_m) / (4 * distance_m) : 0;
    double range_m = direct->range_m + distance_m;
    double size_m = sqrt(radar_cross_section_m2(ercs) / (4 * PI));
    double spread = direct->range_m > 0 ? range_m / direct->range_m : 0;
    return (struct ghost){
        .sight = {range_m, direct->azimuth_rad, direct->range_rate_mps + recession_mps},
        .ercs_factor = reflection * bounded_ratio(size_m, 2 * distance_m) * spread * spread,
    };
}

struct ghost ghost_double(double ercs, double ego_ercs, const struct sight *direct)
{
    double size_m2 = radar_cross_section_m2(sqrt(ercs * ego_ercs));
    double lit_m2 = PI * direct->range_m * direct->range_m;
    return (struct ghost){
        .sight = {2 * direct->range_m, direct->azimuth_rad, 2 * direct->range_rate_mps},
        .ercs_factor = bounded_ratio(size_m2, lit_m2),
    };
}

double ghost_bistatic_factor(struct vec2 sensor_m, struct vec2 bounce_m, struct vec2 point_m)
{
    struct vec2 out = vec2_sub(sensor_m, point_m), in = vec2_sub(bounce_m, point_m);
    double half_rad = elementary_atan2(fabs(vec2_cross(out, in)), vec2_dot(out, in)) / 2;
    double loss_db = 6 * elementary_sin(1.65 * half_rad);
    return units_amplitude_from_db(-loss_db) * sqrt(sqrt(elementary_cos(half_rad)));
}
