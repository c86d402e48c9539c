#include "base/search.h"

#include "check.h"
#include "sample.h"

struct row {
    char name[8];
    double at;
    double level;
};

static size_t row_of(const struct row *rows, size_t count, double at)
{
    return search_row(&rows[0].at, sizeof *rows, count, at);
}

/* The same by looking at every row. */
static size_t plain_row_of(const struct row *rows, size_t count, double at)
{
    size_t last = 0;
    for (size_t i = 0; i < count; i++)
        if (rows[i].at <= at)
            last = i;
    return last;
}

TEST(the_last_row_at_or_before_a_number_is_found)
{
    const struct row rows[] = {{.at = -3}, {.at = -1}, {.at = 0}, {.at = 0.5}, {.at = 70}};
    assert_int_equal(row_of(rows, 5, -3), 0);
    assert_int_equal(row_of(rows, 5, nextafter(-1, -2)), 0);
    assert_int_equal(row_of(rows, 5, -1), 1);
    assert_int_equal(row_of(rows, 5, 0.4), 2);
    assert_int_equal(row_of(rows, 5, nextafter(70, 0)), 3);
    assert_int_equal(row_of(rows, 5, 70), 4);
}

TEST(beyond_its_ends_the_first_or_the_last_row_is_found)
{
    const struct row rows[] = {{.at = -3}, {.at = 2}};
    assert_int_equal(row_of(rows, 2, -1e9), 0);
    assert_int_equal(row_of(rows, 2, -(double)INFINITY), 0);
    assert_int_equal(row_of(rows, 2, 1e9), 1);
    assert_int_equal(row_of(rows, 2, (double)INFINITY), 1);
    assert_int_equal(row_of(rows, 1, 5), 0);
    assert_int_equal(row_of(rows, 1, -5), 0);
    assert_int_equal(row_of(rows, 0, 5), 0);
}

TEST(of_equal_rows_the_last_is_found)
{
    const struct row rows[] = {{.at = 1}, {.at = 1}, {.at = 2}, {.at = 2}, {.at = 2}, {.at = 3}};
    assert_int_equal(row_of(rows, 2, 1), 1);
    assert_int_equal(row_of(rows, 6, 1), 1);
    assert_int_equal(row_of(rows, 6, 2), 4);
    assert_int_equal(row_of(rows, 6, 2.5), 4);
}

/* Steps are even, grow, or are drawn; each number is that of a row, or just beside it. */
TEST(every_table_is_searched_as_by_looking_at_every_row)
{
    struct row rows[40] = {{.at = 0}};
    uint64_t sample = 1;
    for (int kind = 0; kind < 3; kind++)
        for (size_t count = 1; count <= 40; count += 3) {
            for (size_t i = 0; i < count; i++) {
                double steps[] = {0.1, pow(1.7, (double)i), sample_between(&sample, 0, 1)};
                rows[i].at = (i > 0 ? rows[i - 1].at : -1) + steps[kind];
            }
            for (size_t i = 0; i < count; i++) {
                double near[] = {nextafter(rows[i].at, -1e9), rows[i].at,
                                 nextafter(rows[i].at, 1e9)};
                for (size_t k = 0; k < 3; k++)
                    assert_int_equal(row_of(rows, count, near[k]),
                                     plain_row_of(rows, count, near[k]));
            }
        }
}

static bool is_at_most(const void *of, size_t row)
{
    return row <= *(const size_t *)of;
}

TEST(the_last_row_that_is_reached_is_found)
{
    for (size_t count = 1; count < 20; count++)
        for (size_t last = 0; last < count; last++)
            assert_int_equal(search_last(0, count, is_at_most, &last), last);
}

static bool is_never(const void *of, size_t row)
{
    (void)of;
    (void)row;
    return false;
}

TEST(where_no_row_is_reached_the_first_one_is_found)
{
    assert_int_equal(search_last(0, 9, is_never, NULL), 0);
    assert_int_equal(search_last(0, 0, is_never, NULL), 0);
}
