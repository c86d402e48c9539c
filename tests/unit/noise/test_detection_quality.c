#include "support/effect_bench.h"

#include "noise/detection_quality.h"
#include "support/array_sensor.h"

static struct contributor parts[] = {
    {.id = {.object = "a", .reflector = "r"}, .range_rate_mps = -40, .weight = 0.4},
    {.id = {.object = "a", .reflector = "r"}, .range_rate_mps = -60, .weight = 0.6},
    {.id = {.object = "a", .reflector = "s"}},
    {.id = {.object = "b", .reflector = "r"}},
};

struct detection {
    struct cell cell;
    struct effect_measurement measurement;
    struct detection_source source;
    size_t first_part, part_count; /* of its label */
};

/* A detection of amplitude 40 at 20 m, 30 degrees to the left, over noise of 1. */
static struct detection detect(struct effect_bench *bench)
{
    bench->sensor.pointer_sigma = 1;
    return (struct detection){.measurement = {.range_m = 20,
                                              .azimuth_rad = PI / 6,
                                              .range_rate_mps = -4,
                                              .amplitude = 40},
                              .part_count = 1};
}

static struct quality quality_of(struct effect_bench *bench, struct detection *detection)
{
    struct effect_measurement *measurement = &detection->measurement;
    struct target target = {.sensor = "radar",
                            .range_m = measurement->range_m,
                            .azimuth_rad = measurement->azimuth_rad,
                            .range_rate_mps = measurement->range_rate_mps};
    target.contributors.items = parts + detection->first_part;
    target.contributors.count = detection->part_count;
    measurement->cell = &detection->cell;
    struct detection_source whole = detection_quality_source(
        &bench->sensor, (struct cell_span){&detection->cell, 1}, detection->source.scan);
    whole.range_rate_interval_mps = detection->source.range_rate_interval_mps;
    return detection_quality_of(&whole, measurement, &target, &bench->frame);
}

/* The bench's amplitude is ERCS A_phi (10 m/R)^2, so 40 at 20 m is that of an ERCS of 160/A_phi.
 * At 30 degrees u is pi/4 and A_phi is si(u) cos 30 cos u, 0.551329 (MODEL 7.1). */
EFFECT_TEST(strength_is_over_noise_and_over_a_reflector_of_ten_square_metres)
{
    struct detection detection = detect(bench);
    struct quality quality = quality_of(bench, &detection);
    assert_close(quality.snr_db, 32.0412, 6e-4);
    assert_close(quality.rcs_dbsm, 10 + 20 * log10(160 / 0.5513288954), 6e-4);
    detection.cell.interference = 9;
    quality = quality_of(bench, &detection);
    assert_close(quality.snr_db, 22.0412, 6e-4);
    bench->sensor.pointer_sigma = 0;
    quality = quality_of(bench, &detection);
    assert_int_equal(quality.present & QUALITY_NOISE, 0);
}

EFFECT_TEST(beyond_the_antennas_table_the_strength_is_that_at_the_border_of_the_view)
{
    static const struct antenna_row rows[] = {{-1, 0.5, -0.5}, {0, 1, 0}, {1, 0.5, 0.5}};
    bench->sensor.antenna =
        (struct antenna){.pattern = ANTENNA_TABLE, .rows = rows, .row_count = COUNT(rows)};
    bench->sensor.field_of_view_rad = 1.6;
    for (int side = -1; side <= 1; side += 2) {
        struct detection at_border = detect(bench), beyond = detect(bench);
        at_border.measurement.azimuth_rad = side * 0.8;
        beyond.measurement.azimuth_rad = side * 1.01;
        struct quality expected = quality_of(bench, &at_border);
        struct quality quality = quality_of(bench, &beyond);
        assert_int_equal(quality.present & QUALITY_RCS, QUALITY_RCS);
        assert_close(quality.rcs_dbsm, expected.rcs_dbsm, 1e-9);
    }
}

/* The ego heads north at 20 m/s and turns left at 0.1 rad/s; the sensor is 2 m ahead and 1 m to the
 * left, and looks left by 30 degrees, so that the sight is at 60 degrees from the heading. */
EFFECT_TEST(places_are_in_four_frames_and_the_rate_is_less_the_sensors_own)
{
    bench->frame.objects.items[0] = (struct object){.id = "ego",
                                                    .class = "car",
                                                    .x_m = 100,
                                                    .y_m = 50,
                                                    .yaw_rad = PI / 2,
                                                    .vy_mps = 20,
                                                    .yaw_rate_radps = 0.1,
                                                    .length_m = 9};
    bench->frame.sensors.list.items[0] = (struct sensor_view){
        .name = "radar", .mount_x_m = 2, .mount_y_m = 1, .mount_yaw_rad = PI / 6, .measured = true};
    struct detection detection = detect(bench);
    struct quality quality = quality_of(bench, &detection);
    double root = sqrt(3);
    assert_close(quality.x_sensor_m, 10 * root, 5.1e-5);
    assert_close(quality.y_sensor_m, 10, 5.1e-5);
    assert_close(quality.x_centre_m, 12, 5.1e-5);
    assert_close(quality.y_centre_m, 1 + 10 * root, 5.1e-5);
    assert_close(quality.x_rear_axle_m, 12 + 2.5, 5.1e-5);
    assert_close(quality.y_rear_axle_m, 1 + 10 * root, 5.1e-5);
    assert_close(quality.x_world_m, 100 - 1 - 10 * root, 5.1e-5);
    assert_close(quality.y_world_m, 50 + 12, 5.1e-5);
    /* The mount moves forward at 20 - 0.1 and to the left at 0.2 m/s. */
    assert_close(quality.range_rate_over_ground_mps, -4 + 19.9 / 2 + 0.2 * root / 2, 5.1e-5);
    *list_add(&bench->frame.vehicles, check_arena()) =
        (struct class_document){.class = "car", .rear_axle_x_m = -1.5};
    quality = quality_of(bench, &detection);
    assert_close(quality.x_rear_axle_m, 13.5, 5.1e-5);
}

/* Half a second before, the ego was 10 m further south. */
EFFECT_TEST(places_are_those_of_the_instant_that_the_scan_shows)
{
    bench->frame.objects.items[0] =
        (struct object){.id = "ego", .class = "car", .yaw_rad = PI / 2, .vy_mps = 20};
    bench->frame.sensors.list.items[0].age_s = 0.5;
    struct detection detection = detect(bench);
    struct quality quality = quality_of(bench, &detection);
    assert_close(quality.x_world_m, -10, 5.1e-5);
    assert_close(quality.y_world_m, -10 + 10 * sqrt(3), 5.1e-5);
}

/* -60 m/s that reads -4 is off by -56 m/s, two intervals of 28; the strongest part decides. */
EFFECT_TEST(the_label_tells_folds_and_merged_echoes)
{
    struct detection detection = detect(bench);
    detection.source.range_rate_interval_mps = 28;
    detection.part_count = 2;
    struct quality quality = quality_of(bench, &detection);
    assert_int_equal(quality.ambiguity_number, -2);
    assert_close(quality.range_rate_interval_mps, 28, 0);
    assert_true(!quality.merged_objects && !quality.merged_reflectors);
    detection.first_part = 1;
    quality = quality_of(bench, &detection);
    assert_true(!quality.merged_objects && quality.merged_reflectors);
    detection.part_count = 3;
    quality = quality_of(bench, &detection);
    assert_true(quality.merged_objects && quality.merged_reflectors);
    detection.source.range_rate_interval_mps = 0;
    quality = quality_of(bench, &detection);
    assert_int_equal(quality.present & QUALITY_FOLDS, 0);
}

static struct effect_measurement estimated(struct effect_bench *bench,
                                           struct detection_source *source, double amplitude,
                                           uint64_t effects)
{
    struct detection detection = detect(bench);
    struct effect_measurement measurement = detection.measurement;
    measurement.cell = &detection.cell;
    measurement.amplitude = amplitude;
    struct effect_scan scan = effect_bench_begin(bench, effects, EFFECT_HOME_NOISE);
    *source = (struct detection_source){
        .sensor = &bench->sensor, .scan = &scan, .noise = 1, .existence.rise = 1};
    detection_quality_estimate(source, true, &measurement, 1);
    measurement.cell = NULL;
    source->scan = NULL;
    return measurement;
}

/* An amplitude of sqrt(101) over noise of 1 is that of an echo of power 100: range and rate have a
 * tenth of their factor, 0.5 cells. At 30 degrees an azimuth has sqrt 2/pi over the amplitude,
 * sqrt(1 + tan^2 45) and cos 30 (MODEL 14.21). */
EFFECT_TEST(standard_deviations_follow_the_amplitude_that_was_measured)
{
    struct sensor *sensor = &bench->sensor;
    struct detection_source source;
    sensor->sigma_law = SIGMA_BY_SNR;
    sensor->window_factor = 0.5;
    sensor->cell_range_m = 2;
    sensor->cell_range_rate_mps = 0.4;
    struct effect_measurement known = estimated(bench, &source, sqrt(101), EVERY_EFFECT);
    assert_near(known.range_sigma_m, 0.1, 1e-12);
    assert_near(known.range_rate_sigma_mps, 0.02, 1e-12);
    double azimuth = sqrt(2) / PI / sqrt(101) / (sqrt(2) * cos(PI / 6));
    assert_near(known.azimuth_sigma_rad, azimuth, 1e-6);
    sensor->azimuth_floor_rad = 0.05;
    known = estimated(bench, &source, sqrt(101), EVERY_EFFECT);
    assert_near(known.azimuth_sigma_rad, sqrt(azimuth * azimuth + 0.0025), 1e-6);
    /* Weaker than the noise: anywhere in the cell, and in the view of 90 degrees. */
    known = estimated(bench, &source, 0.1, EVERY_EFFECT);
    assert_near(known.range_sigma_m, 2 / sqrt(12), 1e-12);
    assert_near(known.azimuth_sigma_rad, PI / 2 / sqrt(12), 1e-12);
    /* At least a share of the range, 20 m, which no cell bounds. */
    sensor->range_sigma_share = 0.05;
    known = estimated(bench, &source, 0.1, EVERY_EFFECT);
    assert_near(known.range_sigma_m, 1.0, 1e-12);
}

/* 0.3 at a threshold of 2 is 0.06 at 10, and 0.1 with the floor. */
EFFECT_TEST(the_deviation_of_the_elevation_is_by_the_amplitude_and_only_where_it_is_measured)
{
    struct sensor *sensor = &bench->sensor;
    struct detection_source source;
    struct detection detection = detect(bench);
    assert_int_equal(quality_of(bench, &detection).present & QUALITY_ELEVATION, 0);
    sensor->threshold_db = units_amplitude_db(2);
    sensor->elevation_view_rad = 1;
    sensor->elevation_sigma_rad = 0.3;
    sensor->elevation_floor_rad = 0.08;
    sensor->elevation_step_rad = 0.12;
    detection.measurement = estimated(bench, &source, 10, EVERY_EFFECT);
    assert_near(detection.measurement.elevation_sigma_rad, 0.1, 1e-12);
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    detection.source.scan = &scan;
    struct quality quality = quality_of(bench, &detection);
    assert_int_equal(quality.present & QUALITY_ELEVATION, QUALITY_ELEVATION);
    assert_near(quality.elevation_sd_rad, sqrt(0.01 + 0.0144 / 12), 1e-12);
}

/* A real delta/sum of 0.1 is 0.1 · 100/sqrt(1.01/2) standard deviations from that of one echo. */
EFFECT_TEST(an_azimuth_of_several_echoes_has_a_wider_deviation)
{
    struct detection detection = detect(bench);
    struct effect_measurement alone = detection.measurement, several;
    alone.cell = &detection.cell;
    alone.amplitude = 100;
    alone.pointers.sum = 100;
    several = alone;
    several.pointers.delta = 10;
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct detection_source source = {
        .sensor = &bench->sensor, .scan = &scan, .noise = 1, .existence.rise = 1};
    detection_quality_estimate(&source, true, &alone, 1);
    detection_quality_estimate(&source, true, &several, 1);
    assert_true(!alone.looks_merged && several.looks_merged);
    assert_near(several.azimuth_sigma_rad / alone.azimuth_sigma_rad,
                sqrt(1 + 100 * 100 / (1.01 / 2) * 0.01), 1e-9);
}

/* 8 elements without a taper: noise of RMS 1 in a beam leaves 7 beside it, with a deviation of
 * sqrt(8). */
EFFECT_TEST(an_azimuth_of_a_beam_with_others_in_its_cell_has_a_wider_deviation)
{
    struct detection detection = detect(bench);
    bench->sensor.beams = array_row(8, 0.5, TAPER_RECTANGULAR);
    struct array_maximum beam = {.amplitude = 100, .sigma = 0.001, .others = 7 + 2.99 * sqrt(8)};
    detection.cell.beam = &beam;
    detection.measurement.cell = &detection.cell;
    struct effect_measurement alone = detection.measurement, several = alone;
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct detection_source source = {
        .sensor = &bench->sensor, .scan = &scan, .noise = 1, .existence.rise = 1};
    detection_quality_estimate(&source, true, &alone, 1);
    assert_true(!alone.looks_merged);
    assert_near(alone.azimuth_sigma_rad, 0.001 / cos(PI / 6), 1e-12);
    beam.others = 7 + 24;
    detection_quality_estimate(&source, true, &several, 1);
    assert_true(several.looks_merged);
    assert_near(several.azimuth_sigma_rad, 5 * 0.001 / cos(PI / 6), 1e-12);
}

EFFECT_TEST(noise_that_is_not_simulated_has_no_deviation)
{
    struct sensor *sensor = &bench->sensor;
    struct detection_source source;
    sensor->range_sigma_m = 0.1;
    sensor->range_rate_sigma_mps = 0.2;
    sensor->sigma_law = SIGMA_BY_AMPLITUDE;
    sensor->threshold_db = units_amplitude_db(3);
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_ANGLE_NOISE);
    struct effect_measurement known = estimated(bench, &source, 30, without);
    assert_near(known.range_sigma_m, 0.01, 1e-12);
    assert_close(known.azimuth_sigma_rad, 0, 0);
    known = estimated(bench, &source, 30, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_ACCURACY));
    assert_close(known.range_rate_sigma_mps, 0.2, 0);
    known = estimated(bench, &source, 30, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_RANGE_NOISE));
    assert_close(known.range_sigma_m, 0, 0);
}

EFFECT_TEST(false_alarms_are_expected_where_they_are_made)
{
    struct sensor *sensor = &bench->sensor;
    struct detection_source source;
    sensor->false_alarms = 0.5;
    sensor->final_threshold = true;
    sensor->threshold_db = units_amplitude_db(3);
    estimated(bench, &source, 30, EVERY_EFFECT);
    assert_close(source.existence.false_alarms, 0.5, 0);
    assert_close(source.existence.least_false_alarm, 9, 1e-12);
    assert_close(source.existence.least_echo, 9, 1e-12);
    estimated(bench, &source, 30, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_FALSE_ALARMS));
    assert_close(source.existence.false_alarms, 0, 0);
}

/* Lowered by 1.75 of the noise's RMS, from 3 to 1.25, or from 1.5 to nothing. */
EFFECT_TEST(the_first_threshold_is_that_of_the_sensor)
{
    struct sensor *sensor = &bench->sensor;
    struct detection_source source;
    sensor->final_threshold = true;
    sensor->threshold_db = units_amplitude_db(3);
    estimated(bench, &source, 30, EVERY_EFFECT);
    assert_close(source.existence.first_threshold, 1.25 * 1.25, 1e-12);
    estimated(bench, &source, 30, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_FINAL_THRESHOLD));
    assert_close(source.existence.first_threshold, 9, 1e-12);
    sensor->first_threshold = FIRST_FULL;
    estimated(bench, &source, 30, EVERY_EFFECT);
    assert_close(source.existence.first_threshold, 9, 1e-12);
    sensor->first_threshold = FIRST_LOWERED;
    sensor->threshold_db = units_amplitude_db(1.5);
    estimated(bench, &source, 30, EVERY_EFFECT);
    assert_close(source.existence.first_threshold, 0, 0);
}

EFFECT_TEST(rounding_adds_its_own_deviation)
{
    struct sensor *sensor = &bench->sensor;
    sensor->range_step_m = 0.2;
    struct detection detection = detect(bench);
    detection.measurement.range_sigma_m = 0.1;
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    detection.source.scan = &scan;
    struct quality quality = quality_of(bench, &detection);
    assert_near(quality.range_sd_m, sqrt(0.01 + 0.04 / 12), 1e-12);
    detection.source.scan = NULL;
    quality = quality_of(bench, &detection);
    assert_near(quality.range_sd_m, 0.1, 1e-12);
}
