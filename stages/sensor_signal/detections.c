#include "detections.h"

#include "base/elementary.h"
#include "base/units.h"
#include "noise/false_alarm_cells.h"
#include "noise/target_list.h"
#include "radar/beam_owner.h"
#include "radar/folding.h"
#include "radar/interferer.h"
#include "radar/measurement_sigma.h"
#include "radar/monopulse.h"
#include "sensor/resolution_cell.h"
#include "unfolding.h"

#define CRAMER_RAO 0.389848400616838 /* sqrt(6)/(2 pi) */

/* Standard deviations in cells at an SNR of 1: the bound without a window; for Hann's, whose loss
 * is 1.5, 1.58 times the bound after the window; 1/sqrt(16 ln 2) for a pulse. */
static const double factors[] = {
    [POINT_RESPONSE_HANN] = 1.58 * CRAMER_RAO / 1.224744871391589,
    [POINT_RESPONSE_RECTANGULAR] = CRAMER_RAO,
    [POINT_RESPONSE_PULSE] = 0.300281,
};

/* Signal-to-noise ratio, as a ratio of powers, of an amplitude that contains noise. */
static double snr_of(double amplitude, double noise)
{
    double ratio = amplitude / noise;
    return elementary_max(ratio * ratio - 1, 0);
}

/* The standard deviation of the azimuth by the elements of an array, or by sum and delta. */
static double azimuth_sigma_rad(const struct signal_cube *signal, double noise,
                                struct effect_measurement *measurement)
{
    double azimuth_rad = measurement->azimuth_rad;
    double widening = detection_quality_widening(signal->sensor, measurement, noise);
    double snr = snr_of(measurement->amplitude, noise);
    if (signal->array->count > 0)
        return widening * measurement->cell->beam->sigma * noise / elementary_cos(azimuth_rad);
    return widening * suite_azimuth_sigma_rad(signal->sensor, azimuth_rad, snr);
}

void detections_estimate(const struct signal_cube *signal, double peak, double noise,
                         struct effect_measurement *measurement)
{
    const struct sensor *sensor = signal->sensor;
    double peak_snr = snr_of(peak, noise);
    struct measurement_sigma range = {.cell = sensor->cell_range_m,
                                      .factor = factors[signal->range_response]};
    struct measurement_sigma rate = {.cell = sensor->cell_range_rate_mps,
                                     .factor = factors[sensor->waveform.window]};
    double rate_mps = measurement_sigma_at_snr(&rate, peak_snr);
    double coupled_m = signal->coupling * signal->range_step_m * rate_mps;
    measurement->range_sigma_m =
        elementary_hypot(measurement_sigma_at_snr(&range, peak_snr), coupled_m);
    measurement->range_rate_sigma_mps = rate_mps;
    measurement->azimuth_sigma_rad = elementary_min(azimuth_sigma_rad(signal, noise, measurement),
                                                    sensor->field_of_view_rad / sqrt(12));
}

double detections_noise_bins(const struct signal_cube *signal)
{
    const struct sensor *sensor = signal->sensor;
    double ranges = (sensor->range_max_m - sensor->range_min_m) / sensor->cell_range_m;
    double beams = elementary_max((double)signal->array->count, 1) * (double)signal->turns;
    return ranges * (double)signal->repetitions * beams;
}

static struct detection *add(struct detections *detections, const struct range_doppler_peak *peak,
                             const struct unfolding_reading *reading, double amplitude,
                             double azimuth_rad, struct arena *arena)
{
    struct detection *detection = list_add(&detections->list, arena);
    detection->peak = peak;
    detection->range_m = reading->range_m;
    detection->range_rate_mps = reading->range_rate_mps;
    detection->azimuth_rad = azimuth_rad;
    detection->amplitude = amplitude;
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
    struct unfolding_reading reading;
    if (!unfolding_choose(detections->signal, peak, peak->amplitude, 0, &reading))
        return;
    struct detection *detection =
        add(detections, peak, &reading, peak->amplitude, angle.azimuth_rad, arena);
    detection->pointers = pointers;
    detection->sign_undecided = angle.sign_undecided;
}

/* The samples of the elements at a cell, without the phases that this range rate makes between
 * transmitters that take turns. */
static void turn_back(const struct signal_cube *signal, const struct phasor *at, size_t stride,
                      double rate_mps, struct phasor *samples)
{
    for (size_t n = 0; n < signal->array->count; n++) {
        struct elementary_sincos turn =
            elementary_sincos_turns(-signal_cube_turn_phase(signal, n, rate_mps));
        struct phasor here = at[n * stride];
        samples[n].re = here.re * turn.cos - here.im * turn.sin;
        samples[n].im = here.re * turn.sin + here.im * turn.cos;
    }
}

/* Finds the maxima of an array at a peak. Range rates that fold alike have other phases between
 * transmitters that take turns; the rate of the largest maximum is taken. */
static size_t find_maxima(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                          const struct phasor *at, size_t stride, double *best_mps,
                          struct array_maximum *best)
{
    double half_mps = (double)signal->turns * signal->fold_mps / 2, most = 0;
    size_t count = 0;
    for (size_t fold = 0; fold < signal->turns; fold++) {
        double rate_mps = folding_range_rate_mps(
            peak->rate * signal->rate_step_mps + (double)fold * signal->fold_mps, 0, half_mps);
        struct phasor samples[ARRAY_MOST_ELEMENTS];
        struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
        turn_back(signal, at, stride, rate_mps, samples);
        size_t found = array_maxima(signal->array, samples, maxima);
        if (found == 0 || maxima[0].amplitude <= most)
            continue;
        memcpy(best, maxima, sizeof maxima);
        most = maxima[0].amplitude;
        count = found;
        *best_mps = rate_mps;
    }
    return count;
}

/* Adds a beam of an array as a detection. Transmitters that take turns have told its range rate;
 * otherwise the second train tells it. */
static void add_beam(struct detections *detections, const struct range_doppler_peak *peak,
                     const struct array_maximum *maximum, double rate_mps, struct arena *arena)
{
    const struct signal_cube *signal = detections->signal;
    double amplitude = maximum->amplitude / peak->gain;
    struct unfolding_reading reading;
    bool measured = signal->turns > 1
                        ? unfolding_read(signal, peak, rate_mps, &reading)
                        : unfolding_choose(signal, peak, amplitude, maximum->sine, &reading);
    if (!measured)
        return;
    struct array_maximum *beam = arena_get(arena, sizeof *beam);
    *beam = *maximum;
    beam->sigma *= peak->gain;
    beam->others /= peak->gain * peak->gain;
    double azimuth_rad = elementary_asin(maximum->sine);
    add(detections, peak, &reading, amplitude, azimuth_rad, arena)->beam = beam;
}

static void add_beams(struct detections *detections, const struct range_doppler_peak *peak,
                      const struct phasor *at, size_t stride, struct arena *arena)
{
    struct array_maximum beams[ARRAY_MOST_ELEMENTS];
    double least = elementary_max(peak->threshold, detections->least) * peak->gain, rate_mps = 0;
    size_t count = find_maxima(detections->signal, peak, at, stride, &rate_mps, beams);
    count = array_keep(detections->signal->array, least, detections->noise, beams, count);
    for (size_t i = 0; i < count && beams[i].amplitude >= least; i++)
        add_beam(detections, peak, &beams[i], rate_mps, arena);
}

struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum, double noise,
                                const struct effect_scan *context)
{
    struct arena *arena = context->frame->arena;
    struct detections detections = {
        .signal = signal,
        .spectrum = spectrum,
        .cfar = waveform_cfar(&signal->sensor->waveform, SIGNAL_CUBE_PADDING, spectrum->beams),
        .noise = noise,
        .least =
            noise > 0 ? 0 : interferer_threshold(signal->sensor->threshold, context->interference),
        .time_s = context->time_s,
    };
    struct range_doppler_peak *peaks;
    size_t count = range_doppler_peaks(spectrum, &detections.cfar, detections.least, arena, &peaks);
    size_t width = spectrum->range_cells, stride = width * spectrum->rate_cells;
    for (size_t i = 0; i < count; i++) {
        const struct phasor *at =
            signal->spectrum + peaks[i].rate_cell * width + peaks[i].range_cell;
        if (signal->array->count > 0)
            add_beams(&detections, &peaks[i], at, stride, arena);
        else
            add_monopulse(&detections, &peaks[i], at, stride, arena);
    }
    return detections;
}

/* The detections and the echoes that may label them. */
struct labelling {
    const struct detections *detections;
    const struct received_echo *echoes;
};

/* The part of the echo's amplitude at the detection's place and in its beam. */
static double part_of(const void *of, size_t echo, size_t number)
{
    const struct labelling *labelling = of;
    const struct detections *detections = labelling->detections;
    const struct received_echo *received = &labelling->echoes[echo];
    const struct detection *detection = &detections->list.items[number];
    const struct signal_cube *signal = detections->signal;
    const struct range_doppler *spectrum = detections->spectrum;
    double range, rate;
    signal_cube_place(signal, received, &range, &rate);
    range_doppler_away(spectrum, detection->peak, &range, &rate);
    double part = fabs(point_response_value(spectrum->range_response, range) *
                       point_response_value(spectrum->rate_response, rate));
    if (signal->array->count == 0)
        return part;
    double distance =
        elementary_sin(received->echo.azimuth_rad) - elementary_sin(detection->azimuth_rad);
    return part * array_response(signal->array, distance);
}

static double amplitude_of(const void *of, size_t echo)
{
    const struct labelling *labelling = of;
    return labelling->echoes[echo].amplitude;
}

/* Labels a detection with its echoes; their range rates are moved into the fold of the strongest.
 */
static void label(const struct signal_cube *signal, struct detection *detection,
                  struct received_echo *members, size_t count, struct arena *arena)
{
    double first_mps = folding_range_rate_mps(members[0].echo.range_rate_mps, 0,
                                              (double)signal->folds * signal->fold_mps / 2);
    for (size_t i = 0; i < count; i++)
        members[i].range_rate_mps =
            first_mps + remainder(members[i].echo.range_rate_mps - first_mps, signal->fold_mps);
    resolution_cell_of(signal->sensor, members, count, true, arena, &detection->cell);
    for (size_t i = 0; i < count; i++)
        margins_merge(&detection->cell.margins, members[i].margins);
}

static void label_false_alarm(const struct sensor *sensor, const struct frame *frame,
                              struct detection *detection, int64_t number, double time_s)
{
    struct contributor noise = false_alarm_cells_contributor(number);
    noise.range_m = detection->range_m;
    noise.azimuth_rad = detection->azimuth_rad;
    noise.range_rate_mps = detection->range_rate_mps;
    noise.time_s = time_s;
    false_alarm_cells_draw_elevation(frame, sensor, &noise);
    detection->cell = false_alarm_cells_cell(sensor, &noise, detection->amplitude, frame->arena);
}

/* Records a received echo as lost: itself below the threshold, below it together with others, or
 * beside stronger echoes without a peak of its own. */
static void lose_echo(const struct detections *detections, struct frame *frame, const char *stage,
                      const struct received_echo *received)
{
    const struct signal_cube *signal = detections->signal;
    double range, rate;
    signal_cube_place(signal, received, &range, &rate);
    struct range_doppler_peak shown =
        range_doppler_at(detections->spectrum, &detections->cfar, range, rate);
    double threshold = elementary_max(shown.threshold, detections->least);
    struct lost_echo lost = frame_lost_echo(&received->echo, received->margins);
    enum loss reason = LOSS_MASKED;
    if (received->amplitude < threshold || (shown.amplitude < threshold && shown.amplitude > 0)) {
        bool alone = received->amplitude < threshold;
        reason = alone ? LOSS_BELOW_THRESHOLD : LOSS_BELOW_FINAL;
        lost.shortfall_db =
            units_shortfall_db(threshold, alone ? received->amplitude : shown.amplitude);
    }
    frame_lose(frame, stage, signal->sensor->name, reason, &lost);
}

void detections_label(struct detections *detections, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved)
{
    const struct sensor *sensor = detections->signal->sensor;
    struct arena *arena = frame->arena;
    struct labelling labelling = {detections, resolved->echoes};
    struct beam_owner owners = {
        .beams = detections->list.count,
        .echoes = resolved->count,
        .part = part_of,
        .amplitude = amplitude_of,
        .of = &labelling,
        .owner = arena_get(arena, (resolved->count + 1) * sizeof *owners.owner),
    };
    size_t *shown = arena_get(arena, (resolved->count + 1) * sizeof *shown);
    struct received_echo *members = arena_get(arena, (resolved->count + 1) * sizeof *members);
    int64_t alarms = 0;
    beam_owner_find(&owners);
    for (size_t number = 0; number < detections->list.count; number++) {
        struct detection *detection = &detections->list.items[number];
        double least = BEAM_OWNER_LEAST_PART * detection->amplitude;
        bool repeats;
        size_t count = beam_owner_shown(&owners, number, least, shown, &repeats);
        for (size_t i = 0; i < count; i++)
            members[i] = resolved->echoes[shown[i]];
        if (count > 0)
            label(detections->signal, detection, members, count, arena);
        else
            label_false_alarm(sensor, frame, detection, ++alarms, detections->time_s);
        detection->cell.repeats = repeats;
        detection->cell.beam = detection->beam;
    }
    for (size_t i = 0; i < resolved->count; i++)
        if (owners.owner[i] == BEAM_OWNER_NONE)
            lose_echo(detections, frame, stage, &resolved->echoes[i]);
    if (alarms > 0)
        frame_count_echoes(frame, sensor->name, PATH_FALSE_ALARM, alarms);
}

static struct effect_measurement measurement_of(const struct detection *detection)
{
    struct effect_measurement measurement = effect_measurement_of(NULL, &detection->cell);
    if (detection->range_m != measurement.range_m ||
        detection->range_rate_mps != measurement.range_rate_mps)
        measurement.effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (detection->azimuth_rad != measurement.azimuth_rad)
        measurement.effects |= EFFECT_BIT(EFFECT_ANGLE_NOISE);
    measurement.pointers = detection->pointers;
    measurement.range_m = detection->range_m;
    measurement.azimuth_rad = detection->azimuth_rad;
    measurement.range_rate_mps = detection->range_rate_mps;
    measurement.amplitude = detection->amplitude;
    measurement.sign_undecided = detection->sign_undecided;
    return measurement;
}

/* False alarms are the bins of noise alone; the weakest echoes are as strong as one bin of them. */
static struct existence existence_in(const struct signal_cube *signal)
{
    double bins = detections_noise_bins(signal);
    return (struct existence){
        .false_alarms = bins, .search_noise = 1, .weakest = elementary_log(bins), .rise = 1};
}

void detections_list(const struct detections *detections, struct frame *frame, const char *stage,
                     const struct effect_scan *noise)
{
    size_t count = detections->list.count;
    struct effect_measurement *measurements =
        arena_get(frame->arena, (count + 1) * sizeof *measurements);
    for (size_t i = 0; i < count; i++) {
        const struct detection *detection = &detections->list.items[i];
        const struct range_doppler_peak *peak = detection->peak;
        measurements[i] = measurement_of(detection);
        measurements[i].address =
            frame_draw_address_in(noise->address, detection->cell.members.items[0].id);
        if (frame_carries(frame, CARRY_QUALITY) && detections->noise > 0)
            detections_estimate(detections->signal, peak->amplitude, detections->noise / peak->gain,
                                &measurements[i]);
        effect_measure(noise, EFFECT_STEP_ANGLES, &measurements[i]);
    }
    struct detection_source source = {
        .sensor = noise->sensor,
        .scan = noise,
        .range_rate_interval_mps = detections->signal->fold_mps,
        .noise = detections->noise,
        .channels = detections->noise > 0,
        .existence = existence_in(detections->signal),
    };
    target_list_make(frame, stage, &source, measurements, count);
}
