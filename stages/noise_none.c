/* No noise: the target list of the cells as they are. */
#include "readings.h"
#include "stage.h"

static int noise_none_step(void *state, struct frame *frame, struct runner *runner)
{
    const struct suite_choice *choice = state;
    const struct suite *suite = runner_suite(runner, frame, choice->sensors);
    for (size_t i = 0; suite != NULL && i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        struct cell_span cells = frame_cells_of(frame, sensor->name);
        struct reading *readings = arena_get(frame->arena, cells.count * sizeof *readings);
        for (size_t j = 0; j < cells.count; j++)
            readings[j] = reading_of(&cells.items[j]);
        readings_list(frame, "noise-none", sensor, readings, cells.count, 0);
    }
    return suite != NULL ? 0 : -1;
}

const struct stage stage_noise_none = {
    .name = "noise-none",
    .summary = "Write the cells as targets, without noise.",
    .details = "Stands in for glint-noise: every cell becomes a target with the cell's own range,\n"
               "azimuth and range rate. No threshold and no list limit is applied; a cell of zero\n"
               "amplitude is lost.",
    .options = &suite_choice_record,
    .reads = SECTION_SENSORS | SECTION_CELLS,
    .writes = SECTION_TARGETS | SECTION_LOST,
    .step = noise_none_step,
};
