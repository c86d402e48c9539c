#include "check.h"

#include "sensor_signal/range_doppler.h"

/* 32 bins by 64, with two cells to a bin. */
enum { BINS = 32, RATES = 64, WIDTH = 2 * BINS, HEIGHT = 2 * RATES };

static const struct cfar quiet = {CFAR_ORDERED, 16, 6, 2, 8, 0};

struct sky {
    struct range_doppler spectrum;
    struct phasor samples[WIDTH * HEIGHT];
    double power[WIDTH * HEIGHT];
};

static void begin(struct sky *sky, enum point_response range_response,
                  enum point_response rate_response)
{
    *sky = (struct sky){.spectrum = {.range_cells = WIDTH,
                                     .rate_cells = HEIGHT,
                                     .beams = 1,
                                     .range_padding = 2,
                                     .rate_padding = 2,
                                     .range_bins = BINS,
                                     .range_ring = true,
                                     .range_response = range_response,
                                     .rate_response = rate_response}};
    sky->spectrum.power = sky->power;
    sky->spectrum.strongest = sky->power;
}

static void add(struct sky *sky, double range, double rate, double amplitude, double phase)
{
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++) {
            double along = range_doppler_distance(column / 2., range, BINS);
            double across = range_doppler_distance(row / 2., rate, RATES);
            double size = point_response_value(sky->spectrum.range_response, along) *
                          point_response_value(sky->spectrum.rate_response, across);
            sky->samples[row * WIDTH + column].re += amplitude * size * cos(phase);
            sky->samples[row * WIDTH + column].im += amplitude * size * sin(phase);
        }
}

static size_t search(struct sky *sky, const struct cfar *cfar, double threshold,
                     struct range_doppler_peak **peaks)
{
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        sky->power[i] =
            sky->samples[i].re * sky->samples[i].re + sky->samples[i].im * sky->samples[i].im;
    return range_doppler_peaks(&sky->spectrum, cfar, threshold, check_arena(), peaks);
}

/* An echo alone, with its side lobes, has one peak, of its place and amplitude. */
TEST(one_echo_is_one_peak_at_its_place)
{
    static const enum point_response responses[][2] = {
        {POINT_RESPONSE_HANN, POINT_RESPONSE_HANN},
        {POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_RECTANGULAR},
        {POINT_RESPONSE_PULSE, POINT_RESPONSE_HANN}};
    for (size_t i = 0; i < 3; i++)
        for (double part = 0; part < 1; part += 0.24) {
            struct sky sky;
            struct range_doppler_peak *peaks;
            begin(&sky, responses[i][0], responses[i][1]);
            add(&sky, 10 + part, -7 - part / 2, 1000, 1);
            assert_int_equal(search(&sky, &quiet, 2, &peaks), 1);
            double within = responses[i][1] == POINT_RESPONSE_HANN ? 0.0017 : 0.0105;
            assert_close(peaks[0].range, 10 + part, within);
            assert_close(peaks[0].rate, -7 - part / 2, within);
            assert_near(peaks[0].amplitude, 1000., within);
        }
}

/* Under Hann's window a pair in phase 1 bin apart is one peak at its middle, 4.60 dB up; in
 * quadrature 1.59 dB up; in antiphase it is two with their peaks outside. 2 bins apart it is always
 * two. */
TEST(two_equal_echoes_are_one_peak_or_two_by_distance_and_phase)
{
    struct sky sky;
    struct range_doppler_peak *peaks;
    static const double gains[] = {4.60, 1.59};
    for (int quarter = 0; quarter <= 2; quarter++) {
        begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
        add(&sky, 9.5, 3, 100, 0);
        add(&sky, 10.5, 3, 100, quarter * 3.14159265358979323846 / 2);
        size_t count = search(&sky, &quiet, 2, &peaks);
        assert_int_equal(count, quarter < 2 ? 1 : 2);
        if (quarter < 2) {
            assert_close(peaks[0].range, 10, 1e-12);
            assert_close(20 * log10(peaks[0].amplitude / 100), gains[quarter], 0.006);
        }
        begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
        add(&sky, 9, 3, 100, 0);
        add(&sky, 11, 3, 100, quarter * 3.14159265358979323846 / 2);
        assert_int_equal(search(&sky, &quiet, 4, &peaks), 2);
    }
}

/* Near each other, two echoes of amplitude ratio rho and phase psi have their peak g half
 * separations from their middle, toward the stronger one. Near its cell the parabola reads 1.7 %
 * too much. */
TEST(a_close_pair_has_its_peak_at_the_published_place)
{
    static const struct {
        double rho, degrees, g;
    } cases[] = {{0.5, 0, 0.333333}, {0.5, 90, 0.6},      {0.5, 150, 1.953254}, {0.5, 180, 3},
                 {0.9, 0, 0.052632}, {0.9, 90, 0.104972}, {0.9, 150, 0.756507}};
    const double half = 0.005;
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct sky sky;
        struct range_doppler_peak *peaks;
        begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
        add(&sky, 10 + half, 3 + half, 100, 0);
        add(&sky, 10 - half, 3 - half, 100 * cases[i].rho,
            cases[i].degrees * 3.14159265358979 / 180);
        assert_int_equal(search(&sky, &quiet, 2, &peaks), 1);
        assert_close((peaks[0].range - 10) / half, cases[i].g, 0.02 * cases[i].g);
        assert_close((peaks[0].rate - 3) / half, cases[i].g, 0.02 * cases[i].g);
    }
}

TEST(a_weak_echo_is_found_outside_the_side_lobes_of_a_strong_one_only)
{
    struct sky sky;
    struct range_doppler_peak *peaks;
    begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
    add(&sky, 10, 3, 1000, 0);
    add(&sky, 13, 3, 10, 1); /* envelope 0.0133 */
    add(&sky, 20, 30, 10, 1);
    assert_int_equal(search(&sky, &quiet, 2, &peaks), 2);
    assert_close(peaks[1].range, 20, 0.01);
    assert_close(peaks[1].rate, 30, 0.01);
}

/* Every range rate of a range has an amplitude of 2: a peak must exceed that by the CFAR factor. */
TEST(a_peak_must_exceed_the_rates_of_its_range)
{
    for (double factor = 1; factor <= 100; factor *= 100) {
        struct sky sky;
        struct range_doppler_peak *peaks;
        struct cfar cfar = {CFAR_MEAN, 16, 6, 2, 0, factor};
        begin(&sky, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_RECTANGULAR);
        for (int rate = 0; rate < HEIGHT; rate++)
            add(&sky, 5, rate, 2, rate);
        add(&sky, 5, 30, 10, 30);
        assert_int_equal(search(&sky, &cfar, 8, &peaks), factor == 1 ? 1 : 0);
    }
}

TEST(a_peak_is_that_of_its_strongest_beam)
{
    enum { BEAMS = 3 };
    static const double amplitudes[BEAMS] = {5, 9, 7};
    static double power[BEAMS * WIDTH * HEIGHT];
    struct sky sky;
    struct range_doppler_peak *peaks;
    for (int beam = 0; beam < BEAMS; beam++) {
        begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
        add(&sky, 5, 20, amplitudes[beam], 0);
        assert_int_equal(search(&sky, &quiet, 3, &peaks), 1);
        memcpy(power + beam * WIDTH * HEIGHT, sky.power, sizeof sky.power);
    }
    begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
    memcpy(sky.power, power + WIDTH * HEIGHT, sizeof sky.power);
    sky.spectrum.beams = BEAMS;
    sky.spectrum.power = power;
    assert_int_equal(range_doppler_peaks(&sky.spectrum, &quiet, 3, check_arena(), &peaks), 1);
    assert_int_equal(peaks[0].beam, 1);
    assert_near(peaks[0].amplitude, 9., 1e-9);
}

/* In its strongest beam the peak stands in a clutter of rates, in the other one alone. */
TEST(a_peak_may_exceed_the_threshold_in_another_than_its_strongest_beam)
{
    static double power[2 * WIDTH * HEIGHT];
    struct sky cluttered, clear;
    struct range_doppler_peak *peaks;
    struct cfar cfar = {CFAR_MEAN, 16, 6, 2, 0, 100};
    begin(&cluttered, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_RECTANGULAR);
    begin(&clear, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_RECTANGULAR);
    for (int rate = 0; rate < HEIGHT; rate++)
        add(&cluttered, 5, rate, 2, rate);
    add(&cluttered, 5, 30, 10, 30);
    add(&clear, 5, 30, 9, 0);
    assert_int_equal(search(&cluttered, &cfar, 8, &peaks), 0);
    assert_int_equal(search(&clear, &cfar, 8, &peaks), 1);
    memcpy(power, cluttered.power, sizeof cluttered.power);
    memcpy(power + WIDTH * HEIGHT, clear.power, sizeof clear.power);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        if (clear.power[i] > cluttered.power[i])
            cluttered.power[i] = clear.power[i];
    cluttered.spectrum.beams = 2;
    cluttered.spectrum.power = power;
    assert_int_equal(range_doppler_peaks(&cluttered.spectrum, &cfar, 8, check_arena(), &peaks), 1);
    assert_int_equal(peaks[0].beam, 1);
    assert_near(peaks[0].amplitude, 9., 0.01);
}

TEST(rings_close_at_both_ends)
{
    struct sky sky;
    struct range_doppler_peak *peaks;
    begin(&sky, POINT_RESPONSE_HANN, POINT_RESPONSE_HANN);
    add(&sky, 0.25, -32, 100, 0);
    assert_int_equal(search(&sky, &quiet, 2, &peaks), 1);
    assert_close(peaks[0].range, 0.25, 0.01);
    assert_close(peaks[0].rate, -32, 0.01);
    assert_close(range_doppler_distance(31, 1, 32), -2, 0);
    struct range_doppler_peak there = range_doppler_at(&sky.spectrum, &quiet, 32.25, 32);
    assert_near(there.amplitude, 100 * point_response_value(POINT_RESPONSE_HANN, 0.25), 1e-12);
}
