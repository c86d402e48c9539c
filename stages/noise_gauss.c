/* The textbook sensor: independent Gaussian noise on range, angles and range rate. */
#include "base/elementary.h"
#include "base/random.h"
#include "base/units.h"
#include "frame/frame.h"
#include "noise/beam_cells.h"
#include "noise/steady_cells.h"
#include "noise/target_list.h"
#include "run/suite_choice.h"

static void add_elevation_noise(const struct sensor *sensor, const struct random_address *address,
                                struct effect_measurement *measurement)
{
    double draw[2], sigma_rad = sensor->elevation_sigma_rad;
    random_gaussian_pair(address, RANDOM_ELEVATION, 0, draw);
    double elevation_rad = measurement->elevation_rad + sigma_rad * draw[0];
    measurement->elevation_rad = elementary_max(elementary_min(elevation_rad, PI / 2), -PI / 2);
    measurement->elevation_sigma_rad = sigma_rad;
}

static struct effect_measurement measure(const struct frame *frame, const struct sensor *sensor,
                                         const struct cell *cell)
{
    struct random_address address =
        frame_draw_address_of(frame, sensor->name, cell->members.items[0].id);
    double range_and_rate[2], azimuth[2];
    random_gaussian_pair(&address, RANDOM_RANGE_RATE, 0, range_and_rate);
    random_gaussian_pair(&address, RANDOM_AZIMUTH, 0, azimuth);
    struct effect_measurement measurement = effect_measurement_of(NULL, cell);
    measurement.range_sigma_m =
        suite_range_sigma_m(sensor, measurement.range_m, sensor->range_sigma_m);
    measurement.range_m =
        elementary_max(measurement.range_m + measurement.range_sigma_m * range_and_rate[0], 0);
    measurement.range_rate_mps += sensor->range_rate_sigma_mps * range_and_rate[1];
    measurement.azimuth_rad =
        units_wrap_rad(measurement.azimuth_rad + sensor->azimuth_sigma_rad * azimuth[0]);
    if (sensor->elevation_view_rad > 0)
        add_elevation_noise(sensor, &address, &measurement);
    measurement.range_rate_sigma_mps = sensor->range_rate_sigma_mps;
    measurement.azimuth_sigma_rad = sensor->azimuth_sigma_rad;
    return measurement;
}

static void list_targets(struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection)
{
    (void)selection;
    struct cell_span steady = steady_cells_of(frame, "noise-gauss", sensor);
    struct cell_span cells = beam_cells_of(frame, "noise-gauss", sensor, NULL, steady);
    struct effect_measurement *measurements =
        arena_get(frame->arena, cells.count * sizeof *measurements);
    for (size_t i = 0; i < cells.count; i++)
        measurements[i] = measure(frame, sensor, &cells.items[i]);
    struct detection_source source = detection_quality_source(sensor, cells, NULL);
    target_list_make(frame, "noise-gauss", &source, measurements, cells.count);
}

const struct stage stage_noise_gauss = {
    .name = "noise-gauss",
    .summary = "Add independent Gaussian noise to range, angles and range rate.",
    .details =
        "Stands in for glint-noise: every cell becomes a target; its range, azimuth, elevation\n"
        "and range rate get noise of the sensor's range_sigma_m, or its range_sigma_share of\n"
        "the range where that is larger, azimuth_sigma_rad, elevation_sigma_rad and\n"
        "range_rate_sigma_mps, whatever its sigma_law. No list limit is applied, nothing is\n"
        "rounded or misaligned, and there are no false alarms. A cell is lost if its\n"
        "amplitude is zero or if glint-sensor found it below the threshold. A range below zero\n"
        "is reported as zero.",
    .options = &suite_choice_record,
    .reads = PART_SENSORS | PART_CELLS,
    .writes = PART_TARGETS | PART_LOST | PART_VISIBILITY,
    .step = suite_choice_step,
    .visit = list_targets,
    .locate_fault = suite_choice_locate_fault,
};
