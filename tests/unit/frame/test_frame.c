#include "check.h"
#include "frame/frame_check.h"
#include "frame/frame_order.h"

#include <string.h>

#include "frame/frame.h"
#include "frame/frame_account.h"
#include "frame/frame_text.h"
#include "sample.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static struct contributor from(const char *object, const char *reflector)
{
    return (struct contributor){.id.object = object, .id.reflector = reflector, .weight = 1};
}

static struct cell cell_of(struct arena *arena, const char *sensor, size_t count,
                           const struct contributor *members)
{
    struct cell cell = {.sensor = sensor, .amplitude = 1};
    for (size_t i = 0; i < count; i++)
        *list_add(&cell.members, arena) = members[i];
    return cell;
}

/* Two sensors; three reflectors; one echo of each kind of end. */
static struct frame accounted_frame(struct arena *arena)
{
    struct frame frame = {.arena = arena};
    field_clear(&frame_record, &frame);
    frame.arena = arena;
    frame.scene = "s";
    frame.interval_s = 1;
    frame.ego = "e";
    frame.account = true;
    static const char *const ids[] = {"e", "b", "a"}, *const sensors[] = {"right", "left"};
    for (size_t i = 0; i < 3; i++)
        *list_add(&frame.objects, arena) = (struct object){.id = ids[i], .class = "car"};
    for (size_t i = 0; i < 2; i++) {
        *list_add(&frame.sensors.list, arena) = (struct sensor_view){.name = sensors[i]};
        struct count *count = list_add(&frame.counts, arena);
        *count = (struct count){.sensor = sensors[i], .pairs = 3};
        *list_add(&count->paths, arena) = (struct path_count){.echoes = 2};
        struct cell cell = cell_of(arena, sensors[i], 2,
                                   (struct contributor[]){from("b", "corner"), from("a", "rear")});
        frame_add_target(&frame, &cell, 3);
        frame_lose(&frame, "ideal", sensors[i], LOSS_OUT_OF_VIEW,
                   &(struct lost_echo){.id.object = "a", .id.reflector = "corner"});
    }
    frame.sensors.suite = "pair";
    frame.sensors.digest = "0";
    frame.present =
        SECTION_OBJECTS | SECTION_SENSORS | SECTION_TARGETS | SECTION_LOST | SECTION_COUNTS;
    return frame;
}

static void a_whole_account_passes(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = accounted_frame(&arena);
    struct diag diag = {0};
    assert_int_equal(frame_account_check(&frame, &diag), 0);
    frame_order(&frame);
    assert_int_equal(frame_check(&frame, &diag), 0);
    assert_int_equal(frame_account_check(&frame, &diag), 0);
    arena_free(&arena);
}

static void an_echo_may_feed_several_targets(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = accounted_frame(&arena);
    struct diag diag = {0};
    struct cell cell = cell_of(&arena, "left", 1, (struct contributor[]){from("b", "corner")});
    frame_add_target(&frame, &cell, 2);
    frame_add_target(&frame, &cell, 1);
    assert_int_equal(frame_account_check(&frame, &diag), 0);
    arena_free(&arena);
}

static void forget_one(struct frame *frame)
{
    frame->targets.items[0].contributors.count = 1;
}

static void forget_a_loss(struct frame *frame)
{
    frame->lost.count--;
}

static void double_one_in_a_target(struct frame *frame)
{
    frame->targets.items[1].contributors.items[1] = from("b", "corner");
}

static void double_one_between_target_and_lost(struct frame *frame)
{
    frame_lose(frame, "noise", "left", LOSS_BELOW_FINAL,
               &(struct lost_echo){.id.object = "a", .id.reflector = "rear"});
}

static void double_three(struct frame *frame)
{
    double_one_between_target_and_lost(frame);
    frame_lose(frame, "ideal", "left", LOSS_OUT_OF_VIEW,
               &(struct lost_echo){.id.object = "a", .id.reflector = "corner"});
    double_one_in_a_target(frame);
}

static void add_a_foreign_one(struct frame *frame)
{
    frame_lose(frame, "noise", "right", LOSS_BELOW_FINAL,
               &(struct lost_echo){.id.object = "x", .id.reflector = "rear"});
}

static void add_one_of_a_foreign_sensor(struct frame *frame)
{
    frame_lose(frame, "ideal", "top", LOSS_BLOCKED,
               &(struct lost_echo){.id.object = "a", .id.reflector = "rear"});
}

static void count_one_more(struct frame *frame)
{
    frame->counts.items[1].pairs++;
}

static void planted_faults_in_the_account_are_caught(void **state)
{
    (void)state;
    static const struct {
        void (*plant)(struct frame *frame);
        const char *message;
    } cases[] = {{forget_one, "account: sensor \"right\" has 2 entries; 3 are due"},
                 {forget_a_loss, "account: sensor \"left\" has 2 entries; 3 are due"},
                 {double_one_in_a_target,
                  "account: sensor \"left\", object \"b\", reflector \"corner\" has two entries"},
                 {double_one_between_target_and_lost,
                  "account: sensor \"left\", object \"a\", reflector \"rear\" has two entries"},
                 {double_three,
                  "account: sensor \"left\", object \"a\", reflector \"corner\" has two entries"},
                 {add_a_foreign_one, "account: sensor \"right\" has 4 entries; 3 are due"},
                 {add_one_of_a_foreign_sensor, "account: 1 entries of sensors without a count"},
                 {count_one_more, "account: sensor \"left\" has 3 entries; 4 are due"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct arena arena = {0};
        struct frame frame = accounted_frame(&arena);
        struct diag diag = {0};
        cases[i].plant(&frame);
        assert_int_equal(frame_account_check(&frame, &diag), -1);
        assert_string_equal(diag.text, cases[i].message);
        assert_int_equal(diag.code, DIAG_INTERNAL);
        arena_free(&arena);
    }
}

static void losses_are_grouped_by_sensor_stage_and_reason(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = {.arena = &arena, .account = true};
    static const char *const sensors[] = {"s", "t"}, *const stages[] = {"ideal", "noise"};
    for (int i = 0; i < 24; i++)
        frame_lose(&frame, stages[i / 2 % 2], sensors[i % 2],
                   i / 4 % 2 ? LOSS_BLOCKED : LOSS_NO_ANGLE,
                   &(struct lost_echo){.id.object = "o", .id.reflector = "r"});
    assert_int_equal(frame.lost.count, 8);
    for (size_t i = 0; i < 8; i++)
        assert_int_equal(frame.lost.items[i].echoes.count, 3);
    assert_int_equal(frame.present, SECTION_LOST);
    struct cell cell =
        cell_of(&arena, "s", 2, (struct contributor[]){from("o", "p"), from("o", "q")});
    frame_lose_cell(&frame, "sensor", &cell, LOSS_BELOW_THRESHOLD, 4.5, &cell.margins);
    const struct lost_group *group = &frame.lost.items[8];
    assert_int_equal(group->echoes.count, 2);
    assert_string_equal(group->echoes.items[1].id.reflector, "q");
    assert_close(group->echoes.items[1].shortfall_db, 4.5, 0);
    arena_free(&arena);
}

static void a_frame_without_account_forgets_its_losses(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    frame_lose(&frame, "ideal", "s", LOSS_BLOCKED,
               &(struct lost_echo){.id.object = "o", .id.reflector = "r"});
    assert_int_equal(frame.lost.count, 0);
    assert_int_equal(frame.present, 0);
    arena_free(&arena);
}

static struct text written(const struct frame *frame)
{
    struct text text = {0};
    struct diag diag = {0};
    assert_int_equal(frame_text_write(frame, &text, &diag), 0);
    return text;
}

#define SHUFFLE(list, random)                                                                      \
    for (size_t i_ = (list).count; i_ > 1; i_--) {                                                 \
        size_t j_ = sample_bits(random) % i_;                                                      \
        char kept_[sizeof *(list).items];                                                          \
        memcpy(kept_, &(list).items[j_], sizeof kept_);                                            \
        (list).items[j_] = (list).items[i_ - 1];                                                   \
        memcpy(&(list).items[i_ - 1], kept_, sizeof kept_);                                        \
    }

static void every_order_of_a_frame_becomes_the_canonical_one(void **state)
{
    (void)state;
    static const char *const names[] = {"a", "b", "ba", "B", "\xc3\xa9"};
    struct arena arena = {0};
    struct frame frame = accounted_frame(&arena);
    for (size_t i = 0; i < 25; i++) {
        *list_add(&frame.echoes, &arena) = (struct echo){.sensor = i % 2 ? "left" : "right",
                                                         .id.object = names[i / 5],
                                                         .id.reflector = names[i % 5]};
        struct contributor members[] = {from(names[i / 5], names[i % 5]), from("z", "1"),
                                        from("z", "2"), from("y", "3")};
        *list_add(&frame.cells, &arena) = cell_of(&arena, i % 3 ? "left" : "right", 4, members);
        frame_lose(&frame, i % 2 ? "noise" : "ideal", i % 3 ? "left" : "right", (enum loss)(i % 4),
                   &(struct lost_echo){.id.object = names[i / 5], .id.reflector = names[i % 5]});
    }
    for (size_t i = 0; i < 5; i++) {
        struct reflector_set *set = list_add(&frame.reflectors, &arena);
        *set = (struct reflector_set){.model = names[i]};
        for (size_t j = 0; j < 5; j++)
            *list_add(&set->objects, &arena) = names[j];
    }
    frame.present |= SECTION_ECHOES | SECTION_CELLS | SECTION_REFLECTORS;
    frame_order(&frame);
    struct diag diag = {0};
    assert_int_equal(frame_check(&frame, &diag), 0);
    for (size_t i = 1; i < frame.echoes.count; i++)
        assert_true(strcmp(frame.echoes.items[i - 1].sensor, frame.echoes.items[i].sensor) <= 0);
    assert_string_equal(frame.cells.items[0].members.items[0].id.object, "B");
    assert_string_equal(frame.cells.items[0].members.items[1].id.reflector, "3");
    struct text canonical = written(&frame);
    uint64_t random = 9;
    for (int round = 0; round < 100; round++) {
        SHUFFLE(frame.echoes, &random)
        SHUFFLE(frame.cells, &random)
        SHUFFLE(frame.lost, &random)
        SHUFFLE(frame.counts, &random)
        SHUFFLE(frame.sensors.list, &random)
        SHUFFLE(frame.reflectors, &random)
        frame_order(&frame);
        struct text text = written(&frame);
        assert_int_equal(text.length, canonical.length);
        assert_memory_equal(text.bytes, canonical.bytes, text.length);
        text_free(&text);
    }
    text_free(&canonical);
    arena_free(&arena);
}

static void targets_keep_their_sensors_order(void **state)
{
    (void)state;
    static const char *const sensors[] = {"c", "a", "b"};
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    for (size_t i = 0; i < 30; i++) {
        struct cell cell = {.sensor = sensors[i * 7 % 3]};
        frame_add_target(&frame, &cell, (double)i);
    }
    frame_order(&frame);
    for (size_t i = 1; i < 30; i++) {
        const struct target *one = &frame.targets.items[i - 1], *next = one + 1;
        int order = strcmp(one->sensor, next->sensor);
        assert_true(order < 0 || (order == 0 && one->amplitude_db < next->amplitude_db));
    }
    arena_free(&arena);
}

/* Begins the next frame, with these objects, and says in which order they come. */
static const char *order_of(struct frame *frame, size_t count, const char *const *ids)
{
    static char text[64];
    frame_clear(frame);
    for (size_t i = 0; i < count; i++)
        *list_add(&frame->objects, frame->arena) = (struct object){.id = ids[i]};
    struct object *const *objects = frame_order_objects(frame);
    text[0] = '\0';
    for (size_t i = 0; i < count; i++)
        strcat(text, objects[i]->id);
    return text;
}

static void objects_are_found_by_id_in_order(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    assert_string_equal(order_of(&frame, 3, (const char *[]){"c", "a", "b"}), "abc");
    assert_string_equal(order_of(&frame, 3, (const char *[]){"a", "b", "c"}), "abc");
    assert_string_equal(order_of(&frame, 2, (const char *[]){"d", "a"}), "ad");
    assert_string_equal(order_of(&frame, 0, NULL), "");
    assert_string_equal(order_of(&frame, 4, (const char *[]){"b", "d", "a", "b"}), "abbd");
    *list_add(&frame.objects, &arena) = (struct object){.id = "c"};
    assert_string_equal(frame_order_objects(&frame)[3]->id, "c");
    frame.objects.items[4].id = "e";
    frame_order_part(&frame, (struct frame_part){SECTION_OBJECTS, NULL});
    assert_string_equal(frame_order_objects(&frame)[4]->id, "e");
    arena_free(&arena);
}

/* A strict total order: antisymmetric and transitive, equal only to itself. */
static void ties_are_decided_by_a_total_order(void **state)
{
    (void)state;
    struct contributor all[32];
    for (unsigned i = 0; i < 32; i++)
        all[i] = (struct contributor){.range_m = i >> 4 & 1,
                                      .range_rate_mps = i >> 3 & 1,
                                      .azimuth_rad = i >> 2 & 1,
                                      .id.object = i >> 1 & 1 ? "b" : "a",
                                      .id.reflector = i & 1 ? "q" : "p",
                                      .weight = 31 - i};
    for (int i = 0; i < 32; i++)
        for (int j = 0; j < 32; j++) {
            int order = frame_order_tied(&all[i], &all[j]);
            assert_int_equal((order > 0) - (order < 0), (i > j) - (i < j));
        }
}

static void name_one_twice(struct frame *frame)
{
    frame->objects.items[1].id = "a";
}

static void lose_the_ego(struct frame *frame)
{
    frame->ego = "x";
}

static void name_a_sensor_twice(struct frame *frame)
{
    frame->sensors.list.items[0].name = "left";
}

static void see_one_twice(struct frame *frame)
{
    for (int i = 0; i < 2; i++)
        *list_add(&frame->echoes, frame->arena) =
            (struct echo){.sensor = "left", .id.object = "a", .id.reflector = "r"};
}

static void see_with_no_sensor(struct frame *frame)
{
    *list_add(&frame->echoes, frame->arena) =
        (struct echo){.sensor = "top", .id.object = "a", .id.reflector = "r"};
}

static void open_a_cell_twice(struct frame *frame)
{
    for (int i = 0; i < 2; i++)
        *list_add(&frame->cells, frame->arena) =
            cell_of(frame->arena, "left", 1, (struct contributor[]){from("a", "r")});
}

static void open_an_empty_cell(struct frame *frame)
{
    *list_add(&frame->cells, frame->arena) = (struct cell){.sensor = "left"};
}

static void report_a_target_without_label(struct frame *frame)
{
    frame->targets.items[1].contributors.count = 0;
}

static void report_with_no_sensor(struct frame *frame)
{
    frame->targets.items[1].sensor = "top";
}

static void frames_that_contradict_themselves_are_refused(void **state)
{
    (void)state;
    static const struct {
        void (*plant)(struct frame *frame);
        const char *message;
    } cases[] = {
        {name_one_twice, "objects: the id \"a\" stands twice"},
        {lose_the_ego, "ego: \"x\" is not among the objects"},
        {name_a_sensor_twice, "sensors.list: \"left\" stands twice"},
        {see_one_twice, "echoes: sensor \"left\", object \"a\", reflector \"r\" stands twice"},
        {see_with_no_sensor, "echoes[0].sensor: \"top\" is not in sensors.list"},
        {open_a_cell_twice, "cells: sensor \"left\" has two led by object \"a\", reflector \"r\""},
        {open_an_empty_cell, "cells[0].members: empty; expected the leader"},
        {report_a_target_without_label, "targets[0].contributors: empty; expected a label"},
        {report_with_no_sensor, "targets[1].sensor: \"top\" is not in sensors.list"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct arena arena = {0};
        struct frame frame = accounted_frame(&arena);
        struct diag diag = {0};
        cases[i].plant(&frame);
        frame_order(&frame);
        assert_int_equal(frame_check(&frame, &diag), -1);
        assert_string_equal(diag.text, cases[i].message);
        assert_int_equal(diag.code, DIAG_DATA);
        arena_free(&arena);
    }
}

static void spans_are_the_sensors_own(void **state)
{
    (void)state;
    static const char *const sensors[] = {"a", "b", "d"};
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    for (size_t i = 0; i < 9; i++) {
        *list_add(&frame.echoes, &arena) = (struct echo){.sensor = sensors[i / 3]};
        *list_add(&frame.cells, &arena) = (struct cell){.sensor = sensors[i / 3]};
    }
    for (size_t i = 0; i < 3; i++) {
        assert_ptr_equal(frame_echoes_of(&frame, sensors[i]).items, frame.echoes.items + 3 * i);
        assert_int_equal(frame_echoes_of(&frame, sensors[i]).count, 3);
        assert_ptr_equal(frame_cells_of(&frame, sensors[i]).items, frame.cells.items + 3 * i);
        assert_int_equal(frame_cells_of(&frame, sensors[i]).count, 3);
    }
    assert_int_equal(frame_echoes_of(&frame, "c").count, 0);
    assert_int_equal(frame_cells_of(&frame, "").count, 0);
    arena_free(&arena);
}

static void dropped_sections_are_as_if_they_had_never_been(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame frame = accounted_frame(&arena);
    frame_drop(&frame, SECTION_SENSORS | SECTION_TARGETS | SECTION_LOST);
    assert_int_equal(frame.present, SECTION_OBJECTS | SECTION_COUNTS);
    assert_int_equal(frame.targets.count + frame.lost.count + frame.sensors.list.count, 0);
    assert_null(frame.sensors.suite);
    assert_int_equal(frame.objects.count, 3);
    assert_int_equal(frame.counts.count, 2);
    assert_string_equal(frame_section_name(SECTION_TARGETS), "targets");
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_account_passes),
        cmocka_unit_test(an_echo_may_feed_several_targets),
        cmocka_unit_test(planted_faults_in_the_account_are_caught),
        cmocka_unit_test(losses_are_grouped_by_sensor_stage_and_reason),
        cmocka_unit_test(a_frame_without_account_forgets_its_losses),
        cmocka_unit_test(every_order_of_a_frame_becomes_the_canonical_one),
        cmocka_unit_test(targets_keep_their_sensors_order),
        cmocka_unit_test(objects_are_found_by_id_in_order),
        cmocka_unit_test(ties_are_decided_by_a_total_order),
        cmocka_unit_test(frames_that_contradict_themselves_are_refused),
        cmocka_unit_test(spans_are_the_sensors_own),
        cmocka_unit_test(dropped_sections_are_as_if_they_had_never_been),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
