#include "check.h"

#include "sample.h"
#include "score/list_embedding.h"

/* A closed list of count targets. */
static struct embedded_list list_of(const struct embedded_target *targets, size_t count,
                                    struct arena *arena)
{
    struct embedded_list list = {0};
    for (size_t i = 0; i < count; i++)
        *list_add(&list.targets, arena) = targets[i];
    list_embedding_close(&list, arena);
    return list;
}

static double distance_of(const struct embedded_target *one, size_t ones,
                          const struct embedded_target *other, size_t others)
{
    struct arena arena = {0};
    struct embedded_list a = list_of(one, ones, &arena), b = list_of(other, others, &arena);
    double distance = list_embedding_distance(&a, &b);
    assert_near(list_embedding_distance(&b, &a), distance, 1e-14);
    arena_free(&arena);
    return distance;
}

static void a_target_more_is_the_length_of_its_kernel(void **state)
{
    (void)state;
    const struct embedded_target targets[] = {{{3, 4, 5, 6}}, {{1e6, 0, 0, 0}}};
    assert_near(distance_of(targets, 0, targets, 1), sqrt(3), 1e-15);
    assert_near(distance_of(targets, 1, targets, 2), sqrt(3), 1e-15);
    assert_close(distance_of(targets, 2, targets, 2), 0, 0);
    assert_close(distance_of(targets, 0, targets, 0), 0, 0);
}

/* |m(x) - m(y)|^2 = 2 (3 - sum of exp(-s^2/2w^2)), whatever the direction of the shift. */
static void a_shifted_target_is_as_far_as_its_kernels_say(void **state)
{
    (void)state;
    for (int axis = 0; axis < LIST_EMBEDDING_AXES; axis++)
        for (double shift = -40; shift <= 40; shift += 0.7) {
            struct embedded_target at = {{1, 2, 3, 4}}, moved = at;
            moved.axis[axis] += shift;
            double s = moved.axis[axis] - at.axis[axis];
            double overlap = exp(-s * s / 2) + exp(-s * s / 18) + exp(-s * s / 200);
            assert_close(distance_of(&at, 1, &moved, 1), sqrt(2 * (3 - overlap)), 1e-14);
        }
}

static void twice_the_same_target_is_twice_as_far_from_none(void **state)
{
    (void)state;
    const struct embedded_target twice[] = {{{1, 2, 3, 4}}, {{1, 2, 3, 4}}};
    assert_near(distance_of(twice, 2, twice, 0), 2 * sqrt(3), 1e-15);
    assert_near(distance_of(twice, 2, twice, 1), sqrt(3), 1e-15);
}

static void the_order_of_targets_changes_no_bit(void **state)
{
    (void)state;
    uint64_t sample = 5;
    for (int round = 0; round < 100; round++) {
        struct embedded_target one[9], turned[9], other[7];
        for (int i = 0; i < 9; i++)
            for (int k = 0; k < LIST_EMBEDDING_AXES; k++)
                one[i].axis[k] = sample_between(&sample, -5, 5);
        for (int i = 0; i < 7; i++)
            for (int k = 0; k < LIST_EMBEDDING_AXES; k++)
                other[i].axis[k] = sample_between(&sample, -5, 5);
        for (int i = 0; i < 9; i++)
            turned[(4 * i + round) % 9] = one[i];
        assert_close(distance_of(turned, 9, other, 7), distance_of(one, 9, other, 7), 0);
        assert_close(distance_of(turned, 9, one, 9), 0, 0);
    }
}

static void the_distance_of_lists_is_a_metric(void **state)
{
    (void)state;
    uint64_t sample = 6;
    for (int round = 0; round < 300; round++) {
        struct embedded_target all[9];
        for (int i = 0; i < 9; i++)
            for (int k = 0; k < LIST_EMBEDDING_AXES; k++)
                all[i].axis[k] = sample_between(&sample, -3, 3);
        double ab = distance_of(all, 3, all + 3, 2), bc = distance_of(all + 3, 2, all + 5, 4);
        assert_true(distance_of(all, 3, all + 5, 4) <= ab + bc);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_target_more_is_the_length_of_its_kernel),
        cmocka_unit_test(a_shifted_target_is_as_far_as_its_kernels_say),
        cmocka_unit_test(twice_the_same_target_is_twice_as_far_from_none),
        cmocka_unit_test(the_order_of_targets_changes_no_bit),
        cmocka_unit_test(the_distance_of_lists_is_a_metric),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
