#include "geometry/predicates.h"

#include "check.h"
#include "sample.h"

__extension__ typedef __int128 wide;

/* A point whose coordinates are x and y units. Products of three of them fit 128 bits as long as
 * the units stay below 2^61. */
struct lattice_point {
    int64_t x, y;
};

static int lattice_sign(struct lattice_point a, struct lattice_point b, struct lattice_point c)
{
    wide left = (wide)(b.x - a.x) * (c.y - a.y);
    wide right = (wide)(b.y - a.y) * (c.x - a.x);
    return (left > right) - (left < right);
}

static struct vec2 lattice_place(struct lattice_point p, double unit_m)
{
    struct vec2 place = {(double)p.x * unit_m, (double)p.y * unit_m};
    assert_true((int64_t)(double)p.x == p.x && (int64_t)(double)p.y == p.y);
    return place;
}

static void check_all_orders(struct vec2 a, struct vec2 b, struct vec2 c, int expected)
{
    assert_int_equal(predicates_orientation(a, b, c), expected);
    assert_int_equal(predicates_orientation(b, c, a), expected);
    assert_int_equal(predicates_orientation(c, a, b), expected);
    assert_int_equal(predicates_orientation(b, a, c), -expected);
    assert_int_equal(predicates_orientation(a, c, b), -expected);
    assert_int_equal(predicates_orientation(c, b, a), -expected);
}

static void check_lattice(struct lattice_point a, struct lattice_point b, struct lattice_point c,
                          double unit_m)
{
    check_all_orders(lattice_place(a, unit_m), lattice_place(b, unit_m), lattice_place(c, unit_m),
                     lattice_sign(a, b, c));
}

TEST(known_triples_have_their_sign_in_every_order)
{
    static const struct {
        struct vec2 a, b, c;
        int sign;
    } cases[] = {
        {{0, 0}, {1, 0}, {0, 1}, 1},
        {{0, 0}, {1, 0}, {5, -1e-300}, -1},
        {{0, 0}, {1, 0}, {7, 0}, 0},
        {{3, 4}, {3, 4}, {-1, 9}, 0},
        {{3, 4}, {3, 4}, {3, 4}, 0},
        {{-0.0, 0.0}, {0.0, -0.0}, {1, 1}, 0},
        /* from the grid of the test below */
        {{0.5 + 41 * 0x1p-53, 0.5 + 48 * 0x1p-53}, {12, 12}, {24, 24}, 1},
        {{0.5, 0.5}, {12, 12}, {24, 24}, 0},
        {{0.5, 0.5 - 0x1p-54}, {12, 12}, {24, 24}, -1},
        /* doubled numbers stay on a line through the origin */
        {{0.1, 0.3}, {2 * 0.1, 2 * 0.3}, {4 * 0.1, 4 * 0.3}, 0},
        /* the ends of the promised range of coordinates */
        {{1e-140, 1e-140}, {1, 1}, {1e140, 1e140}, 0},
        {{1e-140, 1.1e-140}, {1, 1}, {1e140, 1e140}, 1},
        {{1e140, -1e140}, {-1e140, 1e140}, {1e-140, -1e-140}, 0},
        {{1e140, -1e140}, {-1e140, 1e140}, {1e-140, 1e-140}, -1},
        /* n(n + 2) < (n + 1)^2, off by one part in 2^104 among the subnormals */
        {{0, 0},
         {0x1p-465, 0x1.0000000000001p-465},
         {0x1.0000000000001p-465, 0x1.0000000000002p-465},
         -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_all_orders(cases[i].a, cases[i].b, cases[i].c, cases[i].sign);
}

TEST(every_point_of_a_fine_grid_has_its_side_of_a_diagonal)
{
    const struct lattice_point q = {INT64_C(12) << 53, INT64_C(12) << 53};
    const struct lattice_point r = {INT64_C(24) << 53, INT64_C(24) << 53};
    for (int64_t i = 0; i < 256; i++) {
        for (int64_t j = 0; j < 256; j++) {
            struct lattice_point p = {(INT64_C(1) << 52) + i, (INT64_C(1) << 52) + j};
            assert_int_equal(lattice_sign(p, q, r), (j > i) - (j < i));
            check_lattice(p, q, r, 0x1p-53);
        }
    }
}

TEST(near_collinear_triples_agree_with_integer_arithmetic)
{
    static const double units_m[] = {1, 0x1p-30, 0x1p-465, 0x1p413};
    uint64_t sample = 1;
    for (int i = 0; i < 200000; i++) {
        struct lattice_point a = {sample_integer(&sample, INT64_C(1) << 40),
                                  sample_integer(&sample, INT64_C(1) << 40)};
        struct lattice_point step = {sample_integer(&sample, INT64_C(1) << 32),
                                     sample_integer(&sample, INT64_C(1) << 32)};
        int64_t b_steps = sample_integer(&sample, 1 << 18);
        int64_t c_steps = sample_integer(&sample, 1 << 18);
        struct lattice_point b = {a.x + b_steps * step.x, a.y + b_steps * step.y};
        struct lattice_point c = {a.x + c_steps * step.x + sample_integer(&sample, 1),
                                  a.y + c_steps * step.y + sample_integer(&sample, 1)};
        check_lattice(a, b, c, units_m[i % 4]);
    }
}

/* Offsets from one lattice step to the size of the figure take every way through the filter. */
TEST(every_distance_from_the_line_agrees_with_integer_arithmetic)
{
    uint64_t sample = 2;
    for (int i = 0; i < 200000; i++) {
        struct lattice_point a = {sample_integer(&sample, INT64_C(1) << 45),
                                  sample_integer(&sample, INT64_C(1) << 45)};
        struct lattice_point half = {sample_integer(&sample, INT64_C(1) << 45),
                                     sample_integer(&sample, INT64_C(1) << 45)};
        int64_t offset = INT64_C(1) << i % 45;
        struct lattice_point b = {a.x + 2 * half.x, a.y + 2 * half.y};
        struct lattice_point c = {a.x + half.x + sample_integer(&sample, offset),
                                  a.y + half.y + sample_integer(&sample, offset)};
        check_lattice(a, b, c, 0x1p-20);
    }
}

/* Points abreast of a, or off by a lattice step along or across. */
TEST(the_order_along_a_direction_agrees_with_integer_arithmetic)
{
    uint64_t sample = 4;
    for (int i = 0; i < 200000; i++) {
        struct lattice_point a = {sample_integer(&sample, INT64_C(1) << 45),
                                  sample_integer(&sample, INT64_C(1) << 45)};
        struct lattice_point way = {sample_integer(&sample, INT64_C(1) << 26),
                                    sample_integer(&sample, INT64_C(1) << 26)};
        int64_t steps = sample_integer(&sample, INT64_C(1) << 24);
        int64_t offset = INT64_C(1) << i % 45;
        struct lattice_point b = {a.x - steps * way.y + (i % 3 ? sample_integer(&sample, 1) : 0),
                                  a.y + steps * way.x +
                                      (i % 7 ? 0 : sample_integer(&sample, offset))};
        wide exact = (wide)(b.x - a.x) * way.x + (wide)(b.y - a.y) * way.y;
        int sign = (exact > 0) - (exact < 0);
        struct vec2 from = lattice_place(a, 0x1p-30), to = lattice_place(b, 0x1p-30);
        struct vec2 direction = lattice_place(way, 0x1p-10);
        assert_int_equal(predicates_along(from, to, direction), sign);
        assert_int_equal(predicates_along(to, from, direction), -sign);
        assert_int_equal(predicates_along(from, from, direction), 0);
    }
}

TEST(mirroring_and_quarter_turns_keep_the_answer)
{
    uint64_t sample = 3;
    for (int i = 0; i < 100000; i++) {
        struct vec2 p[3], turned[3], mirrored[3];
        double slope = sample_between(&sample, -3, 3);
        for (int k = 0; k < 3; k++) {
            p[k].x = sample_between(&sample, -1e3, 1e3);
            p[k].y = slope * p[k].x;
            turned[k] = vec2_left(p[k]);
            mirrored[k] = (struct vec2){p[k].x, -p[k].y};
        }
        int sign = predicates_orientation(p[0], p[1], p[2]);
        assert_int_equal(predicates_orientation(turned[0], turned[1], turned[2]), sign);
        assert_int_equal(predicates_orientation(mirrored[0], mirrored[1], mirrored[2]), -sign);
    }
}
