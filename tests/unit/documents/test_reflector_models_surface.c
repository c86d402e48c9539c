#include "check.h"

#include "base/hash.h"
#include "base/units.h"
#include "documents/reflector_models.h"
#include "printed.h"
#include "propagation/reflection.h"
#include "radar/radar_equation.h"

#define FAR_M 1e7
#define DEGREE (PI / 180)

static const struct contour car = {15, 10.8, 13.6, 20.1, 7.1};
static const struct surface rough = {0.25, 50 * DEGREE, 60 * DEGREE, 90 * DEGREE, 3};
static const struct vec2 usual_m = {4.5, 1.8};
static const double usual_height_m = 1.5;

/* The scatterers of a body in a scene, on an object of this size. */
static struct reflector_set tall_body_of(const struct surface *surface, struct vec2 size_m,
                                         double height_m, const char *object, uint64_t scene)
{
    struct reflector_set set = {.model = "m"};
    const struct random_address body = {
        .seed = 1, .scene = scene, .item = hash_text(HASH_START, object)};
    reflector_models_of_surface(&car, surface, usual_m, size_m, height_m, &body, &set,
                                check_arena());
    return set;
}

static struct reflector_set body_of(const struct surface *surface, struct vec2 size_m,
                                    const char *object, uint64_t scene)
{
    return tall_body_of(surface, size_m, usual_height_m, object, scene);
}

static bool is_of(const struct point_reflector *point, const char *face)
{
    return strncmp(point->name, face, strlen(face)) == 0;
}

/* The normal of the point's face. */
static double normal_rad(const struct point_reflector *point)
{
    static const char *const faces[] = {"front", "left", "rear", "right"};
    size_t face = 0;
    while (!is_of(point, faces[face]))
        face++;
    return (double)face * PI / 2;
}

/* The cross section of the points of a face, seen from far away at an aspect; NULL: of all. */
static double cross_section_m2(const struct reflector_set *set, const char *face, double aspect_rad)
{
    const struct box box = {.heading = {1, 0}, .length_m = usual_m.x, .width_m = usual_m.y};
    const struct vec2 sensor = {FAR_M * cos(aspect_rad), FAR_M * sin(aspect_rad)};
    double total_m2 = 0;
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        if (face != NULL && !is_of(point, face))
            continue;
        double seen = reflectors_visibility(&box, point, vec2_heading(point->facing_rad),
                                            reflectors_point_place(&box, point), sensor);
        total_m2 += radar_cross_section_m2(seen * point->ercs);
    }
    return total_m2;
}

/* Steps around the body: so many that the mean of powers of raised cosines is exact to 1e-6. */
enum { STEPS = 7200 };

static double mean_over_aspects_m2(const struct reflector_set *set)
{
    double total_m2 = 0;
    for (int i = 0; i < STEPS; i++)
        total_m2 += cross_section_m2(set, NULL, 2 * PI * (i + 0.5) / STEPS);
    return total_m2 / STEPS;
}

/* The same of a contour without own facings, by its faces' visibilities: MODEL 2.7. */
static double contour_mean_m2(void)
{
    const double face_dbsm[] = {car.front_dbsm, car.side_dbsm, car.rear_dbsm, car.side_dbsm};
    double total_m2 = 0;
    for (size_t face = 0; face < COUNT(face_dbsm); face++) {
        struct contour_view view = reflector_models_contour_view(face_dbsm[face], car.oblique_dbsm);
        for (int i = 0; i < STEPS; i++) {
            double off_rad = fabs(PI - 2 * PI * (i + 0.5) / STEPS);
            double seen = directivity_visibility(VISIBILITY_RAISED_COSINE, view.full_rad,
                                                 view.zero_rad, off_rad);
            total_m2 += pow(10, face_dbsm[face] / 10) * seen * seen / STEPS;
        }
    }
    return total_m2;
}

TEST(every_body_has_the_contours_cross_section_on_average_over_aspects)
{
    struct surface level = rough;
    level.level_sigma_db = 0;
    for (uint64_t scene = 0; scene < 20; scene++) {
        struct reflector_set set = body_of(&level, usual_m, "a", scene);
        assert_close(10 * log10(mean_over_aspects_m2(&set) / contour_mean_m2()), 0, 1e-4);
    }
}

TEST(a_body_with_the_views_of_its_faces_keeps_that_mean_too)
{
    const struct surface own_views = {0.25, 50 * DEGREE, -1, -1, 0};
    struct reflector_set set = body_of(&own_views, usual_m, "a", 1);
    assert_close(10 * log10(mean_over_aspects_m2(&set) / contour_mean_m2()), 0, 1e-4);
}

/* The mean of V^2 over facings that are normal around a face, at an angle off it, by integration.
 */
static double mean_seen(const struct surface *surface, double off_rad)
{
    double total = 0, sigma_rad = surface->facing_sigma_rad, step = 1e-3;
    for (double z = -8; z < 8; z += step) {
        double delta_rad = fabs(remainder(off_rad - sigma_rad * z, 2 * PI));
        double seen = directivity_visibility(VISIBILITY_RAISED_COSINE, surface->full_rad,
                                             surface->zero_rad, delta_rad);
        total += seen * seen * exp(-0.5 * z * z) / sqrt(2 * PI) * step;
    }
    return total;
}

/* The mean over bodies of a car's cross section at an aspect, by the formulas of MODEL 2.7. */
static double mean_dbsm(double aspect_rad)
{
    const double face_dbsm[] = {car.front_dbsm, car.side_dbsm, car.rear_dbsm, car.side_dbsm};
    double total_m2 = 0, own = (rough.full_rad + 3.0 / 8 * (rough.zero_rad - rough.full_rad)) / PI;
    for (size_t face = 0; face < COUNT(face_dbsm); face++) {
        struct contour_view view = reflector_models_contour_view(face_dbsm[face], car.oblique_dbsm);
        double given = (view.full_rad + 3.0 / 8 * (view.zero_rad - view.full_rad)) / PI;
        total_m2 += pow(10, face_dbsm[face] / 10) * given / own *
                    mean_seen(&rough, aspect_rad - (double)face * PI / 2);
    }
    return 10 * log10(total_m2);
}

TEST(cross_sections_of_a_surface_are_printed)
{
    PRINTED("2.7", "a car has aspect, deg 0 45 90 180 σ, dBsm # # # #", mean_dbsm(0),
            mean_dbsm(PI / 4), mean_dbsm(PI / 2), mean_dbsm(PI));
}

/* Their own mean, over 2000 bodies. */
TEST(bodies_have_these_cross_sections_on_average)
{
    const double aspects_rad[] = {0, PI / 4, PI / 2, PI};
    for (size_t i = 0; i < COUNT(aspects_rad); i++) {
        double total_m2 = 0;
        for (uint64_t scene = 0; scene < 2000; scene++) {
            struct reflector_set set = body_of(&rough, usual_m, "a", scene);
            total_m2 += cross_section_m2(&set, NULL, aspects_rad[i]) / 2000;
        }
        assert_close(10 * log10(total_m2), mean_dbsm(aspects_rad[i]), 0.15);
    }
}

/* A mean over 36,000 scatterers is good to 0.1 dB where it is above a tenth of the most. */
TEST(a_face_fades_with_the_aspect_as_the_integral_over_facings_says)
{
    static double total_m2[4];
    const double off_rad[] = {0, PI / 4, PI / 2, 3 * PI / 4};
    const int bodies = 2000;
    for (int scene = 0; scene < bodies; scene++) {
        struct reflector_set set = body_of(&rough, usual_m, "a", (uint64_t)scene);
        for (size_t i = 0; i < COUNT(off_rad); i++)
            total_m2[i] += cross_section_m2(&set, "left", PI / 2 + off_rad[i]) / bodies;
    }
    for (size_t i = 1; i < COUNT(off_rad); i++) {
        double measured = total_m2[i] / total_m2[0];
        double expected = mean_seen(&rough, off_rad[i]) / mean_seen(&rough, 0);
        assert_close(10 * log10(measured / expected), 0, 0.3);
    }
}

TEST(facings_are_normal_around_the_normal_of_the_face)
{
    static const double limits[] = {-2, -1, -0.5, 0, 0.5, 1, 2};
    size_t below[COUNT(limits)] = {0}, count = 0;
    struct surface narrow = rough;
    narrow.facing_sigma_rad = 0.5; /* no facing is so far off that it turns around */
    for (uint64_t scene = 0; scene < 1000; scene++) {
        struct reflector_set set = body_of(&narrow, usual_m, "a", scene);
        for (size_t i = 0; i < set.points.count; i++, count++) {
            const struct point_reflector *point = &set.points.items[i];
            double off_rad = remainder(point->facing_rad - normal_rad(point), 2 * PI);
            assert_true(fabs(point->facing_rad) <= PI);
            for (size_t k = 0; k < COUNT(limits); k++)
                below[k] += off_rad < limits[k] * narrow.facing_sigma_rad;
        }
    }
    for (size_t k = 0; k < COUNT(limits); k++) {
        double expected = 0.5 * erfc(-limits[k] / sqrt(2));
        double sigma = sqrt(expected * (1 - expected) / (double)count);
        assert_close((double)below[k] / (double)count, expected, 5 * sigma);
    }
}

TEST(levels_are_normal_in_decibels_and_keep_the_mean_power)
{
    double powers = 0, sum_db = 0, squares = 0, count = 0;
    struct surface even = rough;
    even.level_sigma_db = 0;
    for (uint64_t scene = 0; scene < 2000; scene++) {
        struct reflector_set set = body_of(&rough, usual_m, "a", scene);
        struct reflector_set mean = body_of(&even, usual_m, "a", scene);
        for (size_t i = 0; i < set.points.count; i++, count++) {
            double ratio = set.points.items[i].ercs / mean.points.items[i].ercs;
            double level_db = 20 * log10(ratio);
            powers += ratio * ratio;
            sum_db += level_db;
            squares += level_db * level_db;
            assert_close(set.points.items[i].facing_rad, mean.points.items[i].facing_rad, 0);
        }
    }
    /* The power of a level of 3 dB has a standard deviation of 0.78 of its mean. */
    assert_close(powers / count, 1, 5 * 0.78 / sqrt(count));
    double mean_db = sum_db / count;
    assert_close(mean_db, -log(10) / 20 * 9, 5 * 3 / sqrt(count));
    assert_close(sqrt(squares / count - mean_db * mean_db), 3, 5 * 3 / sqrt(2 * count));
}

/* Middles of scatterers of 0.25 m that lie within the body are even over what is left of its
 * height: the mean is its half, the variance a twelfth of the square, the fourth central moment its
 * fourth power over 80. */
TEST(heights_are_even_over_the_body)
{
    static const double heights_m[] = {0.4, 1.5, 4};
    for (size_t k = 0; k < COUNT(heights_m); k++) {
        double height_m = heights_m[k], left_m = height_m - 0.25;
        double sum_m = 0, squares = 0, count = 0;
        for (uint64_t scene = 0; scene < 1000; scene++) {
            struct reflector_set set = tall_body_of(&rough, usual_m, height_m, "a", scene);
            for (size_t i = 0; i < set.points.count; i++, count++) {
                const struct point_reflector *point = &set.points.items[i];
                double off_m = (point->z - 0.5) * height_m;
                assert_close(point->extent * height_m, 0.25, 1e-12);
                assert_true(fabs(off_m) <= left_m / 2 + 1e-12);
                sum_m += off_m;
                squares += off_m * off_m;
            }
        }
        double variance = left_m * left_m / 12, fourth = pow(left_m, 4) / 80;
        assert_close(sum_m / count, 0, 5 * sqrt(variance / count));
        assert_close(squares / count, variance, 5 * sqrt((fourth - variance * variance) / count));
    }
}

/* The correlation of independent draws has the standard deviation 1/sqrt(count). */
TEST(a_height_says_nothing_of_facing_level_and_neighbour)
{
    double facing = 0, level = 0, neighbour = 0, count = 0;
    double sigma = (1 - 0.25 / usual_height_m) / sqrt(12);
    struct surface narrow = rough, even = rough;
    narrow.facing_sigma_rad = 0.5; /* no facing is so far off that it turns around */
    even.level_sigma_db = 0;
    for (uint64_t scene = 0; scene < 1000; scene++) {
        struct reflector_set set = body_of(&narrow, usual_m, "a", scene);
        struct reflector_set mean = body_of(&even, usual_m, "a", scene);
        for (size_t i = 1; i < set.points.count; i++, count++) {
            const struct point_reflector *point = &set.points.items[i];
            double up = (point->z - 0.5) / sigma;
            facing += up * remainder(point->facing_rad - normal_rad(point), 2 * PI) / 0.5;
            level +=
                up * (20 * log10(point->ercs / mean.points.items[i].ercs) + log(10) / 20 * 9) / 3;
            neighbour += up * (set.points.items[i - 1].z - 0.5) / sigma;
        }
    }
    assert_close(facing / count, 0, 5 / sqrt(count));
    assert_close(level / count, 0, 5 / sqrt(count));
    assert_close(neighbour / count, 0, 5 / sqrt(count));
}

TEST(a_scatterer_is_no_higher_than_its_body_nor_lower_than_documents_may_say)
{
    struct reflector_set flat = tall_body_of(&rough, usual_m, 0.1, "a", 1);
    struct reflector_set tower = tall_body_of(&rough, usual_m, 1000, "a", 1);
    for (size_t i = 0; i < flat.points.count; i++) {
        assert_close(flat.points.items[i].z, 0.5, 0);
        assert_close(flat.points.items[i].extent, 1, 0);
        assert_true(tower.points.items[i].z >= 0.001 && tower.points.items[i].z <= 1);
    }
}

/* F^4/<F^4> of MODEL 14.10 for a point at this height, with the four paths added up one by one. */
static double fading(double height_m, double distance_m)
{
    const double sensor_m = 0.5, wave_m = 299792458 / 76.5e9;
    double direct_m = hypot(distance_m, height_m - sensor_m);
    double bounced_m = hypot(distance_m, height_m + sensor_m);
    double part = 0.7 * direct_m / bounced_m, turn = 2 * PI * (bounced_m - direct_m) / wave_m;
    double real = 1 - 2 * part * cos(turn) + part * part * cos(2 * turn);
    double imaginary = 2 * part * sin(turn) - part * part * sin(2 * turn);
    return (real * real + imaginary * imaginary) / (1 + 4 * part * part + pow(part, 4));
}

/* Parts of scatterers are within the body, and the middles of these even: the mean over the drawn
 * ones is that over both. g is -0.7. A body has about 50 scatterers, powers of 0 to 2.7. */
TEST(the_mean_over_heights_of_a_bodys_fading_over_a_road_is_that_of_points_on_it)
{
    enum { MIDDLES = 2000, PARTS = 50 };
    static const double distances_m[] = {10, 40, 150};
    for (size_t k = 0; k < COUNT(distances_m); k++) {
        double expected = 0, sum = 0, squares = 0, count = 0;
        for (int i = 0; i < MIDDLES; i++)
            for (int j = 0; j < PARTS; j++)
                expected +=
                    fading(0.125 + 1.25 * (i + 0.5) / MIDDLES + 0.25 * ((j + 0.5) / PARTS - 0.5),
                           distances_m[k]) /
                    MIDDLES / PARTS;
        for (uint64_t scene = 0; scene < 1000; scene++) {
            struct reflector_set set = body_of(&rough, usual_m, "a", scene);
            for (size_t i = 0; i < set.points.count; i++, count++) {
                const struct point_reflector *point = &set.points.items[i];
                const struct two_ray_ends ends = {0.5, point->z * usual_height_m,
                                                  point->extent * usual_height_m, distances_m[k]};
                struct two_ray_paths paths = reflection_two_ray_paths(&ends);
                double factor = reflection_two_ray_factor(&paths, -0.7, 299792458 / 76.5e9);
                sum += factor * factor;
                squares += pow(factor, 4);
            }
        }
        double mean = sum / count, variance = squares / count - mean * mean;
        assert_close(mean, expected, 5 * sqrt(variance / count) + 1e-3);
    }
}

TEST(scatterers_are_no_farther_apart_than_the_spacing_on_a_body_of_any_size)
{
    static const struct vec2 sizes_m[] = {{4.5, 1.8}, {4.8, 2},  {0.2, 0.1},
                                          {17, 2.55}, {3.01, 1}, {1e-6, 1e-9}};
    for (size_t i = 0; i < COUNT(sizes_m); i++) {
        struct reflector_set set = body_of(&rough, sizes_m[i], "a", 1);
        size_t along = (size_t)ceil(sizes_m[i].x / 0.25 - 1e-9);
        size_t across = (size_t)ceil(sizes_m[i].y / 0.25 - 1e-9);
        assert_int_equal(set.points.count, 2 * (along + across));
        for (size_t k = 1; k < set.points.count; k++) {
            const struct point_reflector *a = &set.points.items[k - 1], *b = a + 1;
            double apart_m = hypot((a->x - b->x) * sizes_m[i].x, (a->y - b->y) * sizes_m[i].y);
            assert_true(apart_m <= 0.25 + 1e-9);
            assert_true(fabs(a->x) == 0.5 || fabs(a->y) == 0.5);
        }
    }
}

TEST(a_metre_of_a_side_has_the_same_power_on_a_longer_body)
{
    struct surface even = rough;
    even.level_sigma_db = even.facing_sigma_rad = 0;
    struct reflector_set set = body_of(&even, usual_m, "a", 1);
    struct reflector_set longer = body_of(&even, (struct vec2){3 * usual_m.x, usual_m.y}, "a", 1);
    double once_m2 = cross_section_m2(&set, "left", PI / 2);
    assert_close(cross_section_m2(&longer, "left", PI / 2), 3 * once_m2, 1e-6 * once_m2);
    double front_m2 = cross_section_m2(&set, "front", 0);
    assert_close(cross_section_m2(&longer, "front", 0), front_m2, 1e-6 * front_m2);
}

static bool same_body(const struct reflector_set *a, const struct reflector_set *b)
{
    for (size_t i = 0; i < a->points.count; i++)
        if (a->points.items[i].facing_rad != b->points.items[i].facing_rad ||
            a->points.items[i].z != b->points.items[i].z ||
            a->points.items[i].ercs != b->points.items[i].ercs)
            return false;
    return true;
}

TEST(a_body_is_drawn_once_for_its_scene_and_each_differently)
{
    struct reflector_set a = body_of(&rough, usual_m, "a", 1);
    struct reflector_set again = body_of(&rough, usual_m, "a", 1);
    struct reflector_set other = body_of(&rough, usual_m, "b", 1);
    struct reflector_set elsewhere = body_of(&rough, usual_m, "a", 2);
    assert_true(same_body(&a, &again));
    assert_false(same_body(&a, &other));
    assert_false(same_body(&a, &elsewhere));
}

TEST(a_wider_body_keeps_the_facings_and_heights_of_its_sides)
{
    struct reflector_set a = body_of(&rough, usual_m, "a", 1);
    struct reflector_set wide = body_of(&rough, (struct vec2){usual_m.x, 2.5}, "a", 1);
    for (size_t i = 0; i < a.points.count; i++)
        for (size_t k = 0; k < wide.points.count; k++)
            if (strcmp(a.points.items[i].name, wide.points.items[k].name) == 0) {
                assert_close(a.points.items[i].facing_rad, wide.points.items[k].facing_rad, 0);
                assert_close(a.points.items[i].z, wide.points.items[k].z, 0);
            }
    assert_true(wide.points.count > a.points.count);
}

TEST(what_is_stated_replaces_what_is_not)
{
    const struct surface over = {-1, 0, 0.5, -1, -1};
    struct surface result = reflector_models_surface(&rough, &over);
    assert_close(result.spacing_m, rough.spacing_m, 0);
    assert_close(result.facing_sigma_rad, 0, 0);
    assert_close(result.full_rad, 0.5, 0);
    assert_close(result.zero_rad, rough.zero_rad, 0);
    assert_close(result.level_sigma_db, rough.level_sigma_db, 0);
    assert_true(reflector_models_differs(&result));
    assert_false(reflector_models_differs(&reflector_models_usual_surface));
}

TEST(a_view_has_both_ends_in_order)
{
    const struct surface full_alone = {-1, -1, 0.5, -1, -1}, zero_alone = {-1, -1, -1, 0.5, -1};
    const struct surface turned = {-1, -1, 0.5, 0.4, -1}, hard = {-1, -1, 0.5, 0.5, -1};
    struct diag diag = {0};
    assert_int_equal(reflector_models_check_surface(&full_alone, &car, &diag), -1);
    assert_non_null(strstr(diag.text, "zero_rad: missing"));
    diag = (struct diag){0};
    assert_int_equal(reflector_models_check_surface(&zero_alone, &car, &diag), -1);
    assert_non_null(strstr(diag.text, "full_rad: missing"));
    diag = (struct diag){0};
    assert_int_equal(reflector_models_check_surface(&turned, &car, &diag), -1);
    assert_non_null(strstr(diag.text, "zero_rad: 0.4 is less than full_rad, 0.5 rad"));
    diag = (struct diag){0};
    assert_int_equal(reflector_models_check_surface(&hard, &car, &diag), 0);
    assert_int_equal(reflector_models_check_surface(&rough, &car, &diag), 0);
}

TEST(a_surface_is_that_of_a_contour)
{
    const struct contour none = {0};
    const struct surface absent = {-1, -1, -1, -1, -1}, spaced = {0.25, -1, -1, -1, -1};
    struct diag diag = {0};
    assert_int_equal(reflector_models_check_surface(&absent, &none, &diag), 0);
    assert_int_equal(reflector_models_check_surface(&spaced, &car, &diag), 0);
    assert_int_equal(reflector_models_check_surface(&spaced, &none, &diag), -1);
    assert_string_equal(diag.text, "surface: expected a contour, too");
}
