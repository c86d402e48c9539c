#include "check.h"

#include "base/arena.h"
#include "documents/suite_file.h"
#include "documents/usual_figures.h"
#include "text/document.h"

TEST(shipped_radars_have_usual_figures)
{
    struct diag diag = {0};
    struct document_names shipped = {0};
    assert_int_equal(document_list("sensors", ".json", &shipped, check_arena(), &diag), 0);
    assert_true(shipped.names.count > 10);
    for (size_t i = 0; i < shipped.names.count; i++) {
        const struct suite *suite = suite_file_load(shipped.names.items[i], check_arena(), &diag);
        assert_non_null(suite);
        for (size_t k = 0; k < suite->sensors.count; k++) {
            struct usual_figure unusual[USUAL_FIGURES_MOST];
            assert_int_equal(usual_figures_list(&suite->sensors.items[k], unusual), 0);
        }
    }
}

TEST(figures_in_other_units_are_not_usual)
{
    struct sensor sensor = {
        .range_max_m = 0.25,     /* in kilometres */
        .cycle_s = 40,           /* in milliseconds */
        .latency_s = 50,         /* in milliseconds */
        .cell_range_m = 30,      /* in centimetres */
        .azimuth_sigma_rad = 1,  /* in degrees */
        .chirp_slope_hzps = -50, /* in MHz a microsecond */
    };
    static const char *const expected[] = {"range_max_m",      "cycle_s",      "latency_s",
                                           "chirp_slope_hzps", "cell_range_m", "azimuth_sigma_rad"};
    struct usual_figure unusual[USUAL_FIGURES_MOST];
    assert_int_equal(usual_figures_list(&sensor, unusual), 6);
    for (size_t i = 0; i < 6; i++)
        assert_string_equal(unusual[i].member, expected[i]);
    assert_true(unusual[1].value == 40 && unusual[1].most < 40);
}
