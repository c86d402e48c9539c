#include "radar/point_response.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"

/* Of point_response_offset, in bins. */
#define MOST_OFFSET 0.75

double point_response_weight(enum point_response response, size_t n, size_t count)
{
    if (response == POINT_RESPONSE_RECTANGULAR)
        return 1 / (double)count;
    double turns = (double)n / (double)count;
    return (1 - elementary_sincos_turns(turns).cos) / (double)count;
}

double point_response_noise(enum point_response response, size_t count)
{
    return sqrt((response == POINT_RESPONSE_HANN ? 1.5 : 1) / (double)count);
}

double point_response_hann(double bins)
{
    double d = fabs(bins);
    if (d == 0)
        return 1;
    if (d == 1)
        return 0.5;
    return elementary_sincos_turns(d / 2).sin / (PI * d * ((1 - d) * (1 + d)));
}

static double gaussian(double d)
{
    return elementary_exp(-0.25 * d * d * elementary_log(2));
}

double point_response_value(enum point_response response, double bins)
{
    double d = fabs(bins);
    if (response == POINT_RESPONSE_PULSE)
        return gaussian(d);
    return response == POINT_RESPONSE_HANN ? point_response_hann(d) : units_si(PI * d);
}

double point_response_envelope(enum point_response response, double bins)
{
    double d = fabs(bins);
    if (response == POINT_RESPONSE_PULSE)
        return gaussian(d);
    if (response == POINT_RESPONSE_HANN)
        return d > 1 ? elementary_min(1 / (PI * d * (d * d - 1)), 1) : 1;
    return elementary_min(1 / (PI * d), 1);
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

static double in_phase(const struct phasor *samples, const struct phasor *middle, size_t channels,
                       size_t stride)
{
    double sum = 0;
    for (size_t i = 0; i < channels * stride; i += stride)
        sum += samples[i].re * middle[i].re + samples[i].im * middle[i].im;
    return sum;
}

static double windowed(enum point_response response, double before, double at, double after)
{
    double ratio = (before - after) / (2 * at + before + after);
    if (response == POINT_RESPONSE_HANN)
        return 2 * ratio / (sqrt(4 * ratio * ratio + 2.25) + 1.5);
    return 2 * ratio / (sqrt(8 * ratio * ratio + 1) + 1);
}

double point_response_offset(enum point_response response, const struct phasor *before,
                             const struct phasor *at, const struct phasor *after, size_t channels,
                             size_t stride)
{
    double offset;
    if (response == POINT_RESPONSE_PULSE)
        offset = vertex(log_power(before, channels, stride), log_power(at, channels, stride),
                        log_power(after, channels, stride));
    else
        offset =
            windowed(response, in_phase(before, at, channels, stride),
                     in_phase(at, at, channels, stride), in_phase(after, at, channels, stride));
    return isfinite(offset) ? elementary_min(elementary_max(offset, -MOST_OFFSET), MOST_OFFSET) : 0;
}

double point_response_hann_offset(double before, double peak, double after)
{
    double ratio = elementary_max(before, after) / peak;
    double bins = elementary_max((2 * ratio - 1) / (ratio + 1), 0);
    return before > after ? -bins : before < after ? bins : 0;
}
