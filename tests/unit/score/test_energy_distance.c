#include "check.h"

#include "sample.h"
#include "score/energy_distance.h"
#include "score/relative_error.h"

enum { MOST = 64 };

/* Lists that are numbers, whose distance is their difference. */
static struct energy_sample sample_of(const double *place, size_t ones, size_t others,
                                      double *distance)
{
    size_t all = ones + others;
    for (size_t i = 0; i < all; i++)
        for (size_t j = 0; j < all; j++)
            distance[i * all + j] = fabs(place[i] - place[j]);
    return (struct energy_sample){distance, ones, others};
}

TEST(two_lists_of_each_follow_the_definition)
{
    double distance[MOST];
    struct energy_sample sample = sample_of((double[]){0, 1, 5, 8}, 2, 2, distance);
    /* 2 (5 + 8 + 4 + 7)/4 - 1 - 3 */
    assert_near(energy_distance_of(&sample), 8.0, 1e-15);
}

/* For one target that is there with probability p against q, D = 2 (p - q)^2 |m|. Here all possible
 * lists come as often as they should, so the mean of the estimate over them is D exactly. */
TEST(a_target_listed_more_often_costs_twice_the_squared_difference)
{
    double length = sqrt(3), distance[16];
    for (double p = 0; p <= 1; p += 0.25)
        for (double q = 0; q <= 1; q += 0.125) {
            double expected = 0;
            for (unsigned seen = 0; seen < 16; seen++) {
                double chance = 1, place[4];
                for (int i = 0; i < 4; i++) {
                    bool there = (seen >> i & 1) != 0;
                    double share = i < 2 ? p : q;
                    chance *= there ? share : 1 - share;
                    place[i] = there ? length : 0;
                }
                struct energy_sample sample = sample_of(place, 2, 2, distance);
                expected += chance * energy_distance_of(&sample);
            }
            assert_close(expected, 2 * (p - q) * (p - q) * length, 1e-14);
        }
}

/* Numbers even in [0, 1) and in [s, 1 + s): D = 2 E|X - Y| - 2/3 with E|X - Y| = 1/3 + s^2 - s^3/3
 * for s up to 1. The mean over many samples is D; below 0 for equal laws as often as above. */
TEST(estimates_are_unbiased)
{
    enum { ROUNDS = 4000, EACH = 5 };
    uint64_t random = 9;
    for (double shift = 0; shift <= 1; shift += 0.5) {
        double sum = 0, squares = 0, variance = 0, distance[4 * EACH * EACH], place[2 * EACH];
        int below = 0;
        for (int round = 0; round < ROUNDS; round++) {
            for (int i = 0; i < 2 * EACH; i++)
                place[i] = sample_between(&random, 0, 1) + (i < EACH ? 0 : shift);
            struct energy_sample sample = sample_of(place, EACH, EACH, distance);
            struct relative_error found = relative_error_of(&sample, NULL);
            double value = found.value;
            sum += value / ROUNDS;
            squares += value * value / ROUNDS;
            variance += found.deviation * found.deviation / ROUNDS;
            below += value < 0;
        }
        double exact = 2 * (shift * shift - shift * shift * shift / 3);
        double error = sqrt((squares - sum * sum) / ROUNDS);
        assert_close(sum, exact, 3 * error);
        assert_true(shift > 0 || (below > ROUNDS / 2 && below < 0.7 * ROUNDS));
        assert_true(variance >= 0.9 * (squares - sum * sum)); /* the jackknife errs upwards */
    }
}

/* A closed list of count targets. */
static struct embedded_list list_of(const struct embedded_target *targets, size_t count,
                                    struct arena *arena)
{
    struct embedded_list list = {0};
    for (size_t i = 0; i < count; i++)
        *list_add(&list.targets, arena) = targets[i];
    energy_distance_close(&list, arena);
    return list;
}

static double distance_of(const struct embedded_target *one, size_t ones,
                          const struct embedded_target *other, size_t others)
{
    struct embedded_list a = list_of(one, ones, check_arena()),
                         b = list_of(other, others, check_arena());
    double distance = energy_distance_of_lists(&a, &b);
    assert_near(energy_distance_of_lists(&b, &a), distance, 1e-14);
    return distance;
}

TEST(a_target_more_is_the_length_of_its_kernel)
{
    const struct embedded_target targets[] = {{{3, 4, 5, 6}}, {{1e6, 0, 0, 0}}};
    assert_near(distance_of(targets, 0, targets, 1), sqrt(3), 1e-15);
    assert_near(distance_of(targets, 1, targets, 2), sqrt(3), 1e-15);
    assert_close(distance_of(targets, 2, targets, 2), 0, 0);
    assert_close(distance_of(targets, 0, targets, 0), 0, 0);
}

/* |m(x) - m(y)|^2 = 2 (3 - sum of exp(-s^2/2w^2)), whatever the direction of the shift. */
TEST(a_shifted_target_is_as_far_as_its_kernels_say)
{
    for (int axis = 0; axis < EMBEDDED_AXES; axis++)
        for (double shift = -40; shift <= 40; shift += 0.7) {
            struct embedded_target at = {{1, 2, 3, 4}}, moved = at;
            moved.axis[axis] += shift;
            double s = moved.axis[axis] - at.axis[axis];
            double overlap = exp(-s * s / 2) + exp(-s * s / 18) + exp(-s * s / 200);
            assert_close(distance_of(&at, 1, &moved, 1), sqrt(2 * (3 - overlap)), 1e-14);
        }
}

static double overlap_of(const struct embedded_target *one, size_t ones,
                         const struct embedded_target *other, size_t others)
{
    double sum = 0;
    for (size_t i = 0; i < ones; i++)
        for (size_t j = 0; j < others; j++) {
            double square = 0;
            for (int k = 0; k < EMBEDDED_AXES; k++)
                square += pow(one[i].axis[k] - other[j].axis[k], 2);
            sum += exp(-square / 2) + exp(-square / 18) + exp(-square / 200);
        }
    return sum;
}

/* Some pairs overlap, others are too far apart in range or in rate. */
TEST(lists_over_all_ranges_overlap_where_targets_are_near)
{
    uint64_t sample = 8;
    for (int round = 0; round < 100; round++) {
        struct embedded_target all[30] = {0};
        for (int i = 0; i < 30; i++) {
            all[i].axis[0] = sample_between(&sample, 0, 300);
            all[i].axis[2] = sample_between(&sample, -60, 60);
        }
        double square = overlap_of(all, 10, all, 10) + overlap_of(all + 10, 20, all + 10, 20) -
                        2 * overlap_of(all, 10, all + 10, 20);
        assert_near(distance_of(all, 10, all + 10, 20), sqrt(square), 1e-13);
    }
}

TEST(twice_the_same_target_is_twice_as_far_from_none)
{
    const struct embedded_target twice[] = {{{1, 2, 3, 4}}, {{1, 2, 3, 4}}};
    assert_near(distance_of(twice, 2, twice, 0), 2 * sqrt(3), 1e-15);
    assert_near(distance_of(twice, 2, twice, 1), sqrt(3), 1e-15);
}

static void draw_targets(uint64_t *sample, double bound, struct embedded_target *targets,
                         size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < EMBEDDED_AXES; k++)
            targets[i].axis[k] = sample_between(sample, -bound, bound);
}

TEST(the_order_of_targets_changes_no_bit)
{
    uint64_t sample = 5;
    for (int round = 0; round < 100; round++) {
        struct embedded_target one[9], turned[9], other[7];
        draw_targets(&sample, 5, one, 9);
        draw_targets(&sample, 5, other, 7);
        for (int i = 0; i < 9; i++)
            turned[(4 * i + round) % 9] = one[i];
        assert_close(distance_of(turned, 9, other, 7), distance_of(one, 9, other, 7), 0);
        assert_close(distance_of(turned, 9, one, 9), 0, 0);
    }
}

TEST(the_distance_of_lists_is_a_metric)
{
    uint64_t sample = 6;
    for (int round = 0; round < 300; round++) {
        struct embedded_target all[9];
        draw_targets(&sample, 3, all, 9);
        double ab = distance_of(all, 3, all + 3, 2), bc = distance_of(all + 3, 2, all + 5, 4);
        assert_true(distance_of(all, 3, all + 5, 4) <= ab + bc);
    }
}
