#include "check.h"

#include "base/arena.h"
#include "documents/suite_effects.h"
#include "documents/suite_file.h"
#include "effects/effect.h"

/* The members that describe an effect are those of lib/effects. */
static void a_member_of_the_sensor_describes_its_effect(void **state)
{
    (void)state;
    int tried = 0;
    for (int effect = 0; effect < EFFECT_COUNT; effect++)
        for (int i = 0; i < 3; i++) {
            const struct effect_member *member = &effect_table[effect]->members[i];
            struct sensor sensor = {0};
            if (member->size == 0 || member->of_conditions)
                continue;
            assert_true((suite_effects_missing(&sensor) & EFFECT_BIT(effect)) != 0);
            if (member->size == sizeof(double))
                memcpy((char *)&sensor + member->offset, &(double){1}, sizeof(double));
            else
                *((char *)&sensor + member->offset) = 1;
            assert_true((suite_effects_missing(&sensor) & EFFECT_BIT(effect)) == 0);
            tried++;
        }
    assert_true(tried > 10);
}

static void levels_stand_for_fluctuation(void **state)
{
    (void)state;
    struct sensor sensor = {.level_fast_db = 1};
    assert_true((suite_effects_missing(&sensor) & EFFECT_BIT(EFFECT_FLUCTUATION)) == 0);
    sensor = (struct sensor){.fluctuation = FLUCTUATION_SWERLING_1};
    assert_true((suite_effects_missing(&sensor) & EFFECT_BIT(EFFECT_LEVEL)) != 0);
}

static void the_examples_lack_what_they_are_said_to_lack(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct diag diag = {0};
    const double reaches_m[] = {60, 250};
    for (int i = 0; i < 2; i++) {
        struct sensor sensor = {.range_max_m = reaches_m[i]};
        struct suite_effects_example example = suite_effects_example(&sensor);
        const struct suite *suite = suite_file_load(example.name, &arena, &diag);
        assert_non_null(suite);
        for (size_t k = 0; k < suite->sensors.count; k++)
            assert_true(suite_effects_missing(&suite->sensors.items[k]) == example.missing);
        assert_string_equal(suite_effects_example(&suite->sensors.items[0]).name, example.name);
    }
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_member_of_the_sensor_describes_its_effect),
        cmocka_unit_test(levels_stand_for_fluctuation),
        cmocka_unit_test(the_examples_lack_what_they_are_said_to_lack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
