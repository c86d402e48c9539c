#include "check.h"

#include "effects/effect.h"
#include "noise/false_alarm_cells.h"

static struct range_limit limits[] = {{0, 25}, {1, 10}};

static const struct sensor radar = {
    .name = "s",
    .range_min_m = 5,
    .range_max_m = 25,
    .field_of_view_rad = 2,
    .threshold = 2,
    .search_sigma = 0.5,
    .range_limits = {.items = limits, .count = 2},
    .false_alarm_range_rate_mps = 40,
    .unambiguous_middle_mps = 30,
    .latency_s = 0.05,
};

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};

static double view_rad; /* of elevation; 0: it is not measured */

static struct cell_span false_alarms_of(struct frame *frame, double mean, uint64_t number,
                                        bool measured)
{
    *frame = (struct frame){.scene = "s",
                            .seed = 1,
                            .frame = (int64_t)number,
                            .time_s = 3,
                            .interval_s = 0.1,
                            .sections = CARRY_ACCOUNT,
                            .arena = check_arena()};
    *list_add(&frame->sensors.list, check_arena()) =
        (struct sensor_view){.name = "s", .measured = measured};
    struct sensor sensor = radar;
    sensor.false_alarms = mean;
    sensor.elevation_view_rad = view_rad;
    struct effect_scan context = effect_begin(frame, &sensor, &everything, EFFECT_HOME_NOISE);
    return false_alarm_cells_of(frame, &context);
}

TEST(every_false_alarm_is_within_the_limits_of_its_sensor)
{
    size_t seen = 0;
    for (uint64_t i = 0; i < 500; i++) {
        struct frame frame;
        struct cell_span alarms = false_alarms_of(&frame, 3, i, true);
        for (size_t j = 0; j < alarms.count; j++) {
            const struct cell *cell = &alarms.items[j];
            assert_true(cell->range_m > 5 && cell->range_m < 25 - 15 * fabs(cell->azimuth_rad));
            assert_true(fabs(cell->azimuth_rad) < 1);
            assert_true(fabs(cell->range_rate_mps - 30) < 40);
            assert_true(cell->amplitude > 2 && cell->amplitude == cell->sum_re);
            assert_int_equal(cell->effects, EFFECT_BIT(EFFECT_FALSE_ALARMS));
            assert_int_equal(cell->members.count, 1);
            const struct contributor *label = &cell->members.items[0];
            assert_int_equal(label->id.path, PATH_FALSE_ALARM);
            assert_int_equal(label->id.number, j + 1);
            assert_close(label->range_m, cell->range_m, 0);
            assert_close(label->azimuth_rad, cell->azimuth_rad, 0);
            assert_close(label->range_rate_mps, cell->range_rate_mps, 0);
            assert_close(label->weight, 1, 0);
            assert_close(label->time_s, 2.95, 1e-15);
        }
        assert_int_equal(frame.counts.count, alarms.count > 0);
        if (alarms.count > 0)
            assert_int_equal(frame.counts.items[0].paths.items[0].echoes, alarms.count);
        seen += alarms.count;
    }
    assert_true(seen > 1400 && seen < 1600);
}

TEST(a_larger_mean_adds_to_the_same_false_alarms)
{
    for (uint64_t i = 0; i < 100; i++) {
        struct frame frame, more;
        struct cell_span few = false_alarms_of(&frame, 2, i, true);
        struct cell_span many = false_alarms_of(&more, 4, i, true);
        assert_true(few.count <= many.count);
        for (size_t j = 0; j < few.count; j++)
            assert_close(few.items[j].range_m, many.items[j].range_m, 0);
    }
}

/* A uniform value in a view of 0.6 has the variance 0.03; n of them have a mean within
 * 4 sqrt(0.03/n). */
TEST(elevations_are_uniform_over_the_view_and_nothing_else_changes)
{
    double sum = 0, squares = 0, seen = 0;
    for (uint64_t i = 0; i < 500; i++) {
        struct frame frame, flat;
        view_rad = 0.6;
        struct cell_span alarms = false_alarms_of(&frame, 3, i, true);
        view_rad = 0;
        struct cell_span without = false_alarms_of(&flat, 3, i, true);
        assert_int_equal(alarms.count, without.count);
        for (size_t j = 0; j < alarms.count; j++) {
            double elevation_rad = alarms.items[j].elevation_rad;
            assert_int_equal(alarms.items[j].present, VALUE_ELEVATION);
            assert_true(fabs(elevation_rad) < 0.3);
            assert_close(alarms.items[j].members.items[0].elevation_rad, elevation_rad, 0);
            assert_close(alarms.items[j].azimuth_rad, without.items[j].azimuth_rad, 0);
            assert_int_equal(without.items[j].present, 0);
            sum += elevation_rad;
            squares += elevation_rad * elevation_rad;
            seen++;
        }
    }
    assert_true(seen > 1400);
    assert_close(sum / seen, 0, 4 * sqrt(0.03 / seen));
    assert_close(squares / seen, 0.03, 4 * sqrt(0.03 * 0.03 * 0.8 / seen));
}

TEST(without_a_mean_or_a_measurement_there_are_no_false_alarms)
{
    static const struct {
        double mean;
        bool measured;
    } cases[] = {{50, false}, {0, true}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame;
        assert_int_equal(false_alarms_of(&frame, cases[i].mean, 1, cases[i].measured).count, 0);
        assert_int_equal(frame.counts.count, 0);
    }
}

/* Noise alone passes an amplitude A with P(A) = exp(-(A / sigma)^2), so the share of false alarms
 * above A is P(A) / P(threshold). */
TEST(amplitudes_of_false_alarms_are_those_of_noise_above_the_threshold)
{
    for (double uniform = 0x1p-53; uniform < 1; uniform = uniform * 1.2 + 1e-4) {
        double amplitude = false_alarm_cells_amplitude(2, 0.7, uniform);
        assert_true(amplitude >= 2);
        assert_near(exp((2 - amplitude) * (2 + amplitude) / (0.7 * 0.7)), uniform, 2e-14);
    }
    assert_close(false_alarm_cells_amplitude(2, 0, 0.5), 2, 0);
    assert_near(false_alarm_cells_amplitude(1e200, 1e200, 0.5), 1e200 * sqrt(1 + log(2)), 1e-15);
}
