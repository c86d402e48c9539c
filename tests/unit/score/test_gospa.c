#include "check.h"

#include "sample.h"
#include "score/assignment.h"
#include "score/gospa.h"

enum { LARGEST = 5 };

/* Points on a line, whose distance is their difference. */
struct set {
    size_t count;
    double at[LARGEST];
};

struct answer {
    size_t pairs;
    struct gospa gospa;
    double ospa;
};

static struct answer compare(const struct set *truth, const struct set *list, double cutoff)
{
    struct arena arena = {0};
    double distance[LARGEST * LARGEST], squares = 0;
    size_t item_of[LARGEST];
    for (size_t i = 0; i < truth->count; i++)
        for (size_t j = 0; j < list->count; j++)
            distance[i * list->count + j] = fabs(truth->at[i] - list->at[j]);
    size_t pairs = gospa_pair(distance, truth->count, list->count, cutoff, item_of, &arena);
    for (size_t i = 0; i < truth->count; i++)
        if (item_of[i] != ASSIGNMENT_NONE)
            squares += pow(distance[i * list->count + item_of[i]], 2);
    arena_free(&arena);
    return (struct answer){pairs, gospa_of(squares, pairs, truth->count, list->count, cutoff),
                           gospa_ospa(squares, pairs, truth->count, list->count, cutoff)};
}

static struct set draw(uint64_t *sample)
{
    struct set set = {.count = sample_bits(sample) % (LARGEST + 1)};
    for (size_t i = 0; i < set.count; i++)
        set.at[i] = sample_between(sample, 0, 6);
    return set;
}

static void two_empty_lists_have_no_distance(void **state)
{
    (void)state;
    struct answer answer = compare(&(struct set){0}, &(struct set){0}, 2);
    assert_close(answer.gospa.value, 0, 0);
    assert_close(answer.ospa, 0, 0);
}

static void every_missed_or_false_item_costs_half_a_squared_cutoff(void **state)
{
    (void)state;
    const struct set some = {4, {1, 2, 3, 4}}, none = {0};
    struct answer missed = compare(&some, &none, 3), wrong = compare(&none, &some, 3);
    assert_near(missed.gospa.value, 3 / sqrt(2) * sqrt(4), 1e-15);
    assert_close(missed.gospa.missed_part, 18, 0);
    assert_close(missed.gospa.false_part, 0, 0);
    assert_close(wrong.gospa.value, missed.gospa.value, 0);
    assert_close(wrong.gospa.missed_part, 0, 0);
    assert_close(wrong.gospa.false_part, 18, 0);
    assert_close(missed.ospa, 3, 0);
}

static void one_pair_has_its_own_distance(void **state)
{
    (void)state;
    struct answer near = compare(&(struct set){1, {1}}, &(struct set){1, {2.5}}, 2);
    assert_int_equal(near.pairs, 1);
    assert_close(near.gospa.value, 1.5, 0);
    assert_close(near.ospa, 1.5, 0);
    struct answer far = compare(&(struct set){1, {1}}, &(struct set){1, {9}}, 2);
    assert_int_equal(far.pairs, 0);
    assert_close(far.gospa.value, 2, 1e-15);
    assert_close(far.ospa, 2, 0);
}

static void items_exactly_at_the_cutoff_are_no_pair(void **state)
{
    (void)state;
    struct answer answer = compare(&(struct set){1, {1}}, &(struct set){1, {3}}, 2);
    assert_int_equal(answer.pairs, 0);
    assert_close(answer.gospa.missed_part, 2, 0);
    assert_close(answer.gospa.false_part, 2, 0);
}

/* Ten targets with a cut-off of 2: one moved by 1, one missing, one false, one of each, five
 * missing; and empty lists against one of one and of ten. */
static void ten_targets_give_the_figures_of_the_definitions(void **state)
{
    (void)state;
    static const struct {
        double squares;
        size_t pairs, truths, listed;
        double ospa, gospa;
    } rows[] = {
        {1, 10, 10, 10, 0.316, 1.000}, {0, 9, 10, 9, 0.632, 1.414}, {0, 10, 10, 11, 0.603, 1.414},
        {0, 9, 10, 10, 0.632, 2.000},  {0, 5, 10, 5, 1.414, 3.162}, {0, 0, 0, 1, 2.000, 1.414},
        {0, 0, 0, 10, 2.000, 4.472},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_close(
            gospa_of(rows[i].squares, rows[i].pairs, rows[i].truths, rows[i].listed, 2).value,
            rows[i].gospa, 5e-4);
        assert_close(gospa_ospa(rows[i].squares, rows[i].pairs, rows[i].truths, rows[i].listed, 2),
                     rows[i].ospa, 5e-4);
    }
}

static void both_are_metrics(void **state)
{
    (void)state;
    uint64_t sample = 1;
    for (int round = 0; round < 20000; round++) {
        struct set a = draw(&sample), b = draw(&sample), c = draw(&sample);
        struct answer ab = compare(&a, &b, 2), ba = compare(&b, &a, 2), bc = compare(&b, &c, 2),
                      ac = compare(&a, &c, 2);
        assert_close(ab.gospa.value, ba.gospa.value, 1e-14);
        assert_close(ab.ospa, ba.ospa, 1e-14);
        assert_true(ac.gospa.value <= ab.gospa.value + bc.gospa.value + 1e-13);
        assert_true(ac.ospa <= ab.ospa + bc.ospa + 1e-13);
        assert_true(ab.ospa <= 2);
        assert_close(compare(&a, &a, 2).gospa.value, 0, 0);
        assert_close(compare(&a, &a, 2).ospa, 0, 0);
    }
}

static void the_order_of_a_list_changes_no_distance(void **state)
{
    (void)state;
    uint64_t sample = 2;
    for (int round = 0; round < 2000; round++) {
        struct set a = draw(&sample), b = draw(&sample), turned = b;
        for (size_t i = 0; i < b.count; i++)
            turned.at[i] = b.at[b.count - 1 - i];
        assert_close(compare(&a, &turned, 2).gospa.value, compare(&a, &b, 2).gospa.value, 1e-14);
        assert_close(compare(&a, &turned, 2).ospa, compare(&a, &b, 2).ospa, 1e-14);
    }
}

static void the_parts_add_up(void **state)
{
    (void)state;
    uint64_t sample = 3;
    for (int round = 0; round < 2000; round++) {
        struct set a = draw(&sample), b = draw(&sample);
        struct answer answer = compare(&a, &b, 2);
        assert_close(answer.gospa.missed_part, 2 * (double)(a.count - answer.pairs), 0);
        assert_close(answer.gospa.false_part, 2 * (double)(b.count - answer.pairs), 0);
        assert_close(answer.gospa.value * answer.gospa.value,
                     answer.gospa.localisation + answer.gospa.missed_part + answer.gospa.false_part,
                     1e-13);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_empty_lists_have_no_distance),
        cmocka_unit_test(every_missed_or_false_item_costs_half_a_squared_cutoff),
        cmocka_unit_test(one_pair_has_its_own_distance),
        cmocka_unit_test(items_exactly_at_the_cutoff_are_no_pair),
        cmocka_unit_test(ten_targets_give_the_figures_of_the_definitions),
        cmocka_unit_test(both_are_metrics),
        cmocka_unit_test(the_order_of_a_list_changes_no_distance),
        cmocka_unit_test(the_parts_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
