#include "check.h"

#include "base/random.h"
#include "base/units.h"
#include "radar/monopulse.h"
#include "support/antennas.h"

#define DRAWS 40000

static const struct antenna TURNED_TABLE = {.pattern = ANTENNA_TABLE,
                                            .phase = PHASE_ELEMENT,
                                            .rows = SKEWED_ROWS,
                                            .row_count = COUNT(SKEWED_ROWS)};

static const enum monopulse_estimator ESTIMATORS[] = {MONOPULSE_MAGNITUDE, MONOPULSE_RATIO};

static struct antenna_pointers weigh(struct antenna_pointers pointers, double _Complex weight)
{
    return (struct antenna_pointers){weight * pointers.sum, weight * pointers.delta};
}

/* The additive sensing ratio of equation (7). */
static double sensing_ratio(struct antenna_pointers pointers)
{
    double sum = cabs(pointers.sum), delta = cabs(pointers.delta);
    return (delta - sum) / (delta + sum);
}

/* Equation (8) without noise. */
static struct antenna_pointers superpose(const struct antenna *antenna, double first_rad,
                                         double _Complex first, double second_rad,
                                         double _Complex second)
{
    struct antenna_pointers a = weigh(antenna_pointers(antenna, first_rad), first);
    struct antenna_pointers b = weigh(antenna_pointers(antenna, second_rad), second);
    return (struct antenna_pointers){a.sum + b.sum, a.delta + b.delta};
}

static double _Complex phasor(double phase_rad)
{
    return cos(phase_rad) + sin(phase_rad) * (double _Complex)I;
}

/* MODEL 7.2: ASR = tan((pi/2) |sin| - pi/4), and its inverse. */
TEST(the_sensing_ratio_and_its_inverse_are_closed_forms)
{
    for (int i = -890; i <= 890; i++) {
        double azimuth_rad = 0.1 * i * DEGREE;
        struct antenna_pointers pointers = antenna_pointers(&ELEMENT, azimuth_rad);
        double asr = sensing_ratio(pointers);
        assert_close(asr, tan(PI / 2 * fabs(sin(azimuth_rad)) - PI / 4), 1e-15);
        assert_close(monopulse_angle(&ELEMENT, MONOPULSE_MAGNITUDE, pointers).azimuth_rad,
                     copysign(asin(0.5 + 2 / PI * atan(asr)), azimuth_rad), 2e-14);
    }
}

TEST(a_single_echo_is_seen_where_it_is)
{
    const struct antenna *antennas[] = {&CENTRE, &ELEMENT};
    for (int i = 0; i < 100000; i++)
        for (size_t k = 0; k < 8; k++) {
            double azimuth_rad =
                k < 4 ? antennas_dense_azimuth(i, 150) : -antennas_dense_azimuth(i, 150);
            const struct antenna *antenna = antennas[k % 2];
            struct monopulse_angle angle = monopulse_angle(antenna, ESTIMATORS[k / 2 % 2],
                                                           antenna_pointers(antenna, azimuth_rad));
            assert_true(angle.valid && !angle.sign_undecided);
            assert_close(angle.azimuth_rad, azimuth_rad, fmin(2e-15, 1e-14 * fabs(azimuth_rad)));
        }
}

TEST(the_common_phase_and_size_of_the_pointers_do_not_matter)
{
    static const double sizes[] = {1e-300, 1e-150, 1, 3e7, 1e300};
    for (size_t i = 0; i < COUNT(sizes); i++)
        for (int phase = 0; phase < 24; phase++)
            for (int azimuth_deg = -80; azimuth_deg <= 80; azimuth_deg += 8) {
                struct antenna_pointers pointers =
                    weigh(antenna_pointers(&ELEMENT, azimuth_deg * DEGREE),
                          sizes[i] * phasor(0.26 * phase));
                for (size_t k = 0; k < 2; k++) {
                    struct monopulse_angle angle =
                        monopulse_angle(&ELEMENT, ESTIMATORS[k], pointers);
                    assert_true(angle.valid);
                    assert_true(azimuth_deg == 0 || !angle.sign_undecided);
                    assert_close(angle.azimuth_rad, azimuth_deg * DEGREE, 2e-15);
                }
                if (sizes[i] < 1e100)
                    assert_close(sensing_ratio(pointers),
                                 tan(PI / 2 * sin(abs(azimuth_deg) * DEGREE) - PI / 4), 2e-15);
            }
}

TEST(a_single_echo_is_seen_where_it_is_through_a_table)
{
    const struct antenna *antennas[] = {&SKEWED, &TURNED_TABLE};
    for (int i = 1; i < 10000; i++)
        for (size_t k = 0; k < 4; k++) {
            double azimuth_rad = -1.2 + 2.5 * i / 10000;
            struct monopulse_angle angle = monopulse_angle(
                antennas[k / 2], ESTIMATORS[k % 2], antenna_pointers(antennas[k / 2], azimuth_rad));
            assert_true(angle.valid);
            assert_close(angle.azimuth_rad, azimuth_rad, 3e-15);
        }
}

TEST(pointers_of_zero_have_no_angle)
{
    for (size_t k = 0; k < 2; k++) {
        struct monopulse_angle angle =
            monopulse_angle(&CENTRE, ESTIMATORS[k], (struct antenna_pointers){0, 0});
        assert_false(angle.valid);
        assert_false(angle.sign_undecided);
        assert_close(angle.azimuth_rad, 0, 0);
    }
}

TEST(a_delta_of_zero_is_straight_ahead_on_neither_side)
{
    for (size_t k = 0; k < 2; k++) {
        struct monopulse_angle angle =
            monopulse_angle(&CENTRE, ESTIMATORS[k], (struct antenna_pointers){-3, 0});
        assert_true(angle.valid);
        assert_int_equal(angle.sign_undecided, ESTIMATORS[k] == MONOPULSE_MAGNITUDE);
        assert_close(angle.azimuth_rad, 0, 0);
    }
}

TEST(a_sum_of_zero_is_at_one_side_or_the_other)
{
    for (size_t k = 0; k < 2; k++) {
        struct monopulse_angle angle =
            monopulse_angle(&CENTRE, ESTIMATORS[k], (struct antenna_pointers){0, -1e-200});
        assert_true(angle.valid);
        assert_true(angle.sign_undecided);
        assert_close(angle.azimuth_rad, PI / 2, 0);
    }
}

TEST(the_phase_decides_the_sign_whatever_the_sizes)
{
    static const struct {
        double sum, delta, azimuth_rad;
    } cases[] = {{1e-300, 1e300, PI / 2},
                 {1e300, 1e-300, 0},
                 {1e-300, 1e-300, PI / 6},
                 {1e300, 1e300, PI / 6}};
    for (size_t i = 0; i < COUNT(cases); i++)
        for (size_t k = 0; k < 2; k++)
            for (int signs = 0; signs < 4; signs++) {
                int side = signs % 2 ? 1 : -1;
                int turn = signs / 2 ? 1 : -1;
                struct antenna_pointers pointers = {
                    turn * cases[i].sum, -turn * side * cases[i].delta * (double _Complex)I};
                struct monopulse_angle angle = monopulse_angle(&CENTRE, ESTIMATORS[k], pointers);
                assert_true(angle.valid && !angle.sign_undecided);
                assert_close(angle.azimuth_rad, side * cases[i].azimuth_rad, 2e-16);
            }
}

/* The ratio Im(delta conj(sum)) : |delta| |sum| on either side of 2^-47. */
TEST(a_sign_below_the_rounding_is_undecided)
{
    static const struct {
        double imag;
        int undecided;
        double azimuth_rad;
    } cases[] = {{0x1p-46, 0, -PI / 6}, {-0x1p-46, 0, PI / 6}, {0x1p-47, 1, PI / 6},
                 {-0x1p-47, 1, PI / 6}, {0x1p-48, 1, PI / 6},  {0, 1, PI / 6}};
    static const double sizes[] = {1e-280, 1, 1e300};
    for (size_t i = 0; i < COUNT(cases); i++)
        for (size_t k = 0; k < COUNT(sizes); k++) {
            struct antenna_pointers pointers = {
                sizes[k], sizes[k] * (1 + cases[i].imag * (double _Complex)I)};
            struct monopulse_angle angle = monopulse_angle(&CENTRE, MONOPULSE_MAGNITUDE, pointers);
            assert_true(angle.valid);
            assert_int_equal(angle.sign_undecided, cases[i].undecided);
            assert_close(angle.azimuth_rad, cases[i].azimuth_rad, 1e-15);
            angle = monopulse_angle(&CENTRE, MONOPULSE_RATIO, pointers);
            assert_false(angle.sign_undecided);
            assert_close(angle.azimuth_rad, asin(2 / PI * -cases[i].imag), 1e-28);
        }
}

/* MODEL 8.1: two equal echoes at either side. */
TEST(two_equal_echoes_meet_in_the_middle)
{
    static const double rows[][3] = {{4, 0.44, 0.00501},  {6, 1.00, 0.00501},  {8, 1.80, 0.00501},
                                     {10, 2.85, 0.00501}, {12, 4.17, 0.00501}, {15, 6.70, 0.00501},
                                     {20, 12.5, 0.0501},  {25, 20.5, 0.0501},  {30, 30.0, 1e-12}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        double azimuth_rad = rows[i][0] * DEGREE;
        struct antenna_pointers literal = superpose(&ELEMENT, azimuth_rad, 1, -azimuth_rad, 1);
        struct monopulse_angle angle = monopulse_angle(&ELEMENT, MONOPULSE_MAGNITUDE, literal);
        assert_true(angle.valid && angle.sign_undecided);
        assert_close(angle.azimuth_rad / DEGREE, rows[i][1], rows[i][2]);
        angle = monopulse_angle(&ELEMENT, MONOPULSE_RATIO, literal);
        assert_true(angle.valid && !angle.sign_undecided);
        assert_close(angle.azimuth_rad, 0, 0);
        struct antenna_pointers centred = superpose(&CENTRE, azimuth_rad, 1, -azimuth_rad, 1);
        for (size_t k = 0; k < 2; k++) {
            angle = monopulse_angle(&CENTRE, ESTIMATORS[k], centred);
            assert_true(angle.valid);
            assert_int_equal(angle.sign_undecided, ESTIMATORS[k] == MONOPULSE_MAGNITUDE);
            assert_close(angle.azimuth_rad, 0, 0);
        }
    }
}

/* MODEL 8.1: the worked examples. */
TEST(unequal_echoes_are_seen_between)
{
    static const struct {
        double first_deg, second_deg, ratio, literal_deg, centred_deg;
    } rows[] = {{-8, 8, 1, 1.80, 0},
                {-8, 8, 2, 3.23, 2.70},
                {-8, 8, 5, 5.60, 5.37},
                {-5, 15, 1, 5.40, 4.64}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        double first_rad = rows[i].first_deg * DEGREE;
        double second_rad = rows[i].second_deg * DEGREE;
        struct antenna_pointers literal =
            superpose(&ELEMENT, first_rad, 1, second_rad, rows[i].ratio);
        assert_close(monopulse_angle(&ELEMENT, MONOPULSE_MAGNITUDE, literal).azimuth_rad / DEGREE,
                     rows[i].literal_deg, 0.00501);
        struct antenna_pointers centred =
            superpose(&CENTRE, first_rad, 1, second_rad, rows[i].ratio);
        for (size_t k = 0; k < 2; k++)
            assert_close(monopulse_angle(&CENTRE, ESTIMATORS[k], centred).azimuth_rad / DEGREE,
                         rows[i].centred_deg, 0.00501);
    }
}

/* MODEL 8.1: equal g (amplitude times element factor) gives the mean of the sines. */
TEST(centred_echoes_of_equal_weight_average_their_sines)
{
    for (int first = -70; first <= 70; first += 10)
        for (int second = -65; second <= 75; second += 10) {
            double angles[] = {first * DEGREE, second * DEGREE};
            double weights[2];
            for (int k = 0; k < 2; k++) {
                double u = PI / 2 * sin(angles[k]);
                weights[k] = first || k ? u / (sin(u) * cos(angles[k])) : 1;
            }
            struct antenna_pointers sum =
                superpose(&CENTRE, angles[0], weights[0], angles[1], weights[1]);
            for (size_t k = 0; k < 2; k++)
                assert_close(sin(monopulse_angle(&CENTRE, ESTIMATORS[k], sum).azimuth_rad),
                             (sin(angles[0]) + sin(angles[1])) / 2, 2e-15);
        }
}

/* MODEL 8.2: delta / sum = -tan(u) tan(theta / 2). */
TEST(the_relative_phase_of_two_echoes_drives_them_apart)
{
    double azimuth_rad = 8 * DEGREE;
    double u = PI / 2 * sin(azimuth_rad);
    for (int i = 1; i < 31; i++) {
        struct antenna_pointers sum =
            superpose(&CENTRE, azimuth_rad, phasor(0.1 * i), -azimuth_rad, 1);
        struct monopulse_angle angle = monopulse_angle(&CENTRE, MONOPULSE_MAGNITUDE, sum);
        assert_close(angle.azimuth_rad, asin(2 / PI * atan(tan(u) * tan(0.05 * i))), 1e-14);
        assert_true(angle.sign_undecided);
        angle = monopulse_angle(&CENTRE, MONOPULSE_RATIO, sum);
        assert_close(angle.azimuth_rad, 0, 1e-14);
    }
}

/* Hard case 11: neither estimator may jump for one rounding of an amplitude. The magnitude is held
 * to it from 1 deg up: nearer the middle delta is what the two echoes leave of each other. */
TEST(one_ulp_of_an_amplitude_does_not_flip_the_sign)
{
    for (int i = 1; i < 700; i++)
        for (size_t k = i < 10; k < 2; k++) {
            double azimuth_rad = 0.1 * i * DEGREE;
            double even = monopulse_angle(&ELEMENT, ESTIMATORS[k],
                                          superpose(&ELEMENT, azimuth_rad, 1, -azimuth_rad, 1))
                              .azimuth_rad;
            for (int side = -1; side <= 1; side += 2) {
                double amplitude = 1 + side * 0x1p-52;
                double odd =
                    monopulse_angle(&ELEMENT, ESTIMATORS[k],
                                    superpose(&ELEMENT, azimuth_rad, amplitude, -azimuth_rad, 1))
                        .azimuth_rad;
                assert_close(odd, even, 1e-12);
            }
        }
}

struct spread {
    double mean_deg, deviation_deg, size_mean_deg, size_deviation_deg, wrong_sign;
};

/* Many draws of one echo with noise of total rms noise on either pointer. */
static struct spread spread_of(enum monopulse_estimator estimator, double azimuth_rad,
                               double amplitude, double noise)
{
    double sum = 0;
    double size_sum = 0;
    double squares = 0;
    double wrong = 0;
    struct random_address address = {.seed = 4, .scene = (uint64_t)(1e6 * (azimuth_rad + 2))};
    for (address.frame = 0; address.frame < DRAWS; address.frame++) {
        double draw[4];
        random_gaussian(&address, RANDOM_POINTERS, 0, draw);
        struct antenna_pointers pointers =
            weigh(antenna_pointers(&ELEMENT, azimuth_rad), amplitude);
        pointers.sum += noise * sqrt(0.5) * (draw[0] + draw[1] * (double _Complex)I);
        pointers.delta += noise * sqrt(0.5) * (draw[2] + draw[3] * (double _Complex)I);
        double azimuth_deg = monopulse_angle(&ELEMENT, estimator, pointers).azimuth_rad / DEGREE;
        sum += azimuth_deg / DRAWS;
        size_sum += fabs(azimuth_deg) / DRAWS;
        squares += azimuth_deg * azimuth_deg / DRAWS;
        wrong += (azimuth_deg < 0) / (double)DRAWS;
    }
    return (struct spread){sum, sqrt(squares - sum * sum), size_sum,
                           sqrt(squares - size_sum * size_sum), wrong};
}

/* MODEL 7.3: the standard deviations of the magnitude estimator by Monte Carlo there. */
TEST(noise_spreads_the_magnitude_angle_as_published)
{
    static const double rows[][3] = {{16, 0, 2.28},  {16, 10, 1.67}, {16, 30, 2.38},
                                     {16, 50, 5.04}, {8, 0, 4.56},   {8, 5, 3.59},
                                     {8, 10, 3.29},  {8, 30, 4.75},  {8, 40, 6.58}};
    for (size_t i = 0; i < COUNT(rows); i++)
        assert_near(
            spread_of(MONOPULSE_MAGNITUDE, rows[i][1] * DEGREE, rows[i][0], 1).deviation_deg,
            rows[i][2], 0.02);
    struct spread weak = spread_of(MONOPULSE_MAGNITUDE, 5 * DEGREE, 8, 1);
    assert_close(weak.wrong_sign, 0.063, 0.005);
    assert_close(spread_of(MONOPULSE_MAGNITUDE, 10 * DEGREE, 8, 1).wrong_sign, 0.002, 0.001);
    assert_close(spread_of(MONOPULSE_MAGNITUDE, 5 * DEGREE, 4, 1).wrong_sign, 0.23, 0.01);
}

/* (2/pi) |cos u| / (cos sqrt(2 chi)), chi the signal-to-noise ratio of the sum channel. */
TEST(noise_spreads_the_ratio_angle_as_published)
{
    static const double rows[][2] = {{0, 0.8156}, {20, 0.7457}, {40, 0.5666}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        double azimuth_rad = rows[i][0] * DEGREE;
        double noise = antenna_gain(&ELEMENT, azimuth_rad) / sqrt(1000);
        struct spread spread = spread_of(MONOPULSE_RATIO, azimuth_rad, 1, noise);
        assert_near(spread.deviation_deg, rows[i][1], 0.015);
        assert_close(spread.mean_deg, rows[i][0], 0.03);
    }
}

/* MODEL 7.3: the rows of the magnitude; of a table by drawing. */
TEST(the_predicted_spread_is_that_of_noise)
{
    static const double rows[][2] = {{0, 2.28}, {10, 1.67}, {30, 2.38}, {50, 5.04}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        double azimuth_rad = rows[i][0] * DEGREE, sum = 16 * antenna_gain(&ELEMENT, azimuth_rad);
        assert_near(monopulse_sigma_rad(&ELEMENT, MONOPULSE_MAGNITUDE, azimuth_rad, sum * sum) /
                        DEGREE,
                    rows[i][1], 0.03);
    }
    double squares = 0;
    struct random_address address = {.seed = 5};
    for (address.frame = 0; address.frame < DRAWS; address.frame++) {
        double draw[4], noise = 0.85 / sqrt(2 * 10000.0); /* the sum is 0.85 at 0.35 rad */
        random_gaussian(&address, RANDOM_POINTERS, 0, draw);
        struct antenna_pointers pointers = antenna_pointers(&SKEWED, 0.35);
        pointers.sum += noise * (draw[0] + draw[1] * (double _Complex)I);
        pointers.delta += noise * (draw[2] + draw[3] * (double _Complex)I);
        double error_rad = monopulse_angle(&SKEWED, MONOPULSE_RATIO, pointers).azimuth_rad - 0.35;
        squares += error_rad * error_rad / DRAWS;
    }
    assert_near(monopulse_sigma_rad(&SKEWED, MONOPULSE_RATIO, 0.35, 10000), sqrt(squares), 0.015);
}

/* Beyond its last row a table has no pattern; at its first one SKEWED has no sum. */
TEST(at_the_end_of_a_table_the_predicted_spread_is_that_just_inside)
{
    const struct antenna_row *last = SKEWED.rows + SKEWED.row_count - 1;
    double inside = monopulse_sigma_rad(&SKEWED, MONOPULSE_RATIO, last->azimuth_rad - 3e-4, 100);
    double end = monopulse_sigma_rad(&SKEWED, MONOPULSE_RATIO, last->azimuth_rad, 100);
    assert_true(inside > 0);
    assert_near(end, inside, 0.01);
    assert_true(monopulse_sigma_rad(&SKEWED, MONOPULSE_RATIO, SKEWED.rows->azimuth_rad, 100) > 0);
}

/* Equal echoes at both sides, one ahead of the other by theta, have delta/sum = -tan u
 * tan(theta/2), which is real, and a single echo has an imaginary one (MODEL 8.2). */
TEST(several_echoes_have_a_quadrature_that_one_has_not)
{
    static const struct antenna centred = {.phase = PHASE_CENTRE};
    const double u = PI / 2 * sin(0.1), theta = 0.5, noise = 0.01;
    assert_close(monopulse_quadrature(antenna_pointers(&centred, 0.3), noise), 0, 1e-9);
    struct antenna_pointers both = superpose(&centred, 0.1, 1, -0.1, phasor(theta));
    double ratio = tan(u) * tan(theta / 2);
    double sigma = noise / cabs(both.sum) * sqrt((1 + ratio * ratio) / 2);
    assert_near(fabs(monopulse_quadrature(both, noise)), ratio / sigma, 1e-12);
    both.delta *= 1e-200;
    both.sum *= 1e-200;
    assert_near(fabs(monopulse_quadrature(both, 1e-200 * noise)), ratio / sigma, 1e-12);
    assert_close(monopulse_quadrature((struct antenna_pointers){0, 1}, noise), 0, 0);
}

/* Of a standard Gaussian number 0.27 % lie beyond 3. */
TEST(noise_makes_a_quadrature_beyond_3_with_its_probability)
{
    int beyond = 0;
    struct random_address address = {.seed = 6};
    for (address.frame = 0; address.frame < DRAWS; address.frame++) {
        double draw[4], noise = 0.85 / sqrt(2 * 100.0);
        random_gaussian(&address, RANDOM_POINTERS, 0, draw);
        struct antenna_pointers pointers = antenna_pointers(&SKEWED, 0.35);
        pointers.sum += noise * (draw[0] + draw[1] * (double _Complex)I);
        pointers.delta += noise * (draw[2] + draw[3] * (double _Complex)I);
        beyond += fabs(monopulse_quadrature(pointers, sqrt(2) * noise)) > 3;
    }
    assert_close((double)beyond / DRAWS, 0.0027, 4 * sqrt(0.0027 / DRAWS));
}

TEST(the_magnitude_angle_folds_at_boresight)
{
    struct spread spread = spread_of(MONOPULSE_MAGNITUDE, 0, 1, 0.1);
    assert_close(spread.size_mean_deg, 3.23, 0.05);
    assert_close(spread.size_deviation_deg, 1.69, 0.03);
    assert_close(spread.wrong_sign, 0.5, 0.013);
}

/* The phase between the channels, whatever their amplitudes: sine of the angle by which delta
 * leads.
 */
TEST(the_sign_margin_is_the_sine_between_the_channels)
{
    const double _Complex i = (double _Complex)I;
    for (int degrees = -180; degrees <= 180; degrees += 15)
        for (double size = 1e-300; size <= 1e300; size *= 1e100) {
            double sine = sin(degrees * DEGREE), cosine = cos(degrees * DEGREE);
            struct antenna_pointers pointers = {.sum = 3 * size * (0.6 + 0.8 * i),
                                                .delta =
                                                    size * (cosine + sine * i) * (0.6 + 0.8 * i)};
            assert_close(monopulse_sign_margin(pointers), fabs(sine), 1e-15);
        }
    assert_true(isnan(monopulse_sign_margin((struct antenna_pointers){.sum = 1})));
    assert_true(isnan(monopulse_sign_margin((struct antenna_pointers){.delta = 1})));
}
