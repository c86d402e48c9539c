/* The sensor as a windowed range-Doppler transform shows it: every echo is smeared over the bins
 * around it, and cells are the peaks of the sum of all (MODEL 6.1). */
#include "run/suite_choice.h"
#include "sensor/resolution_cell.h"
#include "sensor/scan.h"
#include "sensor/smear.h"

/* Lists the cell in the frame, or loses it. */
static void report(struct frame *frame, const struct effect_scan *scan,
                   const struct selection *selection, const struct smear *smear, size_t number)
{
    struct cell cell;
    bool has_angle = smear_cell(smear, number, frame->arena, &cell);
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number)
            margins_merge(&cell.margins, smear->echoes[i].margins);
    resolution_cell_list(frame, "sensor-smear", scan, selection, &cell, has_angle);
}

/* With merging left out, every received echo has a transform of its own. */
static void sense(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection)
{
    struct effect_scan context = effect_begin(frame, sensor, selection, EFFECT_HOME_SENSOR);
    struct scan scan = scan_receive(&context);
    bool merge = effects_enabled(selection, EFFECT_MERGING);
    size_t count = scan.received.count, together = merge ? count : 1;
    effects_note(selection, EFFECT_MERGING, merge);
    effects_note(selection, EFFECT_SUPERPOSITION, merge);
    effects_note(selection, EFFECT_THRESHOLD, true);
    scan_account(&scan, frame, "sensor-smear");
    for (size_t first = 0; first < count; first += together) {
        struct smear smear =
            smear_make(sensor, &scan.received.echoes[first], together, frame->arena);
        for (size_t number = 0; number < smear.cells; number++)
            report(frame, &context, selection, &smear, number);
    }
}

const struct stage stage_sensor_smear = {
    .name = "sensor-smear",
    .summary = "Smear echoes over range and Doppler bins and make cells of the peaks.",
    .details =
        "Stands in for glint-sensor. Instead of sorting echoes into cells, it computes the bins "
        "of a range-Doppler transform with a Hann window; a bin is as wide as the sensor's cell. "
        "Every echo is spread over the bins around it with its phase, amplitude and antenna "
        "pointers. The way uphill from an echo ends at a peak of the sum, which becomes a cell. "
        "Its "
        "range, rate and amplitude are interpolated between bins; its angle is that of the sum and "
        "the delta channel. A peak below the first threshold is lost; a peak of side lobes "
        "alone is not listed. So echoes merge gradually and shift each other's peaks, apart if "
        "they are out of phase; cell_phase sets their phases. Merging and superposition are one "
        "effect here: with --effects=-merging every echo is a cell of its own.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_ECHOES,
    .writes = PART_CELLS | PART_LOST | PART_COUNTS,
    .step = suite_choice_step,
    .visit = sense,
    .locate_fault = suite_choice_locate_fault,
};
