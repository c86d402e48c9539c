#include "check.h"

#include "sample.h"
#include "score/assignment.h"

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
        if (column_of[row] == ASSIGNMENT_NONE)
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
    struct arena arena = {0};
    size_t column_of[SIDE];
    assignment_least(cost, rows, columns, column_of, &arena);
    double least = try_all(cost, rows, columns, 0, 0, rows > columns ? rows - columns : 0);
    assert_close(answered(cost, rows, columns, column_of), least, 1e-13 * SIDE);
    arena_free(&arena);
}

static void random_costs_are_paired_as_cheaply_as_trying_all_finds(void **state)
{
    (void)state;
    uint64_t sample = 1;
    double cost[SIDE * SIDE];
    for (int round = 0; round < 4000; round++) {
        size_t rows = sample_bits(&sample) % (SIDE + 1),
               columns = sample_bits(&sample) % (SIDE + 1);
        for (size_t i = 0; i < rows * columns; i++)
            cost[i] = sample_between(&sample, -1, 1);
        check(cost, rows, columns);
    }
}

static void costs_that_tie_are_paired_as_cheaply_as_trying_all_finds(void **state)
{
    (void)state;
    uint64_t sample = 2;
    double cost[SIDE * SIDE];
    for (int round = 0; round < 4000; round++) {
        size_t rows = sample_bits(&sample) % (SIDE + 1),
               columns = sample_bits(&sample) % (SIDE + 1);
        for (size_t i = 0; i < rows * columns; i++)
            cost[i] = (double)sample_integer(&sample, 1);
        check(cost, rows, columns);
    }
}

/* Pairing the nearest first would cost 1 + 9; the best is 2 + 3. */
static void a_row_moves_on_where_that_is_cheaper(void **state)
{
    (void)state;
    struct arena arena = {0};
    size_t column_of[2];
    assignment_least((double[]){1, 2, 3, 9}, 2, 2, column_of, &arena);
    assert_int_equal(column_of[0], 1);
    assert_int_equal(column_of[1], 0);
    arena_free(&arena);
}

static void equal_costs_are_paired_in_order(void **state)
{
    (void)state;
    struct arena arena = {0};
    size_t column_of[3];
    const double cost[6] = {0};
    assignment_least(cost, 2, 3, column_of, &arena);
    assert_int_equal(column_of[0], 0);
    assert_int_equal(column_of[1], 1);
    assignment_least(cost, 3, 2, column_of, &arena);
    assert_int_equal(column_of[0], 0);
    assert_int_equal(column_of[1], 1);
    assert_true(column_of[2] == ASSIGNMENT_NONE);
    arena_free(&arena);
}

/* The sum of costs i j is least when the longest go with the shortest: rows ascend, columns
 * descend. */
static void a_large_matrix_is_paired_as_the_rearrangement_inequality_says(void **state)
{
    (void)state;
    enum { LARGE = 200 };
    struct arena arena = {0};
    double *cost = arena_get(&arena, LARGE * LARGE * sizeof *cost);
    size_t column_of[LARGE];
    for (size_t i = 0; i < LARGE * LARGE; i++)
        cost[i] = (double)(i / LARGE) * (double)(i % LARGE);
    assignment_least(cost, LARGE, LARGE, column_of, &arena);
    for (size_t row = 0; row < LARGE; row++)
        assert_int_equal(column_of[row], LARGE - 1 - row);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_costs_are_paired_as_cheaply_as_trying_all_finds),
        cmocka_unit_test(costs_that_tie_are_paired_as_cheaply_as_trying_all_finds),
        cmocka_unit_test(a_row_moves_on_where_that_is_cheaper),
        cmocka_unit_test(equal_costs_are_paired_in_order),
        cmocka_unit_test(a_large_matrix_is_paired_as_the_rearrangement_inequality_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
