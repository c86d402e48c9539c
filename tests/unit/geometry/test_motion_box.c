#include "geometry/motion.h"

#include "base/units.h"
#include "check.h"
#include "sample.h"

/* A car of 5 m by 2 m, centred on (10, 20), that looks along (0.6, 0.8). */
static const struct box car = {
    .motion = {.position_m = {10, 20}}, .heading = {0.6, 0.8}, .length_m = 5, .width_m = 2};

static void assert_vector(struct vec2 actual, double x, double y, double tolerance)
{
    assert_close(actual.x, x, tolerance);
    assert_close(actual.y, y, tolerance);
}

TEST(a_place_is_a_fraction_of_length_and_width)
{
    assert_vector(motion_box_place(&car, 0, 0), 10, 20, 0);
    assert_vector(motion_box_place(&car, 0.5, 0), 11.5, 22, 1e-14);
    assert_vector(motion_box_place(&car, 0, 0.5), 9.2, 20.6, 1e-14);
    assert_vector(motion_box_place(&car, -1, -0.5), 10 - 3 + 0.8, 20 - 4 - 0.6, 1e-14);
}

TEST(the_outline_is_counter_clockwise_from_the_front_left)
{
    struct vec2 corner[4];
    motion_box_outline(&car, corner);
    assert_vector(corner[0], 11.5 - 0.8, 22 + 0.6, 1e-14);
    assert_vector(corner[1], 8.5 - 0.8, 18 + 0.6, 1e-14);
    assert_vector(corner[2], 8.5 + 0.8, 18 - 0.6, 1e-14);
    assert_vector(corner[3], 11.5 + 0.8, 22 - 0.6, 1e-14);
}

static struct box random_box(uint64_t *sample)
{
    return (struct box){
        .motion.position_m = {sample_between(sample, -50, 50), sample_between(sample, -50, 50)},
        .heading = vec2_heading(sample_between(sample, -PI, PI)),
        .length_m = sample_between(sample, 0.3, 20),
        .width_m = sample_between(sample, 0.3, 3)};
}

/* Walls meet at corners, and sight lines run through them: both ways to one must agree. */
TEST(corners_are_the_places_of_their_fractions)
{
    static const double x[4] = {0.5, -0.5, -0.5, 0.5}, y[4] = {0.5, 0.5, -0.5, -0.5};
    uint64_t sample = 1;
    for (int i = 0; i < 100000; i++) {
        const struct box box = random_box(&sample);
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        for (int k = 0; k < 4; k++)
            assert_true(vec2_same(corner[k], motion_box_place(&box, x[k], y[k])));
    }
}

TEST(a_direction_is_that_from_one_place_to_another)
{
    uint64_t sample = 2;
    for (int i = 0; i < 10000; i++) {
        const struct box box = random_box(&sample);
        double from_x = sample_between(&sample, -1, 0), from_y = sample_between(&sample, -1, 1);
        double to_x = sample_between(&sample, 0.1, 1), to_y = sample_between(&sample, -1, 1);
        struct vec2 along = motion_box_along(&box, from_x, from_y, to_x, to_y);
        struct vec2 way =
            vec2_sub(motion_box_place(&box, to_x, to_y), motion_box_place(&box, from_x, from_y));
        assert_close(vec2_length(along), 1, 1e-15);
        assert_close(vec2_cross(along, way), 0, 1e-13);
        assert_true(vec2_dot(along, way) > 0);
    }
}

TEST(sides_of_boxes_that_are_turned_alike_have_one_direction)
{
    uint64_t sample = 3;
    for (int i = 0; i < 10000; i++) {
        const struct box box = random_box(&sample);
        struct vec2 left = vec2_left(box.heading);
        assert_true(vec2_same(motion_box_along(&box, -0.5, -0.5, 0.5, -0.5), box.heading));
        assert_true(vec2_same(motion_box_along(&box, -0.2, 0.5, 0.1, 0.5), box.heading));
        assert_true(vec2_same(motion_box_along(&box, 0.5, -0.5, 0.5, 0.5), left));
    }
}
