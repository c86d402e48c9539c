#include "check.h"

#include "frame/conditions.h"
#include "text/record_write.h"

TEST(what_is_said_replaces_and_what_is_not_stays)
{
    struct interferer one[] = {{.object = "a"}};
    struct conditions before = {
        .road = ROAD_ASPHALT, .rain_mmph = 5, .fog_gpm3 = 0.1, .interferers = {one, 1, 0}};
    static const struct {
        enum road change;
        double rain_change, fog_change;
        enum road road;
        double rain_mmph, fog_gpm3;
    } cases[] = {
        {ROAD_UNSAID, -1, -1, ROAD_ASPHALT, 5, 0.1},
        {ROAD_CONCRETE, -1, -1, ROAD_CONCRETE, 5, 0.1},
        {ROAD_UNKNOWN, -1, -1, ROAD_UNKNOWN, 5, 0.1},
        {ROAD_UNSAID, 7, -1, ROAD_ASPHALT, 7, 0.1},
        {ROAD_UNSAID, 0, 0, ROAD_ASPHALT, 0, 0},
        {ROAD_CONCRETE, 1, 0.2, ROAD_CONCRETE, 1, 0.2},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct conditions changed = before, changes;
        field_clear(&conditions_changes_record, &changes);
        changes.road = cases[i].change;
        changes.rain_mmph = cases[i].rain_change;
        changes.fog_gpm3 = cases[i].fog_change;
        conditions_change(&changed, &changes);
        assert_int_equal(changed.road, cases[i].road);
        assert_close(changed.rain_mmph, cases[i].rain_mmph, 0);
        assert_close(changed.fog_gpm3, cases[i].fog_gpm3, 0);
        assert_close(changed.clutter_ercs, 0, 0);
        assert_ptr_equal(changed.interferers.items, one);
    }
}

/* Every member that may change alone, to the most that it may be and to nothing. */
TEST(a_change_of_one_member_leaves_all_others)
{
    const struct field *field = conditions_changes_record.fields;
    for (; field->name != NULL; field++)
        for (int most = 0; most <= 1; most++) {
            struct conditions before, changed, changes;
            memset(&before, 0, sizeof before);
            before.rain_mmph = before.fog_gpm3 = before.clutter_ercs = 0.25;
            before.road = ROAD_ASPHALT;
            field_clear(&conditions_changes_record, &changes);
            if (field->kind == FIELD_CHOICE)
                assert_done(field_set_text, field, &changes, most ? "concrete" : "unknown",
                            most ? 8 : 7, NULL);
            else
                assert_done(field_set_number, field, &changes, most ? field->high : field->low);
            changed = before;
            conditions_change(&changed, &changes);
            size_t size = field->kind == FIELD_CHOICE ? sizeof(enum road) : sizeof(double);
            assert_memory_equal((char *)&changed + field->offset, (char *)&changes + field->offset,
                                size);
            memcpy((char *)&changed + field->offset, (char *)&before + field->offset, size);
            assert_memory_equal(&changed, &before, sizeof before);
        }
}

TEST(impossible_conditions_are_refused)
{
    static const struct conditions bad[] = {
        {.rain_mmph = -1}, {.rain_mmph = 501}, {.fog_gpm3 = -0.1}, {.fog_gpm3 = 11}};
    static const struct interferer worse[] = {{.object = "a", .eirp_dbm = 101},
                                              {.object = "a", .slope_hzps = 2e15},
                                              {.object = "a", .hit_share = 1.1},
                                              {.object = "a", .hit_share = -0.1}};
    struct diag diag = {0};
    struct interferer good = {.object = "a", .eirp_dbm = 33, .hit_share = 1};
    struct conditions conditions = {
        .road = ROAD_CONCRETE, .rain_mmph = 500, .fog_gpm3 = 10, .interferers = {&good, 1, 0}};
    assert_int_equal(record_write_check(&conditions_record, &conditions, ~0U, &diag), 0);
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(record_write_check(&conditions_record, &bad[i], ~0U, &diag), -1);
        good = worse[i];
        assert_int_equal(record_write_check(&conditions_record, &conditions, ~0U, &diag), -1);
    }
}
