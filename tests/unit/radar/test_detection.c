#include "check.h"

#include "base/random.h"
#include "radar/detection.h"

/* Marcum's Q(sqrt 2 A, sqrt 2 T) for noise of power 1, by its series of Poisson terms. */
static double marcum(double amplitude, double threshold)
{
    double x = amplitude * amplitude, y = threshold * threshold;
    double weight = exp(-x), term = exp(-y), below = term, sum = weight * below;
    for (int k = 1; k < 2000; k++) {
        weight *= x / k;
        term *= y / k;
        below += term;
        sum += weight * below;
    }
    return sum;
}

TEST(noise_carries_an_echo_over_the_threshold_by_marcums_function)
{
    static const double thresholds[] = {0.5, 2, 3.0348, 8, 15};
    static const double shares[] = {0, 1e-9, 0.5, 0.9, 1 - 1e-9, 1, 1.01, 1.2, 1.7};
    for (size_t i = 0; i < COUNT(thresholds); i++)
        for (size_t k = 0; k < COUNT(shares); k++) {
            double amplitude = shares[k] * thresholds[i];
            assert_close(detection_in_noise(3 * amplitude, 3 * thresholds[i], 3),
                         marcum(amplitude, thresholds[i]), 1e-12);
        }
    assert_close(detection_in_noise(0, 2, 1), exp(-4), 1e-12);
}

TEST(without_noise_the_threshold_decides)
{
    assert_close(detection_in_noise(2, 2, 0), 1, 0);
    assert_close(detection_in_noise(1.999, 2, 0), 0, 0);
    assert_close(detection_in_noise(1.999, 2, 1e-6), 0, 0);
    struct detection_law detection = {.threshold = 2, .final_threshold = 2, .noise = 0};
    assert_close(detection_probability(&detection, 2), 1, 0);
    assert_close(detection_probability(&detection, 1.999), 0, 0);
}

TEST(without_a_final_threshold_the_laws_tails_decide)
{
    for (double amplitude = 0.3; amplitude < 30; amplitude *= 1.7) {
        double power = 4 / (amplitude * amplitude);
        struct detection_law detection = {.fluctuation = FLUCTUATION_SWERLING_1, .threshold = 2};
        assert_close(detection_probability(&detection, amplitude), exp(-power), 1e-6);
        detection.fluctuation = FLUCTUATION_SWERLING_3;
        assert_close(detection_probability(&detection, amplitude),
                     (1 + 2 * power) * exp(-2 * power), 1e-6);
        detection.fluctuation = FLUCTUATION_LOG_NORMAL;
        detection.fluctuation_sigma_db = 3.41;
        double mean_db = -log(10) / 20 * 3.41 * 3.41;
        double deviations = (10 * log10(power) - mean_db) / 3.41;
        assert_close(detection_probability(&detection, amplitude),
                     deviations > 3 ? 0 : erfc(deviations / sqrt(2)) / 2, 1e-6);
        detection.fluctuation_sigma_db = 0;
        assert_close(detection_probability(&detection, amplitude), power <= 1, 0);
    }
}

/* The closed forms of gamma laws of the power, whose mean is S times the noise's, at y times it. */
TEST(with_a_final_threshold_alone_fluctuating_echoes_are_detected_by_swerlings_closed_forms)
{
    static const double noises[] = {0.001, 0.02, 0.1, 0.25, 0.5, 1, 2};
    for (size_t i = 0; i < COUNT(noises); i++)
        for (double amplitude = 0.5; amplitude < 20; amplitude *= 1.3) {
            struct detection_law detection = {
                .fluctuation = FLUCTUATION_SWERLING_1, .final_threshold = 2, .noise = noises[i]};
            double y = 4 / (noises[i] * noises[i]);
            double ratio = pow(amplitude / noises[i], 2), mean = 1 + ratio / 2;
            assert_close(detection_probability(&detection, amplitude), exp(-y / (1 + ratio)), 1e-6);
            detection.fluctuation = FLUCTUATION_SWERLING_3;
            assert_close(detection_probability(&detection, amplitude),
                         exp(-y / mean) * (1 + ratio / 2 * y / (mean * mean)), 1e-6);
        }
}

/* The sum over 20,000 levels with a deviation of 6 dB. */
TEST(levels_of_bodies_are_summed_where_noise_decides)
{
    static const double firsts[] = {0, 1.5625, 2};
    for (size_t i = 0; i < COUNT(firsts); i++)
        for (double amplitude = 0.7; amplitude < 9; amplitude *= 2) {
            struct detection_law detection = {
                .threshold = firsts[i], .final_threshold = 2, .noise = 0.25, .level_sigma_db = 6};
            double sum = 0;
            for (int k = -10000; k < 10000; k++) {
                double deviations = (k + 0.5) / 1666;
                double echo = amplitude * pow(10, 6 * deviations / 20);
                double passes = echo < 4 ? marcum(4 * echo, 8) : 1;
                if (echo >= firsts[i])
                    sum += passes * exp(-deviations * deviations / 2) / sqrt(2 * acos(-1)) / 1666;
            }
            assert_close(detection_probability(&detection, amplitude), sum, 1e-4);
        }
}

/* Of normal factors the mean of the power is 1; that they are cut changes less than 1e-4. */
TEST(a_narrow_factor_beside_a_level_is_a_wider_level)
{
    for (double sigma_db = 0.05; sigma_db < 1; sigma_db *= 3)
        for (double amplitude = 0.7; amplitude < 9; amplitude *= 2) {
            struct detection_law both = {.fluctuation = FLUCTUATION_LOG_NORMAL,
                                         .fluctuation_sigma_db = sigma_db,
                                         .final_threshold = 2,
                                         .noise = 0.02,
                                         .level_sigma_db = 6};
            struct detection_law wider = both;
            wider.fluctuation = FLUCTUATION_NONE;
            wider.level_sigma_db = hypot(6, sigma_db);
            wider.level_mean_db = -log(10) / 20 * sigma_db * sigma_db;
            assert_close(detection_probability(&both, amplitude),
                         detection_probability(&wider, amplitude), 1e-4);
        }
}

TEST(the_lowered_threshold_takes_little_from_marcums_function)
{
    static const double thresholds_db[] = {4, 6, 10, 13.2, 18.1, 26};
    static const double most[] = {0, 0.024, 0.012, 0.012, 0.012, 0.012};
    for (size_t i = 0; i < COUNT(thresholds_db); i++) {
        double threshold = pow(10, thresholds_db[i] / 20);
        struct detection_law detection = {.final_threshold = threshold, .noise = 1};
        detection.threshold = detection_lowered_threshold(threshold, 1);
        for (double amplitude = 0.02; amplitude < threshold + 3; amplitude += 0.02) {
            double lost =
                marcum(amplitude, threshold) - detection_probability(&detection, amplitude);
            assert_close(lost, 0, most[i] + 1e-12);
        }
    }
    assert_close(detection_lowered_threshold(2, 0), 2, 0);
    assert_close(detection_lowered_threshold(2, 0.4), 1.3, 1e-15);
    assert_close(detection_lowered_threshold(2, 1.2), 0, 0);
}

/* Both thresholds, by drawing factors and noise as the stages do. */
TEST(both_thresholds_together_are_those_of_drawn_echoes)
{
    enum { DRAWS = 100000 };
    static const enum fluctuation_law laws[] = {FLUCTUATION_SWERLING_1, FLUCTUATION_SWERLING_3,
                                                FLUCTUATION_LOG_NORMAL};
    static const double noises[] = {0.25, 1};
    for (int i = 0; i < 6; i++) {
        struct detection_law detection = {.fluctuation = laws[i / 2],
                                          .fluctuation_sigma_db = 3.41,
                                          .threshold = 2,
                                          .final_threshold = 2,
                                          .noise = noises[i % 2]};
        double amplitude = 1.5 + 0.5 * i;
        int64_t found = 0;
        for (int k = 0; k < DRAWS; k++) {
            struct random_address address = {.seed = 7, .frame = (uint64_t)k};
            double uniform[4], noise[4];
            random_uniform(&address, RANDOM_OWN, 0, uniform);
            random_gaussian(&address, RANDOM_POINTERS, 0, noise);
            double steady = amplitude * detection_fluctuation(laws[i / 2], 3.41, uniform);
            double part = detection.noise * sqrt(0.5);
            found += steady >= 2 && hypot(steady + part * noise[0], part * noise[1]) >= 2;
        }
        double share = (double)found / DRAWS;
        assert_close(detection_probability(&detection, amplitude), share,
                     4 * sqrt(share * (1 - share) / DRAWS));
    }
}

/* The normal tail without noise; with a fluctuation beside it, its closed form over many levels. */
TEST(a_level_beside_the_fluctuation_spreads_the_echo)
{
    for (double amplitude = 0.5; amplitude < 40; amplitude *= 2.1) {
        struct detection_law level = {.threshold = 2, .level_mean_db = -4, .level_sigma_db = 6};
        double short_db = 20 * log10(2 / amplitude) + 4;
        assert_close(detection_probability(&level, amplitude), erfc(short_db / 6 / sqrt(2)) / 2,
                     1e-6);
        level.fluctuation = FLUCTUATION_SWERLING_1;
        double expected = 0;
        for (int i = -5000; i < 5000; i++) {
            double deviations = (i + 0.5) / 500;
            double power = 4 / pow(amplitude * pow(10, (-4 + 6 * deviations) / 20), 2);
            expected += exp(-power - deviations * deviations / 2) / sqrt(2 * acos(-1)) / 500;
        }
        assert_close(detection_probability(&level, amplitude), expected, 1e-6);
    }
}

TEST(levels_that_vary_by_less_than_any_rounding_are_steady)
{
    static const enum fluctuation_law laws[] = {FLUCTUATION_NONE, FLUCTUATION_LOG_NORMAL,
                                                FLUCTUATION_SWERLING_1};
    for (int i = 0; i < 3; i++)
        for (double sigma_db = 1e-17; sigma_db > 0; sigma_db *= 1e-9) {
            struct detection_law steady = {.fluctuation = laws[i], .threshold = 2};
            struct detection_law tiny = steady;
            tiny.fluctuation_sigma_db = tiny.level_sigma_db = sigma_db;
            double expected = detection_probability(&steady, 2.5);
            assert_close(detection_probability(&tiny, 2.5), expected, 1e-6);
        }
}

TEST(the_amplitude_of_a_probability_is_detected_with_it)
{
    struct detection_law detection = {
        .fluctuation = FLUCTUATION_SWERLING_1, .threshold = 2, .final_threshold = 2, .noise = 0.25};
    double probability = detection_probability(&detection, 5);
    assert_near(detection_amplitude(&detection, probability), 5.0, 1e-6);
    /* A steady echo just above the first threshold passes the final one with more than 0.5. */
    detection.fluctuation = FLUCTUATION_NONE;
    assert_near(detection_amplitude(&detection, 0.3), 2.0, 1e-6);
    detection.level_mean_db = -100;
    detection.level_sigma_db = 30;
    double far = detection_amplitude(&detection, 0.99);
    assert_close(detection_probability(&detection, far), 0.99, 1e-6);
}
