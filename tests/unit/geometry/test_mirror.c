#include "check.h"

#include "geometry/mirror.h"
#include "sample.h"

/* The example of MODEL 14.1: the wall y = 4, mirroring downwards. */
static struct mirror mirror_between(struct vec2 a, struct vec2 b)
{
    return mirror_of(a, b, (struct motion){0}, (struct vec2){0, 0});
}

/* The same mirror for another sensor. */
static struct mirror seen_from(struct vec2 sensor, const struct mirror *mirror)
{
    return mirror_of(mirror->a, mirror->b, mirror->body, sensor);
}

static struct vec2 random_place(uint64_t *sample, double bound_m)
{
    return (struct vec2){sample_between(sample, -bound_m, bound_m),
                         sample_between(sample, -bound_m, bound_m)};
}

static struct mirror random_mirror(uint64_t *sample)
{
    struct vec2 a = random_place(sample, 40), b = random_place(sample, 40);
    struct motion body = {.position_m = random_place(sample, 40)};
    body.velocity_mps = random_place(sample, 30);
    body.yaw_rate_radps = sample_between(sample, -1, 1);
    return mirror_of(a, b, body, random_place(sample, 40));
}

TEST(the_example_of_the_model_has_its_image_and_its_bounce)
{
    struct mirror wall = mirror_between((struct vec2){-10, 4}, (struct vec2){50, 4});
    struct mirror_image image = mirror_image(&wall, (struct vec2){30, -2}, (struct vec2){-5, 0});
    assert_close(image.place_m.x, 30, 0);
    assert_close(image.place_m.y, 10, 0);
    assert_close(image.velocity_mps.x, -5, 0);
    assert_close(image.velocity_mps.y, 0, 0);
    struct vec2 bounce;
    assert_true(mirror_bounce(&wall, (struct vec2){30, -2}, &bounce));
    assert_close(bounce.x, 12, 1e-14);
    assert_close(bounce.y, 4, 1e-15);
}

TEST(known_walls_mirror_or_do_not)
{
    static const struct {
        struct vec2 a, b, sensor, point;
        bool exists;
        struct vec2 bounce;
    } cases[] = {
        /* seen from either end of the path */
        {{-10, 4}, {50, 4}, {30, -2}, {0, 0}, true, {12, 4}},
        /* ends belong to the wall: the bounce of (0, 0) and (12, 0) is (6, 4) */
        {{6, 4}, {20, 4}, {0, 0}, {12, 0}, true, {6, 4}},
        {{-5, 4}, {6, 4}, {0, 0}, {12, 0}, true, {6, 4}},
        {{0x1.8000000000001p2, 4}, {20, 4}, {0, 0}, {12, 0}, false, {0, 0}},
        {{-5, 4}, {0x1.7ffffffffffffp2, 4}, {0, 0}, {12, 0}, false, {0, 0}},
        /* the inner face does not mirror */
        {{50, 4}, {-10, 4}, {0, 0}, {30, -2}, false, {0, 0}},
        {{50, 4}, {-10, 4}, {0, 8}, {12, 8}, true, {6, 4}},
        /* on either side of the wall, or on it */
        {{-10, 4}, {50, 4}, {0, 0}, {30, 5}, false, {0, 0}},
        {{-10, 4}, {50, 4}, {0, 5}, {30, 0}, false, {0, 0}},
        {{-10, 4}, {50, 4}, {0, 4}, {30, 0}, false, {0, 0}},
        {{-10, 4}, {50, 4}, {0, 0}, {30, 4}, false, {0, 0}},
        {{-10, 4}, {50, 4}, {0, 4}, {30, 4}, false, {0, 0}},
        {{-10, 4}, {50, 4}, {60, 4}, {70, 4}, false, {0, 0}},
        /* less than a rounding before it: far from the sensor, near the point */
        {{-10, 4}, {50, 4}, {0, 0}, {30, 0x1.fffffffffffffp1}, true, {30, 4}},
        {{-10, 4}, {50, 4}, {0, 0x1.fffffffffffffp1}, {30, 0x1.fffffffffffffp1}, true, {15, 4}},
        /* less than a rounding before an oblique wall: in exact arithmetic only */
        {{3.1, -1.6}, {-3.3, -3.2}, {-22.5, -8}, {-22.5, -8}, false, {0, 0}},
        {{2, -2.4},
         {1.6, -2.8},
         {5, -9},
         {0.040000000000000258, -4.3599999999999994},
         false,
         {0, 0}},
        /* the point is the sensor: the foot of the perpendicular */
        {{-10, 4}, {50, 4}, {7, 1}, {7, 1}, true, {7, 4}},
        /* no length, no mirror */
        {{6, 4}, {6, 4}, {0, 0}, {12, 0}, false, {0, 0}},
        /* oblique: (5, 0) and (9, 0) mirrored at y = x */
        {{0, 0}, {9, 9}, {5, 0}, {9, 0}, true, {45. / 14, 45. / 14}},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct mirror mirror =
            mirror_of(cases[i].a, cases[i].b, (struct motion){0}, cases[i].sensor);
        struct vec2 bounce = {-1e9, -1e9};
        bool exists = mirror_bounce(&mirror, cases[i].point, &bounce);
        assert_int_equal(exists, cases[i].exists);
        if (exists) {
            assert_close(bounce.x, cases[i].bounce.x, 8e-15);
            assert_close(bounce.y, cases[i].bounce.y, 8e-15);
            assert_true(mirror_may_bounce(&mirror, cases[i].point, 0));
        }
    }
}

TEST(a_bounce_lies_on_the_wall_and_its_legs_add_up_to_the_image)
{
    uint64_t sample = 71;
    int found = 0;
    for (int i = 0; i < 200000; i++) {
        struct mirror mirror = random_mirror(&sample);
        struct vec2 sensor = mirror.sensor_m, point = random_place(&sample, 40);
        struct vec2 along = vec2_sub(mirror.b, mirror.a);
        double length_m = vec2_length(along);
        struct vec2 bounce;
        if (length_m < 1 || !mirror_bounce(&mirror, point, &bounce))
            continue;
        found++;
        struct vec2 image = mirror_image(&mirror, point, (struct vec2){0, 0}).place_m;
        double legs_m =
            vec2_length(vec2_sub(bounce, sensor)) + vec2_length(vec2_sub(point, bounce));
        assert_near(legs_m, vec2_length(vec2_sub(image, sensor)), 1e-13);
        struct vec2 from_a = vec2_sub(bounce, mirror.a);
        assert_close(vec2_cross(along, from_a) / length_m, 0, 1e-12);
        double part = vec2_dot(along, from_a) / (length_m * length_m);
        assert_true(part > -1e-12 && part < 1 + 1e-12);
    }
    assert_true(found > 20000);
}

/* Fermat: of all ways by the wall's line the mirrored one is the shortest. Golden section finds it
 * from the lengths alone; it exists if its parameter lies inside the wall. */
TEST(the_bounce_is_the_shortest_way_by_the_wall)
{
    uint64_t sample = 72;
    int inside = 0, outside = 0;
    for (int i = 0; i < 5000; i++) {
        struct mirror mirror = random_mirror(&sample);
        struct vec2 sensor = mirror.sensor_m, point = random_place(&sample, 40);
        struct vec2 along = vec2_sub(mirror.b, mirror.a);
        if (vec2_length(along) < 1 || vec2_cross(along, vec2_sub(sensor, mirror.a)) >= 0 ||
            vec2_cross(along, vec2_sub(point, mirror.a)) >= 0)
            continue;
        double low = -1000, high = 1000;
        for (int k = 0; k < 80; k++) {
            double part[2] = {high - 0.6180339887498949 * (high - low),
                              low + 0.6180339887498949 * (high - low)};
            double way_m[2];
            for (int j = 0; j < 2; j++) {
                struct vec2 place = vec2_add(mirror.a, vec2_scale(part[j], along));
                way_m[j] =
                    vec2_length(vec2_sub(place, sensor)) + vec2_length(vec2_sub(place, point));
            }
            if (way_m[0] < way_m[1])
                high = part[1];
            else
                low = part[0];
        }
        double shortest = (low + high) / 2;
        if (fabs(shortest) < 1e-3 || fabs(shortest - 1) < 1e-3)
            continue;
        struct vec2 bounce;
        bool expected = shortest > 0 && shortest < 1;
        assert_int_equal(mirror_bounce(&mirror, point, &bounce), expected);
        inside += expected;
        outside += !expected;
    }
    assert_true(inside > 500 && outside > 500);
}

/* Two pieces of a wall along an axis: a wave that bounces off their joint bounces off both. */
TEST(a_joint_of_two_pieces_along_an_axis_never_loses_the_bounce)
{
    uint64_t sample = 73;
    for (int i = 0; i < 100000; i++) {
        double joint = (double)sample_integer(&sample, 1 << 20) * 0x1p-14;
        double wall = (double)sample_integer(&sample, 1 << 20) * 0x1p-14;
        double height = (double)(1 + sample_bits(&sample) % (1 << 20)) * 0x1p-14;
        double offset = (double)sample_integer(&sample, 1 << 20) * 0x1p-14;
        double side_m = (double)sample_integer(&sample, 1) * 0x1p-30;
        struct vec2 sensor = {joint - offset + 2 * side_m, wall - height};
        struct vec2 point = {joint + offset, wall - height};
        struct vec2 shared = {joint, wall};
        struct mirror before = mirror_between((struct vec2){joint - 1.7, wall}, shared);
        struct mirror after = mirror_between(shared, (struct vec2){joint + 0.3, wall});
        before = seen_from(sensor, &before);
        after = seen_from(sensor, &after);
        struct vec2 bounce;
        assert_int_equal(mirror_bounce(&before, point, &bounce), side_m <= 0);
        assert_int_equal(mirror_bounce(&after, point, &bounce), side_m >= 0);
    }
}

TEST(a_mirrored_scene_has_the_mirrored_answer_to_the_last_bit)
{
    uint64_t sample = 74;
    int found = 0;
    for (int i = 0; i < 100000; i++) {
        struct mirror mirror = random_mirror(&sample), other = mirror;
        struct vec2 sensor = mirror.sensor_m, point = random_place(&sample, 40);
        struct vec2 velocity = random_place(&sample, 30);
        other.a = (struct vec2){mirror.b.x, -mirror.b.y};
        other.b = (struct vec2){mirror.a.x, -mirror.a.y};
        other.body.position_m.y *= -1;
        other.body.velocity_mps.y *= -1;
        other.body.yaw_rate_radps *= -1;
        struct vec2 there = {0, 0}, here = {0, 0};
        other = seen_from((struct vec2){sensor.x, -sensor.y}, &other);
        struct vec2 point_there = {point.x, -point.y};
        bool exists = mirror_bounce(&mirror, point, &here);
        assert_int_equal(mirror_bounce(&other, point_there, &there), exists);
        assert_true(there.x == here.x && there.y == -here.y);
        struct mirror_image image = mirror_image(&mirror, point, velocity);
        struct mirror_image image_there =
            mirror_image(&other, point_there, (struct vec2){velocity.x, -velocity.y});
        assert_true(image_there.place_m.x == image.place_m.x);
        assert_true(image_there.place_m.y == -image.place_m.y);
        assert_true(image_there.velocity_mps.x == image.velocity_mps.x);
        assert_true(image_there.velocity_mps.y == -image.velocity_mps.y);
        found += exists;
    }
    assert_true(found > 10000);
}

/* The wall and the point after t seconds of their own motion. */
static struct vec2 image_after(const struct mirror *mirror, struct vec2 point, struct vec2 velocity,
                               double t)
{
    struct mirror moved = *mirror;
    moved.body = motion_after(mirror->body, t);
    struct vec2 turn = vec2_heading(moved.body.yaw_rad - mirror->body.yaw_rad);
    moved.a = vec2_add(moved.body.position_m,
                       vec2_turn(vec2_sub(mirror->a, mirror->body.position_m), turn));
    moved.b = vec2_add(moved.body.position_m,
                       vec2_turn(vec2_sub(mirror->b, mirror->body.position_m), turn));
    moved = seen_from(mirror->sensor_m, &moved);
    return mirror_image(&moved, vec2_add(point, vec2_scale(t, velocity)), velocity).place_m;
}

/* The central difference misses the derivative by a constant times step^2 (third derivatives of
 * a wall 100 m long turning at 1 rad/s under points of 40 m/s), and by rounding over the step. */
TEST(the_images_velocity_is_the_derivative_of_its_place)
{
    static const double steps_s[] = {1e-2, 1e-3, 1e-4, 1e-5};
    uint64_t sample = 75;
    for (int i = 0; i < 3000; i++) {
        struct mirror mirror = random_mirror(&sample);
        struct vec2 point = random_place(&sample, 40), velocity = random_place(&sample, 30);
        if (vec2_length(vec2_sub(mirror.a, mirror.b)) < 1)
            continue;
        struct vec2 image_mps = mirror_image(&mirror, point, velocity).velocity_mps;
        for (size_t k = 0; k < COUNT(steps_s); k++) {
            double step_s = steps_s[k];
            struct vec2 moved_m = vec2_sub(image_after(&mirror, point, velocity, step_s),
                                           image_after(&mirror, point, velocity, -step_s));
            double tolerance = 400 * step_s * step_s + 1e-12 / step_s;
            assert_close(moved_m.x / (2 * step_s), image_mps.x, tolerance);
            assert_close(moved_m.y / (2 * step_s), image_mps.y, tolerance);
        }
    }
}

TEST(no_wall_that_mirrors_a_point_of_the_disc_is_left_out)
{
    uint64_t sample = 76;
    int mirrored = 0, left_out = 0, needless = 0;
    for (int i = 0; i < 1000000; i++) {
        struct vec2 a = random_place(&sample, 40), b = random_place(&sample, 40);
        if (i % 4 == 0) /* short pieces, far from the origin */
            b = vec2_add(a, random_place(&sample, 1));
        struct vec2 shift = {i % 3 == 0 ? 1e6 : 0, i % 3 == 0 ? -3e6 : 0};
        struct vec2 sensor = vec2_add(random_place(&sample, 40), shift);
        struct mirror mirror =
            mirror_of(vec2_add(a, shift), vec2_add(b, shift), (struct motion){0}, sensor);
        struct vec2 centre = vec2_add(random_place(&sample, 40), shift);
        double radius_m = i % 5 == 0 ? 0 : sample_between(&sample, 0, 6);
        bool may = mirror_may_bounce(&mirror, centre, radius_m), does = false;
        for (int k = 0; k < 4; k++) { /* k = 0: on the rim, the decisive case */
            double part_m = k == 0 ? radius_m : sample_between(&sample, 0, radius_m);
            struct vec2 arm = vec2_scale(part_m * (1 - 0x1p-50),
                                         vec2_heading(sample_between(&sample, -3.2, 3.2)));
            struct vec2 bounce;
            does |= mirror_bounce(&mirror, vec2_add(centre, arm), &bounce);
        }
        assert_true(may || !does);
        mirrored += does;
        left_out += !may;
        needless += may && !does;
    }
    assert_true(mirrored > 100000);
    assert_true(left_out > 500000);
    assert_true(needless < 100000);
}

/* Built so that the disc just touches one of the two rays through the wall's ends. */
TEST(a_disc_that_touches_the_mirrored_sector_is_not_left_out)
{
    uint64_t sample = 77;
    for (int i = 0; i < 100000; i++) {
        struct vec2 b = {sample_between(&sample, 1, 30), 4};
        struct vec2 sensor = {sample_between(&sample, -30, 30), sample_between(&sample, -30, 3.9)};
        struct mirror mirror = mirror_of((struct vec2){0, 4}, b, (struct motion){0}, sensor);
        /* A point that the sensor sees by way of the end, and a disc beyond it through it. */
        struct vec2 end = i % 2 ? mirror.a : mirror.b;
        struct vec2 received = vec2_sub(end, sensor);
        double beyond = sample_between(&sample, 0.01, 3);
        struct vec2 point = {end.x + beyond * received.x, end.y - beyond * received.y};
        double radius_m = sample_between(&sample, 0, 3);
        struct vec2 outwards = {i % 2 ? -received.y : received.y, i % 2 ? -received.x : received.x};
        struct vec2 aside = vec2_scale(radius_m / vec2_length(received), outwards);
        assert_true(mirror_may_bounce(&mirror, vec2_add(point, aside), radius_m));
        assert_false(
            mirror_may_bounce(&mirror, vec2_add(point, aside), radius_m * (1 - 1e-6) - 1e-6));
    }
}

/* Lines of 60 m, some of them along the wall or towards its ends. What is kept has few places too
 * many, so that a cut at the wrong side would be seen. */
TEST(a_clipped_line_keeps_every_place_with_a_bounce)
{
    uint64_t sample = 78;
    int mirrored = 0, left_out = 0, needless = 0;
    for (int i = 0; i < 200000; i++) {
        struct vec2 shift = {i % 3 == 0 ? 1e6 : 0, i % 3 == 0 ? -3e6 : 0};
        struct vec2 a = vec2_add(random_place(&sample, 40), shift);
        struct vec2 b = vec2_add(a, random_place(&sample, i % 4 == 0 ? 1 : 40));
        struct vec2 sensor = vec2_add(random_place(&sample, 40), shift);
        struct vec2 from = vec2_add(random_place(&sample, 40), shift), bounce;
        struct vec2 to =
            i % 5 == 0 ? a : vec2_add(from, i % 7 == 0 ? vec2_sub(b, a) : random_place(&sample, 9));
        struct vec2 along = vec2_scale(1 / vec2_length(vec2_sub(to, from)), vec2_sub(to, from));
        struct mirror mirror = mirror_of(a, b, (struct motion){0}, sensor);
        double first_m = 0, end_m = 60;
        if (mirror.sensor_height_m == 0)
            continue;
        mirror_clip(&mirror, from, along, &first_m, &end_m);
        for (int k = 0; k <= 20; k++) {
            bool kept = first_m <= 3 * k && 3 * k <= end_m;
            bool does = mirror_bounce(&mirror, vec2_add(from, vec2_scale(3 * k, along)), &bounce);
            assert_true(kept || !does);
            mirrored += does;
            left_out += !kept;
            needless += kept && !does;
        }
    }
    assert_true(mirrored > 100000);
    assert_true(left_out > 500000);
    assert_true(needless < 1000);
}
