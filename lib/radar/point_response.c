#include "radar/point_response.h"

#include "base/elementary.h"
#include "base/units.h"

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

double point_response_main_lobe(enum point_response response)
{
    if (response == POINT_RESPONSE_PULSE)
        return (double)INFINITY;
    return response == POINT_RESPONSE_HANN ? 2 : 1;
}

double point_response_resolution(enum point_response response)
{
    if (response == POINT_RESPONSE_PULSE)
        return 3.5802;
    return response == POINT_RESPONSE_HANN ? 1.7748 : 0.9967;
}

bool point_response_pulses_part(double bins, double ratio, double phase_rad)
{
    double cosine = elementary_cos(phase_rad), slope = 2 / (elementary_log(2) * bins * bins);
    if (2 * slope * (1 + cosine) >= 1)
        return false;
    double root = sqrt(cosine * cosine + 8 * slope * (1 - cosine) * (1 + cosine));
    double cosh = elementary_max(((1 - 4 * slope) * cosine + root) / (4 * slope), 1);
    double sinh = sqrt((cosh - 1) * (cosh + 1));
    double most = slope * (fabs(elementary_log(ratio)) + elementary_log(cosh + sinh));
    /* Of opposite pulses the right side is infinite, or 0/0. */
    return !(most >= sinh / (2 * (cosh + cosine)));
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

double point_response_hann_offset(double before, double peak, double after)
{
    double ratio = elementary_max(before, after) / peak;
    double bins = elementary_max((2 * ratio - 1) / (ratio + 1), 0);
    if (before == after)
        return 0;
    return before > after ? -bins : bins;
}

double point_response_vertex(double before, double peak, double after)
{
    if (!(before > 0 && after > 0) || before == after)
        return 0;
    double left = elementary_log(before), right = elementary_log(after);
    return (left - right) / (2 * (left - 2 * elementary_log(peak) + right));
}

/* A ratio that is 1 at rest and proportional to the number of cells if that is large. Coefficients
 * were fitted to the integral; b and c are 0 for a Gaussian window. */
struct walk_law {
    double a, b, c;
};

static double walk_ratio(const struct walk_law *law, double cells)
{
    double square = cells * cells, cube = cells * square;
    return sqrt(1 + square * ((law->a + law->b * cube) / (1 + law->c * cube)));
}

struct point_response_walk point_response_of_walk(enum point_response response, double cells)
{
    static const struct walk_law loss[] = {
        [POINT_RESPONSE_RECTANGULAR] = {0.142, 0.1191, 0.1389},
        [POINT_RESPONSE_HANN] = {0.04446, 0.0003041, 0.004899},
    };
    static const struct walk_law width[] = {
        [POINT_RESPONSE_RECTANGULAR] = {0, 0.07909, 0.1149},
        [POINT_RESPONSE_HANN] = {0.0368, 0.0002462, 0.003976},
    };
    double walked = fabs(cells);
    return (struct point_response_walk){1 / walk_ratio(&loss[response], walked),
                                        walk_ratio(&width[response], walked) - 1};
}
