#include "frame/frame_check.h"

#include "accounted_frame.h"
#include "check.h"
#include "frame/frame_order.h"

/* Checks the account; the message is empty where it passes. */
static void assert_account(const struct frame *frame, const char *message)
{
    struct diag diag = {0};
    int status = frame_check_account(frame, &diag);
    assert_string_equal(diag.text, message);
    assert_int_equal(status, message[0] == '\0' ? 0 : -1);
    assert_int_equal(diag.code, message[0] == '\0' ? 0 : DIAG_DATA);
}

TEST(a_whole_account_passes_in_any_order)
{
    struct frame frame = accounted_frame(check_arena());
    assert_account(&frame, "");
    frame_order(&frame);
    assert_account(&frame, "");
}

TEST(an_echo_may_feed_several_targets)
{
    struct frame frame = accounted_frame(check_arena());
    struct cell cell = accounted_cell(check_arena(), "left", 1,
                                      (struct contributor[]){accounted_echo("b", "corner")});
    frame_add_target(&frame, &cell, 2);
    frame_add_target(&frame, &cell, 1);
    assert_account(&frame, "");
}

/* A frame on its way to targets: its cells, or its echoes, are what is not lost. */
TEST(before_there_are_targets_cells_or_echoes_stand_for_them)
{
    for (int early = 0; early < 2; early++) {
        struct arena *arena = check_arena();
        struct frame frame = accounted_frame(arena);
        for (size_t i = 0; i < 2; i++) {
            const struct target *target = &frame.targets.items[i];
            struct cell cell = accounted_cell(arena, target->sensor, 2, target->contributors.items);
            *list_add(&frame.cells, arena) = cell;
            for (size_t j = 0; j < 2; j++)
                *list_add(&frame.echoes, arena) =
                    (struct echo){.sensor = cell.sensor, .id = cell.members.items[j].id};
        }
        frame_drop(&frame, PART_TARGETS);
        frame.present |= early ? PART_ECHOES : PART_CELLS | PART_ECHOES;
        assert_account(&frame, "");
        if (early)
            frame.echoes.count--;
        else
            frame.cells.items[1].members.count--;
        assert_account(&frame, "account: sensor \"left\" has 2 entries of path direct; 3 are due");
    }
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
    frame->targets.items[1].contributors.items[1] = accounted_echo("b", "corner");
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

static void double_one_of_each_sensor(struct frame *frame)
{
    for (int i = 0; i < 2; i++)
        frame_lose(frame, "noise", i == 0 ? "left" : "right", LOSS_BELOW_FINAL,
                   &(struct lost_echo){.id.object = "a", .id.reflector = "rear"});
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

TEST(planted_faults_in_the_account_are_caught)
{
    static const struct {
        void (*plant)(struct frame *frame);
        const char *message;
    } cases[] = {
        {forget_one, "account: sensor \"right\" has 2 entries of path direct; 3 are due"},
        {forget_a_loss, "account: sensor \"left\" has 2 entries of path direct; 3 are due"},
        {double_one_in_a_target,
         "account: sensor \"left\", object \"b\", reflector \"corner\" has two entries"},
        {double_one_between_target_and_lost,
         "account: sensor \"left\", object \"a\", reflector \"rear\" has two entries"},
        {double_three,
         "account: sensor \"left\", object \"a\", reflector \"corner\" has two entries"},
        {double_one_of_each_sensor,
         "account: sensor \"left\", object \"a\", reflector \"rear\" has two entries"},
        {add_a_foreign_one, "account: sensor \"right\" has 4 entries of path direct; 3 are due"},
        {add_one_of_a_foreign_sensor, "account: 1 entries of sensors without a count"},
        {count_one_more, "account: sensor \"left\" has 3 entries of path direct; 4 are due"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame = accounted_frame(check_arena());
        cases[i].plant(&frame);
        assert_account(&frame, cases[i].message);
    }
}

/* Direct echoes are those of the pairs; a wheel's and a ghost's come on top. */
TEST(echoes_of_other_paths_are_due_beyond_the_pairs)
{
    struct frame frame = accounted_frame(check_arena());
    frame_count_echoes(&frame, "left", PATH_WHEEL, 2);
    frame_count_echoes(&frame, "left", PATH_WALL_OBJECT, 1);
    assert_account(&frame, "account: sensor \"left\" has 0 entries of path wall_object; 1 are due");
    struct lost_echo lost[] = {
        {.id = {.object = "a", .reflector = "rear", .path = PATH_WHEEL, .number = 1}},
        {.id = {.object = "a", .reflector = "rear", .path = PATH_WHEEL, .number = 2}},
        {.id = {.object = "a", .reflector = "rear", .path = PATH_WALL_OBJECT, .mirror = "b"}},
    };
    for (size_t i = 0; i < 3; i++)
        frame_lose(&frame, "sensor", "left", LOSS_BELOW_THRESHOLD, &lost[i]);
    assert_account(&frame, "");
    frame_count_echoes(&frame, "left", PATH_WHEEL, -1);
    frame_count_echoes(&frame, "left", PATH_LIMB, 1);
    assert_account(&frame, "account: sensor \"left\" has 2 entries of path wheel; 1 are due");
}

/* Each pair of echoes differs in one member of the identity alone. */
TEST(echoes_that_differ_in_one_member_are_two_entries)
{
    static const struct echo_id one = {"a", "p", PATH_WALL_OBJECT, "w", 1};
    static const struct echo_id others[] = {{"b", "p", PATH_WALL_OBJECT, "w", 1},
                                            {"a", "q", PATH_WALL_OBJECT, "w", 1},
                                            {"a", "p", PATH_OBJECT_WALL, "w", 1},
                                            {"a", "p", PATH_WALL_OBJECT, "v", 1},
                                            {"a", "p", PATH_WALL_OBJECT, "w", 2}};
    for (size_t i = 0; i <= COUNT(others); i++) {
        struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
        struct diag diag = {0};
        bool same_path = i == COUNT(others) || others[i].path == one.path;
        frame_count_echoes(&frame, "s", one.path, 1 + same_path);
        frame_count_echoes(&frame, "s", PATH_OBJECT_WALL, !same_path);
        frame_lose(&frame, "sensor", "s", LOSS_NO_ANGLE, &(struct lost_echo){.id = one});
        frame_lose(&frame, "noise", "s", LOSS_NO_ANGLE,
                   &(struct lost_echo){.id = i < COUNT(others) ? others[i] : one});
        assert_int_equal(frame_check_account(&frame, &diag), i < COUNT(others) ? 0 : -1);
    }
}

TEST(the_same_echo_of_two_sensors_is_one_entry_of_each)
{
    struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
    static const char *const sensors[] = {"s", "t"};
    for (int i = 0; i < 2; i++) {
        frame_count_pairs(&frame, sensors[i], 1);
        frame_lose(&frame, "ideal", sensors[i], LOSS_BLOCKED,
                   &(struct lost_echo){.id = {.object = "a", .reflector = "p"}});
    }
    assert_account(&frame, "");
}

/* Whatever their hashes are: 20000 echoes, and the last of them once more. */
TEST(one_that_is_doubled_is_found_among_many)
{
    enum { MANY = 20000 };
    struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
    frame_count_pairs(&frame, "s", MANY);
    struct lost_echo lost = {.id = {.object = "a", .reflector = "p"}};
    for (lost.id.number = 1; lost.id.number <= MANY; lost.id.number++)
        frame_lose(&frame, "ideal", "s", LOSS_BLOCKED, &lost);
    assert_account(&frame, "");
    lost.id.number = MANY;
    frame_lose(&frame, "noise", "s", LOSS_NO_ANGLE, &lost);
    assert_account(&frame, "account: sensor \"s\", object \"a\", reflector \"p\" has two entries");
}
