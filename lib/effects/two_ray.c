/* The road mirrors echoes whose height is known (MODEL 14.10): direct ones, and those of wheels and
 * limbs. Ghosts and clutter have no height. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/units.h"
#include "propagation/reflection.h"

static bool described(const struct effect_scan *scan)
{
    if (scan->frame->conditions.road == ROAD_UNKNOWN || !(scan->sensor->mount_z_m > 0))
        return false;
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (scan->echoes.items[i].height_m > 0)
            return true;
    return false;
}

/* The road's complex permittivity and its roughness in m. Asphalt and roughness are assumed. */
static const double *begin(const struct effect_scan *scan)
{
    double *constants = arena_get(scan->frame->arena, 3 * sizeof *constants);
    struct material_permittivity permittivity =
        reflection_permittivity(MATERIAL_CONCRETE, scan->sensor->carrier_hz);
    bool asphalt = scan->frame->conditions.road == ROAD_ASPHALT;
    constants[0] = asphalt ? 5 : permittivity.real;
    constants[1] = asphalt ? 0.25 : permittivity.loss;
    constants[2] = asphalt ? 1e-3 : 3e-4;
    return constants;
}

/* Distance of an echo along the road; its range is slant if the effect elevation changed it. */
static double road_distance_m(const struct sensor *sensor, const struct echo *echo)
{
    double up_m = fabs(echo->height_m - sensor->mount_z_m);
    if ((echo->effects & EFFECT_BIT(EFFECT_ELEVATION)) == 0)
        return echo->range_m;
    return sqrt(elementary_max(echo->range_m - up_m, 0) * (echo->range_m + up_m));
}

/* Pulls the elevation of an echo towards that of its image below the road, whose power is this part
 * of its own (MODEL 7.6). */
static void pull_elevation(const struct two_ray_ends *ends, double power,
                           struct effect_reception *reception)
{
    double image_m = -ends->reflector_height_m - ends->sensor_height_m;
    double image_rad = elementary_atan2(image_m, ends->distance_m);
    double share = power / (1 + power);
    reception->elevation_rad += share * (image_rad - reception->elevation_rad);
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    const struct sensor *sensor = scan->sensor;
    const struct echo *echo = reception->echo;
    if (!(echo->height_m > 0))
        return false;
    const double *constants = reception->constants;
    const struct two_ray_road road = {{constants[0], constants[1]}, constants[2]};
    const struct two_ray_ends ends = {sensor->mount_z_m, echo->height_m, echo->extent_m,
                                      road_distance_m(sensor, echo)};
    const struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    double wavelength_m = units_wavelength_m(sensor->carrier_hz);
    double _Complex reflection =
        reflection_road(&road, sensor->polarization, wavelength_m, paths.grazing_sine);
    if (sensor->elevation_view_rad > 0)
        pull_elevation(&ends, reflection_two_ray_image_power(&paths, reflection), reception);
    return effect_scale(reception, reflection_two_ray_factor(&paths, reflection, wavelength_m));
}

const struct effect effect_two_ray = {
    .summary = "the road mirrors the wave, so that echoes fade and rise with range",
    .cause = "road of the conditions, mount_z_m of a sensor, z of a reflector",
    .left_out_when =
        "the road is unknown, the sensor has no mount_z_m or no reflector in sight has a z",
    .cost = "a Fresnel coefficient per echo",
    .scene = "the road mirrors {object}",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(mount_z_m)},
                {EFFECT_CONDITION(road), {3, 0.5, EFFECT_EVENLY, ROAD_ASPHALT, ROAD_CONCRETE}}},
    .described = described,
    .begin = begin,
    .receive = receive,
};
