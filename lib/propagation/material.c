#include "propagation/material.h"

#include "base/elementary.h"

const char *const material_names[] = {
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

struct material_permittivity material_permittivity(enum material material, double carrier_hz)
{
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

double _Complex material_reflection(const struct material_permittivity *permittivity,
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
