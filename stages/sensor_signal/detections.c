#include "detections.h"

#include "base/elementary.h"
#include "base/units.h"
#include "noise/false_alarm_cells.h"
#include "noise/target_list.h"
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

static double element_sigma_rad(const struct element_row *array, double azimuth_rad, double snr)
{
    double count = (double)array->elements;
    struct measurement_sigma sine = {.cell = 1 / (count * array->spacing), .factor = CRAMER_RAO};
    return measurement_sigma_at_snr(&sine, snr * (1 - 1 / (count * count))) /
           elementary_cos(azimuth_rad);
}

/* Signal-to-noise ratio, as a ratio of powers, of an amplitude that contains noise. */
static double snr_of(double amplitude, double noise)
{
    double ratio = amplitude / noise;
    return elementary_max(ratio * ratio - 1, 0);
}

void detections_estimate(const struct signal_cube *signal, double peak, double noise,
                         struct effect_measurement *measurement)
{
    const struct sensor *sensor = signal->sensor;
    double azimuth_rad = measurement->azimuth_rad;
    double peak_snr = snr_of(peak, noise), beam_snr = snr_of(measurement->amplitude, noise);
    struct measurement_sigma range = {.cell = sensor->cell_range_m,
                                      .factor = factors[signal->range_response]};
    struct measurement_sigma rate = {.cell = sensor->cell_range_rate_mps,
                                     .factor = factors[sensor->waveform.window]};
    double rate_mps = measurement_sigma_at_snr(&rate, peak_snr);
    double coupled_m = signal->coupling * signal->range_step_m * rate_mps;
    double sigma_rad = sensor->beams.count > 0
                           ? measurement->cell->beam->sigma * noise / elementary_cos(azimuth_rad)
                       : signal->array.elements > 0
                           ? element_sigma_rad(&signal->array, azimuth_rad, beam_snr)
                           : detection_quality_widening(measurement, noise) *
                                 suite_azimuth_sigma_rad(sensor, azimuth_rad, beam_snr);
    measurement->range_sigma_m =
        elementary_hypot(measurement_sigma_at_snr(&range, peak_snr), coupled_m);
    measurement->range_rate_sigma_mps = rate_mps;
    measurement->azimuth_sigma_rad =
        elementary_min(sigma_rad, sensor->field_of_view_rad / sqrt(12));
}

double detections_noise_bins(const struct signal_cube *signal)
{
    const struct sensor *sensor = signal->sensor;
    double ranges = (sensor->range_max_m - sensor->range_min_m) / sensor->cell_range_m;
    double beams = signal->array.elements > 0 ? (double)signal->array.elements : 1;
    beams *= (double)signal->turns;
    return ranges * (double)signal->repetitions * beams;
}

#define NONE SIZE_MAX
#define LEAST_PART 0.5

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

/* Adds a detection of this amplitude and azimuth, if a range rate puts it within the sensor's
 * ranges. */
static struct detection *add_unfolded(struct detections *detections,
                                      const struct range_doppler_peak *peak, double amplitude,
                                      double azimuth_rad, struct arena *arena)
{
    struct unfolding_reading reading;
    if (!unfolding_choose(detections->signal, peak, amplitude, elementary_sin(azimuth_rad),
                          &reading))
        return NULL;
    return add(detections, peak, &reading, amplitude, azimuth_rad, arena);
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
    struct detection *detection =
        add_unfolded(detections, peak, peak->amplitude, angle.azimuth_rad, arena);
    if (detection == NULL)
        return;
    detection->pointers = pointers;
    detection->sign_undecided = angle.sign_undecided;
}

static void add_beams(struct detections *detections, const struct range_doppler_peak *peak,
                      const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct signal_cube *signal = detections->signal;
    struct element_row_peak beams[ELEMENT_ROW_MOST_PEAKS];
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    double least = elementary_max(peak->threshold, detections->least) * peak->gain;
    size_t count = element_row_peaks(&signal->array, at, stride, limit, least, beams);
    for (size_t i = 0; i < count; i++)
        add_unfolded(detections, peak, beams[i].amplitude / peak->gain,
                     elementary_asin(beams[i].sine), arena);
}

/* Adds the beams of an array. Range rates that fold alike have other phases between transmitters
 * that take turns; the one of the largest maximum is taken. */
static void add_array(struct detections *detections, const struct range_doppler_peak *peak,
                      const struct phasor *at, size_t stride, struct arena *arena)
{
    const struct signal_cube *signal = detections->signal;
    const struct array *array = &signal->sensor->beams;
    double half_mps = (double)signal->turns * signal->fold_mps / 2, best_mps = 0;
    struct array_maximum best[ARRAY_MOST_ELEMENTS] = {{0}};
    struct unfolding_reading reading;
    size_t count = 0;
    for (size_t fold = 0; fold < signal->turns; fold++) {
        double rate_mps = folding_range_rate_mps(
            peak->rate * signal->rate_step_mps + (double)fold * signal->fold_mps, 0, half_mps);
        struct phasor samples[ARRAY_MOST_ELEMENTS];
        struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
        for (size_t n = 0; n < array->count; n++) {
            struct elementary_sincos turn =
                elementary_sincos_turns(-signal_cube_turn_phase(signal, n, rate_mps));
            struct phasor here = at[n * stride];
            samples[n] = (struct phasor){here.re * turn.cos - here.im * turn.sin,
                                         here.re * turn.sin + here.im * turn.cos};
        }
        size_t found = array_maxima(array, samples, maxima);
        if (found == 0 || maxima[0].amplitude <= best[0].amplitude)
            continue;
        memcpy(best, maxima, sizeof best);
        count = found;
        best_mps = rate_mps;
    }
    double least = elementary_max(peak->threshold, detections->least) * peak->gain;
    count = array_keep(array, least, detections->noise, best, count);
    if (!unfolding_read(signal, peak, best_mps, &reading))
        return;
    for (size_t i = 0; i < count && best[i].amplitude >= least; i++) {
        struct array_maximum *beam = arena_get(arena, sizeof *beam);
        *beam = best[i];
        beam->sigma *= peak->gain;
        add(detections, peak, &reading, best[i].amplitude / peak->gain,
            elementary_asin(best[i].sine), arena)
            ->beam = beam;
    }
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
    bool row = signal->array.elements > 0, array = signal->sensor->beams.count > 0;
    size_t count = range_doppler_peaks(spectrum, &detections.cfar, detections.least, arena, &peaks);
    size_t width = spectrum->range_cells, stride = width * spectrum->rate_cells;
    for (size_t i = 0; i < count; i++) {
        const struct phasor *at =
            signal->spectrum + peaks[i].rate_cell * width + peaks[i].range_cell;
        (array ? add_array
         : row ? add_beams
               : add_monopulse)(&detections, &peaks[i], at, stride, arena);
    }
    return detections;
}

/* The part of the echo's amplitude at the detection's place and in its beam. */
static double part_of(const struct detections *detections, const struct received_echo *received,
                      const struct detection *detection)
{
    const struct signal_cube *signal = detections->signal;
    const struct range_doppler *spectrum = detections->spectrum;
    double range, rate;
    signal_cube_place(signal, received, &range, &rate);
    range_doppler_away(spectrum, detection->peak, &range, &rate);
    double part = fabs(point_response_value(spectrum->range_response, range) *
                       point_response_value(spectrum->rate_response, rate));
    double distance =
        elementary_sin(received->echo.azimuth_rad) - elementary_sin(detection->azimuth_rad);
    if (detection->beam != NULL)
        return part * array_response(&signal->sensor->beams, distance);
    if (signal->array.elements > 0)
        part *= element_row_factor(&signal->array, distance);
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

static void label_false_alarm(const struct sensor *sensor, struct detection *detection,
                              int64_t number, double time_s, struct arena *arena)
{
    struct contributor noise = false_alarm_cells_contributor(number);
    noise.range_m = detection->range_m;
    noise.azimuth_rad = detection->azimuth_rad;
    noise.range_rate_mps = detection->range_rate_mps;
    noise.time_s = time_s;
    detection->cell = false_alarm_cells_cell(sensor, &noise, detection->amplitude, arena);
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
        }
        if (own > 0)
            label(detections->signal, detection, members, own, arena);
        else
            label_false_alarm(sensor, detection, ++alarms, detections->time_s, arena);
        if (dominant != NONE) {
            detection->cell.repeats = owner[dominant] != NONE;
            owner[dominant] = detection->cell.repeats ? owner[dominant] : number;
        }
        detection->cell.beam = detection->beam;
    }
    for (size_t i = 0; i < count; i++)
        if (owner[i] == NONE)
            lose_echo(detections, frame, stage, &received_echoes[i]);
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
        if (frame_carries(frame, CARRY_QUALITY) && detections->noise > 0)
            detections_estimate(detections->signal, peak->amplitude, detections->noise / peak->gain,
                                &measurements[i]);
        effect_measure(noise, EFFECT_STEP_AZIMUTH, &measurements[i]);
    }
    struct detection_source source = {
        .sensor = noise->sensor,
        .scan = noise,
        .range_rate_interval_mps = detections->signal->fold_mps,
        .noise = detections->noise,
        .channels = detections->noise > 0 && detections->signal->array.elements == 0,
        .existence = {.false_alarms = detections_noise_bins(detections->signal), .rise = 1},
    };
    target_list_make(frame, stage, &source, measurements, count);
}
