#include "radar/detection.h"

#include <assert.h>
#include <stdbool.h>

#include "base/elementary.h"
#include "base/root.h"
#include "base/units.h"
#include "radar/level.h"

/* Deviations at which the log-normal law is cut, and what a Gaussian number is beyond them with. */
#define CUT 3
#define BEYOND_CUT 0.00134989803163

/* A standard Gaussian number by Box and Muller, cut from above. */
static double cut_gaussian(const double uniform[4])
{
    double radius = sqrt(-2 * elementary_log(uniform[0]));
    return elementary_min(radius * elementary_sincos_turns(uniform[1]).cos, CUT);
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

/* How a power varies. A normal law in decibels is cut at `most` deviations from above. */
struct power_law {
    enum fluctuation_law law;
    double mean_db, sigma_db, most;
};

/* How likely a varying power is, per decibel. */
static double density(const struct power_law *varying, double power_db)
{
    double power = elementary_pow(10, power_db / 10);
    double power_a_db = power * 2 * units_amplitude_logarithm(1);
    double deviations = (power_db - varying->mean_db) / varying->sigma_db;
    if (varying->law == FLUCTUATION_SWERLING_1)
        return power_a_db * elementary_exp(-power);
    if (varying->law == FLUCTUATION_SWERLING_3)
        return 4 * power_a_db * power * elementary_exp(-2 * power);
    return elementary_exp(-deviations * deviations / 2) / (varying->sigma_db * sqrt(2 * PI));
}

/* An echo that meets the first threshold, at the final one. */
static double passes(const struct detection_law *detection, double amplitude)
{
    if (detection->final_threshold == 0)
        return 1;
    return detection_in_noise(amplitude, detection->final_threshold, detection->noise);
}

/* The weight of a step of Simpson's rule: 4, 2, 4, ... 4, 1, without the first, at which nothing
 * is.
 */
static double simpson_weight(int step, int steps)
{
    if (step == steps)
        return 1;
    return step % 2 == 1 ? 4 : 2;
}

/* Simpson's rule over the power in decibels, with steps that grow from 0: the final threshold
 * decides close to the first one. */
static double integral(const struct detection_law *detection, const struct power_law *varying,
                       double amplitude, double from, double to)
{
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 1; i <= STEPS; i++) {
        double part = (double)i / STEPS, power_db = from + (to - from) * part * part;
        sum += simpson_weight(i, STEPS) * 2 * part * density(varying, power_db) *
               passes(detection, amplitude * units_amplitude_from_db(power_db));
    }
    return (to - from) * sum / (3 * STEPS);
}

static double varying_probability(const struct detection_law *detection,
                                  const struct power_law *varying, double amplitude)
{
    double mean_db = varying->mean_db, sigma_db = varying->sigma_db;
    double least = detection->threshold / amplitude;
    bool normal = varying->law == FLUCTUATION_LOG_NORMAL;
    if (varying->law == FLUCTUATION_NONE || (normal && sigma_db == 0))
        return least <= 1 ? passes(detection, amplitude) : 0;
    double from = normal ? mean_db - 9 * sigma_db : -90,
           to = normal ? mean_db + varying->most * sigma_db : 17;
    if (least > 0)
        from = elementary_max(from, units_amplitude_db(least));
    if (from > to)
        return 0;
    double cut = normal && varying->most == CUT
                     ? BEYOND_CUT * passes(detection, amplitude * units_amplitude_from_db(to))
                     : 0;
    return integral(detection, varying, amplitude, from, to) + cut;
}

/* The mean over levels of a fluctuating echo's probability, which is smooth, by the trapezoidal
 * rule, which converges exponentially under a normal law. */
static double levelled_probability(const struct detection_law *detection,
                                   const struct power_law *varying, double amplitude)
{
    double sigma_db = detection->level_sigma_db, step_db = elementary_min(sigma_db / 2, 2);
    double sum = 0, total = 0;
    int steps = (int)ceil(16 * sigma_db / step_db);
    for (int i = 0; i < steps; i++) {
        double db = i * step_db - 8 * sigma_db;
        double weight = elementary_exp(-db * db / (2 * sigma_db * sigma_db));
        double level = units_amplitude_from_db(detection->level_mean_db + db);
        sum += weight * varying_probability(detection, varying, amplitude * level);
        total += weight;
    }
    return sum / total;
}

double detection_probability(const struct detection_law *detection, double amplitude)
{
    assert(amplitude > 0);
    double sigma_db = detection->fluctuation_sigma_db;
    struct power_law echo = {detection->fluctuation, level_mean_db(sigma_db), sigma_db, CUT};
    struct power_law body = {FLUCTUATION_LOG_NORMAL, detection->level_mean_db,
                             detection->level_sigma_db, 9};
    if (body.sigma_db == 0)
        return varying_probability(detection, &echo, amplitude);
    if (echo.law == FLUCTUATION_NONE)
        return varying_probability(detection, &body, amplitude);
    return levelled_probability(detection, &echo, amplitude);
}

struct amplitude_search {
    const struct detection_law *detection;
    double probability;
};

static bool is_detected_less(const void *of, double amplitude_db)
{
    const struct amplitude_search *search = of;
    double amplitude = units_amplitude_from_db(amplitude_db);
    return detection_probability(search->detection, amplitude) < search->probability;
}

double detection_amplitude(const struct detection_law *detection, double probability)
{
    assert(probability > 0 && probability < 1);
    const struct amplitude_search search = {detection, probability};
    double highest = elementary_max(detection->threshold, detection->final_threshold);
    double highest_db = units_amplitude_db(highest);
    double above_db = 80 + 5 * detection->level_sigma_db - detection->level_mean_db;
    struct root root =
        root_between(highest_db - 60, highest_db + above_db, 1e-6, is_detected_less, &search);
    return units_amplitude_from_db(root.high);
}
