#include "check.h"

#include "frame/frame.h"

static const struct echo_id SUBJECT = {"car", "front_left", PATH_WALL_OBJECT, "wall", 2};
static const struct frame FRAME = {.seed = 7, .scene = "scene/ego", .frame = 3};

static bool equal(struct random_address a, struct random_address b)
{
    return a.seed == b.seed && a.scene == b.scene && a.frame == b.frame && a.sensor == b.sensor &&
           a.item == b.item;
}

/* Every part of an address on its own, two parts that run into each other, and bytes that a number
 * carries over. */
TEST(addresses_differ_by_each_of_their_parts)
{
    enum { CASES = 16 };
    struct frame frames[CASES];
    struct echo_id ids[CASES];
    struct random_address addresses[CASES];
    for (int i = 0; i < CASES; i++) {
        frames[i] = FRAME;
        ids[i] = SUBJECT;
    }
    frames[1].seed = 8;
    frames[2].scene = "scene/ego2";
    frames[3].frame = 4;
    ids[5].object = "van";
    ids[6].reflector = "front_right";
    ids[7].path = PATH_OBJECT_WALL;
    ids[8].mirror = "wall2";
    ids[9].mirror = NULL;
    ids[10].number = 0;
    ids[11].number = 3;
    ids[12].number = 0x200;
    ids[13].object = "carf";
    ids[13].reflector = "ront_left";
    ids[14].number = 0x302;
    ids[15].path = PATH_DIRECT;
    for (int i = 0; i < CASES; i++)
        addresses[i] = frame_draw_address_of(&frames[i], i == 4 ? "rear" : "front", ids[i]);
    for (int i = 0; i < CASES; i++)
        for (int j = 0; j < CASES; j++)
            if (equal(addresses[i], addresses[j]) != (i == j))
                fail_msg("cases %d and %d", i, j);
    assert_true(equal(addresses[0], frame_draw_address_of(&FRAME, "front", SUBJECT)));
}

/* Promises of bytes: FNV-1a and its final mix, worked out apart from this code. Whoever changes one
 * changes every data set made. */
TEST(addresses_are_these_on_every_machine)
{
    static const struct {
        const char *sensor;
        struct echo_id id;
        uint64_t sensor_hash, echo_id_hash;
    } cases[] = {
        {"front",
         {"car", "front_left", PATH_DIRECT, NULL, 0},
         UINT64_C(0x5705280031febd57),
         UINT64_C(0xf39013ff295b0f5e)},
        {"front",
         {"car", "front_left", PATH_WALL_OBJECT, "wall", 2},
         UINT64_C(0x5705280031febd57),
         UINT64_C(0xbc2027669f5bc1cf)},
        {"rear-left",
         {"noise", "cell", PATH_FALSE_ALARM, NULL, 300},
         UINT64_C(0xed1dcd1308a3d5c0),
         UINT64_C(0x2ad856944850622b)},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct random_address address = frame_draw_address_of(&FRAME, cases[i].sensor, cases[i].id);
        assert_true(address.seed == 7 && address.frame == 3);
        assert_true(address.scene == UINT64_C(0x64f84b6fffa5f816));
        assert_true(address.sensor == cases[i].sensor_hash);
        assert_true(address.item == cases[i].echo_id_hash);
    }
}
