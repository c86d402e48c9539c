#include "check.h"

#include "base/units.h"
#include "geometry/directivity.h"

static const struct lobe front = {40.54 * DEGREE, 71.75 * DEGREE, 29.13 * DEGREE, 14.91};

static double drop_db(const struct lobe *lobe, double off, double zenith)
{
    return -units_amplitude_db(directivity_lobe_factor(lobe, off * DEGREE, zenith * DEGREE));
}

TEST(a_lobe_loses_nothing_in_its_middle)
{
    assert_true(directivity_lobe_factor(&front, 0, front.zenith_rad) == 1);
}

TEST(a_lobe_is_3_db_down_half_a_width_off_its_middle)
{
    assert_close(drop_db(&front, 20.27, 71.75), 3, 1e-12);
    assert_close(drop_db(&front, 0, 71.75 + 14.565), 3, 1e-12);
    assert_close(drop_db(&front, 0, 71.75 - 14.565), 3, 1e-12);
    assert_close(drop_db(&front, 20.27, 71.75 - 14.565), 6, 1e-12);
}

TEST(a_lobe_never_falls_below_its_depth)
{
    assert_close(drop_db(&front, 180, 71.75), 14.91, 1e-12);
    assert_close(drop_db(&front, 0, 180), 14.91, 1e-12);
    assert_close(drop_db(&front, 180, 0), 14.91, 1e-12);
    for (double off = 0; off < 180; off++)
        assert_true(drop_db(&front, off + 1, 80) >= drop_db(&front, off, 80));
}

TEST(a_lobe_without_a_width_is_the_same_all_around)
{
    const struct lobe around = {.zenith_rad = 1, .zenith_width_rad = 0.5, .depth_db = 20};
    const struct lobe upright = {.width_rad = 0.5, .depth_db = 20}, none = {.zenith_rad = 1};
    assert_true(directivity_lobe_factor(&around, 0, 1.2) ==
                directivity_lobe_factor(&around, PI, 1.2));
    assert_true(directivity_lobe_factor(&upright, 0.3, 0) ==
                directivity_lobe_factor(&upright, 0.3, PI));
    assert_true(directivity_lobe_factor(&none, PI, PI) == 1);
}
