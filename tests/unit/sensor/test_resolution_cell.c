#include "check.h"

#include "base/units.h"
#include "sample.h"
#include "sensor/resolution_cell.h"

/* The paper's sensor: an ERCS of 0.8 meets a threshold of 2 at 30 m, so A_ref = 2.5 (30 / R)^2. */
static struct sensor paper_sensor(enum antenna_phase phase)
{
    struct sensor sensor = {.name = "s",
                            .carrier_hz = 77e9,
                            .threshold_db = 20 * 0.30102999566398120,
                            .calibration_ercs = 0.8,
                            .calibration_range_m = 30,
                            .exponent = 2,
                            .range_floor_m = 0.5,
                            .cell_range_m = 0.3,
                            .cell_range_rate_mps = 0.5,
                            .phase_reference = phase};
    suite_derive(&sensor);
    return sensor;
}

static struct echo echo_at(double range_m, double azimuth_rad, double range_rate_mps, double ercs)
{
    return (struct echo){.sensor = "s",
                         .id.object = "o",
                         .id.reflector = "r",
                         .range_m = range_m,
                         .azimuth_rad = azimuth_rad,
                         .range_rate_mps = range_rate_mps,
                         .ercs = ercs};
}

/* |H_sum| of equation (6): si(u) cos(azimuth) cos(u), u = pi/2 sin(azimuth). */
static double pattern(double azimuth_rad)
{
    double u = PI / 2 * sin(azimuth_rad);
    return (u == 0 ? 1 : sin(u) / u) * cos(azimuth_rad) * cos(u);
}

TEST(strength_is_reference_amplitude_times_ercs_and_amplitude_has_the_pattern)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    struct echo echo = echo_at(15, 0.4, -2, 0.5);
    struct received_echo received = received_echo_in_free_space(&sensor, &echo, 0.25);
    assert_near(received.strength, 2.5 * 4 * 0.5, 1e-12);
    assert_near(received.amplitude, 5 * pattern(0.4), 1e-12);
    assert_close(received.phase_rad, 0.25, 0);
    assert_close(received.echo.range_rate_mps, -2, 0);
    assert_close(received.echo.weight, 0, 0);
    /* A range below the floor counts as the floor. */
    echo = echo_at(0.1, 0, 0, 1);
    assert_near(received_echo_in_free_space(&sensor, &echo, 0).strength, 2.5 * 3600, 1e-12);
}

TEST(without_superposition_a_cell_is_one_echo_of_the_summed_strength)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    struct received_echo echoes[4];
    struct cell cell;
    for (int i = 0; i < 4; i++) {
        struct echo echo = echo_at(15, 0, 0, 0.1 * (4 - i));
        echoes[i] = received_echo_in_free_space(&sensor, &echo, i);
    }
    assert_true(resolution_cell_of(&sensor, echoes, 4, false, check_arena(), &cell));
    assert_near(hypot(cell.sum_re, cell.sum_im), 2.5 * 4 * (0.4 + 0.3 + 0.2 + 0.1), 1e-14);
}

/* Amplitudes 3, 2 and 1 have powers 9, 4 and 1: (9 0.01 - 4 0.02 + 0.03)/14. */
TEST(the_elevation_of_a_cell_is_the_mean_of_its_echoes_by_power)
{
    static const double elevations_rad[] = {0.01, -0.02, 0.03};
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    struct received_echo echoes[3];
    struct cell cell;
    for (int i = 0; i < 3; i++) {
        struct echo echo = echo_at(15, 0, 0, 0.1 * (3 - i));
        echo.elevation_rad = elevations_rad[i];
        echoes[i] = received_echo_in_free_space(&sensor, &echo, i);
    }
    resolution_cell_of(&sensor, echoes, 3, true, check_arena(), &cell);
    assert_int_equal(cell.present, 0);
    sensor.elevation_view_rad = 0.3;
    resolution_cell_of(&sensor, echoes, 3, true, check_arena(), &cell);
    assert_int_equal(cell.present, VALUE_ELEVATION);
    assert_close(cell.elevation_rad, 0.04 / 14, 1e-15);
    resolution_cell_of(&sensor, echoes + 1, 1, true, check_arena(), &cell);
    assert_close(cell.elevation_rad, -0.02, 0);
}

static struct echo ghost_at(double azimuth_rad, double departure_azimuth_rad)
{
    struct echo ghost = echo_at(15, azimuth_rad, 0, 0.5);
    ghost.id.path = PATH_WALL_OBJECT;
    ghost.departure_azimuth_rad = departure_azimuth_rad;
    return ghost;
}

TEST(a_ghost_has_the_root_of_the_pattern_each_way_and_the_level_of_its_reverse)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    for (double azimuth_rad = -1.4; azimuth_rad <= 1.4; azimuth_rad += 0.1) {
        struct echo out = ghost_at(azimuth_rad, 0.4), back = ghost_at(0.4, azimuth_rad);
        struct received_echo echoes[] = {received_echo_in_free_space(&sensor, &out, 0),
                                         received_echo_in_free_space(&sensor, &back, 0)};
        assert_true(echoes[0].amplitude == echoes[1].amplitude);
        for (size_t i = 0; i < 2; i++) {
            struct cell cell;
            assert_near(echoes[i].amplitude, 5 * sqrt(pattern(azimuth_rad) * pattern(0.4)), 1e-13);
            assert_true(resolution_cell_of(&sensor, &echoes[i], 1, true, check_arena(), &cell));
            assert_close(cell.azimuth_rad, i == 0 ? azimuth_rad : 0.4, 1e-14);
            assert_near(hypot(cell.sum_re, cell.sum_im), echoes[i].amplitude, 1e-14);
        }
    }
    /* A wave that leaves or comes back beyond the side of the array, be it by an ulp, has no
     * amplitude. */
    struct echo echo = ghost_at(0.4, 0x1.921fb54442d19p0);
    assert_true(received_echo_in_free_space(&sensor, &echo, 0).amplitude >= 0);
    assert_true(received_echo_in_free_space(&sensor, &echo, 0).amplitude < 1e-15);
    static const struct antenna_row rows[] = {{-0.5, 1, -1}, {0.5, 1, 1}};
    sensor.antenna = (struct antenna){.pattern = ANTENNA_TABLE, .rows = rows, .row_count = 2};
    assert_close(received_echo_in_free_space(&sensor, &echo, 0).amplitude, 0, 0);
    echo = ghost_at(0.6, 0.3);
    assert_close(received_echo_in_free_space(&sensor, &echo, 0).amplitude, 0, 0);
}

TEST(a_single_echo_is_its_cell)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    for (double azimuth_rad = -1.5; azimuth_rad <= 1.5; azimuth_rad += 0.01) {
        struct echo echo = echo_at(12.3, azimuth_rad, 3.4, 0.7);
        struct received_echo received = received_echo_in_free_space(&sensor, &echo, 0);
        struct cell cell;
        assert_true(resolution_cell_of(&sensor, &received, 1, true, check_arena(), &cell));
        assert_close(cell.range_m, 12.3, 0);
        assert_close(cell.range_rate_mps, 3.4, 0);
        assert_close(cell.azimuth_rad, azimuth_rad, 1e-14);
        assert_close(cell.members.items[0].weight, 1, 0);
        assert_near(hypot(cell.sum_re, cell.sum_im), received.amplitude, 1e-14);
    }
}

/* To the bit: auto leaves superposition out where no cell has two echoes. */
TEST(a_single_echo_of_an_array_has_one_cell_with_and_without_superposition)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    sensor.beams.count = 1;
    struct echo echo = echo_at(12.3, -0.0, 3.4, 0.7);
    struct received_echo received = received_echo_in_free_space(&sensor, &echo, 0);
    for (int superpose = 0; superpose < 2; superpose++) {
        struct cell cell;
        assert_true(resolution_cell_of(&sensor, &received, 1, superpose, check_arena(), &cell));
        assert_true(cell.azimuth_rad == 0 && signbit(cell.azimuth_rad));
    }
}

/* An echo that is received with this amplitude. */
static struct received_echo received_of(const char *object, double azimuth_rad, double amplitude,
                                        double phase_rad)
{
    return (struct received_echo){
        .echo = {.id.object = object, .id.reflector = "r", .azimuth_rad = azimuth_rad},
        .strength = amplitude,
        .amplitude = amplitude,
        .phase_rad = phase_rad};
}

/* Equations (4) and (5): amplitudes 6 and 2, so weights 3/4 and 1/4. */
TEST(two_echoes_are_weighted_by_amplitude)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    struct received_echo echoes[] = {received_of("a", 0, 6, 0), received_of("b", 0, 2, 0)};
    echoes[0].range_m = 10;
    echoes[0].range_rate_mps = -1;
    echoes[1].range_m = 10.2;
    echoes[1].range_rate_mps = 1;
    struct cell cell;
    assert_true(resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell));
    assert_string_equal(cell.sensor, "s");
    assert_close(cell.amplitude, 8, 0);
    assert_near(cell.range_m, 10.05, 1e-15);
    assert_close(cell.range_rate_mps, -0.5, 1e-15);
    assert_int_equal(cell.members.count, 2);
    assert_close(cell.members.items[0].weight, 0.75, 0);
    assert_close(cell.members.items[1].weight, 0.25, 0);
    assert_string_equal(cell.members.items[1].id.object, "b");
    /* Both echoes are on boresight: the sum channel has all, delta nothing. */
    assert_close(cell.sum_re, 8, 1e-15);
    assert_close(cell.sum_im, 0, 0);
    assert_close(cell.delta_re, 0, 0);
    assert_close(cell.delta_im, 0, 0);
    assert_close(cell.azimuth_rad, 0, 0);
}

/* Equation (8) for echoes at 30 degrees to the left and to the right, u = pi/4: with
 * f = si(pi/4) cos(pi/6) and cos u = sin u = sqrt(1/2), H_sum = f sqrt(1/2) and
 * H_delta = -+ j f sqrt(1/2) with phases from the centre. */
TEST(pointers_add_up_as_in_equation_8)
{
    double part = sin(PI / 4) / (PI / 4) * cos(PI / 6) * sqrt(0.5);
    for (int element = 0; element < 2; element++) {
        struct sensor sensor = paper_sensor(element ? PHASE_ELEMENT : PHASE_CENTRE);
        struct received_echo echoes[] = {received_of("a", PI / 6, 3, 0),
                                         received_of("b", -PI / 6, 1, 0)};
        echoes[0].amplitude *= part;
        echoes[1].amplitude *= part;
        struct cell cell;
        assert_true(resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell));
        /* With phases from the first element each pointer turns by e^{ju} = (1 +- j) sqrt(1/2). */
        double root_half = sqrt(0.5);
        assert_close(cell.sum_re, element ? 4 * part * root_half : 4 * part, 1e-14);
        assert_close(cell.sum_im, element ? 2 * part * root_half : 0, 1e-14);
        assert_close(cell.delta_re, element ? 4 * part * root_half : 0, 1e-14);
        assert_close(cell.delta_im, element ? -2 * part * root_half : -2 * part, 1e-14);
        assert_near(cell.amplitude, 4 * part, 1e-14);
        if (!element) /* |delta| : |sum| = 1 : 2 = tan u, to the left */
            assert_close(cell.azimuth_rad, asin(2 / PI * atan(0.5)), 1e-14);
    }
}

TEST(phases_turn_the_pointers)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    struct received_echo echoes[] = {received_of("a", 0, 4, 0), received_of("b", 0, 3, PI / 2)};
    struct cell cell;
    assert_true(resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell));
    assert_close(cell.sum_re, 4, 1e-15);
    assert_close(cell.sum_im, 3, 1e-15);
    assert_close(cell.amplitude, 7, 0);
    /* Equal echoes in antiphase leave nothing but rounding. */
    echoes[1].strength = 4;
    echoes[1].phase_rad = PI;
    resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell);
    assert_close(hypot(cell.sum_re, cell.sum_im), 0, 1e-14);
}

/* MODEL 14.18: two echoes half a separation to either side of boresight, the weaker one rho times
 * as strong and psi behind. In half separations towards the stronger one, the ratio rule reads the
 * coherent position g = (1 - rho^2) / (1 + rho^2 + 2 rho cos psi). The magnitude rule reads the
 * size of the complex position, sqrt((1 + rho^2 - 2 rho cos psi) / (1 + rho^2 + 2 rho cos psi)),
 * which is g in phase and in antiphase alone. Range stays at the mean weighted by amplitude,
 * equation (4). */
TEST(a_coherent_pair_is_read_at_its_coherent_position)
{
    static const struct {
        double rho, psi_deg, ratio, magnitude;
    } cases[] = {
        {0.5, 0, 0.333333, 0.333333},   {0.5, 90, 0.600000, 1},
        {0.5, 150, 1.953254, 2.347519}, {0.5, 180, 3.000000, 3.000000},
        {0.9, 0, 0.052632, 0.052632},   {0.9, 90, 0.104972, 1},
        {0.9, 150, 0.756507, 3.662438}, {0.9, 180, 19.000000, 19.000000},
    };
    const double half_rad = 1e-7;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int rule = 0; rule < 4; rule++) {
            struct sensor sensor = paper_sensor(rule < 2 ? PHASE_CENTRE : PHASE_ELEMENT);
            sensor.angle_estimator = rule % 2 ? MONOPULSE_MAGNITUDE : MONOPULSE_RATIO;
            double rho = cases[i].rho;
            struct received_echo echoes[] = {
                received_of("a", half_rad, 1, 0),
                received_of("b", -half_rad, rho, -cases[i].psi_deg * PI / 180)};
            echoes[0].range_m = 11;
            echoes[1].range_m = 9;
            struct cell cell;
            assert_true(resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell));
            double expected = rule % 2 ? cases[i].magnitude : cases[i].ratio;
            assert_close(fabs(cell.azimuth_rad) / half_rad, expected, 1e-6 + 1e-6 * expected);
            assert_true(rule % 2 || cell.azimuth_rad > 0);
            assert_near(cell.range_m, 10 + (1 - rho) / (1 + rho), 1e-14);
        }
}

/* The mean of g over all phases is exactly the stronger echo's place (MODEL 14.18). */
TEST(a_coherent_pair_is_at_its_stronger_echo_on_average)
{
    enum { PHASES = 4096 };
    const double half_rad = 1e-5;
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    sensor.angle_estimator = MONOPULSE_RATIO;
    double sum = 0;
    for (int i = 0; i < PHASES; i++) {
        struct received_echo echoes[] = {
            received_of("a", half_rad, 1, 0),
            received_of("b", -half_rad, 0.9, 2 * PI * (i + 0.5) / PHASES)};
        struct cell cell;
        assert_true(resolution_cell_of(&sensor, echoes, 2, true, check_arena(), &cell));
        sum += cell.azimuth_rad / half_rad;
        arena_clear(check_arena());
    }
    assert_close(sum / PHASES, 1, 1e-6);
}

TEST(weights_sum_to_one_and_means_stay_inside)
{
    struct sensor sensor = paper_sensor(PHASE_CENTRE);
    uint64_t random = 4;
    for (int round = 0; round < 3000; round++) {
        struct received_echo echoes[40];
        size_t count = 1 + sample_bits(&random) % 40;
        double least = 1e9, most = -1e9;
        for (size_t i = 0; i < count; i++) {
            struct echo echo =
                echo_at(sample_between(&random, 20, 20.3), sample_between(&random, -1.5, 1.5),
                        sample_between(&random, -1, 1), exp(sample_between(&random, -20, 2)));
            echoes[i] = received_echo_in_free_space(&sensor, &echo, 0);
            least = fmin(least, echo.range_m);
            most = fmax(most, echo.range_m);
        }
        qsort(echoes, count, sizeof *echoes, resolution_cell_compare);
        struct cell cell;
        assert_true(resolution_cell_of(&sensor, echoes, count, true, check_arena(), &cell));
        double total = 0, amplitude = 0;
        for (size_t i = 0; i < count; i++) {
            total += cell.members.items[i].weight;
            amplitude += echoes[i].amplitude;
            assert_true(i == 0 || echoes[i - 1].amplitude >= echoes[i].amplitude);
        }
        assert_close(total, 1, 1e-14);
        assert_close(cell.amplitude, amplitude, 0);
        assert_true(cell.range_m >= least && cell.range_m <= most);
        /* The denominator of equation (5) is an upper bound. */
        assert_true(hypot(cell.sum_re, cell.sum_im) <= cell.amplitude * (1 + 1e-14));
        arena_clear(check_arena());
    }
}

TEST(ties_of_amplitude_go_by_the_frames_order)
{
    struct received_echo near = {.echo = {.id.object = "b", .id.reflector = "r", .range_m = 1},
                                 .amplitude = 2};
    struct received_echo far = {.echo = {.id.object = "a", .id.reflector = "r", .range_m = 2},
                                .amplitude = 2};
    assert_true(resolution_cell_compare(&near, &far) < 0);
    assert_true(resolution_cell_compare(&far, &near) > 0);
    far.amplitude = 2.0000000000000004;
    assert_true(resolution_cell_compare(&near, &far) > 0);
}
