#include "base/root.h"

#include "check.h"

struct asked {
    double bound;
    double least, most; /* of the numbers that were asked about */
    int count;
};

static bool is_below(const void *of, double x)
{
    struct asked *asked = *(struct asked *const *)of;
    asked->least = fmin(asked->least, x);
    asked->most = fmax(asked->most, x);
    asked->count++;
    return x < asked->bound;
}

static struct root root_of(struct asked *asked, double low, double high, double width)
{
    asked->least = (double)INFINITY;
    asked->most = -(double)INFINITY;
    asked->count = 0;
    return root_between(low, high, width, is_below, &asked);
}

TEST(without_a_width_the_bounds_become_neighbours)
{
    static const double bounds[] = {1e-9, 0.1, 2. / 3, 1, 1.5, 1.9999999};
    for (size_t i = 0; i < COUNT(bounds); i++) {
        struct asked asked = {.bound = bounds[i]};
        struct root root = root_of(&asked, 0, 2, 0);
        assert_true(root.high == bounds[i]);
        assert_true(root.low == nextafter(bounds[i], 0));
    }
}

TEST(bounds_may_be_negative)
{
    struct asked asked = {.bound = -0.3};
    struct root root = root_of(&asked, -5, 7, 0);
    assert_true(root.high == -0.3);
    assert_true(root.low == nextafter(-0.3, -1));
}

/* 8 is halved ten times to 2^-7. */
TEST(a_width_ends_the_search)
{
    struct asked asked = {.bound = 3.3};
    struct root root = root_of(&asked, 0, 8, 0x1p-7);
    assert_int_equal(asked.count, 10);
    assert_true(root.high - root.low == 0x1p-7);
    assert_true(root.low < 3.3 && root.high >= 3.3);
}

TEST(the_bounds_themselves_are_not_asked_about)
{
    struct asked asked = {.bound = 1e-300};
    root_of(&asked, 0, 1, 0);
    assert_true(asked.least > 0 && asked.most < 1);
    double next = nextafter(1, 2);
    struct root root = root_of(&asked, 1, next, 0);
    assert_int_equal(asked.count, 0);
    assert_true(root.low == 1 && root.high == next);
}

/* cos x is above x below 0.739085..., its fixed point. */
static bool cosine_is_above(const void *of, double x)
{
    (void)of;
    return cos(x) > x;
}

TEST(the_root_of_a_function_is_where_its_sign_changes)
{
    assert_close(root_between(0, 1, 0, cosine_is_above, NULL).low, 0.7390851332151607, 1e-15);
}
