#include "check.h"

#include "base/units.h"
#include "sensor_signal/detections.h"
#include "support/array_sensor.h"

/* A radar of cells of 2 m and 0.25 m/s that sees 100 m and 90 degrees. */
static struct sensor radar(enum point_response window, size_t elements)
{
    struct sensor sensor = {.carrier_hz = 76.5e9,
                            .range_max_m = 100,
                            .field_of_view_rad = PI / 2,
                            .cell_range_m = 2,
                            .cell_range_rate_mps = 0.25,
                            .chirp_slope_hzps = 1e16,
                            .angle_estimator = MONOPULSE_RATIO};
    field_clear(&waveform_record, &sensor.waveform);
    sensor.waveform.samples = 64;
    sensor.waveform.repetitions = 32;
    sensor.waveform.window = window;
    if (elements > 0)
        array_sensor_add(&sensor, elements, 0.5);
    return sensor;
}

/* Found at this ratio of powers, with another one in the beam. A beam of an array has the maximum
 * of one echo. */
static struct effect_measurement accuracy_of(const struct sensor *sensor, double azimuth_rad,
                                             double found, double in_beam)
{
    struct signal_cube signal = signal_cube_of(sensor, check_arena());
    struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS] = {{0}};
    array_receive(&sensor->beams, sin(azimuth_rad), (struct phasor){sqrt(in_beam), 0}, samples);
    if (sensor->beams.count > 0)
        array_maxima(&sensor->beams, samples, maxima);
    struct cell cell = {.beam = &maxima[0]};
    struct effect_measurement measurement = {
        .cell = &cell, .azimuth_rad = azimuth_rad, .amplitude = sqrt(in_beam + 1)};
    detections_estimate(&signal, sqrt(found + 1), 1, &measurement);
    return measurement;
}

/* The Cramer-Rao bound of a frequency in white noise, sqrt(6)/(2 pi sqrt(snr)) bins, and with a
 * steep slope nothing of the range rate's. With Hann's window 1.58 sqrt(2/3) times that. */
TEST(range_and_rate_have_the_bound_of_their_window)
{
    struct sensor sensor = radar(POINT_RESPONSE_RECTANGULAR, 0);
    struct effect_measurement accuracy = accuracy_of(&sensor, 0, 400, 100);
    double bound = sqrt(6) / (2 * PI) / 20;
    assert_near(accuracy.range_rate_sigma_mps, 0.25 * bound, 1e-9);
    assert_near(accuracy.range_sigma_m, 2 * bound, 1e-4);
    sensor = radar(POINT_RESPONSE_HANN, 0);
    accuracy = accuracy_of(&sensor, 0, 400, 100);
    assert_near(accuracy.range_rate_sigma_mps, 0.25 * bound * 1.58 * sqrt(2. / 3), 1e-9);
}

/* A chirp of 20 MHz/us reads 3.825 mm more of range for each m/s. */
TEST(the_error_of_the_rate_adds_to_that_of_the_range)
{
    struct sensor sensor = radar(POINT_RESPONSE_RECTANGULAR, 0);
    double steep = accuracy_of(&sensor, 0, 400, 100).range_sigma_m;
    sensor.chirp_slope_hzps = 2e11; /* 0.3825 m for each m/s */
    struct effect_measurement accuracy = accuracy_of(&sensor, 0, 400, 100);
    double coupled = 0.3825 * accuracy.range_rate_sigma_mps;
    assert_near(accuracy.range_sigma_m, sqrt(steep * steep + coupled * coupled), 1e-4);
}

/* N elements half a wavelength apart: sqrt(6/(N (N^2 - 1)) N/(2 pi^2 d^2 ...)) of the sine, for 8
 * of them 0.389848/(8 d) sqrt(64/63) at 0 dB. Sum and delta: (sqrt 2/pi)/sqrt(snr) (MODEL 7.3). */
TEST(the_azimuth_is_that_of_elements_or_of_sum_and_delta)
{
    struct sensor sensor = radar(POINT_RESPONSE_HANN, 8);
    double sine = sqrt(6) / (2 * PI) / 4 * sqrt(64. / 63) / 10;
    assert_near(accuracy_of(&sensor, 0, 400, 100).azimuth_sigma_rad, sine, 1e-9);
    assert_near(accuracy_of(&sensor, 60 * DEGREE, 400, 100).azimuth_sigma_rad, 2 * sine, 1e-9);
    sensor = radar(POINT_RESPONSE_HANN, 0);
    assert_near(accuracy_of(&sensor, 0, 400, 100).azimuth_sigma_rad, sqrt(2) / PI / 10, 1e-6);
}

/* A real delta/sum of 0.3 is 0.3 · 10/sqrt(1.09/2) standard deviations from that of one echo. */
TEST(an_azimuth_of_several_echoes_has_a_wider_deviation)
{
    struct sensor sensor = radar(POINT_RESPONSE_HANN, 0);
    struct signal_cube signal = signal_cube_of(&sensor, check_arena());
    struct effect_measurement alone = {.amplitude = 10, .pointers = {10, 0}}, several = alone;
    several.pointers.delta = 3;
    detections_estimate(&signal, 10, 1, &alone);
    detections_estimate(&signal, 10, 1, &several);
    assert_true(!alone.looks_merged && several.looks_merged);
    assert_near(several.azimuth_sigma_rad / alone.azimuth_sigma_rad, sqrt(1 + 9 / (1.09 / 2)),
                1e-9);
}

TEST(an_echo_below_the_noise_is_anywhere)
{
    struct sensor sensor = radar(POINT_RESPONSE_HANN, 0);
    struct effect_measurement accuracy = accuracy_of(&sensor, 0.1, 0, 0);
    assert_near(accuracy.range_sigma_m, 2 / sqrt(12), 1e-3);
    assert_near(accuracy.range_rate_sigma_mps, 0.25 / sqrt(12), 1e-9);
    assert_near(accuracy.azimuth_sigma_rad, PI / 2 / sqrt(12), 1e-9);
}

TEST(bins_are_ranges_times_rates_times_beams)
{
    struct sensor sensor = radar(POINT_RESPONSE_HANN, 0), array = radar(POINT_RESPONSE_HANN, 8);
    struct signal_cube signal = signal_cube_of(&sensor, check_arena());
    assert_close(detections_noise_bins(&signal), 50 * 32, 1e-9);
    signal = signal_cube_of(&array, check_arena());
    assert_close(detections_noise_bins(&signal), 50 * 32 * 8, 1e-9);
}
