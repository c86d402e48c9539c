/* Noise: complex noise on the pointers and the angle read off them (MODEL 7, 8), noise on range and
 * range rate (9), the final threshold, the order and the limit of the list (10, 11). */
#include <complex.h>
#include <math.h>

#include "cell_margins.h"
#include "elementary.h"
#include "random.h"
#include "readings.h"
#include "stage.h"
#include "superposition.h"
#include "units.h"

/* What the effects at home here do to this sensor's cells. */
struct disturbance {
    const struct sensor *sensor;
    bool pointers, range, by_amplitude, final_threshold, steps;
    int64_t list_limit;
};

static bool on(const struct selection *selection, enum effect effect, bool described)
{
    bool simulated = described && effects_may(selection, effect);
    effects_note(selection, effect, simulated);
    return simulated;
}

static struct disturbance disturbance_of(const struct sensor *sensor,
                                         const struct selection *selection)
{
    bool steps =
        sensor->range_step_m > 0 || sensor->range_rate_step_mps > 0 || sensor->azimuth_step_rad > 0;
    return (struct disturbance){
        .sensor = sensor,
        .pointers = on(selection, EFFECT_ANGLE_NOISE, sensor->pointer_sigma > 0),
        .range = on(selection, EFFECT_RANGE_NOISE,
                    sensor->range_sigma_m > 0 || sensor->range_rate_sigma_mps > 0),
        .by_amplitude = on(selection, EFFECT_ACCURACY, sensor->sigma_law == SIGMA_BY_AMPLITUDE),
        .final_threshold = on(selection, EFFECT_FINAL_THRESHOLD, sensor->final_threshold),
        .steps = on(selection, EFFECT_QUANTISATION, steps),
        .list_limit =
            on(selection, EFFECT_LIST_LIMIT, sensor->list_limit > 0) ? sensor->list_limit : 0,
    };
}

/* Equation (8): both channels get independent complex noise of the same RMS. */
static struct antenna_pointers disturb_pointers(const struct disturbance *by,
                                                const struct random_address *address,
                                                struct antenna_pointers pointers)
{
    double draw[4], sigma = by->sensor->pointer_sigma * sqrt(0.5);
    if (!by->pointers)
        return pointers;
    random_gaussian(address, RANDOM_POINTERS, 0, draw);
    const double _Complex i = (double _Complex)I;
    pointers.sum += sigma * draw[0] + i * (sigma * draw[1]);
    pointers.delta += sigma * draw[2] + i * (sigma * draw[3]);
    return pointers;
}

static void disturb_range(const struct disturbance *by, const struct random_address *address,
                          struct reading *reading)
{
    const struct sensor *sensor = by->sensor;
    double draw[4], part = 1;
    if (!by->range)
        return;
    if (by->by_amplitude)
        part = fmin(sensor->threshold / reading->cell->amplitude, 1);
    random_gaussian(address, RANDOM_RANGE_RATE, 0, draw);
    reading->range_m = fmax(reading->range_m + part * sensor->range_sigma_m * draw[0], 0);
    reading->range_rate_mps += part * sensor->range_rate_sigma_mps * draw[1];
    if (reading->range_m != reading->cell->range_m ||
        reading->range_rate_mps != reading->cell->range_rate_mps)
        reading->effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (part != 1)
        reading->effects |= EFFECT_BIT(EFFECT_ACCURACY);
}

/* False if there is nothing to read an angle off. */
static bool measure(const struct frame *frame, const struct disturbance *by,
                    const struct cell *cell, struct reading *reading)
{
    const struct sensor *sensor = by->sensor;
    struct random_address address = runner_address(frame, sensor->name, &cell->members.items[0]);
    struct antenna_pointers pointers = disturb_pointers(by, &address, superposition_pointers(cell));
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    *reading = reading_of(cell);
    reading->azimuth_rad = angle.azimuth_rad;
    reading->amplitude = elementary_hypot(creal(pointers.sum), cimag(pointers.sum));
    reading->sign_undecided = angle.sign_undecided;
    if (by->pointers)
        reading->effects |= EFFECT_BIT(EFFECT_ANGLE_NOISE);
    disturb_range(by, &address, reading);
    if (by->steps)
        reading_round(reading, sensor);
    if (frame->margins)
        cell_margins_add_noisy(sensor, pointers, reading->amplitude, by->final_threshold,
                               &reading->margins);
    return angle.valid;
}

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    struct disturbance by = disturbance_of(sensor, selection);
    struct cell_span cells = frame_cells_of(frame, sensor->name);
    struct reading *readings = arena_get(frame->arena, (cells.count + 1) * sizeof *readings);
    size_t count = 0;
    for (size_t i = 0; i < cells.count; i++) {
        const struct cell *cell = &cells.items[i];
        struct reading *reading = &readings[count];
        bool has_angle = measure(frame, &by, cell, reading);
        if (by.final_threshold && reading->amplitude < sensor->threshold)
            frame_lose_cell(frame, "noise", cell, LOSS_BELOW_FINAL,
                            units_shortfall_db(sensor->threshold, reading->amplitude),
                            &reading->margins);
        else if (!has_angle)
            frame_lose_cell(frame, "noise", cell, LOSS_NO_ANGLE, 0, &reading->margins);
        else
            count++;
    }
    readings_list(frame, "noise", sensor, readings, count, by.list_limit);
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
