#include "sensor/escalation.h"

#include <complex.h>
#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/attenuation.h"

#define WEATHER (EFFECT_BIT(EFFECT_RAIN) | EFFECT_BIT(EFFECT_FOG))
#define WEATHER_AZIMUTH 0.5
#define WEATHER_AMPLITUDE 0.5
#define SUPERPOSITION_AZIMUTH 0.5
#define SUPERPOSITION_AMPLITUDE 0.5

/* Bounds are widened by this part of themselves: they are computed in doubles too. */
#define SLACK 1e-9

static double factor_over(const struct reception *reception, double range_m)
{
    double least = attenuation_amplitude_factor(reception->rain_dbpkm, range_m) *
                   attenuation_amplitude_factor(reception->fog_dbpkm, range_m);
    return (1 + SLACK) / least;
}

/* Folded ranges hide how far apart two echoes truly are. */
struct weakening escalation_weakening(const struct reception *reception)
{
    const struct sensor *sensor = reception->sensor;
    bool folded = (reception->effects & EFFECT_BIT(EFFECT_AMBIGUITY)) != 0;
    double alone = factor_over(reception, sensor->range_max_m);
    return (struct weakening){alone,
                              folded ? alone : factor_over(reception, 2 * sensor->half_range_m)};
}

static bool tolerant(const struct tolerance *tolerance)
{
    return tolerance->range_m > 0 || tolerance->azimuth_rad > 0 || tolerance->range_rate_mps > 0 ||
           tolerance->amplitude_db > 0;
}

uint64_t escalation_spared(const struct reception *reception, const struct selection *selection)
{
    const struct tolerance *tolerance = &selection->tolerance;
    uint64_t spared = reception->effects & WEATHER;
    if (!selection->automatic || !tolerant(tolerance) || spared == 0)
        return 0;
    double loss_db = units_amplitude_db(escalation_weakening(reception).alone);
    return loss_db <= WEATHER_AMPLITUDE * tolerance->amplitude_db ? spared : 0;
}

/* M1: no cell is above the threshold that weather might take below it. */
static bool thresholds_hold(const struct scan *scan, double alone)
{
    double threshold = suite_threshold(scan->reception.sensor, scan->reception.interference);
    for (size_t number = 0; number < scan->cells; number++) {
        size_t count;
        const struct received_echo *members = scan_members(scan, number, &count);
        double amplitude = 0;
        for (size_t i = 0; i < count; i++)
            amplitude += members[i].amplitude;
        if (amplitude * (1 + SLACK) >= threshold && amplitude / alone < threshold)
            return false;
    }
    return true;
}

static bool in_reach(const struct sensor *sensor, const struct received_echo *a,
                     const struct received_echo *b)
{
    return fabs(a->range_m - b->range_m) <= 2 * sensor->half_range_m * (1 + SLACK) &&
           fabs(a->range_rate_mps - b->range_rate_mps) <=
               2 * sensor->half_range_rate_mps * (1 + SLACK);
}

/* M2: no leader might be passed by an echo that competes with it. Rays are strongest first, and
 * the first one with a new number leads. */
static bool leaders_hold(const struct scan *scan, double between)
{
    const struct clustered_echoes *all = &scan->resolved;
    size_t opened = 0;
    for (size_t i = 0; i < all->count; i++) {
        if (all->cell[i] != opened)
            continue;
        opened++;
        for (size_t j = i + 1; j < all->count; j++)
            if (in_reach(scan->reception.sensor, &all->received_echoes[i],
                         &all->received_echoes[j]) &&
                !(all->received_echoes[i].amplitude > between * all->received_echoes[j].amplitude))
                return false;
    }
    return true;
}

/* Do pointers add in phase and have a real ratio, so that what is read lies between the members? */
static bool adds_in_phase(const struct sensor *sensor, const struct received_echo *members,
                          size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (members[i].phase_rad != 0)
            return false;
    return sensor->phase_reference == PHASE_CENTRE;
}

struct span {
    double least, most;
};

static struct span widen(struct span span, double value)
{
    return (struct span){elementary_min(span.least, value), elementary_max(span.most, value)};
}

/* Delta over sum, signed, of a pointer from the array's centre: sum is real, delta imaginary. */
static double ratio_of(const struct sensor *sensor, const struct received_echo *received)
{
    struct antenna_pointers pointers =
        antenna_pointers(&sensor->antenna, received->echo.azimuth_rad);
    return -cimag(pointers.delta) / creal(pointers.sum);
}

static bool angle_holds(const struct sensor *sensor, const struct received_echo *members,
                        size_t count, double part, double limit_rad)
{
    double weighted = 0, total = 0;
    struct span span = {(double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < count; i++) {
        double ratio = ratio_of(sensor, &members[i]);
        weighted += members[i].amplitude / members[0].amplitude * ratio;
        total += members[i].amplitude / members[0].amplitude;
        span = widen(span, ratio);
    }
    double ratio = weighted / total, shift = part * (span.most - span.least);
    double azimuth = antenna_azimuth_rad(&sensor->antenna, ratio, 1);
    double high =
        antenna_azimuth_rad(&sensor->antenna, elementary_min(ratio + shift, span.most), 1);
    double low =
        antenna_azimuth_rad(&sensor->antenna, elementary_max(ratio - shift, span.least), 1);
    return elementary_max(high - azimuth, azimuth - low) * (1 + SLACK) <= limit_rad;
}

/* M4 and M5: a weighted mean over [0, 1] whose weights change by factors within [1/g, g] moves by
 * at most (g - 1)/(g + 1). */
static bool means_hold(const struct sensor *sensor, const struct received_echo *members,
                       size_t count, double between, const struct tolerance *tolerance)
{
    struct span range = {(double)INFINITY, -(double)INFINITY}, rate = range;
    for (size_t i = 0; i < count; i++) {
        range = widen(range, members[i].range_m);
        rate = widen(rate, members[i].range_rate_mps);
    }
    double part = (between - 1) / (between + 1);
    return (range.most - range.least) * part <= tolerance->range_m &&
           (rate.most - rate.least) * part <= tolerance->range_rate_mps &&
           adds_in_phase(sensor, members, count) &&
           angle_holds(sensor, members, count, part, WEATHER_AZIMUTH * tolerance->azimuth_rad);
}

bool escalation_holds(const struct scan *scan, struct weakening weakening,
                      const struct tolerance *tolerance)
{
    if (!thresholds_hold(scan, weakening.alone) || !leaders_hold(scan, weakening.between))
        return false;
    for (size_t number = 0; number < scan->cells; number++) {
        size_t count;
        const struct received_echo *members = scan_members(scan, number, &count);
        if (count > 1 &&
            !means_hold(scan->reception.sensor, members, count, weakening.between, tolerance))
            return false;
    }
    return true;
}

bool escalation_spares_superposition(const struct sensor *sensor,
                                     const struct received_echo *members, size_t count,
                                     const struct tolerance *tolerance)
{
    struct span azimuth = {(double)INFINITY, -(double)INFINITY};
    if (!tolerant(tolerance) || !adds_in_phase(sensor, members, count))
        return false;
    for (size_t i = 0; i < count; i++)
        azimuth = widen(azimuth, members[i].echo.azimuth_rad);
    if (!((azimuth.most - azimuth.least) * (1 + SLACK) <=
          SUPERPOSITION_AZIMUTH * tolerance->azimuth_rad))
        return false;
    struct interval gain = antenna_gain_bounds(&sensor->antenna, azimuth.least, azimuth.most);
    return gain.least > 0 && units_amplitude_db(gain.most / gain.least * (1 + SLACK)) <=
                                 SUPERPOSITION_AMPLITUDE * tolerance->amplitude_db;
}
