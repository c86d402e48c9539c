/* A perfect sensor: every echo becomes an exact cell. None merge, and none is too weak. */
#include "run/suite_choice.h"
#include "sensor/resolution_cell.h"

static void make_cell(struct frame *frame, const struct sensor *sensor, const struct echo *echo)
{
    struct received_echo received = received_echo_in_free_space(sensor, echo, 0);
    struct cell cell;
    if (!(received.amplitude > 0)) {
        struct lost_echo lost = frame_lost_echo(&received.echo, &echo->margins);
        frame_lose(frame, "sensor-perfect", sensor->name, LOSS_NO_AMPLITUDE, &lost);
        return;
    }
    resolution_cell_of(sensor, &received, 1, true, frame->arena, &cell);
    cell.azimuth_rad = echo->azimuth_rad;
    cell.sign_undecided = false;
    cell.margins = echo->margins;
    *list_add(&frame->cells, frame->arena) = cell;
}

static void sense(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection)
{
    (void)selection;
    struct echo_span echoes = frame_echoes_of(frame, sensor->name);
    for (size_t i = 0; i < echoes.count; i++)
        make_cell(frame, sensor, &echoes.items[i]);
}

const struct stage stage_sensor_perfect = {
    .name = "sensor-perfect",
    .summary = "Make one exact cell of every echo.",
    .details =
        "Stands in for glint-sensor: nothing merges, no threshold is applied, range, azimuth\n"
        "and range rate are exact. An echo of zero amplitude is lost. The sensor's other\n"
        "effects are left out too: wheels, limbs, clutter, road, weather, fluctuation.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_ECHOES,
    .writes = PART_CELLS | PART_LOST,
    .step = suite_choice_step,
    .visit = sense,
    .locate_fault = suite_choice_locate_fault,
};
