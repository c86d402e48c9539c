#include "support/effect_bench.h"

EFFECT_TEST(every_effect_says_what_it_is)
{
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const struct effect *effect = effect_table[i];
        assert_non_null(effects_names[i]);
        assert_true(effect->summary && effect->cause && effect->cost);
        assert_true(effect->home <= EFFECT_HOME_NOISE);
    }
    assert_null(effects_names[EFFECT_COUNT]);
    assert_string_equal(effect_homes[EFFECT_HOME_IDEAL], "ideal");
    assert_string_equal(effect_homes[EFFECT_HOME_SENSOR], "sensor");
    assert_string_equal(effect_homes[EFFECT_HOME_NOISE], "noise");
}

/* A home calls its own hooks alone. */
EFFECT_TEST(an_effect_acts_at_its_home_alone)
{
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const struct effect *effect = effect_table[i];
        bool receives = effect->receive || effect->add_echoes || effect->interference;
        bool measures = false;
        for (int step = 0; step < EFFECT_STEPS; step++)
            measures |= effect->measure[step] != NULL;
        assert_true(effect->home == EFFECT_HOME_SENSOR || !receives);
        assert_true(effect->home == EFFECT_HOME_NOISE || !measures);
        assert_true(effect_has_cause(effect) || !(receives || measures || effect->begin));
    }
}

/* The effect's condition of this field that random scenes draw. */
static const struct effect_member *drawn_member(const struct field *field)
{
    for (int i = 0; i < EFFECT_COUNT; i++)
        for (const struct effect_member *member = effect_table[i]->members; member->size > 0;
             member++)
            if (member->owner == EFFECT_OWNER_CONDITIONS && member->offset == field->offset &&
                member->random.number > 0)
                return member;
    fail_msg("no effect says how random scenes draw %s", field->name);
    return NULL;
}

/* The number that a further draw takes. */
static int free_draw(void)
{
    int number = 1;
    while (effect_random_condition(number) != NULL)
        number++;
    return number;
}

/* Each draw has a number of its own, from 1 without a gap, and the first a share. */
EFFECT_TEST(what_random_scenes_draw_is_what_documents_may_say)
{
    int draws = 0;
    for (const struct field *field = conditions_record.fields; field->name != NULL; field++) {
        const struct effect_member *member = drawn_member(field);
        const struct effect_random *random = &member->random;
        if (effect_random_condition(random->number) != member)
            fail_msg("%s is draw %d, as another condition is; %d is free", field->name,
                     random->number, free_draw());
        assert_true(random->share >= 0 && random->share <= 1 && random->low <= random->high);
        assert_true(random->low > 0 || random->law == EFFECT_EVENLY);
        if (field->kind == FIELD_REAL)
            assert_true(random->low >= field->low && random->high <= field->high);
        if (field->kind == FIELD_CHOICE)
            assert_true(field->choices[0] && random->low == 1 &&
                        field->choices[(int)random->high + 1] == NULL);
        draws++;
    }
    if (free_draw() != draws + 1)
        fail_msg("no condition is draw %d of the %d of random scenes", free_draw(), draws);
    assert_true(effect_random_condition(1)->random.share > 0);
}

/* Does base/random.h name the purpose? The compiler warns here of one that is missing. */
static bool is_named(enum random_purpose purpose)
{
    switch (purpose) {
    case RANDOM_POINTERS:
    case RANDOM_RANGE_RATE:
    case RANDOM_AZIMUTH:
    case RANDOM_TRAFFIC:
    case RANDOM_FALSE_ALARMS:
    case RANDOM_CONDITIONS:
    case RANDOM_SIGNAL:
    case RANDOM_BOOTSTRAP:
    case RANDOM_SAMPLE:
    case RANDOM_VARIATION:
    case RANDOM_ARRIVALS:
    case RANDOM_ROADSIDE:
    case RANDOM_ROADSIDE_LEVEL:
    case RANDOM_STRIPS:
    case RANDOM_ELEMENTS:
    case RANDOM_SURFACE:
    case RANDOM_ELEVATION:
    case RANDOM_OWN:
        return true;
    }
    return false;
}

/* Who draws for a purpose beside the effects before this one; NULL: nobody. */
static const char *taker_of(enum random_purpose purpose, int effect)
{
    if (purpose == 6)
        return "tests/soundness/adversarial_traffic.h";
    if (is_named(purpose))
        return "base/random.h";
    for (int i = 0; i < effect; i++)
        for (int k = 0; effect_table[i]->purposes[k] != 0; k++)
            if (effect_table[i]->purposes[k] == purpose)
                return effects_names[i];
    return NULL;
}

/* An effect may draw for a purpose of base/random.h; its own number is no other's. */
EFFECT_TEST(no_two_effects_draw_for_one_purpose)
{
    enum random_purpose next = RANDOM_ELEVATION + 1;
    while (taker_of(next, EFFECT_COUNT) != NULL)
        next++;
    for (int i = 0; i < EFFECT_COUNT; i++)
        for (const enum random_purpose *own = effect_table[i]->purposes; *own != 0; own++)
            if (!is_named(*own) && taker_of(*own, i) != NULL)
                fail_msg("%s draws for purpose %u, as %s does; %u is free", effects_names[i], *own,
                         taker_of(*own, i), next);
}

static uint64_t effects_with_a_cause(enum effect_home home)
{
    uint64_t effects = 0;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (effect_table[i]->home == home && effect_has_cause(effect_table[i]))
            effects |= EFFECT_BIT(i);
    return effects;
}

EFFECT_TEST(what_no_document_describes_is_left_out_and_noted)
{
    for (int home = 0; home <= EFFECT_HOME_NOISE; home++) {
        struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, (enum effect_home)home);
        assert_true(scan.effects == 0 && scan.receiving == 0 && scan.constants == NULL);
        assert_close(scan.interference, 0, 0);
        assert_true(bench->log.simulated == 0);
        assert_true(bench->log.left_out == effects_with_a_cause((enum effect_home)home));
    }
}

/* Each case sets one member of the sensor to 1. */
EFFECT_TEST(a_member_describes_its_effect_and_no_other)
{
    const struct sensor plain = bench->sensor;
    static const struct {
        enum effect_id effect;
        size_t offset;
    } cases[] = {
        {EFFECT_LEVEL, offsetof(struct sensor, level_constant_db)},
        {EFFECT_LEVEL, offsetof(struct sensor, level_slow_db)},
        {EFFECT_LEVEL, offsetof(struct sensor, level_fast_db)},
        {EFFECT_AMBIGUITY, offsetof(struct sensor, unambiguous_range_m)},
        {EFFECT_AMBIGUITY, offsetof(struct sensor, unambiguous_rate_mps)},
        {EFFECT_ANGLE_NOISE, offsetof(struct sensor, pointer_sigma)},
        {EFFECT_ANGLE_NOISE, offsetof(struct sensor, azimuth_floor_rad)},
        {EFFECT_RANGE_NOISE, offsetof(struct sensor, range_sigma_m)},
        {EFFECT_RANGE_NOISE, offsetof(struct sensor, range_rate_sigma_mps)},
        {EFFECT_MISALIGNMENT, offsetof(struct sensor, misalignment_rad)},
        {EFFECT_MISALIGNMENT, offsetof(struct sensor, radome_bias_rad)},
        {EFFECT_FALSE_ALARMS, offsetof(struct sensor, false_alarms)},
        {EFFECT_QUANTISATION, offsetof(struct sensor, range_step_m)},
        {EFFECT_QUANTISATION, offsetof(struct sensor, range_rate_step_mps)},
        {EFFECT_QUANTISATION, offsetof(struct sensor, azimuth_step_rad)},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        const double one = 1;
        enum effect_home home = effect_table[cases[i].effect]->home;
        bench->sensor = plain;
        memcpy((char *)&bench->sensor + cases[i].offset, &one, sizeof one);
        assert_true(effect_bench_begin(bench, EVERY_EFFECT, home).effects ==
                    EFFECT_BIT(cases[i].effect));
        assert_true(bench->log.simulated == EFFECT_BIT(cases[i].effect));
        uint64_t others = EVERY_EFFECT & ~EFFECT_BIT(cases[i].effect);
        assert_true(effect_bench_begin(bench, others, home).effects == 0);
        assert_true(bench->log.simulated == 0);
    }
}

/* Of a sensor that describes nothing, each member alone. */
EFFECT_TEST(a_sensor_lacks_an_effect_until_a_member_is_set)
{
    int tried = 0;
    for (int effect = 0; effect < EFFECT_COUNT; effect++)
        for (const struct effect_member *member = effect_table[effect]->members; member->size > 0;
             member++) {
            struct sensor sensor = {0};
            if (member->owner != EFFECT_OWNER_SENSOR)
                continue;
            assert_true((effect_missing(&sensor) & EFFECT_BIT(effect)) != 0);
            ((char *)&sensor)[member->offset] = 1;
            assert_true((effect_missing(&sensor) & EFFECT_BIT(effect)) == 0);
            tried++;
        }
    assert_true(tried > 20);
}

EFFECT_TEST(what_a_scene_describes_whatever_the_sensor_is_of_scenes)
{
    static const enum effect_id of_scenes[] = {EFFECT_ROADSIDE, EFFECT_CLUTTER, EFFECT_RAIN};
    static const enum effect_id others[] = {EFFECT_LATENCY, EFFECT_TWO_RAY, EFFECT_INTERFERENCE,
                                            EFFECT_MERGING};
    for (size_t i = 0; i < COUNT(of_scenes); i++)
        assert_true((effect_of_scenes() & EFFECT_BIT(of_scenes[i])) != 0);
    for (size_t i = 0; i < COUNT(others); i++)
        assert_true((effect_of_scenes() & EFFECT_BIT(others[i])) == 0);
}

EFFECT_TEST(flags_choices_and_limits_describe_their_effects)
{
    struct sensor *sensor = &bench->sensor;
    sensor->final_threshold = true;
    assert_true(effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE).effects ==
                EFFECT_BIT(EFFECT_FINAL_THRESHOLD));
    sensor->final_threshold = false;
    sensor->list_limit = 3;
    assert_true(effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE).effects ==
                EFFECT_BIT(EFFECT_LIST_LIMIT));
    sensor->list_limit = 0;
    sensor->sigma_law = SIGMA_BY_AMPLITUDE;
    assert_true(effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE).effects ==
                EFFECT_BIT(EFFECT_ACCURACY));
    sensor->sigma_law = SIGMA_BY_SNR;
    assert_true(effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE).effects ==
                (EFFECT_BIT(EFFECT_ACCURACY) | EFFECT_BIT(EFFECT_RANGE_NOISE)));
}

/* A sensor with a cycle of 70 ms measures at 0.21 s what the frame of 0.22 s shows; with a latency
 * of 40 ms, it sees the world of 0.17 s. */
EFFECT_TEST(a_scan_has_the_instant_of_its_measurement)
{
    static const struct {
        double cycle_s, latency_s;
        uint64_t effects;
        double time_s;
    } cases[] = {
        {0, 0, EVERY_EFFECT, 0.22},
        {0.07, 0, EVERY_EFFECT, 0.21},
        {0.07, 0, 0, 0.21},
        {0, 0.04, EVERY_EFFECT, 0.18},
        {0.07, 0.04, EVERY_EFFECT, 0.17},
        {0.07, 0.04, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_LATENCY), 0.21},
    };
    bench->frame.time_s = 0.22;
    bench->frame.interval_s = 0.05;
    for (size_t i = 0; i < COUNT(cases); i++) {
        bench->sensor.cycle_s = cases[i].cycle_s;
        bench->sensor.latency_s = cases[i].latency_s;
        for (int home = 0; home <= EFFECT_HOME_NOISE; home++)
            assert_close(effect_bench_begin(bench, cases[i].effects, (enum effect_home)home).time_s,
                         cases[i].time_s, 1e-15);
    }
}

/* Factors on amplitude multiply in the order of the chain, to the bit. They are those of the true
 * range, although the range that the radar reads is folded. */
EFFECT_TEST(effects_act_in_the_order_of_the_chain)
{
    struct sensor *sensor = &bench->sensor;
    sensor->fluctuation = FLUCTUATION_SWERLING_3;
    sensor->unambiguous_range_m = 60;
    sensor->unambiguous_rate_mps = 24.5;
    bench->frame.conditions.rain_mmph = 25;
    bench->frame.conditions.fog_gpm3 = 0.5;
    struct echo echo = effect_bench_echo(100);
    double amplitude = 1;
    static const enum effect_id order[] = {EFFECT_FLUCTUATION, EFFECT_RAIN, EFFECT_FOG};
    for (size_t i = 0; i < COUNT(order); i++)
        amplitude *= effect_bench_factor(bench, order[i], &echo);
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR);
    struct effect_reception reception = {
        .echo = &echo, .strength = 2, .amplitude = 1, .range_m = 100, .range_rate_mps = 45};
    assert_true(effect_receive(&scan, &reception) == scan.effects);
    assert_true(scan.effects == (EFFECT_BIT(EFFECT_FLUCTUATION) | EFFECT_BIT(EFFECT_RAIN) |
                                 EFFECT_BIT(EFFECT_FOG) | EFFECT_BIT(EFFECT_AMBIGUITY)));
    assert_close(reception.amplitude, amplitude, 0);
    assert_close(reception.strength, 2 * amplitude, 0);
    assert_close(reception.range_m, 40, 0);
    assert_close(reception.range_rate_mps, -4, 0);
}

EFFECT_TEST(an_added_echo_is_in_range_and_in_view)
{
    struct effect_scan scan = effect_bench_begin(bench, 0, EFFECT_HOME_SENSOR);
    double border_rad = antenna_border_rad(bench->sensor.field_of_view_rad);
    static const double ranges_m[] = {0, 0.999, 1, 200, 200.001};
    struct effect_echoes echoes = {0};
    for (size_t i = 0; i < COUNT(ranges_m); i++) {
        struct echo echo = effect_bench_echo(ranges_m[i]);
        effect_add(&scan, &echoes, &echo);
        echo.azimuth_rad = border_rad * (i % 2 == 0 ? 1 : -1);
        effect_add(&scan, &echoes, &echo);
        echo.azimuth_rad *= 0.999;
        effect_add(&scan, &echoes, &echo);
    }
    assert_int_equal(echoes.list.count, 4);
    for (size_t i = 0; i < 4; i++)
        assert_close(echoes.list.items[i].range_m, i < 2 ? 1 : 200, 0);
}
