#include "check.h"

#include "frame/effects.h"

#define EVERY (EFFECT_BIT(EFFECT_COUNT) - 1)

TEST(a_request_names_what_may_be_simulated)
{
    static const struct {
        const char *text;
        uint64_t allowed;
        bool automatic;
    } cases[] = {
        {"auto", EVERY, true},
        {"all", EVERY, false},
        {"none", 0, false},
        {"occlusion", EFFECT_BIT(EFFECT_OCCLUSION), false},
        {"occlusion,merging", EFFECT_BIT(EFFECT_OCCLUSION) | EFFECT_BIT(EFFECT_MERGING), false},
        {"all,-merging", EVERY & ~EFFECT_BIT(EFFECT_MERGING), false},
        {"auto,-merging,-rows", EVERY & ~(EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_ROWS)),
         true},
        {"-merging", EVERY & ~EFFECT_BIT(EFFECT_MERGING), true},
        {"none,merging", EFFECT_BIT(EFFECT_MERGING), false},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct selection selection;
        assert_done(effects_read, cases[i].text, &selection);
        assert_int_equal(selection.allowed, cases[i].allowed);
        assert_int_equal(selection.automatic, cases[i].automatic);
    }
}

TEST(an_unknown_effect_is_refused_by_name)
{
    static const char *const texts[] = {"",          "fog horn", "auto,all",   "all,",
                                        "merging,-", "-none",    "all,-mergin"};
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct selection selection;
        struct diag diag = {0};
        assert_int_equal(effects_read(texts[i], &selection, &diag), -1);
        assert_int_equal(diag.code, DIAG_CONFIG);
        assert_non_null(strstr(diag.text, "is no effect"));
    }
}

TEST(a_scan_in_which_one_object_needs_an_effect_counts_as_simulated)
{
    struct effect_log log = {0};
    const struct selection selection = {.allowed = EVERY, .automatic = true, .log = &log};
    effects_note(&selection, EFFECT_OCCLUSION, false);
    effects_note(&selection, EFFECT_OCCLUSION, true);
    effects_note(&selection, EFFECT_MERGING, false);
    effects_count_scan(&selection);
    effects_note(&selection, EFFECT_OCCLUSION, false);
    effects_count_scan(&selection);
    assert_int_equal(log.scans, 2);
    assert_int_equal(log.scans_simulated[EFFECT_OCCLUSION], 1);
    assert_int_equal(log.scans_left_out[EFFECT_OCCLUSION], 1);
    assert_int_equal(log.scans_left_out[EFFECT_MERGING], 1);
    assert_int_equal(log.scans_simulated[EFFECT_MERGING], 0);
}
