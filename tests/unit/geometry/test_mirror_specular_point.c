#include "geometry/mirror.h"

#include "check.h"
#include "sample.h"

static struct vec2 unit(struct vec2 a, struct vec2 b)
{
    struct vec2 way = vec2_sub(b, a);
    return vec2_scale(1 / vec2_length(way), way);
}

TEST(known_sides_have_known_feet)
{
    static const struct {
        struct vec2 a, b;
        double margin_m;
        struct vec2 sensor;
        bool exists;
        struct vec2 foot;
    } cases[] = {
        /* the plane of MODEL 13, with the outer face to the right */
        {{8, 2.25}, {8, -2.25}, 0, {0, 0}, true, {8, 0}},
        {{8, 2.25}, {8, -2.25}, 0, {0, 3}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 0, {9, 0}, false, {0, 0}},
        {{8, -2.25}, {8, 2.25}, 0, {0, 0}, false, {0, 0}},
        {{8, -2.25}, {8, 2.25}, 0, {9, 0}, true, {8, 0}},
        /* the ends belong to the side */
        {{8, 2.25}, {8, -2.25}, 0, {0, 2.25}, true, {8, 2.25}},
        {{8, 2.25}, {8, -2.25}, 0, {0, -2.25}, true, {8, -2.25}},
        {{8, 2.25}, {8, -2.25}, 0, {0, 0x1.2000000000001p1}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 0, {0, -0x1.2000000000001p1}, false, {0, 0}},
        /* strictly outside */
        {{8, 2.25}, {8, -2.25}, 0, {8, 0}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 0, {8, 2.25}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 0, {0x1.fffffffffffffp2, 1}, true, {8, 1}},
        {{8, 2.25}, {8, -2.25}, 0, {0x1.0000000000001p3, 1}, false, {0, 0}},
        /* a margin shortens both ends and includes its own */
        {{8, 2.25}, {8, -2.25}, 0.25, {0, 2}, true, {8, 2}},
        {{8, 2.25}, {8, -2.25}, 0.25, {0, -2}, true, {8, -2}},
        {{8, 2.25}, {8, -2.25}, 0.25, {0, 2.0001}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 0.25, {0, -2.0001}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 2.25, {0, 0}, true, {8, 0}},
        {{8, 2.25}, {8, -2.25}, 2.26, {0, 0}, false, {0, 0}},
        {{8, 2.25}, {8, -2.25}, 5, {0, 2.25}, false, {0, 0}},
        /* no length, no foot */
        {{8, 1}, {8, 1}, 0, {0, 1}, false, {0, 0}},
        {{8, 1}, {8, 1}, 0, {8, 1}, false, {0, 0}},
        /* oblique: the foot of (5, 0) on y = x is (2.5, 2.5) */
        {{0, 0}, {4, 4}, 0, {5, 0}, true, {2.5, 2.5}},
        {{4, 4}, {0, 0}, 0, {5, 0}, false, {0, 0}},
        {{4, 4}, {0, 0}, 0, {0, 5}, true, {2.5, 2.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct vec2 foot = {-1e9, -1e9};
        bool exists = mirror_specular_point(cases[i].a, cases[i].b, unit(cases[i].a, cases[i].b),
                                            cases[i].margin_m, cases[i].sensor, &foot);
        assert_int_equal(exists, cases[i].exists);
        if (exists) {
            assert_close(foot.x, cases[i].foot.x, 4e-15);
            assert_close(foot.y, cases[i].foot.y, 4e-15);
        }
    }
}

/* Sides are built around their foot: it lies at t along the side from the nearer end, the sensor
 * straight outwards of it. */
TEST(the_foot_is_where_the_side_was_built_around)
{
    uint64_t sample = 7;
    for (int i = 0; i < 100000; i++) {
        struct vec2 along = vec2_heading(sample_between(&sample, -3.2, 3.2));
        struct vec2 built = {sample_between(&sample, -100, 100),
                             sample_between(&sample, -100, 100)};
        double before_m = sample_between(&sample, -5, 5);
        double after_m = sample_between(&sample, -5, 5);
        double margin_m = sample_between(&sample, 0, 0.5);
        double range_m = sample_between(&sample, -50, 100);
        if (before_m + after_m < 0.1)
            continue;
        struct vec2 foot = {0, 0};
        bool exists =
            mirror_specular_point(vec2_sub(built, vec2_scale(before_m, along)),
                                  vec2_add(built, vec2_scale(after_m, along)), along, margin_m,
                                  vec2_sub(built, vec2_scale(range_m, vec2_left(along))), &foot);
        assert_int_equal(exists, before_m >= margin_m && after_m >= margin_m && range_m > 0);
        /* Coordinates below 200 m are rounded by up to 1.5e-14 m, which turns a short side and
         * carries the foot of a far sensor along. */
        double lever = 1 + range_m / (before_m + after_m);
        if (exists)
            assert_true(vec2_length(vec2_sub(foot, built)) < 1e-13 * lever);
    }
}

TEST(a_mirrored_side_has_the_mirrored_foot_to_the_last_bit)
{
    uint64_t sample = 8;
    int found = 0;
    for (int i = 0; i < 100000; i++) {
        struct vec2 p[3];
        for (int k = 0; k < 3; k++) {
            p[k].x = sample_between(&sample, -20, 20);
            p[k].y = sample_between(&sample, -20, 20);
        }
        struct vec2 foot = {0, 0}, mirrored = {0, 0};
        bool exists = mirror_specular_point(p[0], p[1], unit(p[0], p[1]), 0.1, p[2], &foot);
        for (int k = 0; k < 3; k++)
            p[k].y = -p[k].y;
        assert_int_equal(mirror_specular_point(p[1], p[0], unit(p[1], p[0]), 0.1, p[2], &mirrored),
                         exists);
        assert_true(mirrored.x == foot.x && mirrored.y == -foot.y);
        found += exists;
    }
    assert_true(found > 10000);
}

/* Two collinear walls on a lattice of 2^-40 m, the sensor straight before their joint or a little
 * to either side: with walls along (m, c m + 1) and the offset (c, -1) it is off by one part in
 * 2^80. Exactly straight before it, both walls hold the foot. */
TEST(a_joint_of_collinear_walls_never_loses_the_foot)
{
    uint64_t sample = 33;
    for (int i = 0; i < 200000; i++) {
        double m = (double)sample_integer(&sample, INT64_C(1) << 40);
        double c = (double)sample_integer(&sample, 3);
        double side = (double)sample_integer(&sample, 1);
        struct vec2 step = vec2_scale(0x1p-40, (struct vec2){m, c * m + 1});
        struct vec2 beside = vec2_scale(side * 0x1p-40, (struct vec2){c, -1});
        struct vec2 joint = {(double)sample_integer(&sample, 1 << 26) * 0x1p-20,
                             (double)sample_integer(&sample, 1 << 26) * 0x1p-20};
        struct vec2 before = vec2_sub(joint, vec2_scale(3, step));
        struct vec2 after = vec2_add(joint, vec2_scale(5, step));
        struct vec2 outward = vec2_scale(-7, vec2_left(step));
        struct vec2 sensor = vec2_add(joint, vec2_add(outward, beside));
        struct vec2 foot;
        assert_int_equal(mirror_specular_point(before, joint, step, 0, sensor, &foot), side >= 0);
        assert_int_equal(mirror_specular_point(joint, after, step, 0, sensor, &foot), side <= 0);
    }
}
