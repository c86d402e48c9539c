/* Noise: complex noise on the pointers and the angle read off them (MODEL 7, 8), noise on range and
 * range rate (9), misalignment, false alarms (14), the final threshold, the order and the limit of
 * the list (10, 11), and the rounding of what is reported. */
#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "frame/draw_address.h"
#include "noise/measurement_noise.h"
#include "noise/noise_targets.h"
#include "run/stage.h"

/* False if there is nothing to read an angle off. */
static bool measure(const struct frame *frame, const struct measurement_noise *by,
                    const struct random_address *scan, const struct cell *cell,
                    struct measurement *measurement)
{
    const struct sensor *sensor = by->sensor;
    struct random_address address = draw_address_in(*scan, cell->members.items[0].id);
    struct antenna_pointers pointers = measurement_noise_pointers(by, &address, cell);
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    *measurement = target_list_measure(cell);
    measurement->azimuth_rad = angle.azimuth_rad;
    measurement->amplitude = elementary_hypot(creal(pointers.sum), cimag(pointers.sum));
    measurement->sign_undecided = angle.sign_undecided;
    if (by->pointers)
        measurement->effects |= EFFECT_BIT(EFFECT_ANGLE_NOISE);
    measurement_noise_range(by, &address, measurement);
    measurement_noise_azimuth(by, measurement);
    if (frame->margins)
        target_list_note_margins(sensor, cell, pointers, measurement->amplitude,
                                 by->final_threshold, &measurement->margins);
    return angle.valid;
}

/* The measurements of all cells that are still a target after noise. */
static size_t read_cells(struct frame *frame, const struct measurement_noise *by,
                         const struct random_address *scan, struct cell_span cells,
                         struct measurement *measurements)
{
    const struct sensor *sensor = by->sensor;
    size_t count = 0;
    for (size_t i = 0; i < cells.count; i++) {
        const struct cell *cell = &cells.items[i];
        struct measurement *measurement = &measurements[count];
        bool has_angle = measure(frame, by, scan, cell, measurement);
        double threshold = suite_threshold(sensor, cell->interference);
        if (by->final_threshold && measurement->amplitude < threshold)
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

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    struct measurement_noise by = measurement_noise_of(sensor, selection);
    struct contributor noise = noise_targets_contributor(0);
    struct random_address scan = draw_address_of(frame, sensor->name, noise.id);
    struct cell_span alarms = noise_targets_of(frame, sensor, selection, by.false_alarms, &scan);
    struct cell_span cells = frame_cells_of(frame, sensor->name);
    struct measurement *measurements =
        arena_get(frame->arena, (cells.count + alarms.count + 1) * sizeof *measurements);
    size_t count = read_cells(frame, &by, &scan, cells, measurements);
    for (size_t i = 0; i < alarms.count; i++)
        measurements[count++] = target_list_measure(&alarms.items[i]);
    size_t first = frame->targets.count;
    target_list_make(frame, "noise", sensor, measurements, count, by.list_limit);
    for (size_t i = first; i < frame->targets.count && by.steps; i++)
        target_list_round(&frame->targets.items[i], sensor);
}

static int noise_step(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    return runner_visit_sensors(runner, frame, list_targets);
}

const struct stage stage_noise = {
    .name = "noise",
    .summary = "Add noise to every cell and write the target list.",
    .details =
        "Adds complex noise to the sum and delta pointers and reads the angle off them, adds\n"
        "noise to range and range rate, turns the angle by misalignment and radome, applies\n"
        "the final threshold, adds false alarms, and lists what there is in the sensor's\n"
        "order up to its limit, rounded to its steps, each with its exact label.",
    .options = &suite_choice_record,
    .reads = SECTION_SENSORS | SECTION_CELLS,
    .writes = SECTION_TARGETS | SECTION_LOST | SECTION_COUNTS,
    .step = noise_step,
};
