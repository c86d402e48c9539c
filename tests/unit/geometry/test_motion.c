#include "geometry/motion.h"

#include "base/units.h"
#include "check.h"
#include "sample.h"

static const struct {
    double yaw_rad, speed_mps, acceleration_mps2, yaw_rate_radps, duration_s;
} drives[] = {
    {0, 15, 0, 0, 0.1},      {0.7, 15, 0, 1.3e-14, 0.1}, {0.7, 15, 2, 1.3e-14, 10},
    {-2.1, 30, -3, 1e-9, 5}, {1.2, 30, -3, 1e-6, 5},     {3.0, 30, -3, -1e-3, 5},
    {0.3, 10, 1.5, 0.2, 8},  {0.3, 10, -4, -0.7, 6},     {0.3, 0, 2, 0.5, 5.9},
    {0.3, 0, 2, 0.5, 6.1},   {2.5, -5, 3, 1.1, 4},       {-1.5, 8, -1, 6, 10},
    {-1.5, -8, 0.5, -2, 20},
};

enum { DRIVES = sizeof drives / sizeof *drives, STEPS = 20000 };

/* Composite Simpson of (v + a tau) (cos, sin)(yaw + omega tau) in extended precision. */
static struct vec2 integrate_drive_m(size_t i, double duration_s)
{
    long double step_s = (long double)duration_s / STEPS, x = 0, y = 0;
    for (int k = 0; k <= STEPS; k++) {
        long double t_s = k * step_s;
        long double weight = k == 0 || k == STEPS ? 1 : k % 2 == 1 ? 4 : 2;
        long double gain_mps = (long double)drives[i].acceleration_mps2 * t_s;
        long double speed_mps = (long double)drives[i].speed_mps + gain_mps;
        long double turn_rad = (long double)drives[i].yaw_rate_radps * t_s;
        long double yaw_rad = (long double)drives[i].yaw_rad + turn_rad;
        x += weight * speed_mps * cosl(yaw_rad);
        y += weight * speed_mps * sinl(yaw_rad);
    }
    return (struct vec2){(double)(x * step_s / 3), (double)(y * step_s / 3)};
}

static struct motion drive(size_t i, struct vec2 from_m, double duration_s)
{
    return motion_drive(from_m, drives[i].yaw_rad, drives[i].speed_mps, drives[i].acceleration_mps2,
                        drives[i].yaw_rate_radps, duration_s);
}

TEST(a_drive_ends_where_numerical_integration_ends)
{
    for (size_t i = 0; i < DRIVES; i++) {
        double duration_s = drives[i].duration_s;
        struct vec2 moved_m = integrate_drive_m(i, duration_s);
        struct motion end = drive(i, (struct vec2){0, 0}, duration_s);
        assert_close(end.position_m.x, moved_m.x, 1e-12);
        assert_close(end.position_m.y, moved_m.y, 1e-12);
        double yaw_rad = drives[i].yaw_rad + drives[i].yaw_rate_radps * duration_s;
        double speed_mps = drives[i].speed_mps + drives[i].acceleration_mps2 * duration_s;
        assert_close(end.velocity_mps.x, speed_mps * cos(yaw_rad), 1e-13);
        assert_close(end.velocity_mps.y, speed_mps * sin(yaw_rad), 1e-13);
        assert_close(end.yaw_rad, yaw_rad, 1e-14);
        assert_true(end.yaw_rate_radps == drives[i].yaw_rate_radps);
    }
}

TEST(a_drive_starts_at_its_place_and_shifts_with_it)
{
    for (size_t i = 0; i < DRIVES; i++) {
        struct motion start = drive(i, (struct vec2){3, -4}, 0);
        assert_true(start.position_m.x == 3 && start.position_m.y == -4);
        assert_true(start.yaw_rad == drives[i].yaw_rad);
        struct motion moved = drive(i, (struct vec2){3, -4}, 2);
        struct motion centred = drive(i, (struct vec2){0, 0}, 2);
        assert_close(moved.position_m.x - 3, centred.position_m.x, 1e-13);
        assert_close(moved.position_m.y + 4, centred.position_m.y, 1e-13);
    }
}

/* j1 h = sum over k of (-1)^k h^(2k+1) (2k+2)/(2k+3)!: the difference of the series of sine and
 * cosine, term by term. */
static double series_j1(double h)
{
    long double wide_h = (long double)h, power = wide_h / 6, sum = 0;
    for (int k = 0; k < 30; k++) {
        sum += power * (2 * k + 2);
        power *= -wide_h * wide_h / ((2 * k + 4) * (2 * k + 5));
    }
    return (double)sum;
}

/* Two seconds that come to rest at half time, in the frame of the heading there: only the term of
 * j1 is left, and the turn is h = omega. */
TEST(a_reversal_at_half_time_leaves_the_sideways_term_alone)
{
    for (int i = 0; i < 4000; i++) {
        double h = i < 1000 ? 1e-300 * pow(10, i * 0.3) : (i - 999) * 1e-3;
        for (int sign = -1; sign <= 1; sign += 2) {
            struct motion end = motion_drive((struct vec2){0, 0}, -sign * h, -1, 1, sign * h, 2);
            assert_true(end.position_m.x == 0);
            assert_near(end.position_m.y, 2 * series_j1(sign * h), 1e-15);
        }
    }
}

/* Expected from the first terms of the series of sine and cosine in omega t. */
TEST(a_hardly_turning_step_is_not_lost_to_rounding)
{
    static const double rates_radps[] = {0, 1e-300, 1.3e-14, -1.3e-14, 1e-9, 1e-6, -1e-4};
    for (size_t i = 0; i < sizeof rates_radps / sizeof *rates_radps; i++) {
        long double turn_rad = (long double)rates_radps[i] * 0.1L;
        double x_m = (double)(1.5L * (1 - turn_rad * turn_rad / 6));
        double y_m = (double)(1.5L * (turn_rad / 2 - turn_rad * turn_rad * turn_rad / 24));
        struct motion driven = motion_drive((struct vec2){0, 0}, 0, 15, 0, rates_radps[i], 0.1);
        struct motion after = motion_after(
            (struct motion){.velocity_mps = {15, 0}, .yaw_rate_radps = rates_radps[i]}, 0.1);
        assert_near(driven.position_m.x, x_m, 1e-15);
        assert_near(driven.position_m.y, y_m, 1e-15);
        assert_near(after.position_m.x, x_m, 1e-15);
        assert_near(after.position_m.y, y_m, 1e-15);
    }
}

TEST(a_full_circle_ends_at_its_start)
{
    struct motion body = {{5, 7}, {10, 0}, 0, 0.5};
    struct motion half = motion_after(body, 2 * PI);
    assert_close(half.position_m.x, 5, 1e-14);
    assert_close(half.position_m.y, 47, 1e-13);
    struct motion full = motion_after(body, 4 * PI);
    assert_close(full.position_m.x, 5, 1e-13);
    assert_close(full.position_m.y, 7, 1e-13);
    assert_close(full.velocity_mps.x, 10, 1e-14);
    assert_close(full.velocity_mps.y, 0, 1e-13);
    assert_close(full.yaw_rad, 2 * PI, 1e-15);
}

TEST(going_forth_and_back_returns)
{
    uint64_t sample = 4;
    for (int i = 0; i < 100000; i++) {
        struct motion body = {
            .position_m = {sample_between(&sample, -500, 500), sample_between(&sample, -500, 500)},
            .velocity_mps = {sample_between(&sample, -50, 50), sample_between(&sample, -50, 50)},
            .yaw_rad = sample_between(&sample, -3, 3),
            .yaw_rate_radps = sample_between(&sample, -1, 1),
        };
        double duration_s = sample_between(&sample, -2, 2);
        struct motion back = motion_after(motion_after(body, duration_s), -duration_s);
        assert_close(back.position_m.x, body.position_m.x, 5e-13);
        assert_close(back.position_m.y, body.position_m.y, 5e-13);
        assert_close(back.velocity_mps.x, body.velocity_mps.x, 5e-14);
        assert_close(back.velocity_mps.y, body.velocity_mps.y, 5e-14);
        assert_close(back.yaw_rad, body.yaw_rad, 2e-15);
        assert_true(back.yaw_rate_radps == body.yaw_rate_radps);
    }
}

TEST(a_crabbing_body_moves_along_its_velocity_and_not_its_yaw)
{
    struct motion end = motion_after((struct motion){{1, 1}, {0, 3}, 0.4, 0}, 2);
    assert_close(end.position_m.x, 1, 0);
    assert_close(end.position_m.y, 7, 0);
    assert_close(end.yaw_rad, 0.4, 0);
}

TEST(the_path_length_counts_reversing_forward)
{
    static const struct {
        double speed_mps, acceleration_mps2, duration_s, length_m;
    } cases[] = {
        {10, 0, 3, 30},  {10, 2, 3, 39},  {10, -2, 3, 21},
        {10, -5, 2, 10}, {10, -5, 4, 20}, {10, -5, 3, 12.5},
        {-10, 0, 3, 30}, {-3, 2, 1, 2},   {-3, 2, 3, 4.5},
        {0, 2, 3, 9},    {0, -2, 3, 9},   {0, 0, 5, 0},
        {10, -5, 0, 0},  {4, -8, 1, 2},   {1e-3, -1e3, 1, 499.999000001},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_close(motion_drive_length_m(cases[i].speed_mps, cases[i].acceleration_mps2,
                                           cases[i].duration_s),
                     cases[i].length_m, 1e-13 * (1 + cases[i].length_m));
}

TEST(a_material_point_moves_with_its_body)
{
    struct motion body = {{10, 20}, {3, 4}, 0.5, 2};
    struct vec2 own = motion_velocity_at(&body, body.position_m);
    assert_true(own.x == 3 && own.y == 4);
    struct vec2 ahead = motion_velocity_at(&body, (struct vec2){12, 20});
    assert_true(ahead.x == 3 && ahead.y == 8);
    struct vec2 left = motion_velocity_at(&body, (struct vec2){10, 21});
    assert_true(left.x == 1 && left.y == 4);
}

TEST(a_mirrored_drive_ends_mirrored_to_the_last_bit)
{
    for (size_t i = 0; i < DRIVES; i++) {
        struct motion left = drive(i, (struct vec2){3, 4}, drives[i].duration_s);
        struct motion right = motion_drive((struct vec2){3, -4}, -drives[i].yaw_rad,
                                           drives[i].speed_mps, drives[i].acceleration_mps2,
                                           -drives[i].yaw_rate_radps, drives[i].duration_s);
        assert_true(right.position_m.x == left.position_m.x);
        assert_true(right.position_m.y == -left.position_m.y);
        assert_true(right.velocity_mps.x == left.velocity_mps.x);
        assert_true(right.velocity_mps.y == -left.velocity_mps.y);
    }
}

struct hermite {
    struct vec2 position_m, velocity_mps, acceleration_mps2;
};

/* A span of the cubic p = c0 + c1 t + c2 t^2 + c3 t^3 in each coordinate. */
static struct vec2 cubic(const struct vec2 c[4], int derivative, double t_s)
{
    static const double factors[3][4] = {{1, 1, 1, 1}, {0, 1, 2, 3}, {0, 0, 2, 6}};
    struct vec2 sum = {0, 0};
    for (int k = derivative; k < 4; k++)
        sum = vec2_add(sum, vec2_scale(factors[derivative][k] * pow(t_s, k - derivative), c[k]));
    return sum;
}

static struct hermite hermite_of_cubic(const struct vec2 c[4], double duration_s, double s)
{
    struct hermite at;
    motion_hermite(cubic(c, 0, 0), cubic(c, 1, 0), cubic(c, 0, duration_s), cubic(c, 1, duration_s),
                   duration_s, s, &at.position_m, &at.velocity_mps, &at.acceleration_mps2);
    return at;
}

static void assert_vectors_close(struct vec2 actual, struct vec2 expected, double tolerance)
{
    assert_close(actual.x, expected.x, tolerance);
    assert_close(actual.y, expected.y, tolerance);
}

TEST(a_hermite_span_of_a_cubic_is_that_cubic)
{
    static const struct vec2 straight[4] = {{3, -2}, {10, 5}, {0, 0}, {0, 0}};
    static const struct vec2 braking[4] = {{3, -2}, {10, 0}, {-1.5, 0}, {0, 0}};
    static const struct vec2 lane_change[4] = {{-40, 7}, {20, 0}, {0.3, 0.7}, {-0.2, -0.11}};
    static const struct vec2 standing[4] = {{0.1, 0.7}, {0, 0}, {0, 0}, {0, 0}};
    static const struct vec2 *const cubics[] = {straight, braking, lane_change, standing};
    for (size_t c = 0; c < 4; c++) {
        for (int i = 0; i <= 20; i++) {
            double s = i / 20.0;
            struct hermite at = hermite_of_cubic(cubics[c], 2.5, s);
            assert_vectors_close(at.position_m, cubic(cubics[c], 0, 2.5 * s), 2e-14);
            assert_vectors_close(at.velocity_mps, cubic(cubics[c], 1, 2.5 * s), 5e-14);
            assert_vectors_close(at.acceleration_mps2, cubic(cubics[c], 2, 2.5 * s), 2e-13);
        }
    }
}

TEST(a_hermite_span_keeps_its_end_velocities_and_a_standing_body)
{
    const struct vec2 from_m = {0.1, 0.7}, to_m = {30.3, -0.9}, rest = {0, 0};
    const struct vec2 from_mps = {13.7, 0.3}, to_mps = {9.1, -2.2};
    struct hermite at;
    motion_hermite(from_m, from_mps, to_m, to_mps, 2.5, 0, &at.position_m, &at.velocity_mps,
                   &at.acceleration_mps2);
    assert_vectors_close(at.position_m, from_m, 0);
    assert_vectors_close(at.velocity_mps, from_mps, 0);
    motion_hermite(from_m, from_mps, to_m, to_mps, 2.5, 1, &at.position_m, &at.velocity_mps,
                   &at.acceleration_mps2);
    assert_vectors_close(at.position_m, to_m, 1e-14);
    assert_vectors_close(at.velocity_mps, to_mps, 0);
    for (int i = 0; i <= 1000; i++) {
        motion_hermite(from_m, rest, from_m, rest, 2.5, i / 1000.0, &at.position_m,
                       &at.velocity_mps, &at.acceleration_mps2);
        assert_vectors_close(at.position_m, from_m, 0);
        assert_vectors_close(at.velocity_mps, rest, 0);
        assert_vectors_close(at.acceleration_mps2, rest, 0);
    }
}

/* The least speed of a span on a line of 1 m in 1 s, among 2,001 of them. */
static double least_mps(double from_mps, double to_mps)
{
    double least = (double)INFINITY;
    for (int i = 0; i <= 2000; i++) {
        struct hermite at;
        motion_hermite((struct vec2){0, 0}, (struct vec2){from_mps, 0}, (struct vec2){1, 0},
                       (struct vec2){to_mps, 0}, 1, i / 2000.0, &at.position_m, &at.velocity_mps,
                       &at.acceleration_mps2);
        least = fmin(least, at.velocity_mps.x);
    }
    return least;
}

TEST(a_monotone_share_stops_spans_from_running_back_and_leaves_all_others)
{
    for (int i = 0; i <= 60; i++) {
        for (int k = 0; k <= 60; k++) {
            double from_mps = i / 10.0, to_mps = k / 10.0;
            double share = motion_monotone_share(from_mps, to_mps, 1);
            double least = least_mps(from_mps, to_mps);
            assert_true(least_mps(share * from_mps, share * to_mps) >= -1e-12);
            assert_true(share == 1 ? least >= -1e-12 : share < 1 && least < 1e-5);
        }
    }
    assert_true(motion_monotone_share(0, 0, 0) == 1);
    assert_true(motion_monotone_share(1, 0, 0) == 0);
    assert_true(motion_monotone_share(1, 2, 1e-300) < 1e-299);
}
