#include "kernel.h"

#include <math.h>

#include "elementary.h"
#include "units.h"
#include "window.h"

#define FARTHEST 0.75

double kernel_weight(enum kernel kernel, size_t n, size_t count)
{
    if (kernel == KERNEL_RECTANGULAR)
        return 1 / (double)count;
    double turns = (double)n / (double)count;
    return (1 - elementary_sincos_turns(turns).cos) / (double)count;
}

double kernel_noise(enum kernel kernel, size_t count)
{
    return sqrt((kernel == KERNEL_HANN ? 1.5 : 1) / (double)count);
}

static double gaussian(double d)
{
    return elementary_exp(-0.25 * d * d * elementary_log(2));
}

double kernel_value(enum kernel kernel, double bins)
{
    double d = fabs(bins);
    if (kernel == KERNEL_PULSE)
        return gaussian(d);
    return kernel == KERNEL_HANN ? window_hann(d) : units_si(PI * d);
}

double kernel_envelope(enum kernel kernel, double bins)
{
    double d = fabs(bins);
    if (kernel == KERNEL_PULSE)
        return gaussian(d);
    if (kernel == KERNEL_HANN)
        return d > 1 ? fmin(1 / (PI * d * (d * d - 1)), 1) : 1;
    return fmin(1 / (PI * d), 1);
}

double kernel_half_width(enum kernel kernel)
{
    static const double widths[] = {
        [KERNEL_HANN] = 1, [KERNEL_RECTANGULAR] = 0.603354, [KERNEL_PULSE] = 2};
    return widths[kernel];
}

static double log_power(const struct phasor *samples, size_t channels, size_t stride)
{
    double power = 0;
    for (size_t i = 0; i < channels; i++)
        power += samples[i * stride].re * samples[i * stride].re +
                 samples[i * stride].im * samples[i * stride].im;
    return elementary_log(power);
}

static double vertex(double before, double at, double after)
{
    return (before - after) / (2 * (before - 2 * at + after));
}

/* Over all channels, least squares of d (2 X - A - B) = B - A. */
static double ratio(const struct phasor *before, const struct phasor *at,
                    const struct phasor *after, size_t channels, size_t stride)
{
    double above = 0, below = 0;
    for (size_t i = 0; i < channels * stride; i += stride) {
        double re = before[i].re - after[i].re, im = before[i].im - after[i].im;
        double whole_re = 2 * at[i].re - before[i].re - after[i].re;
        double whole_im = 2 * at[i].im - before[i].im - after[i].im;
        above += re * whole_re + im * whole_im;
        below += whole_re * whole_re + whole_im * whole_im;
    }
    return above / below;
}

double kernel_offset(enum kernel kernel, const struct phasor *before, const struct phasor *at,
                     const struct phasor *after, size_t channels, size_t stride)
{
    double offset;
    if (kernel == KERNEL_PULSE)
        offset = vertex(log_power(before, channels, stride), log_power(at, channels, stride),
                        log_power(after, channels, stride));
    else
        offset = (kernel == KERNEL_HANN ? 2 : 1) * ratio(before, at, after, channels, stride);
    return isfinite(offset) ? fmin(fmax(offset, -FARTHEST), FARTHEST) : 0;
}
