#include "geometry/kinematics.h"

#include "base/units.h"
#include "check.h"
#include "sample.h"

__extension__ typedef __int128 wide;

TEST(known_points_are_read_as_computed_by_hand)
{
    static const struct {
        struct vec2 sensor_m, sensor_mps, boresight, point_m, point_mps;
        struct kinematics kinematics;
    } cases[] = {
        {{0, 0}, {0, 0}, {1, 0}, {3, 4}, {0, 0}, {5, 0.92729521800161223, 0}},
        {{0, 0}, {0, 0}, {0.6, 0.8}, {3, 4}, {10, 0}, {5, 0, 6}},
        {{1, 2}, {3, 0}, {1, 0}, {4, -2}, {3, 5}, {5, -0.92729521800161223, -4}},
        /* ahead, left, right; approaching is negative; own motion counts */
        {{0, 0}, {20, 0}, {1, 0}, {50, 0}, {-10, 0}, {50, 0, -30}},
        {{0, 0}, {0, 0}, {1, 0}, {0, 9}, {7, 2}, {9, PI / 2, 2}},
        {{0, 0}, {0, 0}, {1, 0}, {0, -9}, {7, 2}, {9, -PI / 2, -2}},
        {{0, 0}, {0, 0}, {0, 1}, {0, 9}, {7, 2}, {9, 0, 2}},
        {{0, 0}, {30, 0}, {1, 0}, {10, 0}, {30, 4}, {10, 0, 0}},
        /* behind: pi, whatever the sign of zero */
        {{0, 0}, {0, 0}, {1, 0}, {-2, 0}, {1, 0}, {2, PI, -1}},
        {{0, 0}, {0, 0}, {1, 0}, {-2, -0.0}, {1, 0}, {2, PI, -1}},
        {{0, 0}, {0, 0}, {1, -0.0}, {-2, 0}, {1, 0}, {2, PI, -1}},
        {{0, 0}, {0, 0}, {-1, 0}, {2, 0}, {1, 0}, {2, PI, 1}},
        {{0, 0}, {0, 0}, {1, 0}, {-2, -1e-300}, {1, 0}, {2, PI, -1}},
        /* in the sensor */
        {{7, 8}, {1, 2}, {1, 0}, {7, 8}, {30, 40}, {0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kinematics kinematics =
            kinematics_of(cases[i].sensor_m, cases[i].sensor_mps, cases[i].boresight,
                          cases[i].point_m, cases[i].point_mps);
        assert_close(kinematics.range_m, cases[i].kinematics.range_m, 1e-15);
        assert_close(kinematics.azimuth_rad, cases[i].kinematics.azimuth_rad, 3e-16);
        assert_close(kinematics.range_rate_mps, cases[i].kinematics.range_rate_mps, 2e-15);
    }
}

TEST(range_and_azimuth_are_those_the_point_was_placed_at)
{
    uint64_t sample = 1;
    for (int i = 0; i < 100000; i++) {
        double range_m = sample_between(&sample, 0.1, 300);
        double azimuth_rad = sample_between(&sample, -3.14, 3.14);
        struct vec2 boresight = vec2_heading(sample_between(&sample, -3.14, 3.14));
        double rate_mps = sample_between(&sample, -70, 70);
        double across_mps = sample_between(&sample, -70, 70);
        struct vec2 direction = vec2_turn(vec2_heading(azimuth_rad), boresight);
        struct vec2 velocity_mps =
            vec2_add(vec2_scale(rate_mps, direction), vec2_scale(across_mps, vec2_left(direction)));
        struct kinematics kinematics =
            kinematics_of((struct vec2){0, 0}, (struct vec2){0, 0}, boresight,
                          vec2_scale(range_m, direction), velocity_mps);
        assert_near(kinematics.range_m, range_m, 1e-15);
        assert_close(kinematics.azimuth_rad, azimuth_rad, 2e-15);
        assert_close(kinematics.range_rate_mps, rate_mps, 1e-13);
    }
}

static struct vec2 sample_vector(uint64_t *sample, double bound)
{
    double x = sample_between(sample, -bound, bound);
    return (struct vec2){x, sample_between(sample, -bound, bound)};
}

static struct vec2 mirror(struct vec2 a)
{
    return (struct vec2){a.x, -a.y};
}

TEST(a_mirrored_scene_negates_the_azimuth_and_nothing_else)
{
    uint64_t sample = 2;
    for (int i = 0; i < 200000; i++) {
        struct vec2 sensor_m = sample_vector(&sample, 100);
        struct vec2 sensor_mps = sample_vector(&sample, 50);
        struct vec2 boresight = vec2_heading(sample_between(&sample, -3.14, 3.14));
        struct vec2 point_m = sample_vector(&sample, 100);
        struct vec2 point_mps = sample_vector(&sample, 50);
        struct kinematics left = kinematics_of(sensor_m, sensor_mps, boresight, point_m, point_mps);
        struct kinematics right =
            kinematics_of(mirror(sensor_m), mirror(sensor_mps), mirror(boresight), mirror(point_m),
                          mirror(point_mps));
        assert_true(right.range_m == left.range_m);
        assert_true(right.azimuth_rad == -left.azimuth_rad);
        assert_true(right.range_rate_mps == left.range_rate_mps);
    }
}

/* Coordinates and speeds are whole numbers of 2^-30, so v · r is known exactly. Its products take
 * up to 81 bits and cancel down to the last 40. */
TEST(nearly_tangential_motion_keeps_its_sign_and_its_size)
{
    uint64_t sample = 35;
    for (int i = 0; i < 300000; i++) {
        int64_t x = sample_integer(&sample, INT64_C(1) << 42);
        int64_t y = sample_integer(&sample, INT64_C(1) << 42);
        int64_t vx = -y / 8 + sample_integer(&sample, 1), vy = x / 8 + sample_integer(&sample, 1);
        wide product = (wide)vx * x + (wide)vy * y;
        struct vec2 point_m = {(double)x * 0x1p-30, (double)y * 0x1p-30};
        struct vec2 point_mps = {(double)vx * 0x1p-30, (double)vy * 0x1p-30};
        struct kinematics kinematics = kinematics_of((struct vec2){0, 0}, (struct vec2){0, 0},
                                                     (struct vec2){1, 0}, point_m, point_mps);
        long double range_m = hypotl((long double)point_m.x, (long double)point_m.y);
        double rate_mps = (double)((long double)product * 0x1p-60L / range_m);
        assert_near(kinematics.range_rate_mps, rate_mps, 8e-16);
        assert_true((kinematics.range_rate_mps > 0) == (product > 0));
        assert_true((kinematics.range_rate_mps < 0) == (product < 0));
    }
}
