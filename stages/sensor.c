/* The sensor before noise: the amplitude of every echo (MODEL 4), echoes of moving parts and of the
 * ground (14), resolution cells (6), the threshold on a cell's summed amplitude, and its superposed
 * sum and delta pointers (7, 8). */
#include "run/suite_choice.h"
#include "sensor/resolution_cell.h"
#include "sensor/scan.h"

/* Makes the cell of these received echoes. False if it has no angle. */
static bool superpose(const struct scan *scan, const struct selection *selection,
                      const struct received_echo *members, size_t count, struct cell *cell)
{
    const struct sensor *sensor = scan->context.sensor;
    bool superposed = effects_forced(selection, EFFECT_SUPERPOSITION) ||
                      (effects_enabled(selection, EFFECT_SUPERPOSITION) && count > 1);
    bool has_angle =
        resolution_cell_of(sensor, members, count, superposed, scan->context.frame->arena, cell);
    effects_note(selection, EFFECT_SUPERPOSITION, superposed);
    return has_angle;
}

/* Lists the cell in the frame, or loses it. */
static void report(struct frame *frame, const struct scan *scan, const struct selection *selection,
                   const struct margins *margins, size_t number)
{
    struct cell cell;
    size_t count;
    const struct received_echo *members = scan_members(scan, number, &count);
    bool has_angle = superpose(scan, selection, members, count, &cell);
    if (margins != NULL)
        cell.margins = margins[number];
    resolution_cell_list(frame, "sensor", &scan->context, selection, &cell, has_angle);
}

static void sense(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection)
{
    struct effect_scan context = effect_begin(frame, sensor, selection, EFFECT_HOME_SENSOR);
    struct scan scan = scan_make(&context, selection);
    effects_note(selection, EFFECT_SUPERPOSITION, false);
    effects_note(selection, EFFECT_THRESHOLD, true);
    scan_account(&scan, frame, "sensor");
    const struct margins *margins =
        frame_carries(frame, CARRY_MARGINS)
            ? resolution_cell_margins(sensor, &scan.received, scan.cells, frame->arena)
            : NULL;
    for (size_t number = 0; number < scan.cells; number++)
        report(frame, &scan, selection, margins, number);
}

const struct stage stage_sensor = {
    .name = "sensor",
    .summary = "Merge echoes into resolution cells and superpose their antenna pointers.",
    .details =
        "Gives every echo its amplitude, adds echoes of wheels, limbs and clutter, puts echoes\n"
        "that the radar cannot resolve into one cell, loses cells whose summed amplitude is\n"
        "below the first threshold, and writes the pointers of the other cells in the sum and\n"
        "delta channels, without noise.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_ECHOES,
    .writes = PART_CELLS | PART_LOST | PART_COUNTS,
    .step = suite_choice_step,
    .visit = sense,
    .locate_fault = suite_choice_locate_fault,
};
