/* Noise: complex noise on the pointers and the angle read off them (MODEL 7, 8), noise on range and
 * range rate (9), the final threshold, the order and the limit of the list (10, 11). */
#include <complex.h>
#include <math.h>

#include "cell_margins.h"
#include "elementary.h"
#include "random.h"
#include "readings.h"
#include "stage.h"
#include "units.h"

/* Equation (8): both channels get independent complex noise of the same RMS. */
static struct antenna_pointers noisy_pointers(const struct cell *cell, const struct sensor *sensor,
                                              const struct random_address *address)
{
    double draw[4], sigma = sensor->pointer_sigma * sqrt(0.5);
    random_gaussian(address, RANDOM_POINTERS, 0, draw);
    const double _Complex i = (double _Complex)I;
    return (struct antenna_pointers){
        .sum = cell->sum_re + sigma * draw[0] + i * (cell->sum_im + sigma * draw[1]),
        .delta = cell->delta_re + sigma * draw[2] + i * (cell->delta_im + sigma * draw[3]),
    };
}

/* False if there is nothing to read an angle off. */
static bool measure(const struct cell *cell, const struct sensor *sensor,
                    const struct random_address *address, struct antenna_pointers pointers,
                    struct reading *reading)
{
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    bool fixed = sensor->sigma_law == SIGMA_FIXED;
    double part = fixed ? 1 : fmin(sensor->threshold / cell->amplitude, 1), draw[4];
    random_gaussian(address, RANDOM_RANGE_RATE, 0, draw);
    double range_m = cell->range_m + part * sensor->range_sigma_m * draw[0];
    double rate_mps = cell->range_rate_mps + part * sensor->range_rate_sigma_mps * draw[1];
    *reading = (struct reading){
        .cell = cell,
        .range_m = reading_step(fmax(range_m, 0), sensor->range_step_m),
        .azimuth_rad = reading_step(angle.azimuth_rad, sensor->azimuth_step_rad),
        .range_rate_mps = reading_step(rate_mps, sensor->range_rate_step_mps),
        .amplitude = elementary_hypot(creal(pointers.sum), cimag(pointers.sum)),
        .sign_undecided = angle.sign_undecided,
        .margins = cell->margins,
    };
    return angle.valid;
}

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    (void)selection;
    struct cell_span cells = frame_cells_of(frame, sensor->name);
    struct reading *readings = arena_get(frame->arena, (cells.count + 1) * sizeof *readings);
    size_t count = 0;
    for (size_t i = 0; i < cells.count; i++) {
        const struct cell *cell = &cells.items[i];
        struct random_address address =
            runner_address(frame, sensor->name, &cell->members.items[0]);
        struct antenna_pointers pointers = noisy_pointers(cell, sensor, &address);
        bool has_angle = measure(cell, sensor, &address, pointers, &readings[count]);
        double amplitude = readings[count].amplitude;
        struct margins *margins = &readings[count].margins;
        if (frame->margins)
            cell_margins_add_noisy(sensor, pointers, amplitude, margins);
        if (sensor->final_threshold && amplitude < sensor->threshold)
            frame_lose_cell(frame, "noise", cell, LOSS_BELOW_FINAL,
                            units_shortfall_db(sensor->threshold, amplitude), margins);
        else if (!has_angle)
            frame_lose_cell(frame, "noise", cell, LOSS_NO_ANGLE, 0, margins);
        else
            count++;
    }
    readings_list(frame, "noise", sensor, readings, count, sensor->list_limit);
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
        "noise to range and range rate, applies the final threshold, and lists what is left\n"
        "in the sensor's order up to its limit, each with its exact label.",
    .options = &suite_choice_record,
    .reads = SECTION_SENSORS | SECTION_CELLS,
    .writes = SECTION_TARGETS | SECTION_LOST,
    .step = noise_step,
};
