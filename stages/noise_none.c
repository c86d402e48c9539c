/* No noise: the cells become targets as they are. */
#include "noise/beam_cells.h"
#include "noise/steady_cells.h"
#include "noise/target_list.h"
#include "run/suite_choice.h"

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    (void)selection;
    struct cell_span steady = steady_cells_of(frame, "noise-none", sensor);
    struct cell_span cells = beam_cells_of(frame, "noise-none", sensor, NULL, steady);
    struct effect_measurement *measurements =
        arena_get(frame->arena, cells.count * sizeof *measurements);
    for (size_t i = 0; i < cells.count; i++)
        measurements[i] = effect_measurement_of(NULL, &cells.items[i]);
    struct detection_source source = detection_quality_source(sensor, cells, NULL);
    target_list_make(frame, "noise-none", &source, measurements, cells.count);
}

const struct stage stage_noise_none = {
    .name = "noise-none",
    .summary = "Write the cells as targets, without noise.",
    .details =
        "Stands in for glint-noise: every cell becomes a target with the cell's own range,\n"
        "azimuth, elevation and range rate. No list limit is applied, nothing is rounded or\n"
        "misaligned, and there are no false alarms. A cell is lost if its amplitude is zero\n"
        "or if glint-sensor found it below the threshold.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_CELLS,
    .writes = PART_TARGETS | PART_LOST | PART_VISIBILITY,
    .step = suite_choice_step,
    .visit = list_targets,
    .locate_fault = suite_choice_locate_fault,
};
