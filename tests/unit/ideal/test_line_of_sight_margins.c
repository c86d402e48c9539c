#include "check.h"

#include "base/units.h"
#include "ideal/line_of_sight.h"

/* The box from (-2, -1) to (2, 1). */
static const struct vec2 outline[4] = {{2, 1}, {-2, 1}, {-2, -1}, {2, -1}};

TEST(a_facing_margin_is_an_angle_times_the_range)
{
    static const struct {
        enum visibility_shape shape;
        double zero_rad, yaw_rad, margin_m;
    } cases[] = {
        {VISIBILITY_HARD, 0.5, 0, 10 * 0.5},    {VISIBILITY_HARD, 0.5, 0.4, 10 * 0.1},
        {VISIBILITY_HARD, 0.5, -0.7, 10 * 0.2}, {VISIBILITY_LINEAR, 1.25, 1.25, 0},
        {VISIBILITY_COSINE, PI, 0, 10 * PI},    {VISIBILITY_HARD, PI, 2, (double)INFINITY},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct box box = {.heading = vec2_heading(cases[i].yaw_rad)};
        double margin_m = line_of_sight_facing_margin_m(&box, cases[i].shape, 0, cases[i].zero_rad,
                                                        (struct vec2){3, 4}, (struct vec2){13, 4});
        if (isfinite(cases[i].margin_m))
            assert_close(margin_m, cases[i].margin_m, 1e-14);
        else
            assert_true(margin_m == cases[i].margin_m);
    }
}

/* The side from (0, 4) to (0, 0), whose outer face looks along -x, not flat 0.5 m from its ends. */
TEST(a_foot_margin_is_the_way_to_the_border)
{
    static const struct {
        struct vec2 sensor;
        double margin_m;
    } cases[] = {{{-9, 2}, 1.5},   {{-9, 3}, 0.5}, {{-9, 0.6}, 0.1}, {{-0.25, 2}, 0.25},
                 {{-9, 3.5}, 0},   {{-9, 4}, 0.5}, {{-9, -2}, 2.5},  {{1, 2}, 1},
                 {{0.25, 4}, 0.5}, {{3, -1}, 3}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(line_of_sight_foot_margin_m((struct vec2){0, 4}, (struct vec2){0, 0},
                                                 (struct vec2){0, -1}, 0.5, cases[i].sensor),
                     cases[i].margin_m, 1e-15);
}

TEST(a_clear_sight_line_is_a_distance_from_the_outline)
{
    static const struct {
        struct vec2 from, to;
        double margin_m;
    } cases[] = {
        {{-9, 1.25}, {9, 1.25}, 0.25}, /* along a side */
        {{-9, 0}, {-2.5, 0}, 0.5},     /* ends before it */
        {{5, 5}, {9, 9}, 5},           /* 3 and 4 from a corner */
        {{0, 3}, {4, 0}, 0.4},         /* 3 x + 4 y = 12, the corner gives 10 */
        {{-1, 0}, {1, 0.5}, 0.5},      /* from inside to inside */
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_close(line_of_sight_outline_margin_m(outline, 4, cases[i].from, cases[i].to),
                     cases[i].margin_m, 1e-15);
        assert_close(line_of_sight_outline_margin_m(outline, 4, cases[i].to, cases[i].from),
                     cases[i].margin_m, 1e-15);
    }
}

TEST(a_blocked_sight_line_is_a_depth_in_the_outline)
{
    static const struct {
        struct vec2 from, to;
        double margin_m;
    } cases[] = {
        {{-9, 0.75}, {9, 0.75}, 0.25}, /* under a side: both ends have a corner 0.25 above */
        {{-9, 0}, {9, 0}, 1},          /* through the middle */
        {{-9, 0.5}, {-1.9, 0.5}, 0.1}, /* ends just behind the rear */
        {{-9, 0}, {1.5, 0}, 1},        /* ends inside, in the middle */
        {{-9, 1}, {9, 1}, 0},          /* along a side, touching it */
        {{-9, 1}, {-2, 1}, 0},         /* to a corner */
        {{1, 0}, {1, 1.125}, 0.125},   /* out of it */
        {{0, 2.5}, {4, -0.5}, 0},      /* 3 x + 4 y = 10, through the corner */
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_close(line_of_sight_depth_margin_m(outline, 4, cases[i].from, cases[i].to),
                     cases[i].margin_m, 1e-15);
        assert_close(line_of_sight_depth_margin_m(outline, 4, cases[i].to, cases[i].from),
                     cases[i].margin_m, 1e-15);
    }
}

TEST(an_outline_without_size_is_a_point)
{
    static const struct vec2 point[4] = {{1, 2}, {1, 2}, {1, 2}, {1, 2}};
    assert_close(line_of_sight_outline_margin_m(point, 4, (struct vec2){0, 0}, (struct vec2){4, 0}),
                 2, 0);
    assert_close(line_of_sight_depth_margin_m(point, 4, (struct vec2){0, 2}, (struct vec2){4, 2}),
                 0, 0);
    assert_true(isnan(line_of_sight_foot_margin_m(point[0], point[1], (struct vec2){1, 0}, 0,
                                                  (struct vec2){0, 0})));
}
