#include "check.h"

#include "elementary.h"
#include "sample.h"
#include "sectors.h"
#include "units.h"

static void what_stands_behind_or_aside_is_not_in_the_way(void **state)
{
    static const struct {
        struct vec2 front_m;
        double front_radius_m;
        struct vec2 target_m;
        double target_radius_m;
        bool overlap;
    } cases[] = {
        {{10, 0}, 2, {30, 0}, 2, true},    /* before it */
        {{30, 0}, 2, {10, 0}, 2, false},   /* behind it */
        {{12, 0}, 3, {10, 0}, 2, true},    /* begins beside its end */
        {{10, 5}, 2, {30, 0}, 2, false},   /* 26.6 degrees aside; they cover 11.5 and 3.8 */
        {{10, 2.6}, 2, {30, 0}, 2, true},  /* 14.6 degrees aside; they cover 11.2 and 3.8 */
        {{10, 2.9}, 2, {30, 0}, 2, false}, /* 16.2 degrees aside; they cover 11.1 and 3.8 */
        {{-10, 0}, 2, {30, 0}, 2, false},  /* on the other side */
        {{1, 0}, 2, {-30, 0}, 2, true},    /* the sensor is within its circle */
        {{-10, 0}, 2, {1, 0}, 20, true},   /* the sensor is among the targets */
        {{10, 0}, 0, {30, 0}, 0, true},    /* two points in line */
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sector front = sector_of(cases[i].front_m, cases[i].front_radius_m);
        struct sector target = sector_of(cases[i].target_m, cases[i].target_radius_m);
        if (sectors_overlap(&front, &target) != cases[i].overlap)
            fail_msg("case %zu: expected %d", i, cases[i].overlap);
    }
}

/* Independent of the test: how near a sight line comes to a circle. */
static bool touches(struct vec2 place, const struct sector *front)
{
    double share = vec2_dot(place, front->centre_m) / vec2_dot(place, place);
    struct vec2 nearest = vec2_scale(fmin(fmax(share, 0), 1), place);
    return vec2_length(vec2_sub(front->centre_m, nearest)) <= front->radius_m;
}

static struct vec2 around(uint64_t *random, struct vec2 centre, double radius_m)
{
    struct elementary_sincos angle = elementary_sincos(sample_between(random, 0, 2 * PI));
    return vec2_add(centre, (struct vec2){radius_m * angle.cos, radius_m * angle.sin});
}

static void no_line_that_touches_is_called_clear(void **state)
{
    (void)state;
    uint64_t random = 1;
    int touched = 0, clear = 0;
    for (int i = 0; i < 300000; i++) {
        struct sector front =
            sector_of(around(&random, (struct vec2){0, 0}, sample_between(&random, 0, 50)),
                      sample_between(&random, 0, 8));
        struct sector target =
            sector_of(around(&random, (struct vec2){0, 0}, sample_between(&random, 0, 50)),
                      sample_between(&random, 0, 8));
        bool overlap = sectors_overlap(&front, &target);
        bool touch = touches(
            around(&random, target.centre_m, target.radius_m * sample_between(&random, 0, 1)),
            &front);
        if (touch && !overlap)
            fail_msg("pair %d: a sight line touches, and the sectors are called apart", i);
        touched += touch;
        clear += !overlap;
    }
    assert_true(touched > 30000);
    assert_true(clear > 100000);
}

static double half_angle_rad(const struct sector *sector)
{
    return elementary_asin(sector->radius_m / sector->distance_m);
}

/* One line touches both, to the last digits: what is clear by rounding alone is not clear. */
static void sectors_that_only_touch_are_not_called_clear(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int i = 0; i < 100000; i++) {
        double distance_m = sample_between(&random, 1, 200);
        struct sector front = sector_of(around(&random, (struct vec2){0, 0}, distance_m),
                                        distance_m * sample_between(&random, 0, 0.999) *
                                            sample_between(&random, 0, 1));
        double share = sample_between(&random, 0, 1);
        struct sector target = {.distance_m = distance_m * sample_between(&random, 1, 3)};
        target.radius_m = target.distance_m * 0.999 * share * share * share;
        double apart_rad = half_angle_rad(&front) + half_angle_rad(&target);
        struct vec2 turn = vec2_heading(i % 2 == 0 ? apart_rad : -apart_rad);
        target.centre_m =
            vec2_scale(target.distance_m / front.distance_m, vec2_turn(front.centre_m, turn));
        if (!sectors_overlap(&front, &target))
            fail_msg("pair %d: sectors touch and are called apart", i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_behind_or_aside_is_not_in_the_way),
        cmocka_unit_test(no_line_that_touches_is_called_clear),
        cmocka_unit_test(sectors_that_only_touch_are_not_called_clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
