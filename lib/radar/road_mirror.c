#include "radar/road_mirror.h"

#include <math.h>
#include <stdbool.h>

#include "base/elementary.h"
#include "base/units.h"

struct complex_parts {
    double re, im;
};

/* The root in the fourth quadrant of re - j loss, for re >= 0. */
static struct complex_parts root(double re, double loss)
{
    double root_re = sqrt((elementary_hypot(re, loss) + re) / 2);
    return (struct complex_parts){root_re, loss == 0 ? 0 : -loss / (2 * root_re)};
}

/* (x - r)/(x + r), in real operations, as compilers divide complex numbers differently. */
static struct complex_parts contrast(struct complex_parts x, struct complex_parts r)
{
    struct complex_parts minus = {x.re - r.re, x.im - r.im};
    struct complex_parts plus = {x.re + r.re, x.im + r.im};
    double norm = plus.re * plus.re + plus.im * plus.im;
    return (struct complex_parts){(minus.re * plus.re + minus.im * plus.im) / norm,
                                  (minus.im * plus.re - minus.re * plus.im) / norm};
}

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
    double cosine_squared = (1 - grazing_sine) * (1 + grazing_sine);
    struct complex_parts r = root(road->permittivity - cosine_squared, road->permittivity_loss);
    struct complex_parts x = {grazing_sine, 0};
    if (polarization == POLARIZATION_VERTICAL)
        x = (struct complex_parts){road->permittivity * grazing_sine,
                                   -road->permittivity_loss * grazing_sine};
    struct complex_parts fresnel = contrast(x, r);
    double roughness_waves = PI * road->roughness_m * grazing_sine / wavelength_m;
    double coherent = elementary_exp(-8 * roughness_waves * roughness_waves);
    return coherent * fresnel.re + coherent * fresnel.im * (double _Complex)I;
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
