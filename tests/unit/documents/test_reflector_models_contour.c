#include "check.h"

#include <complex.h>

#include "base/random.h"
#include "base/units.h"
#include "documents/reflector_models.h"
#include "propagation/carrier.h"
#include "radar/radar_equation.h"
#include "text/record_write.h"

#define FAR_M 1e7

static const struct contour car = {15, 10.8, 13.6, 20.1, 7.1};
static const struct contour bicycle = {15, -2, -2, 4, -2};

/* Equal posts so far apart. */
static void posts_on(const struct contour *contour, struct vec2 size_m, double spacing_m,
                     struct reflector_set *set)
{
    struct surface surface = reflector_models_usual_surface;
    surface.spacing_m = spacing_m;
    reflector_models_of_contour(contour, &surface, size_m, set, check_arena());
}

/* The place of a sensor that sees the object's middle from this distance and aspect. */
static struct vec2 sensor_at(double aspect_rad, double range_m)
{
    return (struct vec2){range_m * cos(aspect_rad), range_m * sin(aspect_rad)};
}

/* A post in sight: its amplitude and its place. */
struct post {
    double amplitude; /* root of its cross section */
    double range_m;
};

static size_t posts_of(const struct reflector_set *set, const struct box *box, struct vec2 sensor,
                       struct post *posts, size_t most)
{
    size_t count = 0;
    for (size_t i = 0; i < set->rows.count; i++) {
        const struct post_row *row = &set->rows.items[i];
        int64_t first, end;
        reflectors_posts_within(box, row, sensor, 2 * FAR_M, &first, &end);
        for (int64_t n = first; n < end; n++) {
            struct vec2 place = reflectors_post_place(box, row, n);
            struct point_reflector post = {
                .full_rad = row->full_rad, .zero_rad = row->zero_rad, .shape = row->shape};
            double seen =
                reflectors_visibility(box, &post, vec2_heading(row->facing_rad), place, sensor);
            assert_true(count < most);
            posts[count].amplitude = sqrt(radar_cross_section_m2(seen * row->ercs));
            posts[count++].range_m = vec2_length(vec2_sub(place, sensor));
        }
    }
    return count;
}

static double incoherent_dbsm(const struct contour *contour, struct box box, double spacing_m,
                              double aspect_rad)
{
    static struct post posts[2000];
    struct reflector_set set = {.model = "m"};
    double total_m2 = 0;
    posts_on(contour, (struct vec2){4.6, 1.8}, spacing_m, &set);
    size_t count = posts_of(&set, &box, sensor_at(aspect_rad, FAR_M), posts, COUNT(posts));
    for (size_t i = 0; i < count; i++)
        total_m2 += posts[i].amplitude * posts[i].amplitude;
    return 10 * log10(total_m2);
}

static const struct box car_box = {.heading = {1, 0}, .length_m = 4.6, .width_m = 1.8};

TEST(the_powers_of_all_posts_are_the_class_cross_section)
{
    static const double spacings_m[] = {10, 1, 0.5, 0.13, 0.05, 0.02};
    const struct contour *contours[] = {&car, &bicycle};
    for (size_t i = 0; i < COUNT(spacings_m); i++)
        for (size_t j = 0; j < COUNT(contours); j++) {
            const struct contour *one = contours[j];
            double s = spacings_m[i];
            assert_close(incoherent_dbsm(one, car_box, s, 0), one->front_dbsm, 1e-5);
            assert_close(incoherent_dbsm(one, car_box, s, PI), one->rear_dbsm, 1e-5);
            for (int side = -1; side <= 1; side += 2) {
                assert_close(incoherent_dbsm(one, car_box, s, side * PI / 2), one->side_dbsm, 1e-5);
                assert_close(incoherent_dbsm(one, car_box, s, side * PI / 4), one->oblique_dbsm,
                             1e-5);
                assert_close(incoherent_dbsm(one, car_box, s, side * 3 * PI / 4), one->oblique_dbsm,
                             1e-5);
            }
        }
}

TEST(between_normal_and_diagonal_no_aspect_is_stronger)
{
    for (double aspect_rad = 0; aspect_rad < PI / 4; aspect_rad += 0.01) {
        double front_dbsm = incoherent_dbsm(&car, car_box, 0.1, aspect_rad);
        double side_dbsm = incoherent_dbsm(&car, car_box, 0.1, PI / 2 - aspect_rad);
        assert_true(front_dbsm < 10.8 + 1e-5 && side_dbsm < 20.1 + 1e-5);
        assert_true(front_dbsm > 5 && side_dbsm > 5);
    }
}

TEST(a_longer_object_has_more_power_in_proportion)
{
    struct box longer = car_box;
    longer.length_m *= 3;
    double more_db = incoherent_dbsm(&car, longer, 0.02, PI / 2) - car.side_dbsm;
    assert_close(more_db, 10 * log10(3), 0.05);
}

TEST(rounding_of_a_length_makes_no_post)
{
    for (int i = -3; i <= 3; i++) {
        struct reflector_set set = {.model = "m"};
        double length_m = 4.8 * (1 + i * 2.220446049250313e-16);
        posts_on(&car, (struct vec2){length_m, 1.8}, 0.1, &set);
        for (size_t j = 0; j < set.rows.count; j++)
            assert_near(set.rows.items[j].spacing_m, 0.1, 1e-12);
    }
}

TEST(a_face_has_half_of_the_oblique_cross_section_at_45_degrees)
{
    for (double below_db = -REFLECTOR_MODELS_OBLIQUE_DB; below_db < 40; below_db += 0.25) {
        struct contour_view view = reflector_models_contour_view(20, 20 - below_db);
        double half_way =
            directivity_visibility(VISIBILITY_RAISED_COSINE, view.full_rad, view.zero_rad, PI / 4);
        assert_close(20 * log10(half_way), -below_db - 10 * log10(2), 1e-9);
        assert_true(view.full_rad >= 0 && view.full_rad <= view.zero_rad);
        assert_true(view.zero_rad <= PI / 2);
    }
}

/* The power of all posts with the phases of their paths and, if they are rough, a constant phase
 * each, over their incoherent sum. */
static double coherent_over_incoherent(const struct reflector_set *set, struct vec2 sensor,
                                       bool rough, uint64_t seed)
{
    static struct post posts[2000];
    double _Complex sum = 0;
    double total_m2 = 0;
    size_t count = posts_of(set, &car_box, sensor, posts, COUNT(posts));
    for (size_t i = 0; i < count; i++) {
        const struct random_address address = {.seed = seed, .item = i};
        double uniform[4];
        random_uniform(&address, RANDOM_OWN, 0, uniform);
        double turns = (rough ? uniform[0] : 0) - carrier_phase_turns(posts[i].range_m, 77e9);
        sum += posts[i].amplitude * cexp(2 * PI * turns * (double _Complex)I);
        total_m2 += posts[i].amplitude * posts[i].amplitude;
    }
    return creal(sum * conj(sum)) / total_m2;
}

static double mean_over_incoherent_db(double spacing_m, bool rough)
{
    struct reflector_set set = {.model = "m"};
    const struct vec2 sensor = sensor_at(PI / 4, 50);
    const int draws = rough ? 4000 : 1;
    double total = 0;
    posts_on(&car, (struct vec2){4.6, 1.8}, spacing_m, &set);
    for (int i = 0; i < draws; i++)
        total += coherent_over_incoherent(&set, sensor, rough, (uint64_t)i);
    return 10 * log10(total / draws);
}

/* Five standard deviations of a mean of exponential draws are 0.34 dB. */
TEST(with_random_phases_the_spacing_does_not_matter_and_with_fixed_ones_it_does)
{
    assert_close(mean_over_incoherent_db(0.3, true), 0, 0.35);
    assert_close(mean_over_incoherent_db(0.1, true), 0, 0.35);
    assert_close(mean_over_incoherent_db(0.02, true), 0, 0.35);
    double coarse_db = mean_over_incoherent_db(0.1, false);
    double fine_db = mean_over_incoherent_db(0.02, false);
    assert_true(fabs(coarse_db - fine_db) > 5);
}

TEST(rows_replace_the_reflectors_of_the_document)
{
    struct point_reflector corner = {.name = "corner"};
    struct mirror_plane mirror = {.reflection = 0.5};
    struct reflector_set set = {.model = "m", .blocks = true};
    set.points.items = &corner;
    set.mirrors.items = &mirror;
    set.points.count = set.mirrors.count = 1;
    posts_on(&bicycle, (struct vec2){0.01, 0.01}, 0.02, &set);
    assert_int_equal(set.points.count, 0);
    assert_int_equal(set.rows.count, 4);
    assert_int_equal(set.mirrors.count, 1);
    assert_true(set.blocks);
    assert_done(record_write_check, &reflector_set_record, &set, ~0U);
    posts_on(&car, (struct vec2){1e4, 0.021}, 0.02, &set);
    assert_done(record_write_check, &reflector_set_record, &set, ~0U);
}

TEST(an_oblique_cross_section_must_fit_the_others)
{
    struct diag diag = {0};
    const struct contour none = {.oblique_dbsm = 20}, most = {15, 2, 3, 4, 5};
    const struct contour more = {15, 2, 3, 4, 5.1};
    assert_int_equal(reflector_models_check_contour(&none, &diag), 0);
    assert_int_equal(reflector_models_check_contour(&most, &diag), 0);
    const struct contour some = {11, 2, 3, 0, 1};
    assert_int_equal(reflector_models_check_contour(&some, &diag), -1);
    assert_non_null(strstr(diag.text, "side_dbsm: missing"));
    diag = (struct diag){0};
    assert_int_equal(reflector_models_check_contour(&more, &diag), -1);
    assert_non_null(strstr(diag.text, "oblique_dbsm: 5.1 is more than 3 dB above 2"));
}
