#include "check.h"

#include "noise/detection_quality.h"
#include "sample.h"

/* Half a false alarm is expected from a power of 4 on, over noise of 1, and echoes from there. */
static struct existence expecting(void)
{
    return (struct existence){.false_alarms = 0.5,
                              .search_noise = 1,
                              .least_false_alarm = 4,
                              .least_echo = 4,
                              .weakest = 4,
                              .rise = 1};
}

static double existence_of(const struct existence *existence, double power)
{
    struct detection_evidence alone = {.power = power};
    detection_quality_weigh(existence, &alone, 1);
    return alone.existence;
}

/* By hand: a quarter of an echo is expected, evenly over the 10 dB from 4 on: at 4 with the density
 * 1/4/(4 ln 10), where that of false alarms is 1/2; at 14 with 1/4/(14 ln 10) beside exp(-10)/2. */
TEST(the_only_detection_of_a_scan_has_a_quarter_of_an_echo_beside_noise)
{
    struct existence existence = expecting();
    double echo = 0.25 / (4 * log(10));
    assert_near(existence_of(&existence, 4), echo / (echo + 0.5), 1e-14);
    echo = 0.25 / (14 * log(10));
    assert_near(existence_of(&existence, 14), echo / (echo + exp(-10) / 2), 1e-14);
}

/* Bayes' rule for each one of three, where 1/4 and the others' probabilities are expected. */
TEST(the_others_of_a_scan_tell_how_many_weak_echoes_to_expect)
{
    struct existence existence = expecting();
    struct detection_evidence scan[] = {{.power = 4.5}, {.power = 8}, {.power = 11}};
    detection_quality_weigh(&existence, scan, COUNT(scan));
    for (size_t i = 0; i < COUNT(scan); i++) {
        double power = scan[i].power, expected = 0.25;
        for (size_t other = 0; other < COUNT(scan); other++)
            expected += other != i ? scan[other].existence : 0;
        double echo = expected / (power * log(10)), noise = 0.5 * exp(4 - power);
        assert_near(scan[i].existence, echo / (echo + noise), 1e-6);
    }
    assert_true(scan[0].existence > 3 * existence_of(&existence, 4.5));
}

TEST(strong_echoes_do_not_tell_how_many_are_weak)
{
    struct existence existence = expecting();
    struct detection_evidence scan[] = {{.power = 5}, {.power = 40.1}, {.power = 1e6}};
    detection_quality_weigh(&existence, scan, COUNT(scan));
    assert_close(scan[0].existence, existence_of(&existence, 5), 0);
    scan[1].power = 39.9;
    detection_quality_weigh(&existence, scan, COUNT(scan));
    assert_true(scan[0].existence > 2 * existence_of(&existence, 5));
}

TEST(powers_that_one_cause_alone_can_have_are_certain)
{
    struct existence existence = expecting();
    existence.least_echo = 8;
    existence.rise = 2;
    assert_close(existence_of(&existence, 3), 1, 0);
    assert_close(existence_of(&existence, 6), 0, 0);
    assert_true(existence_of(&existence, 8) > 0);
    assert_close(existence_of(&existence, 1e6), 1, 0);
    existence.false_alarms = 0;
    assert_close(existence_of(&existence, 6), 1, 0);
}

/* Marcum's Q1(sqrt(2 z/rise), sqrt(2 first/rise)), integrated numerically (MODEL 14.21): the share
 * of the echoes of power z that met the first threshold before the noise. */
TEST(echoes_that_fail_the_first_threshold_are_taken_out_of_the_expected_ones)
{
    static const struct {
        double rise, power, first, share;
    } rows[] = {{1, 4, 5, 0.435072015851},
                {1, 6, 5, 0.675549620054},
                {3, 15, 16, 0.521736568899},
                {3, 30, 16, 0.909558904352},
                {1, 64, 63.7, 0.528242134368}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct existence existence = expecting();
        existence.least_false_alarm = rows[i].power - 1;
        existence.least_echo = 0;
        existence.first_threshold = rows[i].first;
        existence.rise = rows[i].rise;
        double echo = 0.25 * rows[i].share / (rows[i].power * log(10)), noise = 0.5 * exp(-1);
        assert_near(existence_of(&existence, rows[i].power), echo / (echo + noise), 1e-6);
    }
}

/* A count whose mean varies from scan to scan, as a gamma law of shape 1/4 and mean 20 has it. */
static size_t echoes_of_scan(uint64_t *sample)
{
    const double shape = 0.25, mean = 20, next = mean / (mean + shape);
    double left = sample_between(sample, 0, 1), share = pow(1 - next, shape);
    size_t count = 0;
    for (; left > share && count < 200; count++) {
        left -= share;
        share *= next * ((double)count + shape) / (double)(count + 1);
    }
    return count;
}

static size_t false_alarms_of_scan(uint64_t *sample, double mean)
{
    size_t count = 0;
    while ((mean += log(sample_between(sample, 0, 1))) > 0)
        count++;
    return count;
}

struct bin {
    double count, expected, variance, echoes;
};

static void tally(const struct detection_evidence *scan, size_t count, size_t echoes,
                  struct bin *bins)
{
    for (size_t i = 0; i < count; i++) {
        double probability = scan[i].existence;
        struct bin *bin = &bins[probability == 1 ? 9 : (int)(10 * probability)];
        bin->count++;
        bin->expected += probability;
        bin->variance += probability * (1 - probability);
        bin->echoes += i < echoes;
    }
}

/* Scans with no echo up to a hundred; each bin within three deviations and 0.025. */
TEST(of_detections_with_a_probability_so_many_are_echoes)
{
    struct existence existence = expecting();
    existence.least_false_alarm = existence.least_echo = existence.weakest = 16;
    existence.false_alarms = 2;
    uint64_t sample = 7;
    struct bin bins[10] = {{0}};
    for (int i = 0; i < 20000; i++) {
        struct detection_evidence scan[300];
        size_t echoes = echoes_of_scan(&sample), count = 0;
        size_t alarms = false_alarms_of_scan(&sample, existence.false_alarms);
        assert_true(echoes + alarms < COUNT(scan));
        for (; count < echoes; count++)
            scan[count].power = 16 * pow(10, sample_between(&sample, 0, 1));
        for (; count < echoes + alarms; count++)
            scan[count].power = 16 - log(sample_between(&sample, 0, 1));
        detection_quality_weigh(&existence, scan, count);
        tally(scan, count, echoes, bins);
    }
    for (size_t i = 0; i < COUNT(bins); i++) {
        assert_true(bins[i].variance > 100);
        assert_close(bins[i].echoes, bins[i].expected,
                     3 * sqrt(bins[i].variance) + 0.025 * bins[i].count);
    }
}
