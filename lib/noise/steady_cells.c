#include "noise/steady_cells.h"

#include "base/units.h"
#include "radar/interferer.h"

/* Adds the cell to the list, or loses it. Cells have a margin of the threshold only if the sensor
 * has tested them. */
static void decide(struct frame *frame, const char *stage, const struct sensor *sensor,
                   struct cell cell, struct cell *list, size_t *count)
{
    double threshold = interferer_threshold(sensor->threshold, cell.interference);
    if ((cell.margins.present & MARGIN_THRESHOLD) != 0)
        margins_note(&cell.margins, MARGIN_THRESHOLD,
                     margins_between_db(cell.amplitude, threshold));
    if (cell.below_threshold)
        frame_lose_cell(frame, stage, &cell, LOSS_BELOW_THRESHOLD,
                        units_shortfall_db(threshold, cell.amplitude), &cell.margins);
    else
        list[(*count)++] = cell;
}

struct cell_span steady_cells_of(struct frame *frame, const char *stage,
                                 const struct sensor *sensor)
{
    struct cell_span cells = frame_cells_of(frame, sensor->name);
    if (sensor->lowered_threshold == sensor->threshold)
        return cells;
    struct cell *steady = arena_get(frame->arena, cells.count * sizeof *steady);
    size_t count = 0;
    for (size_t i = 0; i < cells.count; i++)
        decide(frame, stage, sensor, cells.items[i], steady, &count);
    return (struct cell_span){steady, count};
}
