#include "orientation.h"

#include <math.h>
#include <stdbool.h>

enum { TERMS = 12 };

/* A sum kept exactly: terms that do not overlap, smallest first, zeros allowed. */
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

/* Rounding costs at most (3 + 16u)u of the sum of sizes, u = 2^-53 (NUMERICS 27). 4u leaves room
 * for a bound that is itself rounded among the subnormals. */
static bool is_certain(double total, double left, double right)
{
    return fabs(total) > 0x1p-51 * (fabs(left) + fabs(right));
}

static int exact_sign(struct vec2 a, struct vec2 b, struct vec2 c)
{
    struct expansion sum = {.count = 0};
    add_product(&sum, a.x, b.y);
    add_product(&sum, -a.y, b.x);
    add_product(&sum, b.x, c.y);
    add_product(&sum, -b.y, c.x);
    add_product(&sum, c.x, a.y);
    add_product(&sum, -c.y, a.x);
    return sign_of_sum(&sum);
}

int orientation_sign(struct vec2 a, struct vec2 b, struct vec2 c)
{
    double left = (a.x - c.x) * (b.y - c.y);
    double right = (a.y - c.y) * (b.x - c.x);
    double determinant = left - right;
    return is_certain(determinant, left, right) ? sign_of(determinant) : exact_sign(a, b, c);
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

int orientation_along(struct vec2 a, struct vec2 b, struct vec2 direction)
{
    double x = (b.x - a.x) * direction.x;
    double y = (b.y - a.y) * direction.y;
    double way = x + y;
    return is_certain(way, x, y) ? sign_of(way) : exact_sign_along(a, b, direction);
}
