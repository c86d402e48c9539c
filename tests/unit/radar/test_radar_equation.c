#include "check.h"

#include "base/units.h"
#include "radar/antenna.h"
#include "radar/radar_equation.h"

static const struct antenna DIPOLE_PAIR = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_ELEMENT};

static const struct radar_row ROWS[] = {{1, 1000}, {2, 300}, {5, 100}, {20, 5}};

static struct radar_equation paper_law(void)
{
    return (struct radar_equation){.exponent = 2,
                                   .calibration_ercs = 0.8,
                                   .calibration_range_m = 30,
                                   .range_floor_m = 0.5,
                                   .threshold = units_amplitude_from_db(6)};
}

static struct radar_equation table_law(void)
{
    return (struct radar_equation){.range_floor_m = 0.5,
                                   .threshold = units_amplitude_from_db(6),
                                   .rows = ROWS,
                                   .row_count = sizeof ROWS / sizeof ROWS[0]};
}

TEST(the_amplitude_at_the_detection_range_is_the_threshold)
{
    struct radar_equation law = paper_law();
    for (int q = 2; q <= 5; q++)
        for (int i = 1; i <= 100; i++) {
            law.exponent = 0.5 * q;
            double ercs = 0.03 * i;
            double gain = 0.37;
            double range_m = radar_detection_range_m(&law, gain, ercs);
            assert_near(radar_reference_amplitude(&law, fmax(range_m, 0.5)) * gain * ercs,
                        range_m < 0.5 ? law.threshold * pow(range_m / 0.5, law.exponent)
                                      : law.threshold,
                        1e-14);
        }
}

TEST(a_table_is_left_for_good_at_its_last_crossing)
{
    struct radar_equation law = table_law();
    /* Rows, between rows, and beyond the last one. */
    for (double range_m = 1.1; range_m < 200; range_m *= 1.3) {
        double ercs = law.threshold / radar_reference_amplitude(&law, range_m);
        assert_near(radar_detection_range_m(&law, 1, ercs), range_m, 1e-12);
        assert_near(radar_detection_range_m(&law, 0.5, 2 * ercs), range_m, 1e-12);
    }
    assert_close(radar_detection_range_m(&law, 1, 1e-3), 0, 0);
    static const struct radar_row dip[] = {{1, 1000}, {2, 1}, {3, 100}, {4, 10}};
    law.rows = dip;
    law.row_count = 4;
    assert_close(radar_detection_range_m(&law, 1, law.threshold / 50), 3 * pow(4.0 / 3, log10(2)),
                 1e-12);
    law.row_count = 3;
    assert_true(isinf(radar_detection_range_m(&law, 1, 1)));
}

/* MODEL 4.1, 4.2 and 13. */
TEST(reference_amplitudes_are_those_of_the_paper)
{
    struct radar_equation law = paper_law();
    double amplitude =
        radar_reference_amplitude(&law, 10) * antenna_gain(&DIPOLE_PAIR, 20 * DEGREE) * 0.5;
    assert_close(amplitude, 8.63, 0.005);
    assert_close(units_amplitude_db(amplitude), 18.7, 0.05);
    assert_near(radar_reference_amplitude(&law, 30) * 0.8, law.threshold, 1e-15);
}

TEST(twice_the_range_costs_twelve_decibels)
{
    struct radar_equation law = paper_law();
    for (int i = 1; i < 200; i++)
        assert_near(radar_reference_amplitude(&law, i), 4 * radar_reference_amplitude(&law, 2 * i),
                    1e-15);
}

TEST(other_exponents_move_the_detection_ranges)
{
    static const struct {
        double exponent, range_m, expected_m[6];
    } cases[] = {
        {1.5, 30, {11.9, 15.6, 18.9, 21.9, 24.8, 27.4}},
        {1, 30, {7.5, 11.25, 15, 18.75, 22.5, 26.25}},
        {2, 39.3, {19.7, 24.1, 27.8, 31.1, 34.0, 36.8}},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        for (int k = 0; k < 6; k++) {
            struct radar_equation law = paper_law();
            law.exponent = cases[i].exponent;
            law.calibration_range_m = cases[i].range_m;
            assert_close(radar_detection_range_m(&law, 1, 0.1 * (k + 2)), cases[i].expected_m[k],
                         0.0501);
        }
}

TEST(below_the_floor_the_range_counts_as_the_floor)
{
    struct radar_equation law = paper_law();
    double at_floor = radar_reference_amplitude(&law, 0.5);
    assert_near(at_floor, law.threshold / 0.8 * 3600, 1e-15);
    assert_close(radar_reference_amplitude(&law, 0), at_floor, 0);
    assert_close(radar_reference_amplitude(&law, 0.499), at_floor, 0);
    assert_true(radar_reference_amplitude(&law, 0.501) < at_floor);

    struct radar_equation table = table_law();
    table.range_floor_m = 2;
    assert_close(radar_reference_amplitude(&table, 1), 300, 1e-12);
}

TEST(a_table_passes_through_its_rows)
{
    struct radar_equation law = table_law();
    for (size_t i = 0; i < law.row_count; i++)
        assert_near(radar_reference_amplitude(&law, ROWS[i].range_m), ROWS[i].amplitude, 1e-15);
}

TEST(a_table_is_straight_in_both_logarithms)
{
    struct radar_equation law = table_law();
    for (size_t i = 0; i + 1 < law.row_count; i++)
        assert_near(radar_reference_amplitude(&law, sqrt(ROWS[i].range_m * ROWS[i + 1].range_m)),
                    sqrt(ROWS[i].amplitude * ROWS[i + 1].amplitude), 1e-14);
}

TEST(a_table_is_constant_before_and_goes_on_beyond)
{
    struct radar_equation law = table_law();
    assert_close(radar_reference_amplitude(&law, 0.7), 1000, 0);
    /* From 5 to 20 m the amplitude falls by 20: so it does again from 20 to 80 m. */
    assert_near(radar_reference_amplitude(&law, 80), 0.25, 1e-14);
}

TEST(two_rows_of_the_power_law_are_the_power_law)
{
    struct radar_equation law = paper_law();
    struct radar_row rows[] = {{1, radar_reference_amplitude(&law, 1)},
                               {30, radar_reference_amplitude(&law, 30)}};
    struct radar_equation table = table_law();
    table.rows = rows;
    table.row_count = 2;
    for (int i = 10; i < 1000; i++)
        assert_near(radar_reference_amplitude(&table, 0.1 * i),
                    radar_reference_amplitude(&law, 0.1 * i), 1e-13);
}

TEST(one_row_holds_everywhere)
{
    struct radar_equation table = table_law();
    table.row_count = 1;
    assert_close(radar_reference_amplitude(&table, 0.6), 1000, 0);
    assert_close(radar_reference_amplitude(&table, 60), 1000, 0);
}

/* MODEL 3. */
TEST(an_ercs_is_the_root_of_a_cross_section_over_ten)
{
    for (double ercs = 0.1; ercs < 2; ercs += 0.1) {
        assert_near(radar_cross_section_m2(ercs), 10 * ercs * ercs, 1e-15);
        assert_near(radar_ercs(10 * ercs * ercs), ercs, 1e-15);
    }
}
