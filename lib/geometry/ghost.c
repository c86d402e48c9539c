#include "ghost.h"

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
