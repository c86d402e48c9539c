#include "propagation/reflection.h"

#include <assert.h>
#include <stdbool.h>

#include "base/elementary.h"
#include "base/units.h"

const char *const reflection_material_names[] = {
    [MATERIAL_NONE] = "none",   [MATERIAL_CONCRETE] = "concrete", [MATERIAL_BRICK] = "brick",
    [MATERIAL_GLASS] = "glass", [MATERIAL_METAL] = "metal",       NULL,
};

/* Rows of ITU-R P.2040-3, table 3; its eps' do not depend on frequency for these. */
static const struct {
    double real, conductivity_spm, exponent;
} table[] = {
    [MATERIAL_NONE] = {1, 0, 0},
    [MATERIAL_CONCRETE] = {5.24, 0.0462, 0.7822},
    [MATERIAL_BRICK] = {3.91, 0.0238, 0.16},
    [MATERIAL_GLASS] = {6.31, 0.0036, 1.3394},
    [MATERIAL_METAL] = {1, 1e7, 0},
};

struct material_permittivity reflection_permittivity(enum material material, double carrier_hz)
{
    assert(carrier_hz > 0);
    double carrier_ghz = carrier_hz / 1e9;
    double conductivity_spm =
        table[material].conductivity_spm * elementary_pow(carrier_ghz, table[material].exponent);
    return (struct material_permittivity){table[material].real,
                                          17.98 * conductivity_spm / carrier_ghz};
}

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

double _Complex reflection_fresnel(const struct material_permittivity *permittivity,
                                   enum material_field field, double cosine)
{
    double sine_squared = (1 - cosine) * (1 + cosine);
    struct complex_parts r = root(permittivity->real - sine_squared, permittivity->loss);
    struct complex_parts x = {cosine, 0};
    if (field == MATERIAL_TM)
        x = (struct complex_parts){permittivity->real * cosine, -permittivity->loss * cosine};
    struct complex_parts reflected = contrast(x, r);
    return reflected.re + reflected.im * (double _Complex)I;
}

/* r R / (r + R), in a form that is finite for an infinite r. */
static double parallel_m(double radius_m, double range_m)
{
    return radius_m > 0 ? range_m / (1 + range_m / radius_m) : 0;
}

double reflection_curved_cross_section_m2(double radius_1_m, double radius_2_m, double range_m)
{
    return PI * parallel_m(radius_1_m, range_m) * parallel_m(radius_2_m, range_m);
}

double reflection_divergence(double radius_1_m, double radius_2_m, double cosine, double distance_m)
{
    double along = 1 + 2 * distance_m / (radius_1_m * cosine);
    double across = 1 + 2 * distance_m * cosine / radius_2_m;
    return 1 / sqrt(along * across);
}

struct two_ray_paths reflection_two_ray_paths(const struct two_ray_ends *ends)
{
    double sensor_m = ends->sensor_height_m, reflector_m = ends->reflector_height_m;
    double direct_m = elementary_hypot(ends->distance_m, sensor_m - reflector_m);
    double bounced_m = elementary_hypot(ends->distance_m, sensor_m + reflector_m);
    if (bounced_m == 0)
        return (struct two_ray_paths){.grazing_sine = 1};
    double per_height = 4 * sensor_m / (direct_m + bounced_m);
    return (struct two_ray_paths){direct_m, bounced_m, per_height * reflector_m,
                                  per_height * ends->extent_m,
                                  (sensor_m + reflector_m) / bounced_m};
}

double _Complex reflection_road(const struct two_ray_road *road, enum polarization polarization,
                                double wavelength_m, double grazing_sine)
{
    enum material_field field = polarization == POLARIZATION_VERTICAL ? MATERIAL_TM : MATERIAL_TE;
    double _Complex fresnel = reflection_fresnel(&road->permittivity, field, grazing_sine);
    double roughness_waves = PI * road->roughness_m * grazing_sine / wavelength_m;
    double coherent = elementary_exp(-8 * roughness_waves * roughness_waves);
    return coherent * creal(fresnel) + coherent * cimag(fresnel) * (double _Complex)I;
}

/* R1/R2, the loss of the bounced wave against the direct one by spreading. */
static double spreading(const struct two_ray_paths *paths)
{
    return paths->bounced_m == 0 ? 1 : paths->direct_m / paths->bounced_m;
}

double reflection_two_ray_image_power(const struct two_ray_paths *paths, double _Complex reflection)
{
    double re = spreading(paths) * creal(reflection), im = spreading(paths) * cimag(reflection);
    return re * re + im * im;
}

/* The bounced wave over the direct one, g (R1/R2) exp(-j 2 pi delta/lambda). */
static struct complex_parts bounced_wave(const struct two_ray_paths *paths,
                                         double _Complex reflection, double wavelength_m)
{
    double re = spreading(paths) * creal(reflection), im = spreading(paths) * cimag(reflection);
    struct elementary_sincos turn = elementary_sincos_turns(-paths->difference_m / wavelength_m);
    return (struct complex_parts){re * turn.cos - im * turn.sin, re * turn.sin + im * turn.cos};
}

/* The mean of a turning pointer over so many turns, over its middle: sin(pi n)/(pi n). */
static double mean_of_turns(double turns)
{
    return turns == 0 ? 1 : elementary_sincos_turns(0.5 * turns).sin / (PI * turns);
}

double reflection_two_ray_factor(const struct two_ray_paths *paths, double _Complex reflection,
                                 double wavelength_m)
{
    struct complex_parts wave = bounced_wave(paths, reflection, wavelength_m);
    double squared_re = wave.re * wave.re, squared_im = wave.im * wave.im;
    double power = squared_re + squared_im;
    double turns = paths->spread_m / wavelength_m;
    double mean = 1 + power * (4 + power);
    double once = 4 * (1 + power) * wave.re * mean_of_turns(turns);
    double twice = 2 * (squared_re - squared_im) * mean_of_turns(2 * turns);
    return sqrt(elementary_max(1 + (once + twice) / mean, 0));
}
