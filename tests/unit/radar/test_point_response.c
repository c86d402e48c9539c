#include "check.h"

#include <complex.h>

#include "base/units.h"
#include "radar/point_response.h"
#include "sample.h"

static const enum point_response all[] = {POINT_RESPONSE_HANN, POINT_RESPONSE_RECTANGULAR,
                                          POINT_RESPONSE_PULSE};

TEST(responses_have_their_closed_forms)
{
    assert_close(point_response_value(POINT_RESPONSE_HANN, 0), 1, 0);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 0.5), 0.848826, 5e-7);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 1), 0.5, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_HANN, -1.5), 0.169765, 5e-7);
    assert_close(fabs(point_response_value(POINT_RESPONSE_HANN, 2.5)), 0.024252, 1e-6);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 2), 0, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_RECTANGULAR, 0.5), 2 / PI, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_PULSE, 2), 0.5, 1e-15);
    /* widths at -3 dB */
    assert_close(point_response_value(POINT_RESPONSE_HANN, 1.440583 / 2), sqrt(0.5), 1e-4);
    assert_close(point_response_value(POINT_RESPONSE_RECTANGULAR, 0.885899 / 2), sqrt(0.5), 1e-4);
}

TEST(a_response_is_a_half_at_its_half_width)
{
    static const double half_widths[] = {[POINT_RESPONSE_HANN] = 1,
                                         [POINT_RESPONSE_RECTANGULAR] = 0.603354,
                                         [POINT_RESPONSE_PULSE] = 2};
    for (size_t i = 0; i < COUNT(all); i++)
        assert_close(point_response_value(all[i], half_widths[all[i]]), 0.5, 1e-6);
}

/* The spectrum of a windowed tone of 64 samples, or a pulse, so many bins from its middle. */
static double complex tone(enum point_response window, double bins)
{
    double complex sum = 0;
    if (window == POINT_RESPONSE_PULSE)
        return exp2(-bins * bins / 4);
    for (int n = 0; n < 64; n++) {
        double turns = (n - 31.5) / 64;
        double weight = window == POINT_RESPONSE_HANN ? 1 + cos(2 * PI * turns) : 1;
        double angle_rad = -2 * PI * bins * turns;
        sum += weight * (cos(angle_rad) + sin(angle_rad) * (double complex)I) / 64;
    }
    return sum;
}

/* The share of phases, from 0 to half a turn, in which a tone and another of half its amplitude,
 * `apart` bins from it, show as two peaks. Lower maxima are side lobes. */
static double share_parted(enum point_response window, double apart)
{
    enum { PHASES = 40, PLACES = 400 };
    double complex one[PLACES], other[PLACES];
    double beside = window == POINT_RESPONSE_PULSE ? 2.4 : 0.6;
    int parted = 0;
    for (int i = 0; i < PLACES; i++) {
        double bins = -beside + (apart + 2 * beside) * i / PLACES;
        one[i] = tone(window, bins);
        other[i] = tone(window, bins - apart) / 2;
    }
    for (int k = 0; k < PHASES; k++) {
        double size[PLACES], phase_rad = PI * (k + 0.5) / PHASES;
        double complex turned = cos(phase_rad) + sin(phase_rad) * (double complex)I;
        int peaks = 0;
        for (int i = 0; i < PLACES; i++)
            size[i] = cabs(one[i] + turned * other[i]);
        for (int i = 1; i < PLACES - 1; i++)
            peaks += size[i] > size[i - 1] && size[i] >= size[i + 1] && size[i] > 0.33;
        parted += peaks >= 2;
    }
    return (double)parted / PHASES;
}

TEST(half_of_all_pairs_part_at_the_resolution)
{
    for (size_t i = 0; i < COUNT(all); i++) {
        double resolution = point_response_resolution(all[i]);
        assert_close(share_parted(all[i], resolution), 0.5, 0.03);
        assert_true(share_parted(all[i], 0.85 * resolution) < 0.47);
        assert_true(share_parted(all[i], 1.15 * resolution) > 0.53);
    }
}

/* The size of the sum of two echoes along an axis, from 15 bins before the first to 15 behind the
 * other; returns the number of places, 100 to a bin. */
enum { PLACES_TO_A_BIN = 100, BESIDE = 15 * PLACES_TO_A_BIN, MOST_PLACES = 4000 };
static size_t add_two(enum point_response response, double bins, double ratio, double phase_rad,
                      double size[MOST_PLACES])
{
    size_t count = 2 * BESIDE + (size_t)lround(bins * PLACES_TO_A_BIN) + 1;
    assert_true(count <= MOST_PLACES);
    for (size_t i = 0; i < count; i++) {
        double place = ((double)i - BESIDE) / PLACES_TO_A_BIN;
        double other = ratio * point_response_value(response, place - bins);
        size[i] = hypot(point_response_value(response, place) + other * cos(phase_rad),
                        other * sin(phase_rad));
    }
    return count;
}

static bool pulses_have_two_peaks(double bins, double ratio, double phase_rad)
{
    double size[MOST_PLACES];
    size_t count = add_two(POINT_RESPONSE_PULSE, bins, ratio, phase_rad, size), peaks = 0;
    for (size_t i = 1; i + 1 < count; i++)
        peaks += size[i] > size[i - 1] && size[i] >= size[i + 1];
    return peaks > 1;
}

static size_t summit_from(const double *size, size_t at)
{
    while (size[at - 1] > size[at])
        at--;
    while (size[at + 1] > size[at])
        at++;
    return at;
}

/* True if the two lead uphill to a peak each; side lobes count as none. */
static bool lead_to_two_peaks(enum point_response response, double bins, double ratio,
                              double phase_rad)
{
    double size[MOST_PLACES];
    size_t count = add_two(response, bins, ratio, phase_rad, size);
    return summit_from(size, BESIDE) != summit_from(size, count - 1 - BESIDE);
}

TEST(pulses_part_where_their_sum_has_two_peaks)
{
    uint64_t random = 3;
    int parted = 0, compared = 0;
    for (int i = 0; i < 3000; i++) {
        double bins = sample_between(&random, 2, 8), phase_rad = sample_between(&random, -7, 7);
        double ratio = exp2(sample_between(&random, -8, 2));
        bool answer = point_response_pulses_part(bins, ratio, phase_rad);
        if (point_response_pulses_part(0.99 * bins, ratio, phase_rad) != answer ||
            point_response_pulses_part(1.01 * bins, ratio, phase_rad) != answer)
            continue;
        assert_int_equal(answer, pulses_have_two_peaks(bins, ratio, phase_rad));
        parted += answer;
        compared++;
    }
    assert_true(compared > 2700 && parted > compared / 4 && parted < compared * 3 / 4);
}

/* The sum of two equal bells in phase has two peaks beyond twice their deviation, here
 * sqrt(2/ln 2) bins. */
TEST(equal_pulses_part_from_a_closed_distance_on)
{
    for (double phase_rad = 0; phase_rad < 3; phase_rad += 0.1) {
        double bins = 2 * sqrt((1 + cos(phase_rad)) / log(2));
        assert_false(point_response_pulses_part(bins * (1 - 1e-9), 1, phase_rad));
        assert_true(point_response_pulses_part(bins * (1 + 1e-9), 1, phase_rad));
    }
    assert_true(point_response_pulses_part(3.3973, 1, 0));
    assert_false(point_response_pulses_part(3.3972, 1, 0));
    double resolution = point_response_resolution(POINT_RESPONSE_PULSE);
    assert_false(point_response_pulses_part(resolution - 1e-4, 0.5, PI / 2));
    assert_true(point_response_pulses_part(resolution + 1e-4, 0.5, PI / 2));
    for (double bins = 0.01; bins < 8; bins *= 1.1)
        for (double ratio = 1e-3; ratio < 100; ratio *= 1.3)
            assert_true(point_response_pulses_part(bins, ratio, PI));
}

/* In 91 % of these pairs; the resolution alone tells 82 %. */
TEST(echoes_with_a_hann_window_part_as_pulses_do)
{
    double pulses = point_response_resolution(POINT_RESPONSE_PULSE) /
                    point_response_resolution(POINT_RESPONSE_HANN);
    uint64_t random = 4;
    int alike = 0, half = 0;
    for (int i = 0; i < 4000; i++) {
        double bins = sample_between(&random, 1, 3), phase_rad = sample_between(&random, 0, PI);
        double ratio = exp2(sample_between(&random, -4, 0));
        bool expected = lead_to_two_peaks(POINT_RESPONSE_HANN, bins, ratio, phase_rad);
        alike += point_response_pulses_part(pulses * bins, ratio, phase_rad) == expected;
        half += (bins > point_response_resolution(POINT_RESPONSE_HANN)) == expected;
    }
    assert_true(alike > 0.9 * 4000 && half < 0.83 * 4000);
}

TEST(weights_sum_to_one_and_noise_is_their_rms)
{
    for (size_t i = 0; i < 2; i++) {
        double sum = 0, power = 0;
        for (size_t n = 0; n < 64; n++) {
            double weight = point_response_weight(all[i], n, 64);
            sum += weight;
            power += weight * weight;
        }
        assert_close(sum, 1, 1e-15);
        assert_near(point_response_noise(all[i], 64), sqrt(power), 1e-14);
    }
    assert_near(point_response_noise(POINT_RESPONSE_PULSE, 64), 1. / 8, 1e-15);
}

TEST(the_envelope_bounds_the_response_and_falls)
{
    for (size_t i = 0; i < COUNT(all); i++)
        for (double d = 0; d < 40; d += 0.01) {
            assert_true(fabs(point_response_value(all[i], d)) <=
                        point_response_envelope(all[i], d) * (1 + 1e-12));
            assert_true(point_response_envelope(all[i], d + 0.01) <=
                        point_response_envelope(all[i], -d));
        }
}

static double power_at(enum point_response response, double bins)
{
    double value = 7 * point_response_value(response, bins);
    return value * value;
}

/* Two cells to a bin; pulses have one. */
TEST(the_vertex_is_next_to_an_echo_alone)
{
    static const double within[] = {[POINT_RESPONSE_HANN] = 0.0017,
                                    [POINT_RESPONSE_RECTANGULAR] = 0.0104,
                                    [POINT_RESPONSE_PULSE] = 1e-13};
    for (size_t i = 0; i < COUNT(all); i++) {
        double cell = all[i] == POINT_RESPONSE_PULSE ? 1 : 0.5, worst = 0;
        for (double place = -cell / 2; place <= cell / 2; place += cell / 256) {
            double read = cell * point_response_vertex(power_at(all[i], -cell - place),
                                                       power_at(all[i], place),
                                                       power_at(all[i], cell - place));
            worst = fmax(worst, fabs(read - place));
        }
        assert_true(worst <= within[all[i]]);
    }
    assert_close(point_response_vertex(0, 1, 1), 0, 0);
    assert_close(point_response_vertex(2, 2, 2), 0, 0);
    assert_close(point_response_vertex(1, 1, 0.5), -0.5, 1e-15);
}

TEST(the_hann_response_is_even_and_zero_at_whole_bins)
{
    uint64_t sample = 1;
    for (int i = 0; i < 1000; i++) {
        double d = sample_between(&sample, 0, 10);
        assert_true(point_response_hann(d) == point_response_hann(-d));
    }
    for (int d = 2; d < 100; d++)
        assert_true(point_response_hann(d) == 0);
}

/* The sum of three shifted responses without a window, in extended precision. */
static long double three_lines(long double d)
{
    const long double pi = 3.14159265358979323846264338327950288L;
    long double sum = 0;
    for (int line = -1; line <= 1; line++) {
        long double x = d - (long double)line;
        sum += (line == 0 ? 1 : 0.5L) * (x == 0 ? 1 : sinl(pi * x) / (pi * x));
    }
    return sum;
}

TEST(the_hann_response_is_that_of_a_raised_cosine)
{
    uint64_t sample = 2;
    for (int i = 0; i < 10000; i++) {
        double d = sample_between(&sample, -6, 6);
        assert_close(point_response_hann(d), (double)three_lines((long double)d), 1e-15);
    }
}

/* Where the plain formula is 0/0. */
TEST(the_hann_response_is_smooth_at_0_and_1)
{
    for (double step = 1e-3; step > 1e-16; step /= 7) {
        assert_close(point_response_hann(step), 1, step + 5e-16);
        assert_close(point_response_hann(1 + step), 0.5, step + 5e-16);
        double expected = (double)three_lines((long double)(1 - step));
        assert_near(point_response_hann(1 - step), expected, 1e-15);
    }
}

TEST(one_echo_is_found_exactly_where_it_is)
{
    uint64_t sample = 3;
    for (int i = 0; i < 10000; i++) {
        double d = sample_between(&sample, -0.5, 0.5);
        assert_close(point_response_hann_offset(3 * point_response_hann(-1 - d),
                                                3 * point_response_hann(d),
                                                3 * point_response_hann(1 - d)),
                     d, 1e-15);
    }
    assert_close(point_response_hann_offset(0.5, 1, 0.5), 0, 0);
    assert_close(point_response_hann_offset(1, 1, 0.2), -0.5, 0);
    assert_close(point_response_hann_offset(0.2, 1, 1), 0.5, 0);
}

TEST(a_wide_peak_with_equal_sides_has_no_offset)
{
    for (double side = 0.5; side <= 1; side += 0.1)
        assert_true(point_response_hann_offset(side, 1, side) == 0);
}

TEST(a_peak_narrower_than_one_echo_is_left_on_its_bin)
{
    assert_true(point_response_hann_offset(0.3, 1, 0.49) == 0);
    assert_true(point_response_hann_offset(0, 1, 0) == 0);
}

/* The envelope of two equal echoes, the second `spacing` bins behind and turned by the phase. */
static double envelope(double d, double spacing, double phase_rad)
{
    double first = point_response_hann(d), second = point_response_hann(d - spacing);
    return hypot(first + second * cos(phase_rad), second * sin(phase_rad));
}

TEST(equal_echoes_a_bin_apart_read_as_one_between_them)
{
    for (double phase_rad = 0; phase_rad < 2; phase_rad += 0.5) {
        double before = envelope(-1, 1, phase_rad), at = envelope(0, 1, phase_rad);
        assert_close(point_response_hann_offset(before, at, envelope(1, 1, phase_rad)), 0.5, 1e-15);
    }
}

enum { WALK_POINTS = 200 };

static double walk_weight(enum point_response window, double x)
{
    return window == POINT_RESPONSE_HANN ? 1 + cos(2 * PI * x) : 1;
}

/* The transform of the window, of integral 1, at a distance in cells. */
static double transform(enum point_response window, double d)
{
    if (fabs(d) < 1e-9)
        return 1;
    double sinc = sin(PI * d) / (PI * d);
    if (window == POINT_RESPONSE_RECTANGULAR)
        return sinc;
    return fabs(fabs(d) - 1) < 1e-9 ? 0.5 : sinc / (1 - d * d);
}

/* The integral of MODEL 14.20: over y in closed form, over x by the midpoint rule. */
static double walk_response(enum point_response window, double cells, double a, double b)
{
    double _Complex sum = 0;
    for (int i = 0; i < WALK_POINTS; i++) {
        double x = (i + 0.5) / WALK_POINTS - 0.5;
        sum += walk_weight(window, x) * transform(window, cells * x + b) *
               cexp(2 * PI * a * x * (double _Complex)I);
    }
    return cabs(sum) / WALK_POINTS;
}

struct peak {
    double a, b, level;
};

static struct peak peak_of(enum point_response window, double cells)
{
    struct peak peak = {0, 0, walk_response(window, cells, 0, 0)};
    for (double a = 0; a <= cells / 2; a += 0.25)
        for (double b = -cells / 2; b <= cells / 2; b += 0.25) {
            double level = walk_response(window, cells, a, b);
            if (level > peak.level)
                peak = (struct peak){a, b, level};
        }
    return peak;
}

/* From the peak along b to where the response is half of it, to one side. */
static double half_width(enum point_response window, double cells, const struct peak *peak,
                         double side)
{
    double d = 0;
    while (walk_response(window, cells, peak->a, peak->b + side * d) >= peak->level / 2)
        d += 0.01;
    return d - 0.005;
}

static void check_window(enum point_response window, double level_db, double width_cells)
{
    const struct peak rest = {0, 0, 1};
    double width_at_rest = 2 * half_width(window, 0, &rest, 1);
    for (double cells = 0.25; cells <= 10; cells += 0.75) {
        struct point_response_walk law = point_response_of_walk(window, cells);
        struct peak peak = peak_of(window, cells);
        double width = half_width(window, cells, &peak, 1) + half_width(window, cells, &peak, -1);
        assert_close(20 * log10(law.level), 20 * log10(peak.level), level_db);
        assert_close(width_at_rest * (1 + law.widening), width, width_cells);
    }
}

TEST(level_and_width_are_those_of_the_integral)
{
    check_window(POINT_RESPONSE_HANN, 0.02, 0.03);
    check_window(POINT_RESPONSE_RECTANGULAR, 0.3, 0.2);
}

/* Measured of a sampled chirp: -11.0 and -2.5 dB over four cells; -18.7 and -7.8 dB over 9.3, where
 * Hann's response is 4.75 cells wide. */
TEST(level_and_width_are_those_of_a_chirp)
{
    static const struct {
        enum point_response window;
        double cells, level_db;
    } cases[] = {{POINT_RESPONSE_RECTANGULAR, 4, -11.0},
                 {POINT_RESPONSE_RECTANGULAR, 9.3, -18.7},
                 {POINT_RESPONSE_HANN, 4, -2.5},
                 {POINT_RESPONSE_HANN, 9.3, -7.8}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(20 * log10(point_response_of_walk(cases[i].window, cases[i].cells).level),
                     cases[i].level_db, 0.35);
    assert_close(2 * (1 + point_response_of_walk(POINT_RESPONSE_HANN, 9.3).widening), 4.75, 0.1);
}

TEST(an_echo_at_rest_keeps_its_level_and_width_to_the_bit)
{
    for (enum point_response window = POINT_RESPONSE_HANN; window <= POINT_RESPONSE_RECTANGULAR;
         window++)
        for (double cells = -1e-8; cells <= 1e-8; cells += 1e-9) {
            struct point_response_walk law = point_response_of_walk(window, cells);
            assert_true(law.level == 1 && law.widening == 0);
        }
}

/* Far out the response has the shape of the window itself, over as many cells as the echo walks:
 * amplitudes of 4/K and 1/K, half of them K/2 and K cells wide. */
TEST(a_long_walk_draws_the_window)
{
    struct point_response_walk hann = point_response_of_walk(POINT_RESPONSE_HANN, -1e4);
    struct point_response_walk plain = point_response_of_walk(POINT_RESPONSE_RECTANGULAR, 1e4);
    assert_near(hann.level, 4e-4, 0.01);
    assert_near(hann.widening, 2.5e3, 0.01);
    assert_near(1.2067 * plain.widening, 1e4, 0.01);
    assert_true(plain.level > 1e-4 && plain.level < 1.2e-4);
}
