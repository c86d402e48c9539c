#include "signal/detections.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "effects/effect.h"
#include "noise/false_alarm_cells.h"
#include "radar/interferer.h"
#include "sensor/cell_margins.h"

#define NONE SIZE_MAX
#define LEAST_PART 0.5

static struct detection *add(struct detections *detections, const struct range_doppler_peak *peak,
                             struct arena *arena)
{
    const struct signal_cube *signal = detections->signal;
    struct detection *detection = list_add(&detections->list, arena);
    detection->peak = peak;
    detection->range_m = elementary_max(peak->range * signal->range_step_m, 0);
    detection->range_rate_mps = peak->rate * signal->rate_step_mps;
    return detection;
}

/* Adds a detection with the azimuth from sum and delta, as in glint-noise. */
static void add_monopulse(struct detections *detections, const struct range_doppler_peak *peak,
                          const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct sensor *sensor = detections->signal->sensor;
    const double _Complex i = (double _Complex)I;
    struct antenna_pointers pointers = {
        .sum = at[0].re / peak->gain + i * (at[0].im / peak->gain),
        .delta = at[stride].re / peak->gain + i * (at[stride].im / peak->gain),
    };
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    struct detection *detection = add(detections, peak, arena);
    detection->azimuth_rad = angle.azimuth_rad;
    detection->sign_undecided = angle.sign_undecided;
    detection->amplitude = peak->amplitude;
}

static void add_beams(struct detections *detections, const struct range_doppler_peak *peak,
                      const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct signal_cube *signal = detections->signal;
    struct beamforming_peak beams[BEAMFORMING_MOST_PEAKS];
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    size_t count = beamforming_peaks(&signal->array, at, stride, limit,
                                     detections->threshold * peak->gain, beams);
    for (size_t i = 0; i < count; i++) {
        struct detection *detection = add(detections, peak, arena);
        detection->azimuth_rad = elementary_asin(beams[i].sine);
        detection->amplitude = beams[i].amplitude / peak->gain;
    }
}

struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum,
                                const struct effect_scan *context)
{
    struct arena *arena = context->frame->arena;
    double threshold = signal->sensor->threshold * interferer_noise_factor(context->interference);
    struct detections detections = {signal, spectrum, threshold, context->time_s, {NULL, 0, 0}};
    struct cfar cfar = waveform_cfar(&signal->sensor->waveform);
    struct range_doppler_peak *peaks;
    bool array = signal->array.elements > 0;
    size_t count = range_doppler_peaks(
        spectrum, &cfar, array ? SIGNAL_CUBE_BETWEEN_BEAMS * threshold : threshold, arena, &peaks);
    size_t stride = spectrum->range_bins * spectrum->rate_bins;
    for (size_t i = 0; i < count; i++) {
        const struct phasor *at =
            spectrum->samples + peaks[i].rate_bin * spectrum->range_bins + peaks[i].range_bin;
        (array ? add_beams : add_monopulse)(&detections, &peaks[i], at, stride, arena);
    }
    return detections;
}

/* The part of the echo's amplitude that the detection shows, by its range, range rate and beam. */
static double part_of(const struct detections *detections, const struct received_echo *received,
                      const struct detection *detection)
{
    const struct signal_cube *signal = detections->signal;
    const struct range_doppler *spectrum = detections->spectrum;
    double range = range_doppler_distance(received->range_m / signal->range_step_m,
                                          detection->peak->range, spectrum->range_bins);
    double rate = range_doppler_distance(received->range_rate_mps / signal->rate_step_mps,
                                         detection->peak->rate, spectrum->rate_bins);
    double part = fabs(point_response_value(spectrum->range_response, range) *
                       point_response_value(spectrum->rate_response, rate));
    if (signal->array.elements > 0)
        part *=
            beamforming_array_factor(&signal->array, elementary_sin(received->echo.azimuth_rad) -
                                                         elementary_sin(detection->azimuth_rad));
    return part;
}

static size_t detection_of(const struct detections *detections,
                           const struct received_echo *received)
{
    size_t owner = NONE;
    double most = 0;
    for (size_t i = 0; i < detections->list.count; i++) {
        double part = part_of(detections, received, &detections->list.items[i]);
        if (part >= LEAST_PART && part > most) {
            most = part;
            owner = i;
        }
    }
    return owner;
}

/* The received echo that makes at least half of the detection's amplitude, or NONE. */
static size_t dominant_echo_of(const struct detections *detections,
                               const struct detection *detection,
                               const struct received_echo *received_echoes, size_t count)
{
    size_t dominant = NONE;
    double most = LEAST_PART * detection->amplitude;
    for (size_t i = 0; i < count; i++) {
        double amplitude =
            received_echoes[i].amplitude * part_of(detections, &received_echoes[i], detection);
        if (amplitude >= most) {
            most = amplitude;
            dominant = i;
        }
    }
    return dominant;
}

static void label(const struct sensor *sensor, struct detection *detection,
                  const struct received_echo *received_echoes, size_t count, struct arena *arena)
{
    resolution_cell_of(sensor, received_echoes, count, true, arena, &detection->cell);
    for (size_t i = 0; i < count; i++)
        margins_merge(&detection->cell.margins, received_echoes[i].margins);
    double span_mps = (double)sensor->waveform.repetitions * sensor->cell_range_rate_mps;
    double away_mps = received_echoes[0].range_rate_mps - detection->range_rate_mps;
    detection->range_rate_mps += span_mps * round(away_mps / span_mps);
}

static void label_false_alarm(const struct sensor *sensor, struct detection *detection,
                              int64_t number, double time_s, struct arena *arena)
{
    struct contributor noise = false_alarm_cells_contributor(number);
    noise.range_m = detection->range_m;
    noise.azimuth_rad = detection->azimuth_rad;
    noise.range_rate_mps = detection->range_rate_mps;
    noise.time_s = time_s;
    detection->cell = (struct cell){
        .sensor = sensor->name,
        .range_m = noise.range_m,
        .azimuth_rad = noise.azimuth_rad,
        .range_rate_mps = noise.range_rate_mps,
        .amplitude = detection->amplitude,
        .effects = EFFECT_BIT(EFFECT_FALSE_ALARMS),
    };
    *list_add(&detection->cell.members, arena) = noise;
}

/* Records a received echo as lost: below the threshold alone, below it among others, or, beside
 * stronger echoes, without a peak of its own. */
static void lose_echo(const struct detections *detections, struct frame *frame, const char *stage,
                      const struct received_echo *received)
{
    const struct signal_cube *signal = detections->signal;
    double shown =
        range_doppler_amplitude(detections->spectrum, received->range_m / signal->range_step_m,
                                received->range_rate_mps / signal->rate_step_mps);
    double threshold = detections->threshold;
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

void detections_label(struct detections *detections, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved)
{
    const struct received_echo *received_echoes = resolved->echoes;
    size_t count = resolved->count;
    const struct sensor *sensor = detections->signal->sensor;
    struct arena *arena = frame->arena;
    size_t *owner = arena_get(arena, (count + 1) * sizeof *owner);
    struct received_echo *members = arena_get(arena, (count + 1) * sizeof *members);
    int64_t alarms = 0;
    for (size_t i = 0; i < count; i++)
        owner[i] = detection_of(detections, &received_echoes[i]);
    for (size_t number = 0; number < detections->list.count; number++) {
        struct detection *detection = &detections->list.items[number];
        size_t own = 0;
        for (size_t i = 0; i < count; i++)
            if (owner[i] == number)
                members[own++] = received_echoes[i];
        size_t dominant =
            own == 0 ? dominant_echo_of(detections, detection, received_echoes, count) : NONE;
        if (dominant != NONE) {
            members[own++] = received_echoes[dominant];
            owner[dominant] = owner[dominant] == NONE ? number : owner[dominant];
        }
        if (own > 0)
            label(sensor, detection, members, own, arena);
        else
            label_false_alarm(sensor, detection, ++alarms, detections->time_s, arena);
    }
    for (size_t i = 0; i < count; i++)
        if (owner[i] == NONE)
            lose_echo(detections, frame, stage, &received_echoes[i]);
    if (alarms > 0)
        frame_count_echoes(frame, sensor->name, PATH_FALSE_ALARM, alarms);
}

static struct measurement measurement_of(const struct detection *detection)
{
    struct measurement measurement = target_list_measure(&detection->cell);
    if (detection->range_m != measurement.range_m ||
        detection->range_rate_mps != measurement.range_rate_mps)
        measurement.effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (detection->azimuth_rad != measurement.azimuth_rad)
        measurement.effects |= EFFECT_BIT(EFFECT_ANGLE_NOISE);
    measurement.range_m = detection->range_m;
    measurement.azimuth_rad = detection->azimuth_rad;
    measurement.range_rate_mps = detection->range_rate_mps;
    measurement.amplitude = detection->amplitude;
    measurement.sign_undecided = detection->sign_undecided;
    return measurement;
}

void detections_list(const struct detections *detections, struct frame *frame, const char *stage,
                     const struct effect_scan *noise)
{
    size_t first = frame->targets.count, count = detections->list.count;
    struct measurement *measurements = arena_get(frame->arena, (count + 1) * sizeof *measurements);
    for (size_t i = 0; i < count; i++) {
        measurements[i] = measurement_of(&detections->list.items[i]);
        measurement_noise_turn(noise, &measurements[i]);
    }
    bool limited = effect_simulates(noise, EFFECT_LIST_LIMIT);
    target_list_make(frame, stage, noise->sensor, measurements, count,
                     limited ? noise->sensor->list_limit : 0);
    for (size_t i = first; i < frame->targets.count; i++)
        target_list_round(noise, &frame->targets.items[i]);
}
