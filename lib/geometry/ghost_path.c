#include "geometry/ghost_path.h"

/* A path with one way straight and one way by the wall. */
static struct ghost_path one_way(double reflection, const struct kinematics *direct,
                                 const struct kinematics *image, double azimuth_rad)
{
    double range_m = (direct->range_m + image->range_m) / 2;
    return (struct ghost_path){
        .kinematics = {range_m, azimuth_rad, (direct->range_rate_mps + image->range_rate_mps) / 2},
        .ercs_factor = reflection * (range_m / direct->range_m) * (range_m / image->range_m),
    };
}

struct ghost_path ghost_path_out(double reflection, const struct kinematics *direct,
                                 const struct kinematics *image)
{
    return one_way(reflection, direct, image, direct->azimuth_rad);
}

struct ghost_path ghost_path_back(double reflection, const struct kinematics *direct,
                                  const struct kinematics *image)
{
    return one_way(reflection, direct, image, image->azimuth_rad);
}

struct ghost_path ghost_path_both(double reflection, const struct kinematics *image)
{
    return (struct ghost_path){.kinematics = *image, .ercs_factor = reflection * reflection};
}
