#include "geometry/directivity.h"

#include "base/units.h"
#include "check.h"
#include "sample.h"

static double degrees(double angle_deg)
{
    return angle_deg * (PI / 180);
}

TEST(known_directions_enclose_known_angles)
{
    static const struct {
        struct vec2 a, b;
        double angle_rad;
    } cases[] = {
        {{1, 0}, {1, 0}, 0},
        {{1, 0}, {0, 1}, PI / 2},
        {{1, 0}, {-1, 0}, PI},
        {{1, 0}, {-1, -0.0}, PI},
        {{3, 3}, {0, -5}, 3 * PI / 4},
        {{2, 0}, {1e3, 1e-9}, 1e-12},
        {{-7, 0}, {1e3, 1e-9}, PI - 1e-12},
        {{1, 0}, {1e-5, 1e-5}, PI / 4},
        {{0, 0}, {-3, -4}, 0},
        {{-1, -1}, {-0.0, 0}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_close(directivity_angle_rad(cases[i].a, cases[i].b), cases[i].angle_rad, 1e-15);
        assert_close(directivity_angle_rad(cases[i].b, cases[i].a), cases[i].angle_rad, 1e-15);
    }
    assert_near(directivity_angle_rad((struct vec2){2, 0}, (struct vec2){1e3, 1e-9}), 1e-12, 1e-15);
}

static double long_angle_rad(struct vec2 a, struct vec2 b)
{
    long double ax = (long double)a.x, ay = (long double)a.y;
    long double bx = (long double)b.x, by = (long double)b.y;
    return (double)atan2l(fabsl(ax * by - ay * bx), ax * bx + ay * by);
}

/* Nearly parallel and nearly opposite pairs, where acos of the dot product fails. */
TEST(nearly_parallel_directions_keep_their_angle)
{
    uint64_t sample = 12;
    for (int i = 0; i < 300000; i++) {
        struct vec2 a = {sample_between(&sample, -50, 50), sample_between(&sample, -50, 50)};
        double scale = sample_between(&sample, 0.1, 10) * (i % 2 == 0 ? 1 : -1);
        struct vec2 b = vec2_scale(scale, a);
        b.x *= 1 + 1e-8 * (i % 3);
        double angle_rad = directivity_angle_rad(a, b);
        assert_close(angle_rad, long_angle_rad(a, b), 1e-15);
        assert_true(angle_rad >= 0 && angle_rad <= PI);
        assert_true(angle_rad == directivity_angle_rad(b, a));
        assert_true(angle_rad ==
                    directivity_angle_rad((struct vec2){a.x, -a.y}, (struct vec2){b.x, -b.y}));
    }
}

/* Values of a car's corner (MODEL 2.1: full to 30°, zero at 75°) and of its limits. */
TEST(shapes_have_their_closed_form_values)
{
    static const struct {
        enum visibility_shape shape;
        double full_deg, zero_deg, delta_deg, value;
    } cases[] = {
        {VISIBILITY_RAISED_COSINE, 30, 75, 0, 1},
        {VISIBILITY_RAISED_COSINE, 30, 75, 30, 1},
        {VISIBILITY_RAISED_COSINE, 30, 75, 41.25, 0.85355339059327376},
        {VISIBILITY_RAISED_COSINE, 30, 75, 45, 0.75},
        {VISIBILITY_RAISED_COSINE, 30, 75, 52.5, 0.5},
        {VISIBILITY_RAISED_COSINE, 30, 75, 60, 0.25},
        {VISIBILITY_RAISED_COSINE, 30, 75, 75, 0},
        {VISIBILITY_RAISED_COSINE, 30, 75, 180, 0},
        {VISIBILITY_RAISED_COSINE, 0, 180, 90, 0.5},
        {VISIBILITY_LINEAR, 30, 75, 30, 1},
        {VISIBILITY_LINEAR, 30, 75, 39, 0.8},
        {VISIBILITY_LINEAR, 30, 75, 52.5, 0.5},
        {VISIBILITY_LINEAR, 30, 75, 75, 0},
        {VISIBILITY_LINEAR, 30, 75, 100, 0},
        {VISIBILITY_COSINE, 30, 75, 0, 1},
        {VISIBILITY_COSINE, 30, 75, 25, 0.86602540378443865},
        {VISIBILITY_COSINE, 30, 75, 50, 0.5},
        {VISIBILITY_COSINE, 0, 75, 50, 0.5},
        {VISIBILITY_COSINE, 30, 75, 75, 0},
        {VISIBILITY_COSINE, 75, 75, 50, 0.5},
        {VISIBILITY_HARD, 30, 75, 0, 1},
        {VISIBILITY_HARD, 30, 75, 74.9, 1},
        {VISIBILITY_HARD, 30, 75, 75, 1},
        {VISIBILITY_HARD, 30, 75, 75.1, 0},
        {VISIBILITY_HARD, 0, 0, 0, 1},
        {VISIBILITY_HARD, 0, 180, 180, 1},
        {VISIBILITY_RAISED_COSINE, 40, 40, 39.9, 1},
        {VISIBILITY_RAISED_COSINE, 40, 40, 40, 1},
        {VISIBILITY_LINEAR, 40, 40, 39.9, 1},
        {VISIBILITY_LINEAR, 40, 40, 40, 1},
        {VISIBILITY_RAISED_COSINE, 0, 0, 0, 1},
        {VISIBILITY_LINEAR, 0, 0, 0, 1},
        {VISIBILITY_COSINE, 0, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_close(directivity_visibility(cases[i].shape, degrees(cases[i].full_deg),
                                            degrees(cases[i].zero_deg),
                                            degrees(cases[i].delta_deg)),
                     cases[i].value, 1e-15);
}

TEST(hard_includes_its_edge_and_the_tapered_shapes_end_in_zero)
{
    static const enum visibility_shape tapered[] = {VISIBILITY_RAISED_COSINE, VISIBILITY_LINEAR,
                                                    VISIBILITY_COSINE};
    uint64_t sample = 5;
    for (int i = 0; i < 30000; i++) {
        double zero_rad = sample_between(&sample, 1e-3, PI);
        double full_rad = sample_between(&sample, 0, zero_rad);
        double inside_rad = nextafter(zero_rad, 0);
        double outside_rad = nextafter(zero_rad, 4);
        assert_true(directivity_visibility(VISIBILITY_HARD, full_rad, zero_rad, zero_rad) == 1);
        assert_true(directivity_visibility(VISIBILITY_HARD, full_rad, zero_rad, outside_rad) == 0);
        for (int k = 0; k < 3; k++) {
            double last = directivity_visibility(tapered[k], full_rad, zero_rad, inside_rad);
            assert_true(last > 0 && last < 1e-9);
            assert_true(directivity_visibility(tapered[k], full_rad, zero_rad, zero_rad) == 0);
            assert_true(directivity_visibility(tapered[k], full_rad, zero_rad, outside_rad) == 0);
        }
        for (int k = 0; k < 2; k++)
            assert_true(directivity_visibility(tapered[k], full_rad, zero_rad, full_rad) == 1);
    }
}

TEST(every_shape_falls_from_one_to_zero)
{
    for (enum visibility_shape shape = VISIBILITY_RAISED_COSINE; shape <= VISIBILITY_COSINE;
         shape++) {
        double before = 1;
        for (int i = 0; i <= 18000; i++) {
            double value = directivity_visibility((enum visibility_shape)shape, degrees(30),
                                                  degrees(75), degrees(i * 0.01));
            assert_true(value >= 0 && value <= before);
            before = value;
        }
        assert_true(before == 0);
    }
}

TEST(along_a_vector_visibility_is_that_at_its_angle)
{
    uint64_t sample = 7;
    size_t plain = 0;
    for (int i = 0; i < 200000; i++) {
        double zero_rad = sample_between(&sample, 0, PI);
        double full_rad = i % 3 == 0 ? zero_rad : sample_between(&sample, 0, zero_rad);
        if (i % 16 == 0)
            zero_rad = PI;
        double facing_rad = sample_between(&sample, -PI, PI);
        double aside_rad = i % 4 == 0 ? full_rad : i % 4 == 1 ? zero_rad : PI;
        aside_rad *= 1 + (i % 5 == 0 ? 0 : sample_between(&sample, -1, 1)) *
                             (i % 4 < 2 ? 1e-8 : 1); /* around the deciding angle, or anywhere */
        struct vec2 facing = vec2_heading(facing_rad);
        struct vec2 to_viewer =
            vec2_scale(sample_between(&sample, 0, 300), vec2_heading(facing_rad + aside_rad));
        if (i % 100 == 0)
            to_viewer = vec2_scale(1e-200, to_viewer);
        if (i % 1000 == 0)
            to_viewer = (struct vec2){0, 0};
        for (enum visibility_shape shape = VISIBILITY_RAISED_COSINE; shape <= VISIBILITY_COSINE;
             shape++) {
            double seen =
                directivity_visibility_along(shape, full_rad, zero_rad, facing, to_viewer);
            assert_close(seen,
                         directivity_visibility(shape, full_rad, zero_rad,
                                                directivity_angle_rad(facing, to_viewer)),
                         0);
            plain += seen == 0 || seen == 1;
        }
    }
    assert_true(plain > 200000);
}

/* Viewers within slack_m of the edge of visibility. */
TEST(a_point_surely_unseen_is_unseen_by_all_viewers_nearby)
{
    uint64_t sample = 27;
    int unseen = 0;
    for (int i = 0; i < 300000; i++) {
        double zero_rad = sample_between(&sample, 0, PI), slack_m = i % 2 == 0 ? 1e-6 : 0.1;
        struct vec2 facing = vec2_heading(sample_between(&sample, -PI, PI));
        struct vec2 edge =
            vec2_turn(facing, vec2_heading(zero_rad + sample_between(&sample, 0, 1)));
        struct vec2 to_viewer = vec2_scale(sample_between(&sample, 0, 3), edge);
        if (!directivity_surely_zero(directivity_dark_cosine(zero_rad), facing, to_viewer, slack_m))
            continue;
        unseen++;
        struct vec2 aside = vec2_heading(sample_between(&sample, -PI, PI));
        struct vec2 near = vec2_add(to_viewer, vec2_scale(slack_m, aside));
        for (enum visibility_shape shape = VISIBILITY_RAISED_COSINE; shape <= VISIBILITY_COSINE;
             shape++)
            assert_true(directivity_visibility_along(shape, 0, zero_rad, facing, near) == 0);
    }
    assert_true(unseen > 50000);
    assert_false(directivity_surely_zero(directivity_dark_cosine(PI), (struct vec2){1, 0},
                                         (struct vec2){-9, 0}, 0));
}
