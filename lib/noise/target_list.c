#include "noise/target_list.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/sort.h"
#include "base/units.h"
#include "frame/frame_order.h"
#include "radar/interferer.h"

void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins)
{
    if (final_threshold)
        margins_note(margins, MARGIN_THRESHOLD,
                     margins_between_db(
                         amplitude, interferer_threshold(sensor->threshold, cell->interference)));
    margins_note_sign(margins, sensor->angle_estimator, pointers);
}

static int compare_strength(const void *left, const void *right)
{
    const struct effect_measurement *a = left, *b = right;
    if (a->amplitude != b->amplitude)
        return a->amplitude > b->amplitude ? -1 : 1;
    return frame_order_tied(a->cell->members.items, b->cell->members.items);
}

static int compare_range(const void *left, const void *right)
{
    const struct effect_measurement *a = left, *b = right;
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    return compare_strength(left, right);
}

/* Notes the distance of every measurement to the nearest one on the other side of the limit. */
static void note_limit_margins(struct effect_measurement *measurements, size_t count,
                               enum list_order order, int64_t limit)
{
    const struct effect_measurement *last = NULL, *next = NULL;
    int64_t listed = 0;
    for (size_t i = 0; i < count && next == NULL; i++)
        if (measurements[i].amplitude > 0)
            *(listed++ < limit ? &last : &next) = &measurements[i];
    for (size_t i = 0; i < count && next != NULL; i++) {
        struct effect_measurement *measurement = &measurements[i];
        const struct effect_measurement *other_side = measurement <= last ? next : last;
        if (!(measurement->amplitude > 0))
            continue;
        if (order == LIST_STRONGEST)
            margins_note(&measurement->margins, MARGIN_LIMIT_DB,
                         margins_between_db(other_side->amplitude, measurement->amplitude));
        else
            margins_note(&measurement->margins, MARGIN_LIMIT_M,
                         fabs(other_side->range_m - measurement->range_m));
    }
}

static struct target *add_target(struct frame *frame, const struct effect_measurement *measurement)
{
    struct target *target =
        frame_add_target(frame, measurement->cell, units_amplitude_db(measurement->amplitude));
    target->range_m = measurement->range_m;
    target->azimuth_rad = measurement->azimuth_rad;
    target->elevation_rad = measurement->elevation_rad;
    target->range_rate_mps = measurement->range_rate_mps;
    target->sign_undecided = measurement->sign_undecided;
    target->effects = measurement->effects;
    target->margins = measurement->margins;
    return target;
}

static bool has_echo(const struct cell *cell, const struct contributor *echo)
{
    for (size_t i = 0; i < cell->members.count; i++)
        if (frame_order_echo_ids(&cell->members.items[i], echo) == 0)
            return true;
    return false;
}

static bool has_earlier(const struct effect_measurement *all, size_t number,
                        const struct contributor *echo)
{
    for (size_t i = 0; i < number; i++)
        if (has_echo(all[i].cell, echo))
            return true;
    return false;
}

/* Loses the echoes of a measurement. Where labels repeat, an echo of an earlier measurement is
 * listed or lost already. */
static void lose(struct frame *frame, const char *stage, const struct effect_measurement *all,
                 size_t number, enum loss reason, bool repeats)
{
    const struct cell *cell = all[number].cell;
    if (!repeats) {
        frame_lose_cell(frame, stage, cell, reason, 0, &all[number].margins);
        return;
    }
    for (size_t i = 0; i < cell->members.count; i++) {
        struct lost_echo lost = frame_lost_echo(&cell->members.items[i], &all[number].margins);
        if (!has_earlier(all, number, &cell->members.items[i]))
            frame_lose(frame, stage, cell->sensor, reason, &lost);
    }
}

/* Tells the targets of a scan, the last of the frame, how likely each one is an echo. */
static void add_existence(struct frame *frame, const struct detection_source *source,
                          struct detection_evidence *evidence, size_t count)
{
    struct target *targets = frame->targets.items + frame->targets.count - count;
    detection_quality_weigh(&source->existence, evidence, count);
    for (size_t i = 0; i < count; i++)
        targets[i].quality.existence = evidence[i].existence;
}

void target_list_make(struct frame *frame, const char *stage, const struct detection_source *source,
                      struct effect_measurement *measurements, size_t count)
{
    const struct sensor *sensor = source->sensor;
    const struct effect_scan *scan = source->scan;
    bool limited = scan != NULL && effect_simulates(scan, EFFECT_LIST_LIMIT);
    int64_t limit = limited ? sensor->list_limit : 0;
    size_t listed = 0;
    bool repeats = false, weighs = frame_carries(frame, CARRY_QUALITY) && source->noise > 0;
    struct detection_evidence *evidence =
        arena_get(frame->arena, (weighs ? count : 0) * sizeof *evidence);
    sort_items(measurements, count, sizeof *measurements,
               sensor->list_order == LIST_STRONGEST ? compare_strength : compare_range,
               frame->arena);
    if (frame_carries(frame, CARRY_MARGINS) && limit > 0)
        note_limit_margins(measurements, count, sensor->list_order, limit);
    for (size_t i = 0; i < count; i++)
        repeats |= measurements[i].cell->repeats;
    for (size_t i = 0; i < count; i++) {
        struct effect_measurement *measurement = &measurements[i];
        bool silent = !(measurement->amplitude > 0);
        if (silent || (limit > 0 && (int64_t)listed == limit)) {
            lose(frame, stage, measurements, i, silent ? LOSS_NO_AMPLITUDE : LOSS_LIST_LIMIT,
                 repeats);
            continue;
        }
        if (scan != NULL)
            effect_measure(scan, EFFECT_STEP_ROUNDING, measurement);
        struct target *target = add_target(frame, measurement);
        if (frame_carries(frame, CARRY_QUALITY))
            target->quality = detection_quality_of(source, measurement, target, frame);
        if (weighs)
            evidence[listed].power = detection_quality_power(source, measurement);
        listed++;
    }
    if (weighs && listed > 0)
        add_existence(frame, source, evidence, listed);
}

/* Reads azimuth and amplitude: of the pointers, or of a beam. False without an azimuth. */
static bool read_angle(const struct sensor *sensor, struct effect_measurement *measurement)
{
    const struct array_maximum *beam = measurement->cell->beam;
    measurement->amplitude =
        elementary_hypot(creal(measurement->pointers.sum), cimag(measurement->pointers.sum));
    if (beam != NULL) {
        measurement->azimuth_rad = elementary_asin(beam->sine);
        measurement->amplitude = beam->amplitude;
    }
    if (sensor->beams.count > 0)
        return true;
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, measurement->pointers);
    measurement->azimuth_rad = angle.azimuth_rad;
    measurement->sign_undecided = angle.sign_undecided;
    return angle.valid;
}

bool target_list_measure(const struct effect_scan *context, const struct cell *cell,
                         struct effect_measurement *measurement)
{
    const struct sensor *sensor = context->sensor;
    *measurement = effect_measurement_of(context, cell);
    effect_measure(context, EFFECT_STEP_POINTERS, measurement);
    bool has_angle = read_angle(sensor, measurement);
    effect_measure(context, EFFECT_STEP_NOISE, measurement);
    effect_measure(context, EFFECT_STEP_ANGLES, measurement);
    if (frame_carries(context->frame, CARRY_MARGINS))
        target_list_note_margins(sensor, cell, measurement->pointers, measurement->amplitude,
                                 effect_simulates(context, EFFECT_FINAL_THRESHOLD),
                                 &measurement->margins);
    return has_angle;
}
