#include "radar/detection.h"

#include <stdbool.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/level.h"

#define LN_10 2.30258509299404568402
/* What a Gaussian number is beyond 3 deviations with, where the log-normal law is cut. */
#define BEYOND_CUT 0.00134989803163

/* A standard Gaussian number by Box and Muller, cut at 3 from above. */
static double cut_gaussian(const double uniform[4])
{
    double radius = sqrt(-2 * elementary_log(uniform[0]));
    return elementary_min(radius * elementary_sincos_turns(uniform[1]).cos, 3);
}

double detection_fluctuation(enum fluctuation_law law, double sigma_db, const double uniform[4])
{
    switch (law) {
    case FLUCTUATION_SWERLING_1:
        return sqrt(-elementary_log(uniform[0]));
    case FLUCTUATION_SWERLING_3:
        return sqrt(-(elementary_log(uniform[0]) + elementary_log(uniform[1])) / 2);
    case FLUCTUATION_LOG_NORMAL:
        return units_amplitude_from_db(level_mean_db(sigma_db) + sigma_db * cut_gaussian(uniform));
    case FLUCTUATION_NONE:
        break;
    }
    return 1;
}

/* (1 - exp(-x))/x. */
static double mean_decay(double x)
{
    return x < 1e-8 ? 1 : (1 - elementary_exp(-x)) / x;
}

/* Noise falls inside the circle of radius T around the origin with a probability that is an
 * integral along the circle, seen from the echo at A: rays from there see it through the angle
 * T (T - A cos a)/rho^2 da, and |n| ends before it, at rho, with 1 - exp(-rho^2/noise^2). The
 * integrand is smooth and periodic, so the trapezoidal rule converges exponentially. */
double detection_in_noise(double amplitude, double threshold, double noise)
{
    if (!(threshold < 600 * noise))
        return amplitude >= threshold ? 1 : 0;
    double power = noise * noise, sum = 0;
    int steps = 16 + (int)(8 * (threshold / noise));
    for (int i = 0; i <= steps; i++) {
        double cosine = elementary_sincos_turns(0.5 * i / steps).cos;
        double beyond = threshold - amplitude * cosine, gap = amplitude - threshold;
        double rho2 = gap * gap + 2 * amplitude * threshold * (1 - cosine);
        sum += (i == 0 || i == steps ? 0.5 : 1) * beyond * mean_decay(rho2 / power);
    }
    return elementary_max(0, elementary_min(1, 1 - threshold / power * sum / steps));
}

/* How likely a fluctuating power is, per decibel. */
static double density(const struct detection_law *detection, double power_db)
{
    double power = elementary_pow(10, power_db / 10), sigma_db = detection->fluctuation_sigma_db;
    double deviations = (power_db - level_mean_db(sigma_db)) / sigma_db;
    if (detection->fluctuation == FLUCTUATION_SWERLING_1)
        return LN_10 / 10 * power * elementary_exp(-power);
    if (detection->fluctuation == FLUCTUATION_SWERLING_3)
        return LN_10 / 10 * 4 * power * power * elementary_exp(-2 * power);
    return elementary_exp(-deviations * deviations / 2) / (sigma_db * sqrt(2 * PI));
}

/* An echo that meets the first threshold, at the final one. */
static double passes(const struct detection_law *detection, double amplitude)
{
    if (detection->final_threshold == 0)
        return 1;
    return detection_in_noise(amplitude, detection->final_threshold, detection->noise);
}

/* Simpson's rule over the power in decibels, with steps that grow from 0: the final threshold
 * decides close to the first one. */
static double integral(const struct detection_law *detection, double amplitude, double from,
                       double to)
{
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 1; i <= STEPS; i++) {
        double part = (double)i / STEPS, power_db = from + (to - from) * part * part;
        double weight = i == STEPS ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * 2 * part * density(detection, power_db) *
               passes(detection, amplitude * units_amplitude_from_db(power_db));
    }
    return (to - from) * sum / (3 * STEPS);
}

double detection_probability(const struct detection_law *detection, double amplitude)
{
    double sigma_db = detection->fluctuation_sigma_db, least = detection->threshold / amplitude;
    bool log_normal = detection->fluctuation == FLUCTUATION_LOG_NORMAL;
    if (detection->fluctuation == FLUCTUATION_NONE || (log_normal && sigma_db == 0))
        return least <= 1 ? passes(detection, amplitude) : 0;
    double mean_db = level_mean_db(sigma_db);
    double from = log_normal ? mean_db - 9 * sigma_db : -90,
           to = log_normal ? mean_db + 3 * sigma_db : 17;
    if (least > 0)
        from = elementary_max(from, units_amplitude_db(least));
    if (from > to)
        return 0;
    double cut =
        log_normal ? BEYOND_CUT * passes(detection, amplitude * units_amplitude_from_db(to)) : 0;
    return integral(detection, amplitude, from, to) + cut;
}

double detection_amplitude(const struct detection_law *detection, double probability)
{
    double highest = elementary_max(detection->threshold, detection->final_threshold);
    double low = 1e-3 * highest, high = 1e4 * highest;
    while (high > low * (1 + 1e-7)) {
        double middle = sqrt(low * high);
        if (detection_probability(detection, middle) < probability)
            low = middle;
        else
            high = middle;
    }
    return high;
}
