#include "check.h"

#include "geometry/obstruction.h"
#include "sample.h"

#define HIGH ((double)INFINITY)
#define UP_TO(top) ((struct obstruction_heights){0, (top)})
#define WAVELENGTH_M 0.0124

/* 4 m by 2 m, from (8, -1) to (12, 1). */
static const struct vec2 car[] = {{12, 1}, {8, 1}, {8, -1}, {12, -1}};

static struct vec2 somewhere(uint64_t *random, double reach_m)
{
    return (struct vec2){sample_between(random, -reach_m, reach_m),
                         sample_between(random, -reach_m, reach_m)};
}

/* A box anywhere within 10 m, and a line anywhere within 20 m. */
static struct obstruction_line random_case(uint64_t *random, struct vec2 corners[4])
{
    static const double x[] = {1, -1, -1, 1}, y[] = {1, 1, -1, -1};
    struct vec2 heading = vec2_heading(sample_between(random, 0, 7));
    struct vec2 middle = somewhere(random, 10);
    double length_m = sample_between(random, 0.01, 5), width_m = sample_between(random, 0.01, 3);
    for (int i = 0; i < 4; i++)
        corners[i] =
            vec2_add(middle, vec2_turn((struct vec2){x[i] * length_m, y[i] * width_m}, heading));
    return (struct obstruction_line){somewhere(random, 20), somewhere(random, 20),
                                     sample_between(random, 0, 3), sample_between(random, 0, 3)};
}

TEST(in_a_flat_world_only_the_outline_decides)
{
    uint64_t random = 1;
    int blocked = 0;
    for (int i = 0; i < 100000; i++) {
        struct vec2 corners[4];
        struct obstruction_line line = random_case(&random, corners);
        bool touches = obstruction_blocks(corners, 4, line.from, line.to);
        blocked += touches;
        assert_close(obstruction_of(corners, 4, UP_TO(HIGH), &line, 0).factor, touches ? 0 : 1, 0);
    }
    assert_true(blocked > 10000);
}

TEST(a_line_above_the_top_all_along_is_free)
{
    static const struct {
        struct obstruction_line line;
        double top_m, above_m;
    } cases[] = {
        {{{0, 0}, {20, 0}, 1, 1}, 0.9, 0.1},
        {{{0, 0}, {20, 0}, 1, 1}, 1, 0},
        {{{0, 0}, {20, 0}, 0, 4}, 1.5, 0.1},  /* lowest where it enters, 1.6 */
        {{{0, 0}, {20, 0}, 4, 0}, 1.5, 0.1},  /* lowest where it leaves */
        {{{20, 0}, {0, 0}, 4, 0}, 1.7, -0.1}, /* the other way round */
        {{{0, 0}, {10, 0}, 4, 1}, 1.5, -0.5}, /* it ends inside */
        {{{10, 0}, {20, 0}, 1, 9}, 1.5, -0.5},
        {{{8, -5}, {8, 5}, 0, 10}, 3.9, 0.1}, /* along an end, over its whole width */
        {{{7, 0}, {9, 2}, 0, 2}, 0.9, 0.1},   /* through a corner */
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_close(obstruction_clear_m(car, 4, UP_TO(cases[i].top_m), &cases[i].line),
                     cases[i].above_m, 1e-14);
        assert_close(obstruction_of(car, 4, UP_TO(cases[i].top_m), &cases[i].line, 0).factor,
                     cases[i].above_m > 0 ? 1 : 0, 0);
    }
}

static bool contains(const struct vec2 *corners, struct vec2 place)
{
    for (int i = 0; i < 4; i++)
        if (vec2_cross(vec2_sub(corners[(i + 1) % 4], corners[i]), vec2_sub(place, corners[i])) < 0)
            return false;
    return true;
}

/* Compared with the lowest of many places on the line that are inside. */
TEST(the_lowest_place_over_a_body_counts)
{
    enum { STEPS = 500 };
    uint64_t random = 2;
    int over = 0;
    for (int i = 0; i < 4000; i++) {
        struct vec2 corners[4];
        struct obstruction_line line = random_case(&random, corners);
        double lowest_m = HIGH;
        for (int k = 0; k <= STEPS; k++) {
            double fraction = (double)k / STEPS;
            struct vec2 place =
                vec2_add(vec2_scale(1 - fraction, line.from), vec2_scale(fraction, line.to));
            if (contains(corners, place))
                lowest_m = fmin(lowest_m,
                                (1 - fraction) * line.from_height_m + fraction * line.to_height_m);
        }
        if (lowest_m == HIGH)
            continue;
        over++;
        double above_m = obstruction_clear_m(corners, 4, UP_TO(0), &line);
        assert_true(above_m <= lowest_m + 1e-12 && above_m > lowest_m - 3.01 / STEPS);
    }
    assert_true(over > 500);
}

/* A line below the bottom passes, at the height that is farthest from the road; so does the
 * unfolded line that the road mirrors, and a body without a bottom lets none pass. */
TEST(a_line_passes_under_a_body_with_a_bottom)
{
    static const struct {
        double from_height_m, to_height_m, bottom_m, clear_m;
    } cases[] = {
        {0.5, 0.5, 0.6, 0.1},  {0.5, 0.5, 0.4, -0.1},
        {0.2, 0.7, 0.6, 0.1},  /* 0.5 where it leaves */
        {0.5, -0.5, 0.2, 0.1}, /* 0.1 where it enters, -0.1 where it leaves */
        {1, -0.25, 0.6, 0.1},  /* 0.5 where it enters */
        {0.25, -1, 0.6, 0.1},  /* -0.5 where it leaves */
        {0, 0, 0, -2},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct obstruction_line line = {
            {0, 0}, {20, 0}, cases[i].from_height_m, cases[i].to_height_m};
        struct obstruction_heights body = {cases[i].bottom_m, 2};
        assert_close(obstruction_clear_m(car, 4, body, &line), cases[i].clear_m, 1e-14);
        struct obstruction seen = obstruction_of(car, 4, body, &line, 0);
        assert_close(seen.factor, cases[i].clear_m > 0 ? 1 : 0, 0);
        assert_int_equal(seen.over, cases[i].clear_m > 0);
    }
}

/* ITU-R P.526, equations (26) and (31), written out: a sensor at 0.5 m and a corner of a car at
 * 0.48 m, 40 m away, with a van of 6.5 m whose underside is at 0.19 m; the wave goes by the road.
 */
TEST(a_van_costs_a_knife_edge_under_it)
{
    const double wavelength_m = 299792458 / 76.5e9, sensor_m = 0.5, corner_m = 0.48, far_m = 40;
    int from_10_to_14_db = 0;
    for (double begin_m = 8; begin_m < 26; begin_m += 0.1) {
        const struct vec2 van[] = {
            {begin_m + 6.5, 1.08}, {begin_m, 1.08}, {begin_m, -1.08}, {begin_m + 6.5, -1.08}};
        struct obstruction_line line = {{0, 0}, {far_m, 0}, sensor_m, -corner_m};
        double worst = -HIGH;
        for (int end = 0; end < 2; end++) {
            double d1 = begin_m + (end ? 6.5 : 0), d2 = far_m - d1;
            double h = fabs(sensor_m - (sensor_m + corner_m) * d1 / far_m) - 0.19;
            worst = fmax(worst, h * sqrt(2 * (d1 + d2) / (wavelength_m * d1 * d2)));
        }
        double x = worst - 0.1;
        double loss_db = worst > -0.78 ? 2 * (6.9 + 20 * log10(sqrt(x * x + 1) + x)) : 0;
        struct obstruction_heights body = {0.19, 2.86};
        double factor = obstruction_of(van, 4, body, &line, wavelength_m).factor;
        if (worst < 2.8)
            assert_close(-20 * log10(factor), loss_db, 1e-9);
        from_10_to_14_db += loss_db >= 10 && loss_db <= 14;
    }
    assert_in_range(from_10_to_14_db, 10, 40);
}

TEST(a_line_inside_from_end_to_end_is_free)
{
    const struct obstruction_line line = {{9, 0.5}, {11, -0.9}, 1, 1};
    assert_close(obstruction_of(car, 4, UP_TO(HIGH), &line, 0).factor, 1, 0);
    assert_close(obstruction_of(car, 4, UP_TO(HIGH), &line, WAVELENGTH_M).factor, 1, 0);
}

TEST(soft_shadows_begin_where_hard_ones_do)
{
    uint64_t random = 3;
    double edge = obstruction_edge_amplitude_factor(0);
    int soft = 0;
    for (int i = 0; i < 300000; i++) {
        struct vec2 corners[4];
        struct obstruction_line line = random_case(&random, corners);
        struct obstruction_heights body = UP_TO(i % 2 ? HIGH : sample_between(&random, 0, 3));
        if (i % 3 == 0)
            body.bottom_m = sample_between(&random, 0, 3);
        double hard = obstruction_of(corners, 4, body, &line, 0).factor;
        double factor = obstruction_of(corners, 4, body, &line, WAVELENGTH_M).factor;
        assert_true(factor >= 0 && factor <= 1);
        assert_true(hard == 1 ? factor > edge - 1e-6 : factor < edge + 1e-6);
        soft += factor > 0 && factor < 1;
    }
    assert_true(soft > 3000);
}

/* Compared with the factor without diffraction and with that of an endless body. */
TEST(a_factor_that_diffraction_or_height_changes_is_marked)
{
    uint64_t random = 6;
    int bent = 0, over = 0;
    for (int i = 0; i < 100000; i++) {
        struct vec2 corners[4];
        struct obstruction_line line = random_case(&random, corners);
        double top_m = i % 4 == 0 ? HIGH : sample_between(&random, 0, 3);
        double wavelength_m = i % 3 == 0 ? 0 : WAVELENGTH_M;
        struct obstruction obstruction =
            obstruction_of(corners, 4, UP_TO(top_m), &line, wavelength_m);
        double hard = obstruction_of(corners, 4, UP_TO(top_m), &line, 0).factor;
        double endless = obstruction_of(corners, 4, UP_TO(HIGH), &line, wavelength_m).factor;
        assert_int_equal(obstruction.bent, obstruction.factor != hard);
        assert_int_equal(obstruction.over, obstruction.factor != endless);
        bent += obstruction.bent;
        over += obstruction.over;
    }
    assert_true(bent > 500 && over > 500);
}

/* The line moves sideways past a pole, and upwards over a wall: no step is larger than the steepest
 * slope. */
TEST(shadows_change_without_jumps)
{
    const struct vec2 pole[] = {{10, 0.3}, {9.9, 0.3}, {9.9, -0.3}, {10, -0.3}};
    const double steps_m = 1e-4;
    double last = obstruction_edge_amplitude_factor(2 * sqrt(2));
    for (int upwards = 0; upwards < 2; upwards++) {
        double before = 1;
        for (double shift_m = 2; shift_m > -2; shift_m -= steps_m) {
            struct obstruction_line line = {{0, 0}, {20, 0}, 1, 1};
            if (!upwards)
                line.from.y = line.to.y = shift_m;
            double top_m = upwards ? 1 - shift_m : HIGH;
            double factor =
                obstruction_of(upwards ? car : pole, 4, UP_TO(top_m), &line, WAVELENGTH_M).factor;
            assert_true(fabs(factor - before) < 0.005 || (before < 1.01 * last && factor == 0) ||
                        (factor < 1.01 * last && before == 0));
            before = factor;
        }
    }
}

/* auto leaves out bodies for this reason. */
TEST(edges_out_of_reach_change_nothing)
{
    uint64_t random = 4;
    int clear = 0;
    for (int i = 0; i < 300000; i++) {
        struct vec2 corners[4];
        struct obstruction_line line = random_case(&random, corners);
        struct vec2 way = vec2_sub(line.to, line.from);
        double length_m = vec2_length(way), nearest_m = HIGH;
        for (int k = 0; k < 4; k++) {
            struct vec2 offset = vec2_sub(corners[k], line.from);
            double fraction = fmin(fmax(vec2_dot(offset, way) / length_m / length_m, 0), 1);
            nearest_m = fmin(nearest_m, vec2_length(vec2_sub(offset, vec2_scale(fraction, way))));
        }
        if (nearest_m < obstruction_edge_reach_m(length_m, WAVELENGTH_M) ||
            obstruction_blocks(corners, 4, line.from, line.to))
            continue;
        clear++;
        assert_close(obstruction_of(corners, 4, UP_TO(HIGH), &line, WAVELENGTH_M).factor, 1, 0);
    }
    assert_true(clear > 100000);
}

TEST(a_line_of_length_zero_has_no_diffraction)
{
    const struct obstruction_line inside = {{10, 0}, {10, 0}, 1, 1},
                                  corner = {{8, 1}, {8, 1}, 1, 1};
    assert_close(obstruction_of(car, 4, UP_TO(HIGH), &inside, WAVELENGTH_M).factor, 1, 0);
    assert_close(obstruction_of(car, 4, UP_TO(HIGH), &corner, WAVELENGTH_M).factor, 0, 0);
}
