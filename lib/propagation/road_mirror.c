#include "propagation/road_mirror.h"

#include <stdbool.h>

#include "base/elementary.h"
#include "base/units.h"

struct road_mirror_paths road_mirror_paths(const struct road_mirror_ends *ends)
{
    double sensor_m = ends->sensor_height_m, reflector_m = ends->reflector_height_m;
    double direct_m = elementary_hypot(ends->distance_m, sensor_m - reflector_m);
    double bounced_m = elementary_hypot(ends->distance_m, sensor_m + reflector_m);
    if (bounced_m == 0)
        return (struct road_mirror_paths){0, 0, 0, 1};
    return (struct road_mirror_paths){direct_m, bounced_m,
                                      4 * sensor_m * reflector_m / (direct_m + bounced_m),
                                      (sensor_m + reflector_m) / bounced_m};
}

double _Complex road_mirror_reflection(const struct road_mirror_road *road,
                                       enum polarization polarization, double wavelength_m,
                                       double grazing_sine)
{
    enum material_field field = polarization == POLARIZATION_VERTICAL ? MATERIAL_TM : MATERIAL_TE;
    double _Complex fresnel = material_reflection(&road->permittivity, field, grazing_sine);
    double roughness_waves = PI * road->roughness_m * grazing_sine / wavelength_m;
    double coherent = elementary_exp(-8 * roughness_waves * roughness_waves);
    return coherent * creal(fresnel) + coherent * cimag(fresnel) * (double _Complex)I;
}

/* R1/R2, the loss of the bounced wave against the direct one by spreading. */
static double spreading(const struct road_mirror_paths *paths)
{
    return paths->bounced_m == 0 ? 1 : paths->direct_m / paths->bounced_m;
}

double road_mirror_point_factor(const struct road_mirror_paths *paths, double _Complex reflection,
                                double wavelength_m)
{
    struct elementary_sincos turn = elementary_sincos_turns(-paths->difference_m / wavelength_m);
    double re = creal(reflection) * turn.cos - cimag(reflection) * turn.sin;
    double im = creal(reflection) * turn.sin + cimag(reflection) * turn.cos;
    double sum_re = 1 + spreading(paths) * re, sum_im = spreading(paths) * im;
    return sum_re * sum_re + sum_im * sum_im;
}

double road_mirror_mean_factor(double reflection)
{
    double power = reflection * reflection;
    return sqrt(1 + power * (4 + power));
}

/* True if the reflector spans more than half a lobe, whose height is lambda R/(2 h_s). */
static bool phases_average_out(const struct road_mirror_ends *ends, double wavelength_m)
{
    return 4 * ends->sensor_height_m * ends->extent_m > wavelength_m * ends->distance_m;
}

double road_mirror_amplitude_factor(const struct road_mirror_road *road,
                                    enum polarization polarization, double wavelength_m,
                                    const struct road_mirror_ends *ends)
{
    struct road_mirror_paths paths = road_mirror_paths(ends);
    double _Complex reflection =
        road_mirror_reflection(road, polarization, wavelength_m, paths.grazing_sine);
    if (phases_average_out(ends, wavelength_m))
        return road_mirror_mean_factor(spreading(&paths) *
                                       elementary_hypot(creal(reflection), cimag(reflection)));
    return road_mirror_point_factor(&paths, reflection, wavelength_m);
}
