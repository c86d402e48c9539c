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

/* Notes the distance of every measurement to the nearest measurement on the other side of the
 * limit.
 */
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
    target->range_rate_mps = measurement->range_rate_mps;
    target->sign_undecided = measurement->sign_undecided;
    target->effects = measurement->effects;
    target->margins = measurement->margins;
    return target;
}

void target_list_make(struct frame *frame, const char *stage, const struct detection_source *source,
                      struct effect_measurement *measurements, size_t count)
{
    const struct sensor *sensor = source->sensor;
    const struct effect_scan *scan = source->scan;
    bool limited = scan != NULL && effect_simulates(scan, EFFECT_LIST_LIMIT);
    int64_t limit = limited ? sensor->list_limit : 0, listed = 0;
    sort_items(measurements, count, sizeof *measurements,
               sensor->list_order == LIST_STRONGEST ? compare_strength : compare_range,
               frame->arena);
    if (frame_carries(frame, CARRY_MARGINS) && limit > 0)
        note_limit_margins(measurements, count, sensor->list_order, limit);
    for (size_t i = 0; i < count; i++) {
        struct effect_measurement *measurement = &measurements[i];
        bool silent = !(measurement->amplitude > 0);
        if (silent || (limit > 0 && listed == limit)) {
            frame_lose_cell(frame, stage, measurement->cell,
                            silent ? LOSS_NO_AMPLITUDE : LOSS_LIST_LIMIT, 0, &measurement->margins);
            continue;
        }
        if (scan != NULL)
            effect_measure(scan, EFFECT_STEP_ROUNDING, measurement);
        struct target *target = add_target(frame, measurement);
        if (frame_carries(frame, CARRY_QUALITY))
            target->quality = detection_quality_of(source, measurement, target, frame);
        listed++;
    }
}

bool target_list_measure(const struct effect_scan *context, const struct cell *cell,
                         struct effect_measurement *measurement)
{
    const struct sensor *sensor = context->sensor;
    *measurement = effect_measurement_of(context, cell);
    effect_measure(context, EFFECT_STEP_POINTERS, measurement);
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, measurement->pointers);
    measurement->azimuth_rad = angle.azimuth_rad;
    measurement->sign_undecided = angle.sign_undecided;
    measurement->amplitude =
        elementary_hypot(creal(measurement->pointers.sum), cimag(measurement->pointers.sum));
    effect_measure(context, EFFECT_STEP_NOISE, measurement);
    effect_measure(context, EFFECT_STEP_AZIMUTH, measurement);
    if (frame_carries(context->frame, CARRY_MARGINS))
        target_list_note_margins(sensor, cell, measurement->pointers, measurement->amplitude,
                                 effect_simulates(context, EFFECT_FINAL_THRESHOLD),
                                 &measurement->margins);
    return angle.valid;
}
