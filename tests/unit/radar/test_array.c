#include "check.h"

#include "base/elementary.h"
#include "base/random.h"
#include "support/array_sensor.h"

#define PI 3.14159265358979323846

/* Half a wavelength apart. */
static struct array row(size_t count, enum array_taper taper)
{
    return array_row(count, 0.5, taper);
}

TEST(one_echo_has_one_maximum_of_its_amplitude_at_its_sine)
{
    for (int taper = TAPER_HANN; taper <= TAPER_CHEBYSHEV; taper++)
        for (size_t count = 4; count <= ARRAY_MOST_ELEMENTS; count *= 4)
            for (double sine = -0.93; sine < 0.95; sine += 0.31) {
                struct array array = row(count, (enum array_taper)taper);
                struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
                struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
                array_receive(&array, sine, (struct phasor){-1.8, 2.4}, samples);
                size_t found = array_maxima(&array, samples, maxima);
                assert_int_equal(array_keep(&array, 0, 0.01, maxima, found), 1);
                assert_close(maxima[0].sine, sine, 1e-6);
                assert_close(maxima[0].amplitude, 3, 1e-9);
            }
}

/* A pair at 5 degrees to both sides, in phase at the first element and so not in the middle; in
 * phase there, it is one maximum, at 0. */
TEST(a_pair_in_phase_at_the_first_element_has_two_maxima)
{
    struct array array = row(8, TAPER_RECTANGULAR);
    struct phasor first[8] = {{0, 0}}, middle[8] = {{0, 0}};
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
    for (int side = -1; side <= 1; side += 2) {
        double sine = side * sin(5 * PI / 180), phase = PI * 3.5 * sine;
        array_receive(&array, sine, (struct phasor){cos(phase), sin(phase)}, first);
        array_receive(&array, sine, (struct phasor){1, 0}, middle);
    }
    assert_int_equal(array_keep(&array, 0.5, 0.01, maxima, array_maxima(&array, first, maxima)), 2);
    for (size_t i = 0; i < 2; i++) {
        assert_close(fabs(asin(maxima[i].sine)) * 180 / PI, 4.05, 0.005);
        assert_close(maxima[i].amplitude, 0.9432, 5e-5);
    }
    assert_close(maxima[0].sine + maxima[1].sine, 0, 1e-7);
    assert_int_equal(array_keep(&array, 0.5, 0.01, maxima, array_maxima(&array, middle, maxima)),
                     1);
    assert_close(maxima[0].sine, 0, 1e-9);
}

TEST(a_beam_repeats_at_its_grating_lobes)
{
    struct array array = row(4, TAPER_RECTANGULAR);
    assert_close(array_response(&array, 0), 1, 1e-15);
    assert_close(array_response(&array, 1 / 0.5), 1, 1e-9);
    assert_close(array_response(&array, 1 / (4 * 0.5)), 0, 1e-15);
}

/* Without a taper 0.886/D and -13.26 dB (Van Trees 2002, table 2.1 for long arrays); Hann's 1.44/D
 * and -31.5 dB; Taylor's and Chebyshev's side lobes are what they are made for. */
TEST(beams_have_the_published_widths_and_side_lobes)
{
    static const double width[] = {0.886, 1.44, 1.12, 1.05}, level_db[] = {-13.26, -31.5, -30, -30};
    static const double null[] = {1, 2.1, 1.6, 1.6}, within[] = {0.01, 0.01, 0.05, 0.08};
    for (int taper = 0; taper <= TAPER_CHEBYSHEV; taper++) {
        struct array array = row(64, (enum array_taper)taper);
        double most = 0;
        for (double lobes = null[taper]; lobes < 31; lobes += 0.01)
            most = elementary_max(most, array_response(&array, lobes / 32));
        assert_near(array_beam(&array) * 32, width[taper], within[taper]);
        assert_near(20 * log10(most), level_db[taper], 0.02);
    }
}

/* The bound sqrt(6/(snr N (N^2 - 1)))/(2 pi d) times sqrt(N) of N elements (Rife and Boorstyn
 * 1974). */
TEST(the_sine_of_one_echo_is_as_accurate_as_the_bound)
{
    for (size_t count = 2; count <= ARRAY_MOST_ELEMENTS; count += 127) {
        struct array array = row(count, TAPER_RECTANGULAR);
        double n = (double)count, snr = 100;
        assert_near(array_sigma(&array, snr), sqrt(6 / (snr * (n * n - 1))) / (2 * PI * 0.5), 1e-9);
    }
}

/* 4,000 draws of noise: standard errors are 1.1 %. */
TEST(noise_moves_the_maximum_as_far_as_its_sigma)
{
    struct random_address address = {.seed = 1};
    for (int taper = 0; taper <= TAPER_CHEBYSHEV; taper++) {
        struct array array = row(16, (enum array_taper)taper);
        double squares = 0, power = 0, draw[4], noise = 0.1;
        for (address.item = 0; address.item < 4000; address.item++) {
            struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
            struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
            array_receive(&array, 0.3, (struct phasor){1, 0}, samples);
            for (uint32_t n = 0; n < 16; n++) {
                random_gaussian(&address, RANDOM_ELEMENTS, n, draw);
                samples[n].re += noise / array.noise * sqrt(0.5) * draw[0];
                samples[n].im += noise / array.noise * sqrt(0.5) * draw[1];
            }
            array_maxima(&array, samples, maxima);
            double error = (maxima[0].sine - 0.3) / (maxima[0].sigma * noise);
            squares += error * error;
            power += maxima[0].amplitude * maxima[0].amplitude - 1;
        }
        assert_close(squares / 4000, 1, 0.07);
        assert_near(power / 4000, 1.5 * noise * noise, 0.4);
    }
}

/* Beams of 8 elements half a wavelength apart are orthogonal at sines of 1/4. */
TEST(samples_have_beside_a_beam_the_power_of_other_echoes)
{
    struct array array = row(8, TAPER_RECTANGULAR);
    struct phasor samples[8] = {{0, 0}};
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
    array_receive(&array, 0, (struct phasor){3, 0}, samples);
    array_maxima(&array, samples, maxima);
    assert_close(maxima[0].others, 0, 1e-12);
    array_receive(&array, 0.5, (struct phasor){0.5, 0}, samples);
    array_receive(&array, -0.5, (struct phasor){0.5, 0}, samples);
    array_maxima(&array, samples, maxima);
    assert_close(maxima[0].sine, 0, 1e-12);
    assert_near(maxima[0].others, 0.5, 1e-12);
}

/* The fit of the beam takes a little of both. */
TEST(noise_beside_a_strong_echo_has_its_mean_and_deviation)
{
    enum { DRAWS = 4000 };
    struct array array = row(16, TAPER_HANN);
    struct random_address address = {.seed = 5};
    double noise = 0.1, sum = 0, squares = 0, draw[4];
    for (address.item = 0; address.item < DRAWS; address.item++) {
        struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
        struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
        array_receive(&array, 0.3, (struct phasor){10, 0}, samples);
        for (uint32_t n = 0; n < 16; n++) {
            random_gaussian(&address, RANDOM_ELEMENTS, n, draw);
            samples[n].re += noise / array.noise * sqrt(0.5) * draw[0];
            samples[n].im += noise / array.noise * sqrt(0.5) * draw[1];
        }
        array_maxima(&array, samples, maxima);
        sum += maxima[0].others;
        squares += maxima[0].others * maxima[0].others;
    }
    struct array_others expected = array_noise_beside(&array, noise);
    double mean = sum / DRAWS;
    assert_near(mean, expected.mean, 0.06);
    assert_near(sqrt(squares / DRAWS - mean * mean), expected.sigma, 0.12);
}

TEST(side_lobes_of_a_strong_echo_are_no_echoes)
{
    struct array array = row(16, TAPER_RECTANGULAR);
    struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
    array_receive(&array, 0.1, (struct phasor){100, 0}, samples);
    size_t found = array_maxima(&array, samples, maxima);
    assert_true(found > 10);
    assert_int_equal(array_keep(&array, 1, 0.5, maxima, found), 1);
    array_receive(&array, -0.5, (struct phasor){0, 30}, samples);
    found = array_maxima(&array, samples, maxima);
    assert_int_equal(array_keep(&array, 1, 0.5, maxima, found), 2);
    assert_near(maxima[1].sine, -0.5, 0.01);
    found = array_maxima(&array, samples, maxima);
    assert_int_equal(array_keep(&array, 40, 0.5, maxima, found), 1);
}

/* Two transmitters beside four receivers: the second one's elements follow those of the first; if
 * it stands to the right they come before. */
TEST(virtual_elements_keep_the_turn_of_their_transmitter)
{
    for (int side = -1; side <= 1; side += 2) {
        struct array_element transmit[] = {{3}, {3 + 2 * side}},
                             receive[] = {{1}, {0.5}, {0}, {1.5}};
        struct array_layout layout = {.taper = TAPER_HANN};
        layout.transmit.items = transmit;
        layout.transmit.count = 2;
        layout.receive.items = receive;
        layout.receive.count = 4;
        struct array array = array_of(&layout);
        assert_int_equal(array.count, 8);
        assert_near(array.spacing, 0.5, 1e-12);
        assert_near(array.least_step, array.most_step, 1e-12);
        for (size_t n = 0; n < 8; n++)
            assert_int_equal(array.turn[n], (n >= 4) == (side > 0));
    }
}
