/* Noise: complex noise on the pointers and the angle read off them (MODEL 7, 8), noise on range and
 * range rate (9), misalignment, false alarms (14), the final threshold, the order and the limit of
 * the list (10, 11), and the rounding of what is reported. */
#include "base/units.h"
#include "noise/beam_cells.h"
#include "noise/false_alarm_cells.h"
#include "noise/steady_cells.h"
#include "noise/target_list.h"
#include "radar/interferer.h"
#include "run/suite_choice.h"

/* Measures all cells and keeps those that are still a target after noise. Returns their number. */
static size_t measure_cells(struct frame *frame, const struct effect_scan *context,
                            struct cell_span cells, struct effect_measurement *measurements)
{
    bool tested = effect_simulates(context, EFFECT_FINAL_THRESHOLD);
    size_t count = 0;
    for (size_t i = 0; i < cells.count; i++) {
        const struct cell *cell = &cells.items[i];
        struct effect_measurement *measurement = &measurements[count];
        bool has_angle = target_list_measure(context, cell, measurement);
        double threshold = interferer_threshold(context->sensor->threshold, cell->interference);
        if (tested && measurement->amplitude < threshold)
            frame_lose_cell(frame, "noise", cell, LOSS_BELOW_FINAL,
                            units_shortfall_db(threshold, measurement->amplitude),
                            &measurement->margins);
        else if (!has_angle)
            frame_lose_cell(frame, "noise", cell, LOSS_NO_ANGLE, 0, &measurement->margins);
        else
            count++;
    }
    return count;
}

/* The cells that noise decides, or where it does not, those that are detected without it. */
static struct cell_span cells_of(struct frame *frame, const struct effect_scan *context)
{
    if (effect_simulates(context, EFFECT_FINAL_THRESHOLD))
        return frame_cells_of(frame, context->sensor->name);
    return steady_cells_of(frame, "noise", context->sensor);
}

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    struct effect_scan context = effect_begin(frame, sensor, selection, EFFECT_HOME_NOISE);
    struct cell_span alarms = false_alarm_cells_of(frame, &context);
    struct cell_span cells =
        beam_cells_of(frame, "noise", sensor, &context, cells_of(frame, &context));
    struct effect_measurement *measurements =
        arena_get(frame->arena, (cells.count + alarms.count + 1) * sizeof *measurements);
    size_t count = measure_cells(frame, &context, cells, measurements);
    for (size_t i = 0; i < alarms.count; i++)
        measurements[count++] = effect_measurement_of(NULL, &alarms.items[i]);
    struct detection_source source = detection_quality_source(sensor, cells, &context);
    if (frame_carries(frame, CARRY_QUALITY))
        detection_quality_estimate(&source, effects_enabled(selection, EFFECT_THRESHOLD),
                                   measurements, count);
    target_list_make(frame, "noise", &source, measurements, count);
}

const struct stage stage_noise = {
    .name = "noise",
    .summary = "Add noise to every cell and write the target list.",
    .details =
        "Adds complex noise to the pointers of every cell and estimates the angle from them. Adds "
        "noise to range and range rate, and turns the angle by misalignment and radome. Applies "
        "the final threshold and adds false alarms. Lists the targets in the sensor's order, up to "
        "its limit and rounded to its steps, each with a label of the reflectors that made it.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_CELLS,
    .writes = PART_TARGETS | PART_LOST | PART_COUNTS | PART_VISIBILITY,
    .step = suite_choice_step,
    .visit = list_targets,
    .locate_fault = suite_choice_locate_fault,
};
