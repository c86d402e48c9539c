#include "check.h"

#include "base/units.h"
#include "documents/consistency.h"
#include "documents/suite_file.h"
#include "frame/effects.h"
#include "run/datasheet.h"

/* A steady sensor of the paper's antenna without noise. */
static struct sensor quiet_sensor(void)
{
    struct sensor sensor = {
        .name = "front",
        .carrier_hz = SPEED_OF_LIGHT_MPS / 0.004, /* a wavelength of 4 mm */
        .range_min_m = 1,
        .range_max_m = 100,
        .field_of_view_rad = 120 * DEGREE,
        .threshold_db = 6,
        .calibration_ercs = 1, /* 10 dBsm */
        .calibration_range_m = 50,
        .exponent = 2,
        .range_floor_m = 0.5,
        .cell_range_m = 1,
        .cell_range_rate_mps = 0.1, /* a dwell of 20 ms */
        .angle_estimator = MONOPULSE_RATIO,
        .range_sigma_m = 0.1,
        .range_rate_sigma_mps = 0.01,
        .false_alarm_range_rate_mps = 70,
    };
    return sensor;
}

static const struct consistency *check_of(const struct sensor *sensor, const char *left)
{
    static struct consistency checks[CONSISTENCY_MOST];
    struct sensor derived = *sensor;
    suite_derive(&derived);
    size_t count = consistency_list(&derived, checks);
    assert_true(count <= CONSISTENCY_MOST);
    for (size_t i = 0; i < count; i++)
        if (strncmp(checks[i].left, left, strlen(left)) == 0)
            return &checks[i];
    return NULL;
}

/* Every check with figures that just agree, and the same a little off. */
TEST(checks_tell_figures_that_agree_from_those_that_do_not)
{
    struct sensor good = quiet_sensor();
    good.cycle_s = 0.0201;
    good.unambiguous_rate_mps = 50; /* a repetition of 20 us, a walk of 1 m */
    good.unambiguous_range_m = 100.1;
    good.chirp_s = 20e-6;
    good.chirp_slope_hzps = -1e3 * SPEED_OF_LIGHT_MPS * 26; /* a sweep of 0.9615 m */
    good.receiver_bandwidth_hz = 2 * 100.05 * 26e3; /* beats of 26 kHz a metre, there and back */
    good.latency_s = 0.0101;
    good.range_sigma_m = 0.2886;
    good.range_rate_sigma_mps = 0.02886;
    good.sigma_law = SIGMA_BY_SNR;
    good.window_factor = 0.39;
    good.azimuth_cell_rad = 46 * DEGREE;
    good.azimuth_floor_rad = 13.2 * DEGREE;
    good.elevation_view_rad = 1;
    good.elevation_sigma_rad = 0.2886;
    good.false_alarms = 0.01;
    good.false_alarm_range_rate_mps = 49.9;
    /* 99 ranges, 998 rates, 120/46 azimuths. */
    double cells = 99 * 998 * 120 / 46.0;
    good.pointer_sigma = units_amplitude_from_db(6) / sqrt(log(cells / 0.0099));
    struct sensor bad[15];
    for (size_t i = 0; i < COUNT(bad); i++)
        bad[i] = good;
    bad[0].cycle_s = 0.0199;
    bad[1].receiver_bandwidth_hz = 2 * 99.9 * 26e3;
    bad[2].false_alarm_range_rate_mps = 50.1;
    bad[3].chirp_slope_hzps *= 0.95;
    bad[4].chirp_s = 20.1e-6;
    bad[5].unambiguous_range_m = 99.9;
    bad[6].receiver_bandwidth_hz = 2 * 100.2 * 26e3;
    bad[7].unambiguous_rate_mps = 50.1;
    bad[8].latency_s = 0.0099;
    bad[9].false_alarms = 0.0098;
    bad[10].range_sigma_m = 0.2888;
    bad[11].range_rate_sigma_mps = 0.02888;
    bad[12].azimuth_cell_rad = 45 * DEGREE;
    bad[13].azimuth_floor_rad = 13.3 * DEGREE;
    bad[14].elevation_sigma_rad = 0.2888;
    static const char *const names[] = {"dwell",
                                        "beat",
                                        "false alarms to",
                                        "sweep",
                                        "chirp_s",
                                        "range_max_m",
                                        "receiver_bandwidth_hz",
                                        "walk",
                                        "half a dwell",
                                        "pointer_sigma",
                                        "range_sigma_m",
                                        "range_rate_sigma_mps",
                                        "beam",
                                        "azimuth_floor_rad",
                                        "elevation_sigma_rad"};
    for (size_t i = 0; i < COUNT(bad); i++) {
        const struct consistency *check = check_of(&good, names[i]);
        assert_non_null(check);
        if (!consistency_holds(check))
            fail_msg("%s does not hold: %g, %g", names[i], check->left_value, check->right_value);
        check = check_of(&bad[i], names[i]);
        if (consistency_holds(check))
            fail_msg("%s holds: %g, %g", names[i], check->left_value, check->right_value);
    }
    assert_true(consistency_holds(check_of(&good, "Cramer-Rao")));
    good.window_factor = 0.389;
    assert_false(consistency_holds(check_of(&good, "Cramer-Rao")));
}

TEST(figures_that_a_document_leaves_out_are_not_checked)
{
    struct sensor sensor = quiet_sensor();
    struct consistency checks[CONSISTENCY_MOST];
    suite_derive(&sensor);
    /* The sigmas of range and rate. */
    assert_int_equal(consistency_list(&sensor, checks), 2);
}

TEST(half_widths_count_twice)
{
    struct sensor sensor = quiet_sensor();
    suite_derive(&sensor);
    assert_close(sensor.dwell_s, 0.02, 1e-15);
    sensor.cell_extent = CELL_HALF_WIDTH;
    suite_derive(&sensor);
    assert_close(sensor.dwell_s, 0.01, 1e-15);
}

/* A waveform's dwell is that of its bins, however wide its window makes cells. */
TEST(cells_of_a_waveform_are_as_wide_as_its_window_resolves)
{
    struct sensor sensor = quiet_sensor();
    sensor.waveform = (struct waveform){.samples = 128, .window = POINT_RESPONSE_HANN};
    suite_derive(&sensor);
    double bin_m = sensor.cell_range_m, bin_mps = sensor.cell_range_rate_mps;
    assert_near(sensor.half_range_m, 1.7748 * bin_m, 1e-6);
    assert_near(sensor.half_range_rate_mps, 1.7748 * bin_mps, 1e-6);
    assert_close(sensor.dwell_s, 0.02, 1e-15);
    sensor.waveform.window = POINT_RESPONSE_RECTANGULAR;
    suite_derive(&sensor);
    assert_near(sensor.half_range_m, 0.9967 * bin_m, 1e-6);
    sensor.waveform.kind = WAVEFORM_PULSE; /* the window is that of the repetitions */
    suite_derive(&sensor);
    assert_near(sensor.half_range_m, 0.89505 * bin_m, 1e-6);
    assert_near(sensor.half_range_rate_mps, 0.9967 * bin_mps, 1e-6);
}

TEST(a_signal_has_its_own_limits)
{
    struct sensor sensor = quiet_sensor();
    sensor.waveform = (struct waveform){.samples = 128, .repetitions = 64};
    assert_close(consistency_fold_mps(&sensor), 3.2, 1e-12);
    sensor.waveform.stagger = 4;
    assert_close(consistency_fold_mps(&sensor), 12.8, 1e-12);
    sensor.array.transmit.count = 1; /* one transmitter has no turn that tells rates apart */
    assert_close(consistency_fold_mps(&sensor), 12.8, 1e-12);
    sensor.array.transmit.count = 0;
    sensor.unambiguous_rate_mps = 12.7;
    sensor.cycle_s = 0.0451; /* 2.25 dwells of 20 ms */
    assert_true(consistency_holds(check_of(&sensor, "unambiguous_rate_mps")));
    assert_true(consistency_holds(check_of(&sensor, "dwell of both trains")));
    sensor.unambiguous_rate_mps = 12.9;
    sensor.cycle_s = 0.0449;
    assert_false(consistency_holds(check_of(&sensor, "unambiguous_rate_mps")));
    assert_false(consistency_holds(check_of(&sensor, "dwell of both trains")));
}

/* 99 ranges and 64 range rates at 1e-4, or 4 samples to a range for pulses. */
TEST(false_alarms_of_a_signal_are_those_of_its_cfar)
{
    struct sensor sensor = quiet_sensor();
    sensor.pointer_sigma = 0.1;
    sensor.false_alarms = 1;
    sensor.waveform =
        (struct waveform){.samples = 512, .repetitions = 64, .cfar_false_alarm = 1e-4};
    assert_near(check_of(&sensor, "false_alarms")->right_value, 0.6336, 1e-12);
    sensor.waveform.kind = WAVEFORM_PULSE;
    assert_near(check_of(&sensor, "false_alarms")->right_value, 4 * 0.6336, 1e-12);
}

TEST(a_walk_that_is_compensated_is_no_doubt)
{
    struct sensor sensor = quiet_sensor();
    sensor.unambiguous_rate_mps = 60;
    assert_false(consistency_holds(check_of(&sensor, "walk")));
    sensor.range_migration = MIGRATION_COMPENSATED;
    assert_null(check_of(&sensor, "walk"));
}

static struct datasheet sheet_of(struct sensor *sensor)
{
    struct datasheet sheet;
    suite_derive(sensor);
    datasheet_of(sensor, &sheet);
    return sheet;
}

/* MODEL 4.1: ranges go with the root of an ERCS, which is 1 at 10 dBsm. */
TEST(echoes_are_detected_where_they_meet_the_threshold)
{
    struct sensor sensor = quiet_sensor();
    struct datasheet sheet = sheet_of(&sensor);
    static const double boresight_m[] = {28.117066, 50, 88.913970};
    for (int k = 0; k < DATASHEET_ECHOES; k++) {
        assert_close(sheet.echo_dbsm[k], 10 * k, 0);
        for (int i = 0; i < DATASHEET_AZIMUTHS; i++) {
            double gain = antenna_gain(&sensor.antenna, i * 20 * DEGREE);
            assert_near(sheet.range_m[i][k][0], boresight_m[k] * sqrt(gain), 1e-7);
            /* Without noise, what meets the threshold is detected. */
            assert_near(sheet.range_m[i][k][1], sheet.range_m[i][k][0], 1e-6);
        }
    }
    assert_close(sheet.chance[0], 1, 0);
    /* An ERCS of (100/50)^2. */
    assert_close(sheet.weakest_dbsm, 10 + 40 * log10(2), 1e-9);
}

TEST(ranges_end_at_the_sensors_own)
{
    struct sensor sensor = quiet_sensor();
    sensor.range_max_m = 60;
    sensor.range_min_m = 30;
    struct datasheet sheet = sheet_of(&sensor);
    assert_close(sheet.range_m[0][0][0], 0, 0);
    assert_close(sheet.range_m[0][1][0], 50, 1e-9);
    assert_close(sheet.range_m[0][2][0], 60, 0);
    /* At 20 of 40 degrees half way from 50 to 32 m. */
    struct range_limit limits[] = {{0, 50}, {40 * DEGREE, 32}};
    sensor.range_limits.items = limits;
    sensor.range_limits.count = 2;
    datasheet_of(&sensor, &sheet);
    assert_close(sheet.range_m[0][2][0], 50, 0);
    assert_close(sheet.range_m[1][2][0], 41, 1e-6);
    assert_close(sheet.range_m[2][2][0], 32, 1e-6);
}

TEST(the_azimuths_of_a_view_without_a_width_are_no_less_than_0)
{
    struct sensor sensor = quiet_sensor();
    sensor.field_of_view_rad = 0;
    assert_close(copysign(1, sheet_of(&sensor).azimuth_rad[DATASHEET_AZIMUTHS - 1]), 1, 0);
}

/* At 9 in 10, a Swerling 1 echo without noise is stronger by sqrt(-1/ln 0.9). */
TEST(fluctuation_costs_range)
{
    struct sensor sensor = quiet_sensor();
    sensor.fluctuation = FLUCTUATION_SWERLING_1;
    struct datasheet sheet = sheet_of(&sensor);
    assert_close(sheet.chance[0], exp(-1), 1e-6);
    assert_near(sheet.range_m[0][1][1], 50 * pow(-log(0.9), 0.25), 1e-5);
}

/* Levels of 3, 2 and 6 dB are one of 7 dB; 9 in 10 are above its mean less 1.281552 deviations. */
TEST(levels_cost_range)
{
    struct sensor sensor = quiet_sensor();
    sensor.level_constant_db = 3;
    sensor.level_slow_db = 2;
    sensor.level_fast_db = 6;
    for (int keeps = LEVEL_KEEPS_MEAN; keeps <= LEVEL_KEEPS_MEDIAN; keeps++) {
        double mean_db = keeps == LEVEL_KEEPS_MEAN ? -log(10) / 20 * 49 : 0;
        sensor.level_keeps = (enum level_keeps)keeps;
        struct datasheet sheet = sheet_of(&sensor);
        assert_close(sheet.chance[0], erfc(-mean_db / 7 / sqrt(2)) / 2, 1e-6);
        assert_near(sheet.range_m[0][1][1], 50 * pow(10, (mean_db - 1.2815516 * 7) / 40), 1e-5);
    }
}

TEST(accuracy_follows_law_noise_and_steps)
{
    struct sensor sensor = quiet_sensor();
    sensor.pointer_sigma = units_amplitude_from_db(6 - 10);
    sensor.sigma_law = SIGMA_BY_SNR;
    sensor.window_factor = 0.5;
    sensor.range_step_m = 0.12;
    sensor.azimuth_floor_rad = 0.01;
    struct datasheet sheet = sheet_of(&sensor);
    for (int i = 0; i < DATASHEET_LEVELS; i++) {
        double snr = pow(10, 1 + i);
        assert_close(sheet.accuracy[i].snr_db, 10 * (1 + i), 1e-9);
        double noise_m = fmin(0.25 / snr + 0.01, 1.0 / 12);
        assert_near(sheet.accuracy[i].range_sigma_m, sqrt(noise_m + 0.0012), 1e-9);
        assert_near(sheet.accuracy[i].range_rate_sigma_mps,
                    sqrt(fmin(0.0025 / snr + 1e-4, 0.01 / 12)), 1e-9);
        for (int k = 0; k < DATASHEET_AZIMUTHS; k++) {
            double azimuth_rad = k * 20 * DEGREE, u = PI / 2 * sin(azimuth_rad);
            assert_near(sheet.accuracy[i].azimuth_sigma_rad[k],
                        hypot(0.01, 2 / PI * cos(u) / (cos(azimuth_rad) * sqrt(2 * snr))), 1e-6);
        }
    }
    sensor.sigma_law = SIGMA_BY_AMPLITUDE;
    sheet = sheet_of(&sensor);
    assert_near(sheet.accuracy[2].range_rate_sigma_mps, 0.001, 1e-9);
}

static const char *written(const struct suite *suite)
{
    struct text *text = check_text();
    datasheet_add(suite, text);
    text_add(text, "", 1);
    return text->bytes;
}

TEST(without_noise_rows_of_accuracy_say_how_strong_an_echo_is)
{
    struct sensor sensor = quiet_sensor();
    struct suite suite = {.sensors = {&sensor, 1, 1}};
    suite_derive(&sensor);
    const char *text = written(&suite);
    assert_non_null(strstr(text, "\n  threshold +  0 dB           0.1         0.01"));
    assert_non_null(strstr(text, "\n  threshold + 20 dB           0.1         0.01"));
    assert_null(strstr(text, "inf"));
}

TEST(a_sheet_has_limits_by_azimuth_a_span_of_rates_and_assumptions)
{
    struct sensor sensor = quiet_sensor();
    struct range_limit limits[] = {{0, 50}, {40 * DEGREE, 32}};
    const char *sentences[] = {"The list is the nearest.", "Noise is white."};
    struct suite suite = {.sensors = {&sensor, 1, 1}, .assumed = {sentences, 2, 2}};
    sensor.range_limits.items = limits;
    sensor.range_limits.count = 2;
    sensor.unambiguous_rate_mps = 80;
    sensor.unambiguous_middle_mps = 25;
    suite_derive(&sensor);
    const char *text = written(&suite);
    assert_non_null(strstr(text, "\n  range limits       50 m at 0 degrees, 32 m at 40 degrees\n"));
    assert_non_null(strstr(text, ", from -55 to 105 m/s\n"));
    assert_non_null(strstr(text, "\n\nassumed\n  The list is the nearest.\n  Noise is white.\n"));
}

TEST(a_sensor_that_measures_elevation_lacks_noise_on_it_or_states_it)
{
    struct sensor sensor = quiet_sensor();
    const struct suite suite = {.sensors = {&sensor, 1, 1}};
    suite_derive(&sensor);
    uint64_t noise = EFFECT_BIT(EFFECT_ELEVATION_NOISE);
    assert_true((datasheet_missing(&sensor) & noise) == 0);
    assert_null(strstr(written(&suite), "elevation   "));
    sensor.elevation_view_rad = PI / 6;
    assert_true((datasheet_missing(&sensor) & noise) != 0);
    sensor.elevation_sigma_rad = 4 * PI / 180;
    sensor.elevation_floor_rad = 0.3 * PI / 180;
    assert_true((datasheet_missing(&sensor) & noise) == 0);
    assert_non_null(strstr(written(&suite),
                           "\n  elevation          within +-15 degrees; 1 sigma: 4 "
                           "degrees at the threshold, at best 0.3\n"));
}

TEST(levels_stand_for_fluctuation)
{
    struct sensor sensor = {.level_fast_db = 1};
    assert_true((datasheet_missing(&sensor) & EFFECT_BIT(EFFECT_FLUCTUATION)) == 0);
    sensor = (struct sensor){.fluctuation = FLUCTUATION_SWERLING_1};
    assert_true((datasheet_missing(&sensor) & EFFECT_BIT(EFFECT_LEVEL)) != 0);
}

TEST(the_examples_lack_what_they_are_said_to_lack)
{
    struct diag diag = {0};
    const double reaches_m[] = {60, 250};
    for (int i = 0; i < 2; i++) {
        struct sensor sensor = {.range_max_m = reaches_m[i]};
        struct datasheet_example example = datasheet_example(&sensor);
        const struct suite *suite = suite_file_load(example.name, check_arena(), &diag);
        assert_non_null(suite);
        for (size_t k = 0; k < suite->sensors.count; k++)
            assert_true(datasheet_missing(&suite->sensors.items[k]) == example.missing);
        assert_string_equal(datasheet_example(&suite->sensors.items[0]).name, example.name);
    }
}

TEST(sensors_that_differ_in_their_mount_share_a_sheet)
{
    struct sensor sensors[3] = {quiet_sensor(), quiet_sensor(), quiet_sensor()};
    struct suite suite = {.sensors = {sensors, 3, 3}};
    sensors[1].name = "left";
    sensors[1].mount_yaw_rad = 1;
    sensors[2].name = "far";
    sensors[2].range_max_m = 200;
    for (int i = 0; i < 3; i++)
        suite_derive(&sensors[i]);
    const char *text = written(&suite);
    int sheets = 0;
    for (const char *at = text; (at = strstr(at, "carrier")) != NULL; at++)
        sheets++;
    assert_int_equal(sheets, 2);
    assert_memory_equal(text, "front: ", 7);
    assert_non_null(strstr(text, "\nleft: at x 0 m, y 0 m, looking to 57.3 degrees\n  carrier"));
    assert_non_null(strstr(text, "\n\nfar: "));
}
