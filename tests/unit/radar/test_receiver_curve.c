#include "check.h"

#include "base/units.h"
#include "radar/antenna.h"
#include "radar/receiver_curve.h"

/* Slopes that rise and fall; 0 is within a gap, at 1.5 dB. */
static const struct receiver_curve_row ROWS[] = {{-0.4, -12}, {-0.2, 1},  {-0.1, 1},
                                                 {0.1, 2},    {0.15, -3}, {0.5, -3.5}};
static const struct receiver_curve CURVE = {ROWS, COUNT(ROWS), 1.5};

TEST(levels_are_straight_between_rows_and_constant_beyond)
{
    for (size_t i = 0; i < COUNT(ROWS); i++)
        assert_close(receiver_curve_level_db(&CURVE, ROWS[i].at), ROWS[i].level_db, 0);
    for (size_t i = 0; i + 1 < COUNT(ROWS); i++)
        for (double part = 0.1; part < 1; part += 0.2)
            assert_close(
                receiver_curve_level_db(&CURVE, ROWS[i].at + part * (ROWS[i + 1].at - ROWS[i].at)),
                ROWS[i].level_db + part * (ROWS[i + 1].level_db - ROWS[i].level_db), 1e-13);
    assert_close(receiver_curve_level_db(&CURVE, -1), -12, 0);
    assert_close(receiver_curve_level_db(&CURVE, 1), -3.5, 0);
}

TEST(gains_count_from_the_level_at_zero)
{
    assert_close(receiver_curve_gain(&CURVE, 0), 1, 0);
    assert_near(receiver_curve_gain(&CURVE, 0.15), pow(10, -4.5 / 20), 1e-14);
    assert_near(receiver_curve_gain(&CURVE, -1), pow(10, -13.5 / 20), 1e-14);
}

TEST(a_mirrored_table_has_mirrored_gains)
{
    struct receiver_curve_row rows[COUNT(ROWS)];
    for (size_t i = 0; i < COUNT(ROWS); i++)
        rows[COUNT(ROWS) - 1 - i] = (struct receiver_curve_row){-ROWS[i].at, ROWS[i].level_db};
    struct receiver_curve mirrored = {rows, COUNT(rows), 1.5};
    for (double angle_rad = -0.6; angle_rad < 0.6; angle_rad += 0.0137)
        assert_close(receiver_curve_gain(&mirrored, -angle_rad),
                     receiver_curve_gain(&CURVE, angle_rad), 0);
}

/* The sum of both patterns is the curve, and a single echo is read at its own azimuth. */
TEST(a_curve_over_azimuth_changes_power_and_no_angle)
{
    static const struct antenna_row rows[] = {{-1.2, 0.1, -0.5}, {0.05, 1, 0.02}, {1.3, 0.2, 0.6}};
    for (int pattern = ANTENNA_DIPOLE_PAIR; pattern <= ANTENNA_TABLE; pattern++)
        for (int phase = PHASE_CENTRE; phase <= PHASE_ELEMENT; phase++) {
            struct antenna antenna = {.pattern = (enum antenna_pattern)pattern,
                                      .phase = (enum antenna_phase)phase,
                                      .rows = rows,
                                      .row_count = COUNT(rows),
                                      .curve = CURVE};
            for (double azimuth_rad = -1.1; azimuth_rad < 1.1; azimuth_rad += 0.021) {
                double gain = receiver_curve_gain(&CURVE, azimuth_rad);
                struct antenna_pointers pointers = antenna_pointers(&antenna, azimuth_rad);
                double sum = hypot(creal(pointers.sum), cimag(pointers.sum));
                double delta = hypot(creal(pointers.delta), cimag(pointers.delta));
                assert_close(antenna_gain(&antenna, azimuth_rad), gain, 0);
                assert_near(sum, gain, 1e-14);
                /* Both patterns have their zero of delta where its sign changes. */
                double zero_rad =
                    pattern == ANTENNA_TABLE ? antenna_azimuth_rad(&antenna, 0, 1) : 0;
                assert_close(
                    antenna_azimuth_rad(&antenna, copysign(delta, azimuth_rad - zero_rad), sum),
                    azimuth_rad, 1e-13);
            }
        }
}

TEST(a_zero_of_the_sum_stays_zero)
{
    static const struct antenna_row rows[] = {{-0.3, 0, -1}, {0, 1, 0}, {0.3, 0, 1}};
    struct antenna antenna = {.pattern = ANTENNA_TABLE, .rows = rows, .row_count = 3};
    antenna.curve = CURVE;
    assert_close(antenna_gain(&antenna, 0.3), 0, 0);
    assert_close(antenna_gain(&antenna, 0.4), 0, 0);
    assert_near(antenna_gain(&antenna, 0.15), pow(10, -4.5 / 20), 1e-14);
}
