#include "check.h"

#include "base/units.h"
#include "documents/reflector_models.h"
#include "radar/radar_equation.h"
#include "text/record_write.h"

/* The incoherent sum of all points, seen from a direction in the target's frame, far away. */
static double cross_section_dbsm(enum sensing_target_3gpp target, double azimuth, double zenith)
{
    struct reflector_set set = {.model = "m"};
    const struct box box = {.heading = {1, 0}, .length_m = 5, .width_m = 2};
    const struct vec2 middle = {0, 0}, direction = {cos(azimuth * DEGREE), sin(azimuth * DEGREE)};
    double total_m2 = 0;
    reflector_models_of_3gpp(target, &set, check_arena());
    for (size_t i = 0; i < set.points.count; i++) {
        const struct point_reflector *point = &set.points.items[i];
        double factor =
            reflectors_visibility(&box, point, vec2_heading(point->facing_rad), middle, direction);
        factor *= reflectors_lobe(&box, point, middle, direction, zenith * DEGREE);
        total_m2 += radar_cross_section_m2(factor * point->ercs);
    }
    return 10 * log10(total_m2);
}

TEST(a_vehicle_has_the_published_cross_sections)
{
    static const double level[][2] = {{0, 11.684341},  {45, 7.067702},   {75, 16.626177},
                                      {90, 20.129911}, {165, 12.142018}, {180, 13.762731}};
    for (size_t i = 0; i < COUNT(level); i++) {
        double azimuth = level[i][0], expected = level[i][1];
        assert_close(cross_section_dbsm(SENSING_TARGET_3GPP_VEHICLE, azimuth, 90), expected,
                     5.1e-7);
        assert_close(cross_section_dbsm(SENSING_TARGET_3GPP_VEHICLE, -azimuth, 90), expected,
                     5.1e-7);
    }
}

TEST(only_a_human_moves_its_limbs)
{
    for (int target = SENSING_TARGET_3GPP_VEHICLE; target <= SENSING_TARGET_3GPP_HUMAN; target++) {
        struct reflector_set set = {.model = "m"};
        bool human = target == SENSING_TARGET_3GPP_HUMAN;
        reflector_models_of_3gpp((enum sensing_target_3gpp)target, &set, check_arena());
        assert_int_equal(set.points.count, human ? 1 : 5);
        for (size_t i = 0; i < set.points.count; i++)
            assert_int_equal(set.points.items[i].moving_part, human ? MOVING_LIMBS : MOVING_NONE);
    }
}

/* Seen from straight above, the roof dominates; the other faces are at their floors. */
TEST(from_above_the_roof_dominates)
{
    double floors_m2 = 2 * pow(10, 0.008) + 2 * pow(10, 0.008);
    assert_close(cross_section_dbsm(SENSING_TARGET_3GPP_VEHICLE, 33, 0),
                 10 * log10(pow(10, 2.112) + floors_m2), 1e-12);
}

TEST(a_human_is_the_same_from_everywhere)
{
    for (double azimuth = -180; azimuth <= 180; azimuth += 30)
        assert_close(cross_section_dbsm(SENSING_TARGET_3GPP_HUMAN, azimuth, 80), -1.37, 1e-12);
}

TEST(the_points_replace_the_reflectors_of_the_document)
{
    struct point_reflector corner = {.name = "corner"};
    struct plane_reflector side = {.name = "side"};
    struct mirror_plane mirror = {.reflection = 0.5};
    struct reflector_set set = {.model = "m", .blocks = true};
    set.points.items = &corner;
    set.planes.items = &side;
    set.mirrors.items = &mirror;
    set.points.count = set.planes.count = set.mirrors.count = 1;
    reflector_models_of_3gpp(SENSING_TARGET_3GPP_VEHICLE, &set, check_arena());
    assert_int_equal(set.points.count, 5);
    assert_int_equal(set.planes.count, 0);
    assert_int_equal(set.mirrors.count, 1);
    assert_true(set.blocks);
    assert_string_equal(corner.name, "corner");
    assert_null(reflectors_name_twice(&set, check_arena()));
    assert_done(record_write_check, &reflector_set_record, &set, ~0U);
}
