#include "check.h"

#include "base/units.h"
#include "radar/attenuation.h"
#include "sensor/escalation.h"

/* Cells of 1 m by 1 m/s to either side, a threshold of 1, in phase from the array's centre. */
static const struct sensor sensor = {
    .name = "s",
    .threshold = 1,
    .half_range_m = 1,
    .half_range_rate_mps = 1,
    .range_max_m = 100,
    .antenna = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE},
};

static const struct tolerance wide = {0.1, 0.01, 0.1, 1};

static struct received_echo ray_at(double range_m, double azimuth_rad, double amplitude)
{
    return (struct received_echo){.echo = {.azimuth_rad = azimuth_rad},
                                  .range_m = range_m,
                                  .strength = amplitude,
                                  .amplitude = amplitude};
}

enum { MOST = 3 };

struct situation {
    const char *what;
    struct received_echo received_echoes[MOST];
    size_t cell[MOST];
    size_t count, cells;
    struct weakening weakening;
    bool holds;
};

static void decisions_that_could_turn_are_seen(void **state)
{
    (void)state;
    const struct received_echo straight = ray_at(50, 0, 2);
    const struct situation cases[] = {
        {"a strong cell", {straight}, {0}, 1, 1, {1.1, 1.01}, true},
        {"a cell just above", {ray_at(50, 0, 1.05)}, {0}, 1, 1, {1.1, 1.01}, false},
        {"a cell below", {ray_at(50, 0, 0.9)}, {0}, 1, 1, {1.1, 1.01}, true},
        {"two weak members that are above",
         {ray_at(50, 0, 0.6), ray_at(50, 0, 0.45)},
         {0, 0},
         2,
         1,
         {1.1, 1.01},
         false},
        {"a leader of its own", {straight, ray_at(50.5, 0, 1.5)}, {0, 0}, 2, 1, {1.1, 1.01}, true},
        {"a leader by little", {straight, ray_at(50.5, 0, 1.99)}, {0, 0}, 2, 1, {1.1, 1.01}, false},
        {"a tie next door", {straight, ray_at(51.5, 0, 1.99)}, {0, 1}, 2, 2, {1.1, 1.01}, false},
        {"a tie far away", {straight, ray_at(52.5, 0, 1.99)}, {0, 1}, 2, 2, {1.1, 1.01}, true},
        {"a mean that moves", {straight, ray_at(50.9, 0, 1)}, {0, 0}, 2, 1, {1.9, 1.5}, false},
        {"an angle that moves", {straight, ray_at(50, 0.5, 1.5)}, {0, 0}, 2, 1, {1.3, 1.1}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const size_t one[] = {0, cases[i].count}, each[] = {0, 1, 2};
        const struct scan scan = {
            .reception = {.sensor = &sensor},
            .resolved = {cases[i].received_echoes, cases[i].cell, cases[i].count},
            .cells = cases[i].cells,
            .by_cell = cases[i].received_echoes,
            .first = cases[i].cells == 1 ? one : each,
        };
        if (escalation_holds(&scan, cases[i].weakening, &wide) != cases[i].holds)
            fail_msg("%s: expected %d", cases[i].what, cases[i].holds);
    }
}

static void echoes_with_phases_are_never_spared(void **state)
{
    (void)state;
    struct received_echo received_echoes[] = {ray_at(50, 0, 3), ray_at(50, 0, 2)};
    const size_t cell[] = {0, 0}, first[] = {0, 2};
    const struct scan scan = {.reception = {.sensor = &sensor},
                              .resolved = {received_echoes, cell, 2},
                              .cells = 1,
                              .by_cell = received_echoes,
                              .first = first};
    assert_true(escalation_holds(&scan, (struct weakening){1.1, 1.01}, &wide));
    assert_true(escalation_spares_superposition(&sensor, received_echoes, 2, &wide));
    received_echoes[1].phase_rad = 1;
    assert_false(escalation_holds(&scan, (struct weakening){1.1, 1.01}, &wide));
    assert_false(escalation_spares_superposition(&sensor, received_echoes, 2, &wide));
    received_echoes[1].phase_rad = 0;
    struct sensor element = sensor;
    element.phase_reference = PHASE_ELEMENT;
    assert_false(escalation_spares_superposition(&element, received_echoes, 2, &wide));
}

static void superposition_is_spared_where_all_look_the_same_way(void **state)
{
    (void)state;
    const struct received_echo near[] = {ray_at(50, 0.1, 3), ray_at(50, 0.104, 2)};
    const struct received_echo apart[] = {ray_at(50, 0.1, 3), ray_at(50, 0.106, 2)};
    assert_true(escalation_spares_superposition(&sensor, near, 2, &wide));
    assert_false(escalation_spares_superposition(&sensor, apart, 2, &wide));
    const struct tolerance none = {0}, azimuth = {.azimuth_rad = 0.01};
    assert_false(escalation_spares_superposition(&sensor, near, 2, &none));
    assert_false(escalation_spares_superposition(&sensor, near, 2, &azimuth));
}

/* 5 dB/km over 100 m and back are 1 dB, half of which is weather's share of 2. */
static void weather_is_tried_without_only_within_its_share(void **state)
{
    (void)state;
    struct frame frame = {.account = false};
    struct reception reception = {
        .frame = &frame, .sensor = &sensor, .effects = EFFECT_BIT(EFFECT_RAIN), .rain_dbpkm = 5};
    struct selection selection = {.automatic = true, .tolerance = {.amplitude_db = 2.01}};
    assert_int_equal(escalation_spared(&reception, &selection), EFFECT_BIT(EFFECT_RAIN));
    assert_close(units_amplitude_db(escalation_weakening(&reception).alone), 1, 1e-7);
    assert_close(units_amplitude_db(escalation_weakening(&reception).between), 0.02, 1e-7);
    selection.tolerance.amplitude_db = 1.99;
    assert_int_equal(escalation_spared(&reception, &selection), 0);
    selection.tolerance.amplitude_db = 2.01;
    selection.automatic = false;
    assert_int_equal(escalation_spared(&reception, &selection), 0);
    reception.effects |= EFFECT_BIT(EFFECT_AMBIGUITY);
    assert_close(escalation_weakening(&reception).between, escalation_weakening(&reception).alone,
                 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decisions_that_could_turn_are_seen),
        cmocka_unit_test(echoes_with_phases_are_never_spared),
        cmocka_unit_test(superposition_is_spared_where_all_look_the_same_way),
        cmocka_unit_test(weather_is_tried_without_only_within_its_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
