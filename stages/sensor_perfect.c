/* A perfect sensor: one exact cell per visible echo. Nothing merges and nothing is too weak. */
#include "stage.h"
#include "superposition.h"

static void sense(struct frame *frame, const struct sensor *sensor, const struct echo *echo)
{
    struct ray ray = superposition_ray(sensor, echo, 0);
    struct cell cell;
    if (!(ray.amplitude > 0)) {
        frame_lose_echo(frame, "sensor-perfect", echo, LOSS_NO_AMPLITUDE);
        return;
    }
    superposition_cell(sensor, &ray, 1, frame->arena, &cell);
    cell.azimuth_rad = echo->azimuth_rad;
    cell.sign_undecided = false;
    *list_add(&frame->cells, frame->arena) = cell;
}

static int sensor_perfect_step(void *state, struct frame *frame, struct runner *runner)
{
    const struct suite_choice *choice = state;
    const struct suite *suite = runner_suite(runner, frame, choice->sensors);
    for (size_t i = 0; suite != NULL && i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        struct echo_span echoes = frame_echoes_of(frame, sensor->name);
        for (size_t j = 0; j < echoes.count; j++)
            sense(frame, sensor, &echoes.items[j]);
    }
    return suite != NULL ? 0 : -1;
}

const struct stage stage_sensor_perfect = {
    .name = "sensor-perfect",
    .summary = "Make one exact cell of every echo.",
    .details =
        "Stands in for glint-sensor: nothing merges, no threshold is applied, range, azimuth\n"
        "and range rate are exact. An echo of zero amplitude is lost.",
    .options = &suite_choice_record,
    .reads = SECTION_SENSORS | SECTION_ECHOES,
    .writes = SECTION_CELLS | SECTION_LOST,
    .step = sensor_perfect_step,
};
