#include "geometry/obstruction.h"

#include "check.h"
#include "sample.h"

/* A place rounded to a lattice of 2^-30 m, on which sums and doubles of coordinates below 4 km are
 * exact, so that a ray can be aimed through a corner exactly. */
static struct vec2 on_lattice(struct vec2 a)
{
    return (struct vec2){round(a.x * 0x1p30) * 0x1p-30, round(a.y * 0x1p30) * 0x1p-30};
}

static struct vec2 sample_place(uint64_t *sample, double bound_m)
{
    double x = sample_between(sample, -bound_m, bound_m);
    return on_lattice((struct vec2){x, sample_between(sample, -bound_m, bound_m)});
}

/* The place as far beyond middle as from is before it. */
static struct vec2 opposite(struct vec2 from, struct vec2 middle)
{
    struct vec2 to = vec2_sub(vec2_scale(2, middle), from);
    assert_true(middle.x - from.x == to.x - middle.x && middle.y - from.y == to.y - middle.y);
    return to;
}

static void make_car(struct vec2 centre, double yaw_rad, struct vec2 corners[4])
{
    static const struct vec2 own[4] = {{2.25, 0.9}, {-2.25, 0.9}, {-2.25, -0.9}, {2.25, -0.9}};
    for (int i = 0; i < 4; i++)
        corners[i] = on_lattice(vec2_add(centre, vec2_turn(own[i], vec2_heading(yaw_rad))));
}

TEST(closed_segments_touch_as_tabulated)
{
    static const struct {
        struct vec2 p, q, a, b;
        bool touch;
    } cases[] = {
        {{0, 0}, {2, 2}, {0, 2}, {2, 0}, true},
        {{0, 0}, {1, 1}, {0, 4}, {4, 0}, false},
        /* an end on the other, both ends shared, just short of it */
        {{0, 0}, {1, 1}, {0, 2}, {2, 0}, true},
        {{0, 0}, {1, 1}, {1, 1}, {2, 0}, true},
        {{0, 0}, {1, 1}, {0, 0}, {1, 1}, true},
        {{0, 0}, {1, 0x1.fffffffffffffp-1}, {0, 2}, {2, 0}, false},
        /* collinear: apart, in contact, overlapping, nested */
        {{0, 0}, {1, 1}, {2, 2}, {3, 3}, false},
        {{0, 0}, {1, 1}, {1, 1}, {3, 3}, true},
        {{0, 0}, {2, 2}, {1, 1}, {3, 3}, true},
        {{0, 0}, {4, 4}, {1, 1}, {3, 3}, true},
        {{0, 0}, {0, 1}, {0, 2}, {0, 3}, false},
        {{0, 0}, {0, 2}, {0, 1}, {0, 3}, true},
        /* parallel, with overlapping boxes */
        {{0, 0}, {3, 3}, {0, 1}, {3, 4}, false},
        /* points */
        {{1, 1}, {1, 1}, {0, 0}, {2, 2}, true},
        {{1, 1}, {1, 1}, {1, 1}, {2, 5}, true},
        {{1, 1.5}, {1, 1.5}, {0, 0}, {2, 2}, false},
        {{3, 3}, {3, 3}, {0, 0}, {2, 2}, false},
        {{1, 1}, {1, 1}, {1, 1}, {1, 1}, true},
        {{1, 1}, {1, 1}, {1, 2}, {1, 2}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(obstruction_segments_touch(cases[i].p, cases[i].q, cases[i].a, cases[i].b),
                         cases[i].touch);
}

struct lattice_point {
    int x, y;
};

static struct lattice_point digits(int number)
{
    return (struct lattice_point){number % 4, number / 4 % 4};
}

static int dot(struct lattice_point a, struct lattice_point b)
{
    return a.x * b.x + a.y * b.y;
}

static int cross(struct lattice_point a, struct lattice_point b)
{
    return a.x * b.y - a.y * b.x;
}

static struct lattice_point difference(struct lattice_point a, struct lattice_point b)
{
    return (struct lattice_point){a.x - b.x, a.y - b.y};
}

static bool lattice_on(struct lattice_point p, struct lattice_point a, struct lattice_point b)
{
    struct lattice_point to_a = difference(a, p), to_b = difference(b, p);
    return cross(to_a, to_b) == 0 && dot(to_a, to_b) <= 0;
}

/* True if two segments touch: Cramer's rule for the parameters of the common point, in integers;
 * where there is no single one, an end of one on the other. */
static bool lattice_touch(struct lattice_point p, struct lattice_point q, struct lattice_point a,
                          struct lattice_point b)
{
    struct lattice_point pq = difference(q, p), ab = difference(b, a), pa = difference(a, p);
    int whole = cross(pq, ab);
    if (whole == 0)
        return lattice_on(p, a, b) || lattice_on(q, a, b) || lattice_on(a, p, q) ||
               lattice_on(b, p, q);
    int sign = whole > 0 ? 1 : -1;
    int along_pq = sign * cross(pa, ab), along_ab = sign * cross(pa, pq);
    return along_pq >= 0 && along_pq <= sign * whole && along_ab >= 0 && along_ab <= sign * whole;
}

static struct vec2 place(struct lattice_point p)
{
    return (struct vec2){p.x * 0.1, p.y * 0.1};
}

static struct vec2 whole_place(struct lattice_point p)
{
    return (struct vec2){p.x, p.y};
}

TEST(all_segments_of_a_small_lattice_agree_with_cramers_rule)
{
    for (int n = 0; n < 65536; n++) {
        struct lattice_point p = digits(n), q = digits(n >> 4), a = digits(n >> 8),
                             b = digits(n >> 12);
        assert_int_equal(obstruction_segments_touch(whole_place(p), whole_place(q), whole_place(a),
                                                    whole_place(b)),
                         lattice_touch(p, q, a, b));
    }
}

TEST(the_answer_does_not_depend_on_the_order_of_anything)
{
    for (int n = 0; n < 65536; n++) {
        struct vec2 p = place(digits(n)), q = place(digits(n >> 4)), a = place(digits(n >> 8)),
                    b = place(digits(n >> 12));
        bool touch = obstruction_segments_touch(p, q, a, b);
        assert_int_equal(obstruction_segments_touch(q, p, a, b), touch);
        assert_int_equal(obstruction_segments_touch(p, q, b, a), touch);
        assert_int_equal(obstruction_segments_touch(a, b, p, q), touch);
    }
}

TEST(a_ray_through_a_cars_corner_is_always_blocked)
{
    uint64_t sample = 29;
    for (int i = 0; i < 250000; i++) {
        struct vec2 corners[4];
        struct vec2 centre = sample_place(&sample, 100);
        make_car(centre, sample_between(&sample, -3.2, 3.2), corners);
        struct vec2 sensor = sample_place(&sample, 100);
        for (int k = 0; k < 4; k++)
            assert_true(obstruction_blocks(corners, 4, sensor, opposite(sensor, corners[k])));
    }
}

/* Multiples by powers of two are exact, so the corner lies on the ray; but its distances from the
 * ends of the ray are rounded, and only exact signs see it there. */
TEST(a_wall_that_ends_on_a_ray_through_the_origin_blocks_it)
{
    static const double starts[] = {-0x1p-30, 0x1p-40, -1, 0x1p-3};
    uint64_t sample = 28;
    for (int i = 0; i < 250000; i++) {
        struct vec2 end = {sample_between(&sample, -100, 100), sample_between(&sample, -100, 100)};
        struct vec2 other = {sample_between(&sample, -100, 100),
                             sample_between(&sample, -100, 100)};
        struct vec2 from = vec2_scale(starts[i % 4], end), to = vec2_scale(4, end);
        assert_true(obstruction_segments_touch(from, to, end, other));
        assert_true(obstruction_segments_touch(from, to, other, end));
        assert_true(obstruction_segments_touch(from, to, end, end));
    }
}

/* Without a lattice the line misses the joint by a rounding, to one side or the other. */
TEST(a_ray_close_by_a_joint_cannot_slip_between_two_walls)
{
    static const struct vec2 posts[3] = {{-4.3, 20.1}, {0.1, 20.3}, {4.7, 20.2}};
    uint64_t sample = 30;
    for (int i = 0; i < 250000; i++) {
        struct vec2 sensor = {sample_between(&sample, -3, 3), sample_between(&sample, -5, 5)};
        double reach = sample_between(&sample, 1.1, 1.5);
        struct vec2 target = vec2_add(sensor, vec2_scale(reach, vec2_sub(posts[1], sensor)));
        assert_true(obstruction_segments_touch(sensor, target, posts[0], posts[1]) ||
                    obstruction_segments_touch(sensor, target, posts[1], posts[2]));
    }
}

TEST(an_outline_blocks_where_it_is_touched)
{
    static const struct vec2 box[4] = {{10, -1}, {14, -1}, {14, 1}, {10, 1}};
    static const struct {
        struct vec2 from, to;
        bool blocked;
    } cases[] = {
        {{0, 0}, {20, 0}, true},
        {{0, 0}, {9, 0}, false},
        {{0, 0}, {0x1.3ffffffffffffp3, 0}, false},
        {{0, 0}, {10, 0}, true},
        {{0, 3}, {20, 3}, false},
        /* along an edge, past a corner, onto a corner, one step beside it */
        {{0, 1}, {20, 1}, true},
        {{0, 0x1.0000000000001p0}, {20, 0x1.0000000000001p0}, false},
        {{8, 3}, {12, -1}, true},
        {{6, 5}, {14, -3}, true},
        {{10, 5}, {10, -5}, true},
        {{0, 1}, {10, 1}, true},
        {{9, 2}, {10, 0x1.0000000000001p0}, false},
        /* from inside: places inside are seen, nothing beyond, nor the outline itself */
        {{12, 0}, {13, 0.5}, false},
        {{12, 0}, {20, 0}, true},
        {{12, 0}, {12, -8}, true},
        {{12, 0}, {14, 1}, true},
        {{20, 0}, {12, 0}, true},
        {{12, 0}, {12, 0}, false},
        /* from the outline */
        {{10, 0}, {0, 0}, true},
        {{10, 0}, {10, 0}, true},
        {{14, 1}, {30, 30}, true},
        {{0, 0}, {0, 0}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(obstruction_blocks(box, 4, cases[i].from, cases[i].to), cases[i].blocked);
}

TEST(outlines_of_few_corners_are_points_and_segments)
{
    static const struct vec2 corners[3] = {{5, 0}, {5, 4}, {5, 4}};
    static const struct {
        size_t count;
        struct vec2 to;
        bool blocked;
    } cases[] = {
        {0, {10, 0}, false}, {1, {10, 0}, true}, {1, {10, 1}, false},  {1, {4, 0}, false},
        {2, {10, 0}, true},  {2, {10, 8}, true}, {2, {10, 4}, true},   {2, {10, 9}, false},
        {3, {10, 4}, true},  {3, {10, 8}, true}, {3, {10, -1}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(
            obstruction_blocks(corners, cases[i].count, (struct vec2){0, 0}, cases[i].to),
            cases[i].blocked);
}

TEST(the_edge_from_the_last_corner_to_the_first_blocks_too)
{
    static const struct vec2 triangle[3] = {{5, -2}, {9, 0}, {5, 2}};
    assert_true(obstruction_blocks(triangle, 3, (struct vec2){0, 0}, (struct vec2){6, 0}));
    assert_true(obstruction_blocks(triangle, 3, (struct vec2){6, 0}, (struct vec2){0, 0.5}));
}
