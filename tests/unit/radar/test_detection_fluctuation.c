#include "check.h"

#include "base/random.h"
#include "radar/detection.h"

enum { DRAWS = 400000 };

static const struct random_address ADDRESS = {
    .seed = 11, .scene = 2, .frame = 3, .sensor = 4, .item = 5};

static double power_at(enum fluctuation_law law, double sigma_db, uint32_t index)
{
    double uniform[4];
    random_uniform(&ADDRESS, RANDOM_OWN, index, uniform);
    double factor = detection_fluctuation(law, sigma_db, uniform);
    return factor * factor;
}

/* MODEL 14.14, P_fa = 1e-4 in one look: a threshold on power over complex noise of mean power 1.
 * The closed forms that are left are exp(-T/(1 + chi)) and exp(-T/a) (1 + (chi/2) T/a^2) with a = 1
 * + chi/2. */
TEST(detections_are_as_likely_as_published)
{
    static const double snr_db[6] = {0, 6, 10, 13, 15, 20};
    static const struct {
        enum fluctuation_law law;
        double probability[6];
    } rows[] = {
        {FLUCTUATION_NONE, {0.003681, 0.092480, 0.616136, 0.983047, 0.999910, 1.000000}},
        {FLUCTUATION_SWERLING_1, {0.010000, 0.157384, 0.432876, 0.644307, 0.754026, 0.912843}},
        {FLUCTUATION_SWERLING_3, {0.006564, 0.140198, 0.491042, 0.761637, 0.876107, 0.982573}},
    };
    double threshold = -log(1e-4);
    for (size_t i = 0; i < COUNT(rows); i++) {
        int hits[6] = {0};
        for (uint32_t draw = 0; draw < DRAWS; draw++) {
            double power = power_at(rows[i].law, 0, draw);
            double noise[4];
            random_gaussian(&ADDRESS, RANDOM_POINTERS, draw, noise);
            for (int k = 0; k < 6; k++) {
                double re = sqrt(pow(10, snr_db[k] / 10) * power) + noise[0] / sqrt(2);
                hits[k] += re * re + noise[1] * noise[1] / 2 > threshold;
            }
        }
        for (int k = 0; k < 6; k++) {
            double p = rows[i].probability[k];
            assert_close((double)hits[k] / DRAWS, p, 1e-6 + 4.5 * sqrt(p * (1 - p) / DRAWS));
        }
    }
}

static int ascending(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* MODEL 14.18: mean and deviation in dB of exponential power and of the gamma law of shape 2; their
 * medians are at 1 - exp(-p) = 1/2 and 1 - (1 + 2 p) exp(-2 p) = 1/2. Each within 5 standard
 * errors.
 */
TEST(powers_have_the_published_statistics)
{
    static const struct {
        enum fluctuation_law law;
        double median_db, mean_db, deviation_db, variance;
    } rows[] = {{FLUCTUATION_SWERLING_1, -1.591745, -2.506816, 5.570043, 1},
                {FLUCTUATION_SWERLING_3, -0.761480, -1.174171, 3.487723, 0.5}};
    double *db = malloc(DRAWS * sizeof *db);
    for (size_t i = 0; i < 2; i++) {
        double mean = 0, squares = 0, mean_db = 0, squares_db = 0;
        for (uint32_t draw = 0; draw < DRAWS; draw++) {
            double power = power_at(rows[i].law, 0, draw);
            db[draw] = 10 * log10(power);
            mean += power / DRAWS;
            squares += (power - 1) * (power - 1) / DRAWS;
            mean_db += db[draw] / DRAWS;
            squares_db += db[draw] * db[draw] / DRAWS;
        }
        qsort(db, DRAWS, sizeof *db, ascending);
        assert_close(mean, 1, 5 * sqrt(rows[i].variance / DRAWS));
        assert_close(squares, rows[i].variance, 5 * 3 * rows[i].variance / sqrt(DRAWS));
        assert_close(mean_db, rows[i].mean_db, 5 * rows[i].deviation_db / sqrt(DRAWS));
        assert_close(sqrt(squares_db - mean_db * mean_db), rows[i].deviation_db,
                     5 * rows[i].deviation_db / sqrt(DRAWS));
        assert_close(db[DRAWS / 2], rows[i].median_db, 0.05);
    }
    free(db);
}

static double tail(double x)
{
    return 0.5 * erfc(x / sqrt(2));
}

/* MODEL 14.14: s = 3.41 dB has its mean at -1.338734 dB; the cut takes 0.3 % of the mean power. */
TEST(a_log_normal_echo_is_gaussian_in_decibels_and_cut)
{
    double sigma_db = 3.41, above = 0;
    double mean = 0, mean_db = 0, squares_db = 0;
    for (uint32_t draw = 0; draw < DRAWS; draw++) {
        double power = power_at(FLUCTUATION_LOG_NORMAL, sigma_db, draw);
        double db = 10 * log10(power);
        assert_true(db <= -1.338734 + 3 * sigma_db + 1e-6);
        above += db > -1.338734 + 3 * sigma_db - 1e-6;
        mean += power / DRAWS;
        mean_db += db / DRAWS;
        squares_db += (db + 1.338734) * (db + 1.338734) / DRAWS;
    }
    double a = sigma_db * log(10) / 10;
    double expected = tail(a - 3) + exp(3 * a - a * a / 2) * tail(3);
    assert_close(expected, 0.997, 5e-4);
    assert_close(mean, expected, 5 * 0.9 / sqrt(DRAWS));
    assert_close(mean_db, -1.338734, 5 * sigma_db / sqrt(DRAWS) + 2e-3);
    assert_close(sqrt(squares_db), sigma_db, 5 * sigma_db / sqrt(2.0 * DRAWS) + 1e-2);
    assert_close(above / DRAWS, tail(3), 5 * sqrt(tail(3) / DRAWS));
}

TEST(no_fluctuation_is_exactly_one)
{
    for (uint32_t draw = 0; draw < 1000; draw++) {
        assert_close(power_at(FLUCTUATION_NONE, 5, draw), 1, 0);
        assert_close(power_at(FLUCTUATION_LOG_NORMAL, 0, draw), 1, 0);
    }
}

/* -ln 2^-53 = 53 ln 2; -ln(1 - 2^-53) = 2^-53; a Gaussian draw reaches sqrt(106 ln 2) = 8.57. */
TEST(no_draw_is_beyond_the_extreme_ones)
{
    double mean_db = -log(10) / 20 * 9, gaussian = sqrt(106 * log(2));
    const struct {
        enum fluctuation_law law;
        double least, most;
    } rows[] = {
        {FLUCTUATION_SWERLING_1, 0x1p-26 / sqrt(2), sqrt(53 * log(2))},
        {FLUCTUATION_SWERLING_3, 0x1p-26 / sqrt(2), sqrt(53 * log(2))},
        {FLUCTUATION_LOG_NORMAL, pow(10, (mean_db - 3 * gaussian) / 20),
         pow(10, (mean_db + 9) / 20)},
    };
    static const double extremes[] = {RANDOM_LEAST, 3 * RANDOM_LEAST,     0.25,       0.5,
                                      0.75,         1 - 3 * RANDOM_LEAST, RANDOM_MOST};
    for (size_t i = 0; i < COUNT(rows); i++) {
        double least = HUGE_VAL, most = 0;
        for (int k = 0; k < 49; k++) {
            double uniform[4] = {extremes[k / 7], extremes[k % 7]};
            double factor = detection_fluctuation(rows[i].law, 3, uniform);
            least = fmin(least, factor);
            most = fmax(most, factor);
        }
        assert_near(least, rows[i].least, 1e-14);
        assert_near(most, rows[i].most, 1e-14);
    }
}
