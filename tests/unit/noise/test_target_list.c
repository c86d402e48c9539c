#include "check.h"

#include "base/units.h"
#include "effects/effect.h"
#include "noise/target_list.h"
#include "sample.h"

struct list {
    struct frame frame;
    struct sensor sensor;
    struct cell cells[8];
    struct effect_measurement measurements[8];
    size_t count;
};

static void begin_list(struct list *list, enum list_order order)
{
    *list = (struct list){.sensor = {.name = "s", .list_order = order}};
    list->frame.arena = check_arena();
    list->frame.sections = CARRY_ACCOUNT;
}

static void add_measurement(struct list *list, const char *object, double range_m, double amplitude)
{
    struct cell *cell = &list->cells[list->count];
    *cell = (struct cell){.sensor = "s", .range_m = range_m, .sum_re = amplitude};
    *list_add(&cell->members, check_arena()) = (struct contributor){
        .id.object = object, .id.reflector = "r", .range_m = range_m, .weight = 1};
    list->measurements[list->count++] = effect_measurement_of(NULL, cell);
}

/* Makes the list with at most limit targets; 0: all. */
static void make(struct list *list, int64_t limit)
{
    const struct effect_scan scan = {.effects = EFFECT_BIT(EFFECT_LIST_LIMIT)};
    list->sensor.list_limit = limit;
    const struct detection_source source = {.sensor = &list->sensor, .scan = &scan};
    target_list_make(&list->frame, "noise", &source, list->measurements, list->count);
}

/* Makes the list and compares its targets with objects, one letter each. */
static void assert_listed(struct list *list, int64_t limit, const char *objects)
{
    make(list, limit);
    assert_int_equal(list->frame.targets.count, strlen(objects));
    for (size_t i = 0; i < list->frame.targets.count; i++)
        assert_int_equal(list->frame.targets.items[i].contributors.items[0].id.object[0],
                         objects[i]);
}

static void add_all(struct list *list)
{
    add_measurement(list, "a", 30, 5);
    add_measurement(list, "b", 10, 2);
    add_measurement(list, "c", 20, 5);
    add_measurement(list, "d", 10, 3);
    add_measurement(list, "e", 40, 0);
    add_measurement(list, "f", 10, 3);
}

TEST(targets_come_strongest_or_nearest_first)
{
    static const struct {
        enum list_order order;
        int64_t limit;
        const char *objects;
    } cases[] = {{LIST_STRONGEST, 0, "cadfb"}, {LIST_NEAREST, 0, "dfbca"},
                 {LIST_STRONGEST, 2, "ca"},    {LIST_NEAREST, 4, "dfbc"},
                 {LIST_STRONGEST, 5, "cadfb"}, {LIST_STRONGEST, 9, "cadfb"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct list list;
        begin_list(&list, cases[i].order);
        add_all(&list);
        assert_listed(&list, cases[i].limit, cases[i].objects);
        /* A measurement that is not listed is lost: it has no amplitude, or is beyond the limit. */
        size_t beyond = 5 - strlen(cases[i].objects);
        assert_int_equal(list.frame.lost.count, beyond > 0 ? 2 : 1);
        for (size_t j = 0; j < list.frame.lost.count; j++) {
            const struct lost_group *group = &list.frame.lost.items[j];
            assert_string_equal(group->stage, "noise");
            bool silent = frame_loss_of(group->reason) == LOSS_NO_AMPLITUDE;
            assert_true(silent || frame_loss_of(group->reason) == LOSS_LIST_LIMIT);
            assert_int_equal(group->echoes.count, silent ? 1 : beyond);
        }
    }
}

TEST(the_order_of_the_measurements_does_not_matter)
{
    uint64_t random = 2;
    for (int round = 0; round < 200; round++) {
        struct list list;
        begin_list(&list, round % 2 ? LIST_STRONGEST : LIST_NEAREST);
        add_all(&list);
        for (size_t i = list.count; i > 1; i--) {
            size_t j = sample_bits(&random) % i;
            struct effect_measurement kept = list.measurements[j];
            list.measurements[j] = list.measurements[i - 1];
            list.measurements[i - 1] = kept;
        }
        assert_listed(&list, 3, round % 2 ? "cad" : "dfb");
    }
}

TEST(a_target_has_its_measurement_and_the_label_of_its_cell)
{
    struct list list;
    begin_list(&list, LIST_STRONGEST);
    add_measurement(&list, "a", 10, 3);
    list.cells[0].sum_im = -4;
    list.cells[0].azimuth_rad = 0.1;
    list.cells[0].range_rate_mps = -3;
    list.cells[0].amplitude = 9;
    list.cells[0].sign_undecided = true;
    list.measurements[0] = effect_measurement_of(NULL, &list.cells[0]);
    assert_close(list.measurements[0].amplitude, 5, 0);
    assert_true(list.measurements[0].sign_undecided);
    list.measurements[0].range_m = 10.25;
    list.measurements[0].azimuth_rad = 0.15;
    list.measurements[0].range_rate_mps = -2.5;
    list.measurements[0].amplitude = 10;
    list.measurements[0].sign_undecided = false;
    assert_listed(&list, 0, "a");
    const struct target *target = list.frame.targets.items;
    assert_close(target->range_m, 10.25, 0);
    assert_close(target->azimuth_rad, 0.15, 0);
    assert_close(target->range_rate_mps, -2.5, 0);
    assert_close(target->amplitude_db, 20, 1e-13);
    assert_false(target->sign_undecided);
    assert_close(target->cell_range_m, 10, 0);
    assert_close(target->cell_azimuth_rad, 0.1, 0);
    assert_close(target->cell_range_rate_mps, -3, 0);
    assert_close(target->cell_amplitude, 9, 0);
    assert_close(target->cell_sum, 5, 0);
    assert_int_equal(list.frame.lost.count, 0);
}

/* The list has amplitudes 5, 5, 3, 3, 2 or ranges 10, 10, 10, 20, 30 m in its order. */
TEST(a_limit_gives_margins_to_both_sides_of_the_cut)
{
    const double db_5_3 = 20 * log10(5.0 / 3), db_3_2 = 20 * log10(3.0 / 2),
                 db_5_2 = 20 * log10(2.5);
    const struct {
        enum list_order order;
        int64_t limit;
        unsigned present;
        double listed[4], lost[3];
    } cases[] = {
        {LIST_STRONGEST, 2, MARGIN_LIMIT_DB, {db_5_3, db_5_3}, {db_5_3, db_5_3, db_5_2}},
        {LIST_STRONGEST, 4, MARGIN_LIMIT_DB, {db_5_2, db_5_2, db_3_2, db_3_2}, {db_3_2}},
        {LIST_STRONGEST, 1, MARGIN_LIMIT_DB, {0}, {0}},
        {LIST_NEAREST, 3, MARGIN_LIMIT_M, {10, 10, 10}, {10, 20}},
        {LIST_NEAREST, 4, MARGIN_LIMIT_M, {20, 20, 20, 10}, {10}},
        {LIST_STRONGEST, 5, 0, {0}, {0}},
        {LIST_NEAREST, 0, 0, {0}, {0}},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct list list;
        begin_list(&list, cases[i].order);
        list.frame.sections |= CARRY_MARGINS;
        add_all(&list);
        make(&list, cases[i].limit);
        bool in_db = cases[i].present == MARGIN_LIMIT_DB;
        for (size_t j = 0; j < list.frame.targets.count; j++) {
            const struct margins *margins = &list.frame.targets.items[j].margins;
            assert_int_equal(margins->present, cases[i].present);
            if (margins->present != 0 && cases[i].limit > 1)
                assert_close(in_db ? margins->limit_db : margins->limit_m, cases[i].listed[j],
                             1e-13);
        }
        for (size_t j = 0; j < list.frame.lost.count; j++) {
            const struct lost_group *group = &list.frame.lost.items[j];
            for (size_t k = 0; k < group->echoes.count && k < COUNT(cases[i].lost); k++) {
                const struct margins *margins = &group->echoes.items[k].margins;
                bool silent = frame_loss_of(group->reason) == LOSS_NO_AMPLITUDE;
                assert_int_equal(margins->present, silent ? 0 : cases[i].present);
                if (!silent && cases[i].limit > 1)
                    assert_close(in_db ? margins->limit_db : margins->limit_m, cases[i].lost[k],
                                 1e-13);
            }
        }
    }
}

TEST(an_amplitude_that_is_no_number_makes_no_target)
{
    struct list list;
    begin_list(&list, LIST_STRONGEST);
    add_measurement(&list, "a", 10, (double)NAN);
    assert_listed(&list, 0, "");
}

/* The target of a sensor with steps that lists this measurement alone. */
static struct target round_target(struct list *list, const struct effect_measurement *measurement)
{
    static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};
    begin_list(list, LIST_STRONGEST);
    list->frame.scene = "s";
    list->sensor.range_step_m = 0.5;
    list->sensor.range_rate_step_mps = 0.25;
    list->sensor.azimuth_step_rad = 1.1;
    add_measurement(list, "a", 10.3, 2);
    list->measurements[0].range_m = measurement->range_m;
    list->measurements[0].azimuth_rad = measurement->azimuth_rad;
    list->measurements[0].range_rate_mps = measurement->range_rate_mps;
    struct effect_scan scan =
        effect_begin(&list->frame, &list->sensor, &everything, EFFECT_HOME_NOISE);
    const struct detection_source source = {.sensor = &list->sensor, .scan = &scan};
    target_list_make(&list->frame, "noise", &source, list->measurements, 1);
    assert_int_equal(list->frame.targets.count, 1);
    return list->frame.targets.items[0];
}

TEST(a_listed_target_is_rounded_and_its_label_is_not)
{
    struct list list;
    static const struct {
        double azimuth_rad, reported_rad;
    } cases[] = {{0.4, 0}, {-1, -1.1}, {3.1, 3.3 - 2 * PI}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct effect_measurement measurement = {
            .range_m = 10.3, .azimuth_rad = cases[i].azimuth_rad, .range_rate_mps = -3.2};
        struct target target = round_target(&list, &measurement);
        assert_close(target.range_m, 10.5, 0);
        assert_close(target.azimuth_rad, cases[i].reported_rad, 1e-15);
        assert_close(target.range_rate_mps, -3.25, 0);
        assert_close(target.cell_range_m, 10.3, 0);
        assert_close(target.amplitude_db, 20 * log10(2), 1e-13);
        assert_int_equal(target.effects, EFFECT_BIT(EFFECT_QUANTISATION));
    }
    const struct effect_measurement even = {.range_m = 10.5, .range_rate_mps = -3.25};
    assert_int_equal(round_target(&list, &even).effects, 0);
}
