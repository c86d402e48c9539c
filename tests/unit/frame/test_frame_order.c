#include "frame/frame_order.h"

#include "accounted_frame.h"
#include "check.h"
#include "frame/frame_check.h"
#include "frame/frame_text.h"
#include "sample.h"

static struct text written(const struct frame *frame)
{
    struct text text = {0};
    assert_done(frame_text_write, frame, &text);
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

TEST(every_order_of_a_frame_becomes_the_canonical_one)
{
    static const char *const names[] = {"a", "b", "ba", "B", "\xc3\xa9"};
    struct arena *arena = check_arena();
    struct frame frame = accounted_frame(arena);
    for (size_t i = 0; i < 25; i++) {
        *list_add(&frame.echoes, arena) = (struct echo){.sensor = i % 2 ? "left" : "right",
                                                        .id.object = names[i / 5],
                                                        .id.reflector = names[i % 5]};
        struct contributor members[] = {accounted_echo(names[i / 5], names[i % 5]),
                                        accounted_echo("z", "1"), accounted_echo("z", "2"),
                                        accounted_echo("y", "3")};
        *list_add(&frame.cells, arena) =
            accounted_cell(arena, i % 3 ? "left" : "right", 4, members);
        frame_lose(&frame, i % 2 ? "noise" : "ideal", i < 16 ? "left" : "right", (enum loss)(i % 4),
                   &(struct lost_echo){.id.object = names[i / 5], .id.reflector = names[i % 5]});
    }
    for (enum path path = PATH_WALL_OBJECT; path <= PATH_FALSE_ALARM; path++)
        frame_count_echoes(&frame, "left", path, 1);
    for (size_t i = 0; i < 5; i++) {
        struct reflector_set *set = list_add(&frame.reflectors, arena);
        *set = (struct reflector_set){.model = names[i]};
        for (size_t j = 0; j < 5; j++)
            *list_add(&set->objects, arena) = names[j];
    }
    frame.present |= PART_ECHOES | PART_CELLS | PART_REFLECTORS;
    frame_order(&frame);
    assert_done(frame_check, &frame, ~0U);
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
        for (size_t i = 0; i < frame.reflectors.count; i++)
            SHUFFLE(frame.reflectors.items[i].objects, &random)
        for (size_t i = 0; i < frame.lost.count; i++)
            SHUFFLE(frame.lost.items[i].echoes, &random)
        for (size_t i = 0; i < frame.counts.count; i++)
            SHUFFLE(frame.counts.items[i].paths, &random)
        frame_order(&frame);
        struct text text = written(&frame);
        assert_int_equal(text.length, canonical.length);
        assert_memory_equal(text.bytes, canonical.bytes, text.length);
        text_free(&text);
    }
    text_free(&canonical);
}

TEST(targets_keep_their_sensors_order)
{
    static const char *const sensors[] = {"c", "a", "b"};
    struct frame frame = {.arena = check_arena()};
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

TEST(objects_are_found_by_id_in_order)
{
    struct frame frame = {.arena = check_arena()};
    assert_string_equal(order_of(&frame, 3, (const char *[]){"c", "a", "b"}), "abc");
    assert_string_equal(order_of(&frame, 3, (const char *[]){"a", "b", "c"}), "abc");
    assert_string_equal(order_of(&frame, 2, (const char *[]){"d", "a"}), "ad");
    assert_string_equal(order_of(&frame, 0, NULL), "");
    assert_string_equal(order_of(&frame, 4, (const char *[]){"b", "d", "a", "b"}), "abbd");
    *list_add(&frame.objects, check_arena()) = (struct object){.id = "c"};
    assert_string_equal(frame_order_objects(&frame)[3]->id, "c");
    frame.objects.items[4].id = "e";
    frame_order_parts(&frame, (struct frame_parts){.parts = PART_OBJECTS});
    assert_string_equal(frame_order_objects(&frame)[4]->id, "e");
}

/* A strict total order: antisymmetric and transitive, equal only to itself. */
TEST(ties_are_decided_by_a_total_order)
{
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

static int sign(int order)
{
    return (order > 0) - (order < 0);
}

TEST(names_are_ordered_by_their_bytes)
{
    static const char *const ascending[] = {NULL, "", "B", "a", "ab", "b", "ba", "\xc3\xa9"};
    for (int i = 0; i < (int)COUNT(ascending); i++)
        for (int j = 0; j < (int)COUNT(ascending); j++)
            assert_int_equal(sign(frame_order_names(&ascending[i], &ascending[j])),
                             (i > j) - (i < j));
}

/* Numbers whose binary digits are the members, the first the heaviest: object, reflector, path,
 * mirror, number. */
TEST(echo_ids_are_ordered_by_their_members_one_after_the_other)
{
    struct echo_id all[32];
    for (unsigned i = 0; i < 32; i++)
        all[i] = (struct echo_id){.object = i >> 4 & 1 ? "b" : "a",
                                  .reflector = i >> 3 & 1 ? "q" : "p",
                                  .path = i >> 2 & 1 ? PATH_WHEEL : PATH_DIRECT,
                                  .mirror = i >> 1 & 1 ? "w" : NULL,
                                  .number = i & 1};
    for (int i = 0; i < 32; i++)
        for (int j = 0; j < 32; j++)
            assert_int_equal(sign(frame_order_echo_ids(&all[i], &all[j])), (i > j) - (i < j));
}

TEST(a_cells_leader_stays_first_whatever_its_name)
{
    struct arena *arena = check_arena();
    struct frame frame = {.arena = arena};
    *list_add(&frame.cells, arena) =
        accounted_cell(arena, "s", 4,
                       (struct contributor[]){accounted_echo("z", "1"), accounted_echo("c", "1"),
                                              accounted_echo("a", "1"), accounted_echo("b", "1")});
    frame_order(&frame);
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(frame.cells.items[0].members.items[i].id.object[0], "zabc"[i]);
}

static void lose_two(struct frame *frame, const char *stage)
{
    for (int i = 0; i < 2; i++)
        frame_lose(frame, stage, "s", LOSS_BLOCKED,
                   &(struct lost_echo){.id.object = i == 0 ? "b" : "a", .id.reflector = "p"});
}

/* Only what a stage may have written is sorted after it. */
TEST(other_parts_and_other_stages_losses_stay_as_they_are)
{
    struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
    lose_two(&frame, "ideal");
    lose_two(&frame, "noise");
    for (int i = 0; i < 2; i++)
        *list_add(&frame.echoes, check_arena()) =
            (struct echo){.sensor = "s", .id.object = i == 0 ? "b" : "a", .id.reflector = "p"};
    frame_order_parts(&frame, (struct frame_parts){.parts = PART_LOST, .stage = "noise"});
    assert_string_equal(frame.echoes.items[0].id.object, "b");
    assert_string_equal(frame.lost.items[0].stage, "ideal");
    assert_string_equal(frame.lost.items[0].echoes.items[0].id.object, "b");
    assert_string_equal(frame.lost.items[1].echoes.items[0].id.object, "a");
    frame_order_parts(&frame, (struct frame_parts){.parts = PART_LOST | PART_ECHOES});
    assert_string_equal(frame.echoes.items[0].id.object, "a");
    assert_string_equal(frame.lost.items[0].echoes.items[0].id.object, "a");
}
