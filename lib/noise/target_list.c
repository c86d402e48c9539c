#include "noise/target_list.h"

#include <math.h>

#include "base/elementary.h"
#include "base/sort.h"
#include "base/units.h"
#include "effects/effect.h"
#include "frame/frame_order.h"

struct measurement target_list_measure(const struct cell *cell)
{
    return (struct measurement){
        .cell = cell,
        .range_m = cell->range_m,
        .azimuth_rad = cell->azimuth_rad,
        .range_rate_mps = cell->range_rate_mps,
        .amplitude = elementary_hypot(cell->sum_re, cell->sum_im),
        .sign_undecided = cell->sign_undecided,
        .effects = cell->effects,
        .margins = cell->margins,
    };
}

void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins)
{
    if (final_threshold)
        margins_note(margins, MARGIN_THRESHOLD,
                     margins_between_db(amplitude, suite_threshold(sensor, cell->interference)));
    margins_note_sign(margins, sensor->angle_estimator, pointers);
}

static int compare_leaders(const struct measurement *a, const struct measurement *b)
{
    return frame_order_tied(a->cell->members.items, b->cell->members.items);
}

static int compare_strength(const void *left, const void *right)
{
    const struct measurement *a = left, *b = right;
    if (a->amplitude != b->amplitude)
        return a->amplitude > b->amplitude ? -1 : 1;
    return compare_leaders(a, b);
}

static int compare_range(const void *left, const void *right)
{
    const struct measurement *a = left, *b = right;
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    return compare_strength(left, right);
}

/* Notes the distance of every measurement to the nearest one on the other side of the limit. */
static void note_limit_margins(struct measurement *measurements, size_t count,
                               enum list_order order, int64_t limit)
{
    const struct measurement *last = NULL, *next = NULL;
    int64_t listed = 0;
    for (size_t i = 0; i < count && next == NULL; i++)
        if (measurements[i].amplitude > 0)
            *(listed++ < limit ? &last : &next) = &measurements[i];
    for (size_t i = 0; i < count && next != NULL; i++) {
        struct measurement *measurement = &measurements[i];
        const struct measurement *other_side = measurement <= last ? next : last;
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

void target_list_make(struct frame *frame, const char *stage, const struct sensor *sensor,
                      struct measurement *measurements, size_t count, int64_t limit)
{
    sort_items(measurements, count, sizeof *measurements,
               sensor->list_order == LIST_STRONGEST ? compare_strength : compare_range,
               frame->arena);
    if (frame->margins && limit > 0)
        note_limit_margins(measurements, count, sensor->list_order, limit);
    int64_t listed = 0;
    for (size_t i = 0; i < count; i++) {
        const struct measurement *measurement = &measurements[i];
        if (!(measurement->amplitude > 0)) {
            frame_lose_cell(frame, stage, measurement->cell, LOSS_NO_AMPLITUDE, 0,
                            &measurement->margins);
        } else if (limit > 0 && listed == limit) {
            frame_lose_cell(frame, stage, measurement->cell, LOSS_LIST_LIMIT, 0,
                            &measurement->margins);
        } else {
            struct target *target = frame_add_target(frame, measurement->cell,
                                                     units_amplitude_db(measurement->amplitude));
            target->range_m = measurement->range_m;
            target->azimuth_rad = measurement->azimuth_rad;
            target->range_rate_mps = measurement->range_rate_mps;
            target->sign_undecided = measurement->sign_undecided;
            target->effects = measurement->effects;
            target->margins = measurement->margins;
            listed++;
        }
    }
}

void target_list_round(const struct effect_scan *context, struct target *target)
{
    struct effect_measurement read = {
        .range_m = target->range_m,
        .azimuth_rad = target->azimuth_rad,
        .range_rate_mps = target->range_rate_mps,
        .effects = target->effects,
    };
    effect_measure(context, EFFECT_STEP_ROUNDING, &read);
    target->range_m = read.range_m;
    target->azimuth_rad = read.azimuth_rad;
    target->range_rate_mps = read.range_rate_mps;
    target->effects = read.effects;
}
