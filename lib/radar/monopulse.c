#include "radar/monopulse.h"

#include "base/elementary.h"

/* Below this part of |delta| |sum|, Im(delta conj(sum)) is rounding and has no sign. */
#define UNDECIDED 0x1p-47

/* A pointer as (real + j imag) 2^exponent, exactly. The larger component is in [1/2, 1), or zero,
 * so that products of two pointers neither overflow nor underflow: amplitudes span 1e-300 to 1e300.
 */
struct scaled_pointer {
    double real, imag, size;
    int exponent;
};

static struct scaled_pointer scale_pointer(double _Complex pointer)
{
    struct scaled_pointer scaled;
    frexp(elementary_max(fabs(creal(pointer)), fabs(cimag(pointer))), &scaled.exponent);
    scaled.real = elementary_scaled(creal(pointer), -scaled.exponent);
    scaled.imag = elementary_scaled(cimag(pointer), -scaled.exponent);
    scaled.size = elementary_hypot(scaled.real, scaled.imag);
    return scaled;
}

/* The azimuth of the ratio of delta · 2^delta_exponent to |sum|. */
static double azimuth_of(const struct antenna *antenna, double delta, int delta_exponent,
                         const struct scaled_pointer *sum)
{
    int exponent = delta_exponent > sum->exponent ? delta_exponent : sum->exponent;
    return antenna_azimuth_rad(antenna, elementary_scaled(delta, delta_exponent - exponent),
                               elementary_scaled(sum->size, sum->exponent - exponent));
}

/* Im(delta conj(sum)) of the scaled values. */
static double cross_of(const struct scaled_pointer *sum, const struct scaled_pointer *delta)
{
    return delta->imag * sum->real - delta->real * sum->imag;
}

struct monopulse_angle monopulse_angle(const struct antenna *antenna,
                                       enum monopulse_estimator estimator,
                                       struct antenna_pointers pointers)
{
    struct monopulse_angle angle = {.valid = false};
    struct scaled_pointer sum = scale_pointer(pointers.sum);
    struct scaled_pointer delta = scale_pointer(pointers.delta);
    if (sum.size == 0 && delta.size == 0)
        return angle;
    angle.valid = true;
    double cross = cross_of(&sum, &delta);
    double signed_delta;
    if (estimator == MONOPULSE_RATIO && sum.size > 0) {
        signed_delta = -cross / sum.size;
    } else {
        angle.sign_undecided = fabs(cross) <= UNDECIDED * delta.size * sum.size;
        signed_delta = cross > 0 && !angle.sign_undecided ? -delta.size : delta.size;
    }
    angle.azimuth_rad = azimuth_of(antenna, signed_delta, delta.exponent, &sum);
    return angle;
}

/* atan(delta/sum) at an azimuth, from -pi/2 to pi/2. */
static double ratio_angle_rad(const struct antenna *antenna, double azimuth_rad)
{
    struct antenna centred = *antenna;
    centred.phase = PHASE_CENTRE;
    struct antenna_pointers pointers = antenna_pointers(&centred, azimuth_rad);
    return elementary_atan2(-cimag(pointers.delta), creal(pointers.sum));
}

/* The azimuth, or the nearest one of a table that is two steps from its ends, so that a step is
 * inside for certain. */
static double within_table_rad(const struct antenna *antenna, double azimuth_rad, double step_rad)
{
    if (antenna->row_count == 0)
        return azimuth_rad;
    double least_rad = antenna->rows[0].azimuth_rad + 2 * step_rad;
    double most_rad = antenna->rows[antenna->row_count - 1].azimuth_rad - 2 * step_rad;
    return elementary_max(least_rad, elementary_min(azimuth_rad, most_rad));
}

double monopulse_sigma_rad(const struct antenna *antenna, enum monopulse_estimator estimator,
                           double azimuth_rad, double snr)
{
    const double step_rad = 1e-4;
    double at_rad = within_table_rad(antenna, azimuth_rad, step_rad);
    double slope = (ratio_angle_rad(antenna, at_rad + step_rad) -
                    ratio_angle_rad(antenna, at_rad - step_rad)) /
                   (2 * step_rad);
    double power = estimator == MONOPULSE_MAGNITUDE && azimuth_rad == 0 ? 1 : 0.5;
    return elementary_cos(ratio_angle_rad(antenna, at_rad)) * sqrt(power / snr) / slope;
}

double monopulse_quadrature(struct antenna_pointers pointers, double noise)
{
    struct scaled_pointer sum = scale_pointer(pointers.sum);
    struct scaled_pointer delta = scale_pointer(pointers.delta);
    if (sum.size == 0)
        return 0;
    double along = delta.real * sum.real + delta.imag * sum.imag;
    double size = elementary_scaled(along / sum.size, delta.exponent);
    double ratio = elementary_scaled(delta.size / sum.size, delta.exponent - sum.exponent);
    return size / (noise * sqrt((1 + ratio * ratio) / 2));
}

double monopulse_sign_margin(struct antenna_pointers pointers)
{
    struct scaled_pointer sum = scale_pointer(pointers.sum);
    struct scaled_pointer delta = scale_pointer(pointers.delta);
    double sine = fabs(cross_of(&sum, &delta)) / (sum.size * delta.size);
    return sine > 1 ? 1 : sine;
}
