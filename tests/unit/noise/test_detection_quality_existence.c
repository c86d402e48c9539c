#include "check.h"

#include "noise/detection_quality.h"
#include "sample.h"

/* One echo of this mean power is expected, and 1/2 false alarm over noise of 1. */
static struct existence expecting(double snr)
{
    return (struct existence){
        .echoes = 1, .snr = snr, .false_alarms = 0.5, .search_noise = 1, .rise = 1};
}

/* By hand: with one echo of mean power 9 and 1/2 false alarm from 4 on, a power of 4 has the
 * densities exp(-0.4)/10 and 1/2, one of 14 has exp(-1.4)/10 and exp(-10)/2. */
TEST(probabilities_are_those_of_bayes_rule)
{
    struct existence existence = expecting(9);
    existence.least_false_alarm = existence.least_echo = 4;
    double echo = exp(-0.4) / 10;
    assert_near(detection_quality_existence(&existence, 4), echo / (echo + 0.5), 1e-14);
    echo = exp(-1.4) / 10;
    assert_near(detection_quality_existence(&existence, 14), echo / (echo + exp(-10) / 2), 1e-14);
}

TEST(powers_that_one_cause_alone_can_have_are_certain)
{
    struct existence existence = expecting(9);
    existence.least_false_alarm = 4;
    existence.least_echo = 8;
    existence.rise = 2;
    assert_close(detection_quality_existence(&existence, 3), 1, 0);
    assert_close(detection_quality_existence(&existence, 6), 0, 0);
    assert_true(detection_quality_existence(&existence, 8) > 0);
    assert_close(detection_quality_existence(&existence, 1e6), 1, 0);
    existence.false_alarms = 0;
    assert_close(detection_quality_existence(&existence, 6), 1, 0);
}

/* Where the prior's mean is below that of the noise's tail, strong detections are rarer echoes than
 * noise, and no density underflows on the way. */
TEST(densities_below_the_least_double_still_compare)
{
    const struct existence existence = expecting(1e-3);
    double log_odds = log(0.5 * 1.001) - 2000 + 2000 / 1.001;
    assert_near(detection_quality_existence(&existence, 2000), 1 / (1 + exp(log_odds)), 1e-12);
}

/* Marcum's Q1(sqrt(2 z) S/(s w), sqrt(2 z_T)/w), integrated numerically (MODEL 14.21): the share of
 * the echoes of power z that met z_T before the noise. */
TEST(echoes_that_fail_the_first_threshold_are_taken_out_of_the_expected_ones)
{
    static const struct {
        double snr, rise, power, first, share;
    } rows[] = {{10, 1, 4, 5, 0.326459988433},
                {10, 1, 6, 5, 0.555573903194},
                {10, 3, 15, 16, 0.213966075743},
                {10, 3, 30, 16, 0.629640724351},
                {100, 1, 64, 63.7, 0.483412128171}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct existence existence = expecting(rows[i].snr);
        existence.echoes = 2;
        existence.least_false_alarm = rows[i].power - 1;
        existence.first_threshold = rows[i].first;
        existence.rise = rows[i].rise;
        double mean = rows[i].rise + rows[i].snr;
        double echo = 2 * rows[i].share * exp(-rows[i].power / mean) / mean;
        double noise = 0.5 * exp(-1);
        double probability = detection_quality_existence(&existence, rows[i].power);
        assert_near(probability, echo / (echo + noise), 1e-6);
    }
}

struct bin {
    double expected, variance, echoes;
};

/* A world drawn from the prior: echoes of exponential power in complex Gaussian noise, and false
 * alarms above the threshold. */
TEST(of_detections_with_a_probability_so_many_are_echoes)
{
    struct existence existence = expecting(30);
    existence.echoes = 3;
    existence.false_alarms = 1;
    existence.least_false_alarm = existence.least_echo = 6;
    uint64_t sample = 7;
    struct bin bins[10] = {{0}};
    for (int i = 0; i < 400000; i++) {
        bool echo = sample_between(&sample, 0, 4) < 3;
        double draw = -log(1 - sample_between(&sample, 0, 1));
        double power = echo ? 31 * draw : 6 + draw;
        if (power < 6)
            continue;
        double probability = detection_quality_existence(&existence, power);
        struct bin *bin = &bins[probability == 1 ? 9 : (int)(10 * probability)];
        bin->expected += probability;
        bin->variance += probability * (1 - probability);
        bin->echoes += echo;
    }
    int filled = 0;
    for (size_t i = 0; i < COUNT(bins); i++) {
        filled += bins[i].variance > 100;
        assert_close(bins[i].echoes, bins[i].expected, 3 * sqrt(bins[i].variance) + 1e-9);
    }
    assert_true(filled >= 8);
}
