#include "check.h"

#include "base/hash.h"
#include "text/variation.h"

#define DRAWS 20000

static const char *drawn(const char *line, int64_t scene)
{
    struct random_address address = {.seed = 7, .scene = (uint64_t)scene};
    struct diag diag = {0};
    const char *text = variation_draw(line, address, check_arena(), &diag);
    if (text == NULL)
        fail_msg("%s", diag.text);
    return text;
}

/* The number behind the last colon of a drawn line. */
static double number_of(const char *line, int64_t scene)
{
    return strtod(strrchr(drawn(line, scene), ':') + 1, NULL);
}

TEST(a_document_without_distributions_stays_as_it_is)
{
    static const char line[] =
        "{\"a\":[1,-2.5,[],{}],\"b\":{\"c\":\"x\\\"\\u0001y\",\"d\":[true,null]},\"e\":\"\"}";
    assert_string_equal(drawn(line, 3), line);
}

TEST(a_draw_is_that_of_its_seed_scene_and_path)
{
    double uniform[4], gaussian[4];
    struct random_address address = {
        .seed = 7, .scene = 12, .item = hash_text(HASH_START, "objects[1].x_m")};
    random_uniform(&address, RANDOM_VARIATION, 0, uniform);
    random_gaussian(&address, RANDOM_VARIATION, 0, gaussian);
    assert_close(number_of("{\"objects\":[{},{\"x_m\":{\"uniform\":[-3,5]}}]}", 12),
                 -3 + 8 * uniform[0], 0);
    assert_close(number_of("{\"objects\":[0,{\"y\":2,\"x_m\":{\"normal\":[30,4]}}]}", 12),
                 30 + 4 * gaussian[0], 0);
}

/* Tolerances are five standard errors. */
TEST(uniform_draws_have_their_bounds_mean_and_variance)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < DRAWS; i++) {
        double x = number_of("{\"x\":{\"uniform\":[-1,3]}}", i);
        assert_true(x > -1 && x < 3);
        sum += x;
        squares += (x - 1) * (x - 1);
    }
    assert_close(sum / DRAWS, 1, 5 * sqrt(16 / 12.0 / DRAWS));
    assert_close(squares / DRAWS, 16 / 12.0, 5 * sqrt((256 / 80.0 - 256 / 144.0) / DRAWS));
}

TEST(normal_draws_have_their_mean_and_deviation)
{
    double sum = 0, squares = 0;
    int64_t beyond = 0;
    for (int i = 0; i < DRAWS; i++) {
        double z = (number_of("{\"x\":{\"normal\":[100,5]}}", i) - 100) / 5;
        sum += z;
        squares += z * z;
        beyond += fabs(z) > 1.959963984540054;
    }
    assert_close(sum / DRAWS, 0, 5 / sqrt(DRAWS));
    assert_close(squares / DRAWS, 1, 5 * sqrt(2.0 / DRAWS));
    assert_close((double)beyond, 0.05 * DRAWS, 5 * sqrt(0.05 * 0.95 * DRAWS));
}

TEST(choices_come_equally_often_and_may_be_distributions)
{
    int64_t names = 0, lists = 0, numbers = 0;
    for (int i = 0; i < DRAWS; i++) {
        const char *text =
            drawn("{\"x\":{\"choice\":[\"a\",[1,{\"b\":2}],{\"uniform\":[4,5]}]}}", i);
        names += strcmp(text, "{\"x\":\"a\"}") == 0;
        lists += strcmp(text, "{\"x\":[1,{\"b\":2}]}") == 0;
        numbers += strncmp(text, "{\"x\":4.", 7) == 0;
        arena_clear(check_arena());
    }
    assert_int_equal(names + lists + numbers, DRAWS);
    double tolerance = 5 * sqrt(2.0 / 9 * DRAWS);
    assert_close((double)names, DRAWS / 3.0, tolerance);
    assert_close((double)lists, DRAWS / 3.0, tolerance);
}

TEST(members_draw_independently)
{
    double product = 0;
    for (int i = 0; i < DRAWS; i++) {
        char *end;
        const char *text = drawn("{\"x\":{\"normal\":[0,1]},\"y\":{\"normal\":[0,1]}}", i);
        double x = strtod(text + strlen("{\"x\":"), &end);
        product += x * strtod(end + strlen(",\"y\":"), NULL);
    }
    assert_close(product / DRAWS, 0, 5 / sqrt(DRAWS));
}

TEST(a_wrong_distribution_is_refused_by_its_member)
{
    static const char *const wrong[] = {
        "{\"uniform\":[2,1]}",
        "{\"uniform\":[1]}",
        "{\"uniform\":[1,2,3]}",
        "{\"uniform\":[\"1\",2]}",
        "{\"uniform\":3}",
        "{\"uniform\":[-1e305,1e305]}",
        "{\"normal\":[0,-1]}",
        "{\"normal\":[]}",
        "{\"normal\":{\"mean\":1}}",
        "{\"choice\":[]}",
        "{\"choice\":\"a\"}",
        "{\"choice\":[1],\"weights\":[1]}",
        "{\"uniform\":[1,2],\"a\":1}",
    };
    for (size_t i = 0; i < COUNT(wrong); i++) {
        char line[128];
        snprintf(line, sizeof line, "{\"a\":[{\"b\":%s}]}", wrong[i]);
        struct diag diag = {0};
        assert_null(variation_draw(line, (struct random_address){0}, check_arena(), &diag));
        assert_int_equal(diag.code, DIAG_CONFIG);
        assert_memory_equal(diag.text, "a[0].b: {", 9);
        assert_non_null(strstr(diag.text, "; expected {"));
    }
}
