#include "signal/detections.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "effects/effect.h"
#include "noise/noise_targets.h"
#include "radar/interferer.h"
#include "sensor/cell_margins.h"

#define NOWHERE SIZE_MAX
#define LEAST_PART 0.5

static struct sighting *add(struct detections *sightings, const struct range_doppler_peak *peak,
                            struct arena *arena)
{
    const struct signal_cube *signal = sightings->signal;
    struct sighting *sighting = list_add(&sightings->list, arena);
    sighting->peak = peak;
    sighting->range_m = elementary_max(peak->range * signal->range_step_m, 0);
    sighting->range_rate_mps = peak->rate * signal->rate_step_mps;
    return sighting;
}

/* The azimuth by sum and delta, as glint-noise has it. */
static void add_monopulse(struct detections *sightings, const struct range_doppler_peak *peak,
                          const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct sensor *sensor = sightings->signal->sensor;
    const double _Complex i = (double _Complex)I;
    struct antenna_pointers pointers = {
        .sum = at[0].re / peak->gain + i * (at[0].im / peak->gain),
        .delta = at[stride].re / peak->gain + i * (at[stride].im / peak->gain),
    };
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    struct sighting *sighting = add(sightings, peak, arena);
    sighting->azimuth_rad = angle.azimuth_rad;
    sighting->sign_undecided = angle.sign_undecided;
    sighting->amplitude = peak->amplitude;
}

static void add_beams(struct detections *sightings, const struct range_doppler_peak *peak,
                      const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct signal_cube *signal = sightings->signal;
    struct beamforming_peak beams[BEAMFORMING_MOST_PEAKS];
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    size_t count = beamforming_peaks(&signal->array, at, stride, limit,
                                     sightings->threshold * peak->gain, beams);
    for (size_t i = 0; i < count; i++) {
        struct sighting *sighting = add(sightings, peak, arena);
        sighting->azimuth_rad = elementary_asin(beams[i].sine);
        sighting->amplitude = beams[i].amplitude / peak->gain;
    }
}

struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum,
                                const struct effect_scan *context)
{
    struct arena *arena = context->frame->arena;
    double threshold = signal->sensor->threshold * interferer_noise_factor(context->interference);
    struct detections sightings = {signal, spectrum, threshold, context->time_s, {NULL, 0, 0}};
    struct cfar cfar = waveform_cfar(&signal->sensor->waveform);
    struct range_doppler_peak *peaks;
    bool array = signal->array.elements > 0;
    size_t count = range_doppler_peaks(
        spectrum, &cfar, array ? SIGNAL_CUBE_BETWEEN_BEAMS * threshold : threshold, arena, &peaks);
    size_t stride = spectrum->range_bins * spectrum->rate_bins;
    for (size_t i = 0; i < count; i++) {
        const struct phasor *at =
            spectrum->samples + peaks[i].rate_bin * spectrum->range_bins + peaks[i].range_bin;
        (array ? add_beams : add_monopulse)(&sightings, &peaks[i], at, stride, arena);
    }
    return sightings;
}

/* How much of the echo shows at the sighting, in range and rate, and in the sighting's beam. */
static double part_of(const struct detections *sightings, const struct received_echo *received,
                      const struct sighting *sighting)
{
    const struct signal_cube *signal = sightings->signal;
    const struct range_doppler *spectrum = sightings->spectrum;
    double range = range_doppler_distance(received->range_m / signal->range_step_m,
                                          sighting->peak->range, spectrum->range_bins);
    double rate = range_doppler_distance(received->range_rate_mps / signal->rate_step_mps,
                                         sighting->peak->rate, spectrum->rate_bins);
    double part = fabs(point_response_value(spectrum->range_kernel, range) *
                       point_response_value(spectrum->rate_kernel, rate));
    if (signal->array.elements > 0)
        part *= beamforming_kernel(&signal->array, elementary_sin(received->echo.azimuth_rad) -
                                                       elementary_sin(sighting->azimuth_rad));
    return part;
}

static size_t home_of(const struct detections *sightings, const struct received_echo *received)
{
    size_t home = NOWHERE;
    double most = 0;
    for (size_t i = 0; i < sightings->list.count; i++) {
        double part = part_of(sightings, received, &sightings->list.items[i]);
        if (part >= LEAST_PART && part > most) {
            most = part;
            home = i;
        }
    }
    return home;
}

/* The received echo that makes at least half of it, or NOWHERE. */
static size_t maker_of(const struct detections *sightings, const struct sighting *sighting,
                       const struct received_echo *received_echoes, size_t count)
{
    size_t maker = NOWHERE;
    double most = LEAST_PART * sighting->amplitude;
    for (size_t i = 0; i < count; i++) {
        double amplitude =
            received_echoes[i].amplitude * part_of(sightings, &received_echoes[i], sighting);
        if (amplitude >= most) {
            most = amplitude;
            maker = i;
        }
    }
    return maker;
}

static void label(const struct sensor *sensor, struct sighting *sighting,
                  const struct received_echo *received_echoes, size_t count, struct arena *arena)
{
    resolution_cell_of(sensor, received_echoes, count, true, arena, &sighting->cell);
    for (size_t i = 0; i < count; i++)
        margins_merge(&sighting->cell.margins, received_echoes[i].margins);
    double span_mps = (double)sensor->waveform.repetitions * sensor->cell_range_rate_mps;
    double away_mps = received_echoes[0].range_rate_mps - sighting->range_rate_mps;
    sighting->range_rate_mps += span_mps * round(away_mps / span_mps);
}

static void label_false_alarm(const struct sensor *sensor, struct sighting *sighting,
                              int64_t number, double time_s, struct arena *arena)
{
    struct contributor noise = noise_targets_contributor(number);
    noise.range_m = sighting->range_m;
    noise.azimuth_rad = sighting->azimuth_rad;
    noise.range_rate_mps = sighting->range_rate_mps;
    noise.time_s = time_s;
    sighting->cell = (struct cell){
        .sensor = sensor->name,
        .range_m = noise.range_m,
        .azimuth_rad = noise.azimuth_rad,
        .range_rate_mps = noise.range_rate_mps,
        .amplitude = sighting->amplitude,
        .effects = EFFECT_BIT(EFFECT_FALSE_ALARMS),
    };
    *list_add(&sighting->cell.members, arena) = noise;
}

/* Too weak alone, too weak among others, or beside stronger ones no peak of its own. */
static void lose(const struct detections *sightings, struct frame *frame, const char *stage,
                 const struct received_echo *received)
{
    const struct signal_cube *signal = sightings->signal;
    double shown =
        range_doppler_amplitude(sightings->spectrum, received->range_m / signal->range_step_m,
                                received->range_rate_mps / signal->rate_step_mps);
    double threshold = sightings->threshold;
    struct lost_echo lost = {.id = received->echo.id};
    enum loss reason = LOSS_MASKED;
    if (received->amplitude < threshold || shown < threshold) {
        bool alone = received->amplitude < threshold;
        reason = alone ? LOSS_BELOW_THRESHOLD : LOSS_BELOW_FINAL;
        lost.shortfall_db = units_shortfall_db(threshold, alone ? received->amplitude : shown);
    }
    lost.margins = *received->margins;
    frame_lose(frame, stage, signal->sensor->name, reason, &lost);
}

void detections_label(struct detections *sightings, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved)
{
    const struct received_echo *received_echoes = resolved->received_echoes;
    size_t count = resolved->count;
    const struct sensor *sensor = sightings->signal->sensor;
    struct arena *arena = frame->arena;
    size_t *home = arena_get(arena, (count + 1) * sizeof *home);
    struct received_echo *members = arena_get(arena, (count + 1) * sizeof *members);
    int64_t alarms = 0;
    for (size_t i = 0; i < count; i++)
        home[i] = home_of(sightings, &received_echoes[i]);
    for (size_t number = 0; number < sightings->list.count; number++) {
        struct sighting *sighting = &sightings->list.items[number];
        size_t own = 0;
        for (size_t i = 0; i < count; i++)
            if (home[i] == number)
                members[own++] = received_echoes[i];
        size_t maker = own == 0 ? maker_of(sightings, sighting, received_echoes, count) : NOWHERE;
        if (maker != NOWHERE) {
            members[own++] = received_echoes[maker];
            home[maker] = home[maker] == NOWHERE ? number : home[maker];
        }
        if (own > 0)
            label(sensor, sighting, members, own, arena);
        else
            label_false_alarm(sensor, sighting, ++alarms, sightings->time_s, arena);
    }
    for (size_t i = 0; i < count; i++)
        if (home[i] == NOWHERE)
            lose(sightings, frame, stage, &received_echoes[i]);
    if (alarms > 0)
        frame_count_echoes(frame, sensor->name, PATH_FALSE_ALARM, alarms);
}

static struct measurement reading_at(const struct sighting *sighting)
{
    struct measurement measurement = target_list_measure(&sighting->cell);
    if (sighting->range_m != measurement.range_m ||
        sighting->range_rate_mps != measurement.range_rate_mps)
        measurement.effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (sighting->azimuth_rad != measurement.azimuth_rad)
        measurement.effects |= EFFECT_BIT(EFFECT_ANGLE_NOISE);
    measurement.range_m = sighting->range_m;
    measurement.azimuth_rad = sighting->azimuth_rad;
    measurement.range_rate_mps = sighting->range_rate_mps;
    measurement.amplitude = sighting->amplitude;
    measurement.sign_undecided = sighting->sign_undecided;
    return measurement;
}

void detections_list(const struct detections *sightings, struct frame *frame, const char *stage,
                     const struct effect_scan *noise)
{
    size_t first = frame->targets.count, count = sightings->list.count;
    struct measurement *measurements = arena_get(frame->arena, (count + 1) * sizeof *measurements);
    for (size_t i = 0; i < count; i++) {
        measurements[i] = reading_at(&sightings->list.items[i]);
        measurement_noise_turn(noise, &measurements[i]);
    }
    bool limited = effect_simulates(noise, EFFECT_LIST_LIMIT);
    target_list_make(frame, stage, noise->sensor, measurements, count,
                     limited ? noise->sensor->list_limit : 0);
    for (size_t i = first; i < frame->targets.count; i++)
        target_list_round(noise, &frame->targets.items[i]);
}
