#include "frame/sections.h"

#include "check.h"
#include "frame/frame.h"

/* The choice of a frame after a text of --sections. */
static uint64_t after(const char *text, uint64_t before, int64_t number)
{
    struct frame frame = {.frame = number, .sections = before};
    struct sections_change change;
    struct diag diag = {0};
    if (sections_read(text, &change, &diag) != 0 || sections_apply(&change, &frame, &diag) != 0)
        fail_msg("%s: %s", text, diag.text);
    return frame.sections;
}

TEST(words_change_what_the_frame_says)
{
    static const struct {
        const char *text;
        uint64_t before, after;
    } cases[] = {
        {"account", CARRY_OBJECTS, CARRY_OBJECTS | CARRY_ACCOUNT},
        {"account,cells", CARRY_MARGINS, CARRY_MARGINS | CARRY_ACCOUNT | CARRY_CELLS},
        {"-objects", CARRY_OBJECTS | CARRY_ECHOES, CARRY_ECHOES},
        {"-margins,quality", CARRY_OBJECTS, CARRY_OBJECTS | CARRY_QUALITY},
        {"none", CARRY_OBJECTS | CARRY_ACCOUNT, 0},
        {"none,margins", CARRY_OBJECTS | CARRY_ACCOUNT, CARRY_MARGINS},
        {"all,-cells,-account,-quality", 0,
         CARRY_OBJECTS | CARRY_REFLECTORS | CARRY_ECHOES | CARRY_MARGINS | CARRY_VISIBILITY},
        {"account,-account", CARRY_ACCOUNT, 0},
        {"-account,account", 0, CARRY_ACCOUNT},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_int_equal(after(cases[i].text, cases[i].before, 7), cases[i].after);
}

TEST(an_account_of_every_tenth_frame_is_in_frames_0_10_and_20)
{
    for (int64_t number = 0; number < 30; number++) {
        uint64_t due = number % 10 == 0 ? CARRY_ACCOUNT : 0;
        assert_int_equal(after("account:every=10", 0, number), due);
        assert_int_equal(after("account:every=10", CARRY_ACCOUNT, number), due);
        assert_int_equal(after("account:every=1", 0, number), CARRY_ACCOUNT);
    }
}

TEST(what_is_no_section_is_refused)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"acount", "\"acount\" is no section (did you mean account?); glint-ideal --help"},
        {"-echos", "\"-echos\" is no section (did you mean -echoes?)"},
        {"", "\"\" is no section; glint-ideal"},
        {"account,", "\"\" is no section; glint-ideal"},
        {"account,all", "\"all\" is no section; glint-ideal"},
        {"targets", "\"targets\" is no section; glint-ideal"},
        {"-account:every=2", "\"-account:every=2\" is no section"},
        {"account:every=0", "account:every=0; expected a whole number in [1, 1e9]"},
        {"account:every=2.5", "account:every=2.5; expected a whole number in [1, 1e9]"},
        {"account:every=x", "account:every=x; expected a whole number in [1, 1e9]"},
        {"account:every=", "account:every=; expected a whole number in [1, 1e9]"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct sections_change change;
        struct diag diag = {0};
        assert_int_equal(sections_read(cases[i].text, &change, &diag), -1);
        assert_int_equal(diag.code, DIAG_USAGE);
        if (strncmp(diag.text, cases[i].message, strlen(cases[i].message)) != 0)
            fail_msg("%s: %s", cases[i].text, diag.text);
    }
}

TEST(a_word_is_taken_until_its_stage_has_run)
{
    static const struct {
        const char *word;
        unsigned before, after; /* parts of a frame that still takes it, and that does not */
    } cases[] = {
        {"objects", PART_CELLS | PART_SENSORS, PART_TARGETS},
        {"reflectors", PART_REFLECTORS | PART_SENSORS, PART_SENSORS},
        {"echoes", PART_SENSORS, PART_CELLS | PART_SENSORS},
        {"echoes", PART_ECHOES | PART_CELLS, PART_TARGETS},
        {"cells", PART_SENSORS | PART_CELLS, PART_TARGETS},
        {"account", PART_OBJECTS | PART_REFLECTORS, PART_SENSORS | PART_COUNTS},
        {"margins", PART_OBJECTS | PART_REFLECTORS, PART_SENSORS | PART_ECHOES},
        {"quality", PART_SENSORS | PART_CELLS, PART_TARGETS},
        {"visibility", PART_OBJECTS | PART_REFLECTORS, PART_SENSORS | PART_ECHOES},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame early = {.present = cases[i].before}, late = {.present = cases[i].after};
        struct sections_change change;
        struct diag diag = {0};
        assert_int_equal(sections_read(cases[i].word, &change, &diag), 0);
        assert_int_equal(sections_apply(&change, &early, &diag), 0);
        assert_int_equal(sections_apply(&change, &late, &diag), -1);
        assert_int_equal(diag.code, DIAG_CONFIG);
    }
}

TEST(parts_go_when_no_later_stage_reads_them)
{
    static const struct {
        uint64_t carried;
        unsigned present, left;
    } cases[] = {
        {CARRY_OBJECTS, PART_OBJECTS | PART_REFLECTORS, PART_OBJECTS | PART_REFLECTORS},
        {0, PART_OBJECTS | PART_SENSORS | PART_ECHOES, PART_OBJECTS | PART_SENSORS | PART_ECHOES},
        {0, PART_REFLECTORS | PART_SENSORS | PART_ECHOES, PART_SENSORS | PART_ECHOES},
        {CARRY_REFLECTORS, PART_REFLECTORS | PART_SENSORS, PART_REFLECTORS | PART_SENSORS},
        {CARRY_ECHOES, PART_ECHOES | PART_CELLS | PART_TARGETS, PART_ECHOES | PART_TARGETS},
        {CARRY_CELLS, PART_ECHOES | PART_CELLS | PART_TARGETS, PART_CELLS | PART_TARGETS},
        {0, PART_OBJECTS | PART_TARGETS | PART_COUNTS | PART_VEHICLES,
         PART_TARGETS | PART_COUNTS | PART_VEHICLES},
        {0, PART_SENSORS | PART_LOST, PART_SENSORS},
        {CARRY_ACCOUNT, PART_SENSORS | PART_LOST, PART_SENSORS | PART_LOST},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame = {.sections = cases[i].carried, .present = cases[i].present};
        sections_drop(&frame);
        assert_int_equal(frame.present, cases[i].left);
    }
}

TEST(margins_that_are_left_out_go_at_once)
{
    struct echo echo = {.margins.present = MARGIN_SIGHT};
    struct lost_echo lost = {.margins.present = MARGIN_SIGHT};
    struct lost_group group = {.echoes = {&lost, 1, 1}};
    struct frame frame = {.sections = CARRY_MARGINS | CARRY_ACCOUNT,
                          .present = PART_SENSORS | PART_ECHOES | PART_LOST,
                          .echoes = {&echo, 1, 1},
                          .lost = {&group, 1, 1}};
    struct sections_change change;
    assert_done(sections_read, "-margins", &change);
    assert_done(sections_apply, &change, &frame);
    assert_int_equal(echo.margins.present, 0);
    assert_int_equal(lost.margins.present, 0);
}

TEST(quality_that_is_left_out_goes_at_once)
{
    struct target target = {.quality = {.snr_db = 20, .present = QUALITY_NOISE}};
    struct frame frame = {.sections = CARRY_QUALITY};
    struct sections_change change;
    frame.targets.items = &target;
    frame.targets.count = 1;
    assert_done(sections_read, "-quality", &change);
    assert_done(sections_apply, &change, &frame);
    assert_int_equal(target.quality.present, 0);
}
