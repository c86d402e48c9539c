#include "check.h"

#include "base/units.h"
#include "sample.h"
#include "support/antennas.h"

static const long double PI_LONG = 3.14159265358979323846264338327950288L;

static const struct antenna_row EVEN_ROWS[] = {
    {-PI / 2, 0, -0.2}, {-0.7, 0.3, -0.6}, {0, 0.9, 0}, {0.7, 0.3, 0.6}, {PI / 2, 0, 0.2}};
static const struct antenna EVEN = {.pattern = ANTENNA_TABLE,
                                    .phase = PHASE_CENTRE,
                                    .rows = EVEN_ROWS,
                                    .row_count = COUNT(EVEN_ROWS)};

static double magnitude(double _Complex pointer)
{
    return hypot(creal(pointer), cimag(pointer));
}

static double ulps(double actual, long double exact)
{
    double ulp = ldexp(1, ilogb((double)exact) - 52);
    return (double)fabsl(((long double)actual - exact) / (long double)ulp);
}

/* MODEL 7.1 in extended precision; near the side by the distance to it, half a turn in two parts.
 */
struct reference {
    long double cos_u, sin_u, element;
};

static struct reference reference_at(double azimuth_rad)
{
    long double azimuth = (long double)azimuth_rad;
    long double from_side =
        (long double)(PI / 2 - azimuth_rad) + 6.123233995736766035868820147e-17L;
    long double half_chord = sinl(from_side / 2);
    long double u = PI_LONG / 2 * sinl(azimuth);
    struct reference reference = {.cos_u = cosl(u), .sin_u = sinl(u)};
    long double cosine = azimuth_rad < 1 ? cosl(azimuth) : sinl(from_side);
    if (azimuth_rad >= 1)
        reference.cos_u = sinl(PI_LONG * half_chord * half_chord);
    reference.element = (u > 0 ? reference.sin_u / u : 1) * cosine;
    return reference;
}

static double width_deg(double level)
{
    double inside = 0;
    double outside = 90;
    while (outside - inside > 1e-10) {
        double middle = (inside + outside) / 2;
        if (antenna_gain(&CENTRE, middle * DEGREE) > level)
            inside = middle;
        else
            outside = middle;
    }
    return inside;
}

TEST(the_sum_beam_has_the_published_widths)
{
    assert_close(2 * width_deg(sqrt(0.5)), 45.910123, 1e-5);
    assert_close(antenna_beam_rad(&CENTRE), 45.910123 * DEGREE, 5e-5);
}

/* Equation (6) as printed: half the sum and half the difference of the two dipoles. */
TEST(element_phase_is_equation_six_as_printed)
{
    for (int i = -89; i <= 89; i++) {
        double u = PI / 2 * sin(i * DEGREE);
        double element = (i == 0 ? 1 : sin(u) / u) * cos(i * DEGREE);
        struct antenna_pointers pointers = antenna_pointers(&ELEMENT, i * DEGREE);
        assert_close(creal(pointers.sum), element * (1 + cos(2 * u)) / 2, 3e-16);
        assert_close(cimag(pointers.sum), element * sin(2 * u) / 2, 3e-16);
        assert_close(creal(pointers.delta), element * (1 - cos(2 * u)) / 2, 3e-16);
        assert_close(cimag(pointers.delta), -element * sin(2 * u) / 2, 3e-16);
    }
}

/* MODEL 13: delta over sum at +10 and -40 deg, whatever the phase reference. */
TEST(delta_over_sum_is_minus_j_tan_u)
{
    static const double rows[][2] = {{10, -0.279738}, {-40, 1.591105}};
    const struct antenna *antennas[] = {&CENTRE, &ELEMENT};
    for (size_t i = 0; i < COUNT(rows); i++)
        for (size_t k = 0; k < 2; k++) {
            struct antenna_pointers pointers = antenna_pointers(antennas[k], rows[i][0] * DEGREE);
            double _Complex ratio = pointers.delta / pointers.sum;
            assert_close(creal(ratio), 0, 1e-15);
            assert_close(cimag(ratio), rows[i][1], 5.01e-7);
        }
}

/* Hard cases 1 to 5. */
TEST(pointers_keep_eight_ulp_up_to_the_side)
{
    for (int i = 0; i < 100000; i++) {
        double azimuth_rad = antennas_dense_azimuth(i, 300);
        struct reference exact = reference_at(azimuth_rad);
        long double sum = exact.element * exact.cos_u;
        long double delta = exact.element * exact.sin_u;
        struct antenna_pointers pointers = antenna_pointers(&CENTRE, azimuth_rad);
        assert_true(ulps(creal(pointers.sum), sum) <= 8);
        assert_true(ulps(-cimag(pointers.delta), delta) <= 8);
        assert_true(ulps(antenna_gain(&ELEMENT, azimuth_rad), sum) <= 8);
        assert_close(cimag(pointers.sum), 0, 0);
        assert_close(creal(pointers.delta), 0, 0);
        pointers = antenna_pointers(&ELEMENT, azimuth_rad);
        assert_true(ulps(creal(pointers.sum), sum * exact.cos_u) <= 12);
        assert_true(ulps(cimag(pointers.sum), sum * exact.sin_u) <= 12);
        assert_true(ulps(-cimag(pointers.delta), delta * exact.cos_u) <= 12);
        if (azimuth_rad > 1e-150)
            assert_true(ulps(creal(pointers.delta), delta * exact.sin_u) <= 12);
    }
}

TEST(boresight_and_side_have_finite_pointers)
{
    struct antenna_pointers ahead = antenna_pointers(&ELEMENT, 0);
    assert_close(magnitude(ahead.sum - 1), 0, 0);
    assert_close(magnitude(ahead.delta), 0, 0);
    struct antenna_pointers side = antenna_pointers(&ELEMENT, PI / 2);
    assert_near(magnitude(side.delta), 2 / PI * 6.123233995736766e-17, 1e-15);
    assert_true(magnitude(side.sum) < 1e-48);
}

TEST(mirrored_azimuths_give_mirrored_pointers)
{
    for (int i = 0; i < 100000; i++) {
        double azimuth_rad = antennas_dense_azimuth(i, 300);
        struct antenna_pointers left = antenna_pointers(&CENTRE, azimuth_rad);
        struct antenna_pointers right = antenna_pointers(&CENTRE, -azimuth_rad);
        assert_close(creal(right.sum), creal(left.sum), 0);
        assert_close(cimag(right.delta), -cimag(left.delta), 0);
        left = antenna_pointers(&ELEMENT, azimuth_rad);
        right = antenna_pointers(&ELEMENT, -azimuth_rad);
        assert_close(creal(right.sum), creal(left.sum), 0);
        assert_close(cimag(right.sum), -cimag(left.sum), 0);
        assert_close(creal(right.delta), creal(left.delta), 0);
        assert_close(cimag(right.delta), -cimag(left.delta), 0);
        left = antenna_pointers(&EVEN, azimuth_rad);
        right = antenna_pointers(&EVEN, -azimuth_rad);
        assert_close(creal(right.sum), creal(left.sum), 0);
        assert_close(cimag(right.delta), -cimag(left.delta), 0);
    }
}

TEST(mirrored_ratios_give_mirrored_azimuths)
{
    for (int i = 0; i < 20000; i++) {
        double angle = PI / 2 * i / 19999;
        double delta = sin(angle);
        double sum = fmax(cos(angle), 0);
        assert_close(antenna_azimuth_rad(&CENTRE, -delta, sum),
                     -antenna_azimuth_rad(&CENTRE, delta, sum), 0);
        assert_close(antenna_azimuth_rad(&EVEN, -delta, sum),
                     -antenna_azimuth_rad(&EVEN, delta, sum), 0);
    }
}

/* Hard case 7: any pair, also far towards boresight and the side. */
TEST(the_inverse_keeps_four_ulp_up_to_the_side)
{
    for (int i = -40000; i <= 40000; i++) {
        double delta = i < 0 ? pow(10, 0.005 * i) : 1;
        double sum = i < 0 ? 1 : pow(10, -0.0005 * i);
        long double exact;
        if (delta <= sum) {
            exact = asinl(atan2l((long double)delta, (long double)sum) / (PI_LONG / 2));
        } else {
            /* 1 - sin = 2 sin^2(half the distance to the side). */
            long double chord = atan2l((long double)sum, (long double)delta) / (PI_LONG / 2);
            exact = PI_LONG / 2 - 2 * asinl(sqrtl(chord / 2));
        }
        assert_true(ulps(antenna_azimuth_rad(&CENTRE, delta, sum), exact) <= 4);
    }
}

TEST(the_inverse_of_special_ratios_is_exact)
{
    assert_close(antenna_azimuth_rad(&CENTRE, 0, 3), 0, 0);
    assert_close(antenna_azimuth_rad(&CENTRE, 0, 1e-320), 0, 0);
    assert_close(antenna_azimuth_rad(&CENTRE, 2, 0), PI / 2, 0);
    assert_close(antenna_azimuth_rad(&CENTRE, -1e-320, 0), -PI / 2, 0);
    assert_near(antenna_azimuth_rad(&CENTRE, 1e300, 1e300), PI / 6, 3e-16);
    assert_near(antenna_azimuth_rad(&CENTRE, -1e-300, 1e-300), -PI / 6, 3e-16);
}

TEST(a_table_is_linear_between_its_rows)
{
    for (size_t i = 0; i < COUNT(SKEWED_ROWS); i++) {
        struct antenna_pointers pointers = antenna_pointers(&SKEWED, SKEWED_ROWS[i].azimuth_rad);
        assert_close(creal(pointers.sum), SKEWED_ROWS[i].sum, 0);
        assert_close(cimag(pointers.delta), -SKEWED_ROWS[i].delta, 0);
    }
    assert_near(antenna_gain(&SKEWED, -0.2), 0.7, 1e-15);
    assert_near(cimag(antenna_pointers(&SKEWED, -0.2).delta), 0.2, 1e-15);
    assert_near(antenna_gain(&SKEWED, 0.2), 0.94, 1e-15);
    assert_near(cimag(antenna_pointers(&SKEWED, 0.2).delta), -0.2, 1e-15);
}

TEST(a_table_is_zero_outside)
{
    static const double outside[] = {-1.5, -1.2000001, 1.3000001, 1.5};
    for (size_t i = 0; i < COUNT(outside); i++) {
        struct antenna_pointers pointers = antenna_pointers(&SKEWED, outside[i]);
        assert_close(magnitude(pointers.sum), 0, 0);
        assert_close(magnitude(pointers.delta), 0, 0);
        assert_close(antenna_gain(&SKEWED, outside[i]), 0, 0);
    }
}

TEST(a_table_turns_with_the_dipole_pair_under_element_phase)
{
    struct antenna turned = SKEWED;
    turned.phase = PHASE_ELEMENT;
    for (int i = -12; i <= 13; i++) {
        double azimuth_rad = 0.1 * i;
        double u = PI / 2 * sin(azimuth_rad);
        struct antenna_pointers still = antenna_pointers(&SKEWED, azimuth_rad);
        struct antenna_pointers pointers = antenna_pointers(&turned, azimuth_rad);
        double _Complex turn = cos(u) + sin(u) * (double _Complex)I;
        assert_close(magnitude(pointers.sum - still.sum * turn), 0, 3e-16);
        assert_close(magnitude(pointers.delta - still.delta * turn), 0, 3e-16);
        assert_near(antenna_gain(&turned, azimuth_rad), antenna_gain(&SKEWED, azimuth_rad), 0);
    }
}

TEST(a_table_is_inverted_where_its_lines_cross_the_ratio)
{
    static const struct antenna_row rows[] = {{0, 1, 0}, {0.2, 0.5, 0.5}};
    struct antenna antenna = {
        .pattern = ANTENNA_TABLE, .phase = PHASE_CENTRE, .rows = rows, .row_count = COUNT(rows)};
    /* At the part w of the interval delta : sum = w/2 : 1 - w/2. */
    assert_near(antenna_azimuth_rad(&antenna, 1, 4), 0.08, 1e-15);
    assert_near(antenna_azimuth_rad(&antenna, 1e-300, 4e-300), 0.08, 1e-15);
    assert_near(antenna_azimuth_rad(&antenna, 1e300, 4e300), 0.08, 1e-15);
    assert_near(antenna_azimuth_rad(&antenna, 1, 3), 0.1, 1e-15);
    assert_close(antenna_azimuth_rad(&SKEWED, 1e-300, 1e300), 0, 1e-16);
}

TEST(a_table_gives_back_every_azimuth)
{
    for (int i = 0; i <= 100000; i++) {
        double azimuth_rad = fmin(-1.2 + 2.5 * i / 100000, 1.3);
        struct antenna_pointers pointers = antenna_pointers(&SKEWED, azimuth_rad);
        assert_close(antenna_azimuth_rad(&SKEWED, -cimag(pointers.delta), creal(pointers.sum)),
                     azimuth_rad, 2e-15);
    }
    for (size_t i = 0; i < COUNT(SKEWED_ROWS); i++)
        assert_close(antenna_azimuth_rad(&SKEWED, SKEWED_ROWS[i].delta, SKEWED_ROWS[i].sum),
                     SKEWED_ROWS[i].azimuth_rad, 0);
}

TEST(a_ratio_beyond_a_table_is_its_end)
{
    assert_close(antenna_azimuth_rad(&SKEWED, -1, 0), -1.2, 0);
    assert_close(antenna_azimuth_rad(&SKEWED, 1, 0), 1.3, 0);
    assert_close(antenna_azimuth_rad(&SKEWED, 9, 1), 1.3, 0);
    assert_close(antenna_azimuth_rad(&EVEN, 1, 0), PI / 2, 0);
    assert_close(antenna_azimuth_rad(&EVEN, -1, 0), -PI / 2, 0);
    static const struct antenna_row narrow[] = {{-0.3, 1, -0.1}, {0.3, 1, 0.1}};
    struct antenna antenna = {.pattern = ANTENNA_TABLE,
                              .phase = PHASE_CENTRE,
                              .rows = narrow,
                              .row_count = COUNT(narrow)};
    assert_close(antenna_azimuth_rad(&antenna, -0.2, 1), -0.3, 0);
    assert_close(antenna_azimuth_rad(&antenna, 0.2, 1), 0.3, 0);
    assert_close(antenna_azimuth_rad(&antenna, 0, 1), 0, 0);
}

TEST(a_sound_table_has_no_fault)
{
    size_t row;
    assert_null(antenna_table_fault(SKEWED_ROWS, COUNT(SKEWED_ROWS), &row));
    assert_null(antenna_table_fault(EVEN_ROWS, COUNT(EVEN_ROWS), &row));
}

TEST(the_faulty_row_of_a_table_is_named)
{
    static const struct {
        struct antenna_row rows[3];
        size_t count, row;
        const char *word;
    } cases[] = {
        {{{0, 1, 0}}, 0, 0, "two rows"},
        {{{0, 1, 0}}, 1, 1, "two rows"},
        {{{0, -1, 0}, {1, 1, 1}}, 2, 0, "negative"},
        {{{0, 1, 0}, {1, (double)NAN, 1}}, 2, 1, "negative"},
        {{{0, 1, 0}, {1, 0, 0}}, 2, 1, "both"},
        {{{0, 1, 0}, {0, 1, 1}}, 2, 1, "azimuth"},
        {{{0, 1, 0}, {1, 1, 1}, {0.5, 1, 2}}, 3, 2, "azimuth"},
        {{{0, 1, 0}, {(double)NAN, 1, 1}}, 2, 1, "azimuth"},
        {{{0, 1, 0}, {1, 1, 1}, {2, 1, 0.5}}, 3, 2, "ratio"},
        {{{0, 1, 1}, {1, 2, 2}}, 2, 1, "ratio"},
        {{{0, 0, -1}, {1, 0, 1}}, 2, 1, "ratio"},
        {{{0, 1, 0}, {1, 0, 1}, {2, 0, 2}}, 3, 2, "ratio"},
        {{{0, 1, 0}, {1, 1, (double)NAN}}, 2, 1, "ratio"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        size_t row = 99;
        const char *fault = antenna_table_fault(cases[i].rows, cases[i].count, &row);
        assert_non_null(fault);
        assert_non_null(strstr(fault, cases[i].word));
        assert_int_equal(row, cases[i].row);
    }
}
