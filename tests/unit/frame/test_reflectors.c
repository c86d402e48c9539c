#include "frame/reflectors.h"

#include "base/text.h"
#include "base/units.h"
#include "check.h"
#include "geometry/mirror.h"
#include "sample.h"
#include "text/list_cache.h"
#include "text/record_read.h"

/* A car of 4 m by 2 m at (10, 20) that heads along y. */
static const struct box northward = {
    .motion = {.position_m = {10, 20}}, .heading = {0, 1}, .length_m = 4, .width_m = 2};

static void assert_vector(struct vec2 actual, double x, double y)
{
    assert_close(actual.x, x, 1e-14);
    assert_close(actual.y, y, 1e-14);
}

TEST(a_point_lies_its_inset_behind_its_place_on_the_outline)
{
    struct point_reflector point = {.x = 0.5, .y = -0.25};
    assert_vector(reflectors_point_place(&northward, &point), 10.5, 22);
    point.inset_m = 0.3;
    assert_vector(reflectors_point_place(&northward, &point), 10.5, 21.7);
    point.facing_rad = -PI / 2; /* to the right, which is +x */
    assert_vector(reflectors_point_place(&northward, &point), 10.2, 22);
}

TEST(posts_stand_at_their_spacing_from_the_first)
{
    static const struct post_row row = {.from_x = -0.5, .to_x = 0.5, .spacing_m = 1.5};
    assert_vector(reflectors_post_place(&northward, &row, 0), 10, 18);
    assert_vector(reflectors_post_place(&northward, &row, 1), 10, 19.5);
    assert_vector(reflectors_post_place(&northward, &row, 2), 10, 21);
    int64_t first, end;
    reflectors_posts_within(&northward, &row, (struct vec2){10, 20}, 100, &first, &end);
    assert_int_equal(first, 0);
    assert_int_equal(end, 3);
}

/* Of 4 m in steps of 2 m, and of 0.3 m in steps of 0.1 m: as doubles their ratio is below 3. */
TEST(a_post_on_the_end_of_its_row_is_one)
{
    struct post_row row = {.from_x = -0.5, .to_x = 0.5, .spacing_m = 2};
    int64_t first, end;
    reflectors_posts_within(&northward, &row, (struct vec2){10, 20}, 100, &first, &end);
    assert_int_equal(end, 3);
    struct box small = northward;
    small.length_m = 0.3;
    row.spacing_m = 0.1;
    reflectors_posts_within(&small, &row, (struct vec2){10, 20}, 100, &first, &end);
    assert_int_equal(end, 4);
}

TEST(a_row_without_length_is_one_post)
{
    static const struct post_row row = {
        .from_x = 0.5, .from_y = 0.5, .to_x = 0.5, .to_y = 0.5, .spacing_m = 2};
    int64_t first, end;
    reflectors_posts_within(&northward, &row, (struct vec2){10, 20}, 100, &first, &end);
    assert_int_equal(first, 0);
    assert_int_equal(end, 1);
    assert_vector(reflectors_post_place(&northward, &row, 0), 9, 22);
}

TEST(rows_are_expanded_in_range_and_no_post_is_missed)
{
    uint64_t random = 6;
    for (int i = 0; i < 20000; i++) {
        struct box box = {.motion.position_m = {sample_between(&random, -50, 50),
                                                sample_between(&random, -50, 50)},
                          .heading = vec2_heading(sample_between(&random, -4, 4)),
                          .length_m = sample_between(&random, 0, i % 7 ? 300 : 0.1),
                          .width_m = sample_between(&random, 0, 5)};
        struct post_row row = {.from_x = sample_between(&random, -1, 1),
                               .from_y = sample_between(&random, -1, 1),
                               .to_x = sample_between(&random, -1, 1),
                               .to_y = sample_between(&random, -1, 1),
                               .spacing_m = i % 5 ? sample_between(&random, 0.5, 20) : 4};
        if (i % 11 == 0)
            row.to_x = row.from_x, row.to_y = row.from_y;
        struct vec2 sensor = {sample_between(&random, -200, 200), sample_between(&random, -9, 9)};
        double range_m = sample_between(&random, 0, 120);
        double length_m = vec2_length(vec2_sub(motion_box_place(&box, row.to_x, row.to_y),
                                               motion_box_place(&box, row.from_x, row.from_y)));
        int64_t posts = 1 + (int64_t)floor(length_m / row.spacing_m), first, end, within = 0;
        reflectors_posts_within(&box, &row, sensor, range_m, &first, &end);
        assert_true(0 <= first && first <= posts && end <= posts + 1);
        for (int64_t post = 0; post < posts; post++) {
            struct vec2 place = reflectors_post_place(&box, &row, post);
            bool in_range = vec2_length(vec2_sub(place, sensor)) <= range_m;
            within += in_range;
            if (in_range)
                assert_true(first <= post && post < end);
        }
        assert_true(end - first <= within + 2 || length_m == 0);
    }
}

/* Posts 3 to 9 stand from 5 m to 19 m along the row, at 6 m, 8 m and so on; 2 and 10 are beside. */
TEST(a_cut_keeps_the_posts_between_two_lengths_and_one_on_each_side)
{
    static const struct {
        double first_m, end_m;
        int64_t first, end;
    } cases[] = {{5.5, 19.5, 2, 11},  {6, 18, 2, 11},         {-50, 19.5, 0, 11},
                 {5.5, 1e300, 2, 15}, {1e300, 2e300, 15, 15}, {5, -(double)INFINITY, 2, 2},
                 {9, 8, 4, 6}};
    static const struct post_row row = {.spacing_m = 2};
    for (size_t i = 0; i < COUNT(cases); i++) {
        int64_t first = 0, end = 15;
        reflectors_cut_posts(&row, cases[i].first_m, cases[i].end_m, &first, &end);
        assert_int_equal(first, cases[i].first);
        assert_int_equal(end, cases[i].end);
    }
}

/* Half of the raised cosine between 1 and 2 rad is at 1.5 rad off the facing. */
TEST(visibility_follows_the_angle_from_which_a_point_is_seen)
{
    static const struct point_reflector left = {
        .y = 0.5, .facing_rad = PI / 2, .full_rad = 1, .zero_rad = 2};
    struct vec2 place = reflectors_point_place(&northward, &left);
    static const struct {
        double off_rad, visible;
    } cases[] = {{0, 1}, {-0.99, 1}, {1.5, 0.5}, {-1.5, 0.5}, {2.01, 0}, {PI, 0}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        /* It faces -x: the left side of a car that heads along y. */
        struct vec2 line = vec2_scale(30, vec2_heading(PI + cases[i].off_rad));
        double visible = reflectors_visibility(&northward, &left, vec2_heading(left.facing_rad),
                                               place, vec2_add(place, line));
        assert_close(visible, cases[i].visible, 1e-12);
    }
}

/* 3 dB down half a width off the facing, and no more than its depth behind. */
TEST(a_lobe_lies_around_the_facing_of_its_point)
{
    static const struct point_reflector left = {.facing_rad = PI / 2,
                                                .lobe = {.width_rad = 0.5, .depth_db = 20}};
    struct vec2 place = reflectors_point_place(&northward, &left);
    static const double off_rad[] = {0, 0.25, -0.25, 3}, drop_db[] = {0, 3, 3, 20};
    for (size_t i = 0; i < COUNT(off_rad); i++) {
        struct vec2 sensor = vec2_add(place, vec2_scale(30, vec2_heading(PI + off_rad[i])));
        double factor = reflectors_lobe(&northward, &left, place, sensor, PI / 2);
        assert_close(-20 * log10(factor), drop_db[i], 1e-12);
    }
}

static struct box random_box(uint64_t *random)
{
    return (struct box){
        .motion.position_m = {sample_between(random, -50, 50), sample_between(random, -50, 50)},
        .heading = vec2_heading(sample_between(random, -PI, PI)),
        .length_m = sample_between(random, 0.3, 20),
        .width_m = sample_between(random, 0.3, 3)};
}

/* At a distance of a sensor from 0.01 m to 100 m. */
static struct vec2 random_sensor(const struct box *box, uint64_t *random)
{
    double range_m = pow(10, sample_between(random, -2, 2));
    struct vec2 line = vec2_scale(range_m, vec2_heading(sample_between(random, -PI, PI)));
    return vec2_add(motion_box_place(box, sample_between(random, -0.5, 0.5), 0.5), line);
}

static struct vec2 in_own_frame(const struct box *box, struct vec2 place)
{
    return vec2_turn_back(vec2_sub(place, box->motion.position_m), box->heading);
}

TEST(a_point_that_is_surely_unseen_has_no_visibility)
{
    uint64_t random = 21;
    int dark = 0, plain = 0;
    for (int i = 0; i < 100000; i++) {
        const struct box box = random_box(&random);
        const struct point_reflector point = {.x = sample_between(&random, -0.5, 0.5),
                                              .y = 0.5,
                                              .inset_m = i % 2 ? sample_between(&random, 0, 1) : 0,
                                              .facing_rad = sample_between(&random, -PI, PI),
                                              .zero_rad = sample_between(&random, 0, PI)};
        const struct reflectors_face face = {vec2_heading(point.facing_rad),
                                             directivity_dark_cosine(point.zero_rad)};
        struct vec2 sensor = random_sensor(&box, &random);
        bool away = reflectors_surely_unseen(&box, &point, &face, in_own_frame(&box, sensor));
        double visible = reflectors_visibility(&box, &point, face.heading,
                                               reflectors_point_place(&box, &point), sensor);
        assert_true(!away || visible == 0);
        dark += visible == 0;
        plain += away;
    }
    assert_true(plain > 0.75 * dark && dark > 30000);
}

TEST(a_plane_that_surely_has_no_foot_has_none)
{
    uint64_t random = 22;
    int none = 0, plain = 0;
    for (int i = 0; i < 100000; i++) {
        const struct box box = random_box(&random);
        const struct plane_reflector plane = {.from_x = 0.5,
                                              .from_y = sample_between(&random, 0.1, 0.5),
                                              .to_x = -0.5,
                                              .to_y = 0.5,
                                              .margin_m = i % 2 ? 0.1 : 0};
        struct vec2 sensor = random_sensor(&box, &random), foot;
        struct vec2 along =
            motion_box_along(&box, plane.from_x, plane.from_y, plane.to_x, plane.to_y);
        bool aside = reflectors_surely_no_foot(&box, &plane, in_own_frame(&box, sensor));
        bool mirrors = mirror_specular_point(motion_box_place(&box, plane.from_x, plane.from_y),
                                             motion_box_place(&box, plane.to_x, plane.to_y), along,
                                             plane.margin_m, sensor, &foot);
        assert_true(!aside || !mirrors);
        none += !mirrors;
        plain += aside;
    }
    assert_true(plain > 0.99 * none && none > 30000 && none < 95000);
}

struct names {
    const char *points[3], *planes[2], *rows[2];
};

static struct reflector_set set_of(const struct names *names, struct arena *arena)
{
    struct reflector_set set = {.model = "m"};
    for (size_t i = 0; i < COUNT(names->points) && names->points[i] != NULL; i++)
        list_add(&set.points, arena)->name = names->points[i];
    for (size_t i = 0; i < COUNT(names->planes) && names->planes[i] != NULL; i++)
        list_add(&set.planes, arena)->name = names->planes[i];
    for (size_t i = 0; i < COUNT(names->rows) && names->rows[i] != NULL; i++)
        list_add(&set.rows, arena)->name = names->rows[i];
    return set;
}

TEST(reflectors_of_one_set_have_names_of_their_own)
{
    static const struct {
        struct names names;
        const char *twice; /* NULL: none */
    } cases[] = {
        {{{0}, {0}, {0}}, NULL},
        {{{"a", "b", "c"}, {"d", "e"}, {"f", "g"}}, NULL},
        {{{"a", "b", "a"}, {0}, {0}}, "a"},
        {{{"a", "b"}, {"b"}, {0}}, "b"},
        {{{"a"}, {"b", "b"}, {0}}, "b"},
        {{{"a"}, {"b"}, {"a"}}, "a"},
        {{{0}, {0}, {"a", "a"}}, "a"},
        /* posts of row a are called a_0, a_1 and so on */
        {{{"a_12"}, {0}, {"a"}}, "a_12"},
        {{{"b"}, {"a_0"}, {"a"}}, "a_0"},
        {{{"a_", "a_x", "a_1x"}, {"ab_1", "b_1"}, {"a"}}, NULL},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct reflector_set set = set_of(&cases[i].names, check_arena());
        const char *twice = reflectors_name_twice(&set, check_arena());
        if (cases[i].twice == NULL)
            assert_null(twice);
        else
            assert_string_equal(twice, cases[i].twice);
    }
}

TEST(one_name_among_many_is_found_twice)
{
    enum { MANY = 1000 };
    static char names[MANY][16];
    struct arena *arena = check_arena();
    struct reflector_set set = {.model = "m"};
    for (int i = 0; i < MANY; i++) {
        snprintf(names[i], sizeof names[i], "p%d", i);
        list_add(&set.points, arena)->name = names[i];
    }
    assert_null(reflectors_name_twice(&set, arena));
    list_add(&set.planes, arena)->name = "p617";
    assert_string_equal(reflectors_name_twice(&set, arena), "p617");
}

/* The share is of the box that holds all reflectors: 1 while none stands out of the object's. */
TEST(a_shape_holds_all_reflectors_of_its_set)
{
    struct arena *arena = check_arena();
    struct reflector_set set = {.model = "m"};
    *list_add(&set.points, arena) =
        (struct point_reflector){.x = -0.25, .y = 0.4, .inset_m = 0.5, .facing_rad = PI / 2};
    *list_add(&set.points, arena) = (struct point_reflector){.inset_m = 0.25, .zero_rad = PI};
    const struct reflectors_shape *shape = reflectors_shape(&set, arena);
    assert_close(shape->share, 1, 0);
    assert_close(shape->inset_m, 0.5, 0);
    assert_false(shape->under);
    assert_vector(shape->faces[0].heading, 0, 1);
    assert_true(shape->faces[1].dark_cosine < -1);
    *list_add(&set.planes, arena) = (struct plane_reflector){.from_x = -0.5, .to_y = -0.6};
    assert_close(reflectors_shape(&set, arena)->share, 1.2, 1e-15);
    *list_add(&set.rows, arena) = (struct post_row){.from_y = 0.7, .to_x = 0.5};
    assert_close(reflectors_shape(&set, arena)->share, 1.4, 1e-15);
    *list_add(&set.rows, arena) = (struct post_row){.to_x = 0.75};
    assert_close(reflectors_shape(&set, arena)->share, 1.5, 1e-15);
    list_add(&set.points, arena)->x = 0.8;
    set.points.items[1].under_vehicles = 0.5;
    assert_close(reflectors_shape(&set, arena)->share, 1.6, 1e-15);
    assert_true(reflectors_shape(&set, arena)->under);
}

/* Of points, sides and rows; a reflector without a height, 0, does not count. */
TEST(a_shape_tells_the_range_of_heights_of_its_set)
{
    struct arena *arena = check_arena();
    struct reflector_set set = {.model = "m"};
    list_add(&set.points, arena);
    assert_close(reflectors_shape(&set, arena)->lowest_z, 0, 0);
    assert_close(reflectors_shape(&set, arena)->highest_z, 0, 0);
    list_add(&set.points, arena)->z = 0.5;
    assert_close(reflectors_shape(&set, arena)->lowest_z, 0.5, 0);
    assert_close(reflectors_shape(&set, arena)->highest_z, 0.5, 0);
    list_add(&set.planes, arena)->z = 0.25;
    list_add(&set.rows, arena)->z = 1.5;
    assert_close(reflectors_shape(&set, arena)->lowest_z, 0.25, 0);
    assert_close(reflectors_shape(&set, arena)->highest_z, 1.5, 0);
}

TEST(a_set_has_its_documents_shape_until_one_of_its_lists_changes)
{
    struct arena *arena = check_arena();
    struct point_reflector points[] = {{.name = "a"}}, others[] = {{.name = "a"}};
    const struct reflectors_shape known = {.share = 7};
    struct reflector_set document = {.model = "m"}, set;
    document.points.items = points;
    document.points.count = 1;
    set = document;
    assert_false(reflectors_unchanged(&set));
    set.document = &document;
    set.shape = &known;
    assert_true(reflectors_unchanged(&set));
    assert_close(reflectors_shape(&set, arena)->share, 7, 0);
    set.points.items = others;
    assert_false(reflectors_unchanged(&set));
    assert_close(reflectors_shape(&set, arena)->share, 1, 0);
    set.points.items = points;
    list_add(&set.mirrors, arena)->reflection = 1;
    assert_false(reflectors_unchanged(&set));
}

/* A set with a point p and a plane of this name, as it is read from a line. */
static struct reflector_set read_set(const char *plane, struct list_cache *cache)
{
    struct text *line = check_text();
    struct reflector_set set = {0};
    struct diag diag = {0};
    text_format(line,
                "{\"model\":\"m\",\"objects\":[\"a\"],\"points\":[{\"name\":\"p\",\"x\":0.6,"
                "\"y\":0,\"facing_rad\":0,\"full_rad\":1,\"zero_rad\":2,\"ercs\":1}],\"planes\":["
                "{\"name\":\"%s\",\"from_x\":0,\"from_y\":0,\"to_x\":1,\"to_y\":0,\"ercs\":1}]}",
                plane);
    assert_int_equal(record_read(line->bytes, line->length, &reflector_set_record, &set,
                                 check_arena(), cache, &diag),
                     0);
    return set;
}

TEST(a_set_that_was_kept_is_known_in_later_lines_by_all_its_lists)
{
    struct list_cache cache = {0};
    struct reflector_set set = read_set("q", &cache);
    assert_false(reflectors_recall(&set, &cache));
    reflectors_keep(&set, &cache);
    set = read_set("q", &cache);
    assert_true(reflectors_recall(&set, &cache));
    assert_true(reflectors_unchanged(&set));
    assert_ptr_equal(reflectors_shape(&set, check_arena()), set.shape);
    assert_close(set.shape->share, 2, 0);
    struct reflector_set other = read_set("p", &cache);
    assert_false(reflectors_recall(&other, &cache));
    assert_string_equal(reflectors_name_twice(&other, check_arena()), "p");
    arena_free(&cache.arena);
}

TEST(a_set_with_a_list_that_may_change_is_not_kept)
{
    struct list_cache cache = {0};
    struct reflector_set set = read_set("q", &cache);
    list_add(&set.mirrors, check_arena())->reflection = 1;
    reflectors_keep(&set, &cache);
    assert_false(reflectors_recall(&set, &cache));
    set = read_set("q", &cache);
    assert_false(reflectors_recall(&set, &cache));
    arena_free(&cache.arena);
}
