#include "check.h"

#include "sample.h"
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
};

static struct answer compare(const struct set *truth, const struct set *list, double cutoff)
{
    double distance[LARGEST * LARGEST], squares = 0;
    size_t item_of[LARGEST];
    for (size_t i = 0; i < truth->count; i++)
        for (size_t j = 0; j < list->count; j++)
            distance[i * list->count + j] = fabs(truth->at[i] - list->at[j]);
    size_t pairs = gospa_pair(distance, truth->count, list->count, cutoff, item_of, check_arena());
    for (size_t i = 0; i < truth->count; i++)
        if (item_of[i] != GOSPA_NONE)
            squares += pow(distance[i * list->count + item_of[i]], 2);
    return (struct answer){pairs, gospa_of(squares, pairs, truth->count, list->count, cutoff)};
}

static struct set draw(uint64_t *sample)
{
    struct set set = {.count = sample_bits(sample) % (LARGEST + 1)};
    for (size_t i = 0; i < set.count; i++)
        set.at[i] = sample_between(sample, 0, 6);
    return set;
}

TEST(every_missed_or_false_item_costs_half_a_squared_cutoff)
{
    const struct set some = {4, {1, 2, 3, 4}}, none = {0};
    struct answer missed = compare(&some, &none, 3), wrong = compare(&none, &some, 3);
    assert_near(missed.gospa.value, 3 / sqrt(2) * sqrt(4), 1e-15);
    assert_close(missed.gospa.missed_part, 18, 0);
    assert_close(missed.gospa.false_part, 0, 0);
    assert_close(wrong.gospa.value, missed.gospa.value, 0);
    assert_close(wrong.gospa.missed_part, 0, 0);
    assert_close(wrong.gospa.false_part, 18, 0);
    assert_close(missed.gospa.ospa, 3, 0);
}

TEST(one_pair_has_its_own_distance)
{
    struct answer near = compare(&(struct set){1, {1}}, &(struct set){1, {2.5}}, 2);
    assert_int_equal(near.pairs, 1);
    assert_close(near.gospa.value, 1.5, 0);
    assert_close(near.gospa.ospa, 1.5, 0);
    struct answer far = compare(&(struct set){1, {1}}, &(struct set){1, {9}}, 2);
    assert_int_equal(far.pairs, 0);
    assert_close(far.gospa.value, 2, 1e-15);
    assert_close(far.gospa.ospa, 2, 0);
}

TEST(items_exactly_at_the_cutoff_are_no_pair)
{
    struct answer answer = compare(&(struct set){1, {1}}, &(struct set){1, {3}}, 2);
    assert_int_equal(answer.pairs, 0);
    assert_close(answer.gospa.missed_part, 2, 0);
    assert_close(answer.gospa.false_part, 2, 0);
}

/* Ten targets with a cut-off of 2: one moved by 1, one missing, one false, one of each, five
 * missing; and empty lists against one of one and of ten. */
TEST(ten_targets_give_the_figures_of_the_definitions)
{
    static const struct {
        double squares;
        size_t pairs, truths, listed;
        double ospa, gospa;
    } rows[] = {
        {1, 10, 10, 10, 0.316, 1.000}, {0, 9, 10, 9, 0.632, 1.414}, {0, 10, 10, 11, 0.603, 1.414},
        {0, 9, 10, 10, 0.632, 2.000},  {0, 5, 10, 5, 1.414, 3.162}, {0, 0, 0, 1, 2.000, 1.414},
        {0, 0, 0, 10, 2.000, 4.472},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct gospa gospa =
            gospa_of(rows[i].squares, rows[i].pairs, rows[i].truths, rows[i].listed, 2);
        assert_close(gospa.value, rows[i].gospa, 5e-4);
        assert_close(gospa.ospa, rows[i].ospa, 5e-4);
    }
}

TEST(both_are_metrics)
{
    uint64_t sample = 1;
    for (int round = 0; round < 20000; round++) {
        struct set a = draw(&sample), b = draw(&sample), c = draw(&sample);
        struct answer ab = compare(&a, &b, 2), ba = compare(&b, &a, 2), bc = compare(&b, &c, 2),
                      ac = compare(&a, &c, 2);
        assert_close(ab.gospa.value, ba.gospa.value, 1e-14);
        assert_close(ab.gospa.ospa, ba.gospa.ospa, 1e-14);
        assert_true(ac.gospa.value <= ab.gospa.value + bc.gospa.value + 1e-13);
        assert_true(ac.gospa.ospa <= ab.gospa.ospa + bc.gospa.ospa + 1e-13);
        assert_true(ab.gospa.ospa <= 2);
        assert_close(compare(&a, &a, 2).gospa.value, 0, 0);
        assert_close(compare(&a, &a, 2).gospa.ospa, 0, 0);
    }
}

TEST(the_parts_add_up)
{
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

enum { SIDE = 6 };

/* The least cost of giving every row from this one on an unused column, by trying all; rows may go
 * without a column only where there are more rows than columns. */
static double try_all(const double *cost, size_t rows, size_t columns, size_t row, unsigned used,
                      size_t spare)
{
    if (row == rows)
        return 0;
    double best = 1e300;
    if (spare > 0)
        best = try_all(cost, rows, columns, row + 1, used, spare - 1);
    for (size_t column = 0; column < columns; column++)
        if ((used >> column & 1) == 0)
            best = fmin(best, cost[row * columns + column] + try_all(cost, rows, columns, row + 1,
                                                                     used | 1u << column, spare));
    return best;
}

/* The cost of the pairs found, after a check that they are a full assignment. */
static double answered(const double *cost, size_t rows, size_t columns, const size_t *column_of)
{
    unsigned used = 0;
    size_t pairs = 0;
    double sum = 0;
    for (size_t row = 0; row < rows; row++) {
        if (column_of[row] == GOSPA_NONE)
            continue;
        assert_true(column_of[row] < columns);
        assert_false(used >> column_of[row] & 1);
        used |= 1u << column_of[row];
        sum += cost[row * columns + column_of[row]];
        pairs++;
    }
    assert_int_equal(pairs, rows < columns ? rows : columns);
    return sum;
}

static void check(const double *cost, size_t rows, size_t columns)
{
    size_t column_of[SIDE];
    gospa_assign(cost, rows, columns, column_of, check_arena());
    double least = try_all(cost, rows, columns, 0, 0, rows > columns ? rows - columns : 0);
    assert_close(answered(cost, rows, columns, column_of), least, 1e-13 * SIDE);
}

/* Costs are evenly spread, or -1, 0 and 1, of which many tie. */
static void check_random_costs(bool tied, uint64_t sample)
{
    double cost[SIDE * SIDE];
    for (int round = 0; round < 4000; round++) {
        size_t rows = sample_bits(&sample) % (SIDE + 1),
               columns = sample_bits(&sample) % (SIDE + 1);
        for (size_t i = 0; i < rows * columns; i++)
            cost[i] = tied ? (double)sample_integer(&sample, 1) : sample_between(&sample, -1, 1);
        check(cost, rows, columns);
    }
}

TEST(random_costs_are_paired_as_cheaply_as_trying_all_finds)
{
    check_random_costs(false, 1);
    check_random_costs(true, 2);
}

/* Pairing the nearest first would cost 1 + 9; the best is 2 + 3. */
TEST(a_row_moves_on_where_that_is_cheaper)
{
    size_t column_of[2];
    gospa_assign((double[]){1, 2, 3, 9}, 2, 2, column_of, check_arena());
    assert_int_equal(column_of[0], 1);
    assert_int_equal(column_of[1], 0);
}

TEST(equal_costs_are_paired_in_order)
{
    size_t column_of[3];
    const double cost[6] = {0};
    gospa_assign(cost, 2, 3, column_of, check_arena());
    assert_int_equal(column_of[0], 0);
    assert_int_equal(column_of[1], 1);
    gospa_assign(cost, 3, 2, column_of, check_arena());
    assert_int_equal(column_of[0], 0);
    assert_int_equal(column_of[1], 1);
    assert_true(column_of[2] == GOSPA_NONE);
}

/* The sum of costs i j is least when the longest go with the shortest: rows ascend, columns
 * descend. */
TEST(a_large_matrix_is_paired_as_the_rearrangement_inequality_says)
{
    enum { LARGE = 200 };
    double *cost = arena_get(check_arena(), LARGE * LARGE * sizeof *cost);
    size_t column_of[LARGE];
    for (size_t i = 0; i < LARGE * LARGE; i++)
        cost[i] = (double)(i / LARGE) * (double)(i % LARGE);
    gospa_assign(cost, LARGE, LARGE, column_of, check_arena());
    for (size_t row = 0; row < LARGE; row++)
        assert_int_equal(column_of[row], LARGE - 1 - row);
}
