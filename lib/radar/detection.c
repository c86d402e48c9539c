#include "radar/detection.h"

#include <assert.h>

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

/* In units of the noise's RMS. */
static const double LOWERED_BY = 1.75;

double detection_lowered_threshold(double final_threshold, double noise)
{
    return elementary_max(final_threshold - LOWERED_BY * noise, 0);
}

/* (1 - exp(-x))/x. */
static double mean_decay(double x)
{
    return x < 1e-8 ? 1 : (1 - elementary_exp(-x)) / x;
}

static bool is_noisy(double threshold, double noise)
{
    return threshold < 600 * noise;
}

/* Noise falls inside the circle of radius T around the origin with a probability that is an
 * integral along the circle, seen from the echo at A: rays from there see it through the angle
 * T (T - A cos a)/rho^2 da, and |n| ends before it, at rho, with 1 - exp(-rho^2/noise^2). The
 * integrand is smooth and periodic, so the trapezoidal rule converges exponentially. */
double detection_in_noise(double amplitude, double threshold, double noise)
{
    if (!is_noisy(threshold, noise))
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

/* Less than 1e-15 dB changes an amplitude by less than its rounding does. */
static bool is_steady(const struct power_law *varying)
{
    bool normal = varying->law == FLUCTUATION_LOG_NORMAL;
    return varying->law == FLUCTUATION_NONE || (normal && varying->sigma_db < 1e-15);
}

static double least_db(const struct power_law *varying)
{
    bool normal = varying->law == FLUCTUATION_LOG_NORMAL;
    return normal ? varying->mean_db - 9 * varying->sigma_db : -90;
}

static double most_db(const struct power_law *varying)
{
    bool normal = varying->law == FLUCTUATION_LOG_NORMAL;
    return normal ? varying->mean_db + varying->most * varying->sigma_db : 17;
}

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

/* An echo of a mean amplitude whose power varies by one law, and perhaps by a second one too. */
struct echo_law {
    const struct detection_law *detection;
    struct power_law varying;
    const struct power_law *beside;
    double amplitude;
};

/* So far from the final threshold noise decides, in its RMS; farther away with less than 1e-15. */
static const double DECIDES = 6;

/* The probability that an echo without variation is detected. */
static double steady_probability(const struct detection_law *detection, double amplitude)
{
    double certain = detection->final_threshold + DECIDES * detection->noise;
    if (amplitude < detection->threshold)
        return 0;
    if (detection->final_threshold == 0 || amplitude > certain)
        return 1;
    return detection_in_noise(amplitude, detection->final_threshold, detection->noise);
}

static double single_probability(const struct detection_law *detection,
                                 const struct power_law *varying, double amplitude);

/* The probability that an echo with this power of its law is detected. */
static double probability_at(const struct echo_law *echo, double power_db)
{
    double amplitude = echo->amplitude * units_amplitude_from_db(power_db);
    if (echo->beside == NULL)
        return steady_probability(echo->detection, amplitude);
    return single_probability(echo->detection, echo->beside, amplitude);
}

/* What powers between these two, in dB, contribute to the probability of detection. The steps of
 * the trapezoidal rule shrink smoothly towards both ends, so that it converges quickly. */
static double integral(const struct echo_law *echo, double from, double to)
{
    double sum = 0;
    int steps = 48 + (int)(to - from);
    for (int i = 1; i < steps; i++) {
        double part = (double)i / steps, rest = 1 - part;
        double way = part * part * part * (10 - 15 * part + 6 * part * part);
        double power_db = from + (to - from) * way;
        sum += 30 * part * part * rest * rest * density(&echo->varying, power_db) *
               probability_at(echo, power_db);
    }
    return (to - from) * sum / steps;
}

/* The power in decibels that an echo needs for an amplitude, between two others. */
static double power_for(const struct echo_law *echo, double amplitude, double from, double to)
{
    if (!(amplitude > 0))
        return from;
    double db = units_amplitude_db(amplitude / echo->amplitude);
    return elementary_min(elementary_max(db, from), to);
}

/* Around the threshold, where noise decides, the integrand is the steeper the less noise there is.
 * So this part and that of stronger echoes are integrated separately. */
static double single_probability(const struct detection_law *detection,
                                 const struct power_law *varying, double amplitude)
{
    const struct echo_law echo = {detection, *varying, NULL, amplitude};
    if (is_steady(varying))
        return steady_probability(detection, amplitude);
    double final = detection->final_threshold;
    double reach = is_noisy(final, detection->noise) ? DECIDES * detection->noise : 0;
    double weakest = elementary_max(final - reach, detection->threshold);
    double certain = elementary_max(final + reach, weakest);
    double most = most_db(varying);
    double from_db = power_for(&echo, weakest, least_db(varying), most);
    double certain_db = power_for(&echo, certain, from_db, most);
    return integral(&echo, from_db, certain_db) + integral(&echo, certain_db, most);
}

/* The mean over the narrower of two laws of the smooth probability under the wider one. */
static double double_probability(const struct detection_law *detection,
                                 const struct power_law *narrow, const struct power_law *wide,
                                 double amplitude)
{
    const struct echo_law echo = {detection, *narrow, wide, amplitude};
    return integral(&echo, least_db(narrow), most_db(narrow));
}

/* Of echoes beyond the power at which their law is cut: they count with that power. */
static double cut_probability(const struct detection_law *detection, const struct power_law *echo,
                              const struct power_law *body, double amplitude)
{
    if (echo->law != FLUCTUATION_LOG_NORMAL || is_steady(echo))
        return 0;
    double cut = amplitude * units_amplitude_from_db(most_db(echo));
    return BEYOND_CUT * single_probability(detection, body, cut);
}

double detection_probability(const struct detection_law *detection, double amplitude)
{
    assert(amplitude > 0);
    double sigma_db = detection->fluctuation_sigma_db;
    struct power_law echo = {detection->fluctuation, level_mean_db(sigma_db), sigma_db, CUT};
    struct power_law body = {FLUCTUATION_LOG_NORMAL, detection->level_mean_db,
                             detection->level_sigma_db, 9};
    bool narrow = echo.law == FLUCTUATION_LOG_NORMAL && echo.sigma_db < body.sigma_db;
    double cut = cut_probability(detection, &echo, &body, amplitude);
    if (is_steady(&body))
        return cut + single_probability(detection, &echo, amplitude);
    if (is_steady(&echo))
        return single_probability(detection, &body, amplitude);
    return cut + (narrow ? double_probability(detection, &echo, &body, amplitude)
                         : double_probability(detection, &body, &echo, amplitude));
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
