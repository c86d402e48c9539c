#include "geometry/predicates.h"

enum { TERMS = 12 };

/* An exact sum: terms that do not overlap, smallest first, zeros allowed. */
struct expansion {
    double term[TERMS];
    int count;
};

static void add(struct expansion *sum, double value)
{
    for (int i = 0; i < sum->count; i++) {
        double total = value + sum->term[i];
        double part = total - value;
        sum->term[i] = (value - (total - part)) + (sum->term[i] - part);
        value = total;
    }
    sum->term[sum->count++] = value;
}

static void add_product(struct expansion *sum, double x, double y)
{
    double product = x * y;
    add(sum, vec2_product_rest(x, y, product));
    add(sum, product);
}

static int sign_of(double value)
{
    return (value > 0) - (value < 0);
}

static int sign_of_sum(const struct expansion *sum)
{
    int last = sum->count - 1;
    while (last > 0 && sum->term[last] == 0)
        last--;
    return sign_of(sum->term[last]);
}

/* A difference is rounded to 0 only if it is 0, so two products with such a factor each are 0. A
 * product that is 0 need not be: it may have underflown. */
int predicates_exact_sign(struct vec2 a, struct vec2 b, struct vec2 c)
{
    if ((a.x == c.x || b.y == c.y) && (a.y == c.y || b.x == c.x))
        return 0;
    struct expansion sum = {.count = 0};
    add_product(&sum, a.x, b.y);
    add_product(&sum, -a.y, b.x);
    add_product(&sum, b.x, c.y);
    add_product(&sum, -b.y, c.x);
    add_product(&sum, c.x, a.y);
    add_product(&sum, -c.y, a.x);
    return sign_of_sum(&sum);
}

static int exact_sign_along(struct vec2 a, struct vec2 b, struct vec2 direction)
{
    struct expansion sum = {.count = 0};
    add_product(&sum, b.x, direction.x);
    add_product(&sum, -a.x, direction.x);
    add_product(&sum, b.y, direction.y);
    add_product(&sum, -a.y, direction.y);
    return sign_of_sum(&sum);
}

int predicates_along(struct vec2 a, struct vec2 b, struct vec2 direction)
{
    double x = (b.x - a.x) * direction.x;
    double y = (b.y - a.y) * direction.y;
    double way = x + y;
    bool certain = fabs(way) > PREDICATES_ROUNDING * (fabs(x) + fabs(y));
    return certain ? sign_of(way) : exact_sign_along(a, b, direction);
}
