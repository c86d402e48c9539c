#include "check.h"

#include "bearings.h"
#include "elementary.h"
#include "sample.h"
#include "units.h"

enum { MOST = 150, SCENES = 2000 };

/* A scene of circles: what is all pairs' business, one by one, is asked of the bearings. */
struct scene {
    struct sector sectors[MOST];
    size_t count;
    struct bearings bearings;
};

static int start(void **state)
{
    static struct arena arena;
    *state = &arena;
    return 0;
}

static int stop(void **state)
{
    arena_free(*state);
    return 0;
}

static struct vec2 at(double distance_m, double angle_rad)
{
    return vec2_scale(distance_m, vec2_heading(angle_rad));
}

/* Directions on and beside the borders of slices, among them those where angles wrap. */
static double awkward_rad(uint64_t *random)
{
    double border_rad = (double)sample_integer(random, 8) * PI / 8;
    return sample_bits(random) % 2 != 0 ? border_rad
                                        : border_rad + sample_between(random, -1e-9, 1e-9);
}

static struct sector any_sector(uint64_t *random, const struct sector *other)
{
    double angle_rad =
        sample_bits(random) % 4 == 0 ? awkward_rad(random) : sample_between(random, -PI, PI);
    double distance_m = sample_between(random, 0, sample_bits(random) % 2 == 0 ? 10 : 250);
    struct sector sector = sector_of(at(distance_m, angle_rad), sample_between(random, 0, 9));
    if (sample_bits(random) % 8 == 0) /* the sensor on its edge */
        sector.radius_m = sector.distance_m * (1 + sample_between(random, -1e-12, 1e-12));
    if (sample_bits(random) % 8 == 0)
        sector.radius_m = 0;
    if (sample_bits(random) % 4 == 0 && other != NULL && other->radius_m < other->distance_m &&
        sector.radius_m < sector.distance_m) {
        /* One line touches both. */
        double apart_rad = elementary_asin(sector.radius_m / sector.distance_m) +
                           elementary_asin(other->radius_m / other->distance_m);
        struct vec2 turned = vec2_turn(other->centre_m, vec2_heading(apart_rad));
        sector.centre_m = vec2_scale(sector.distance_m / other->distance_m, turned);
    }
    return sector;
}

static struct scene any_scene(uint64_t *random, struct arena *arena)
{
    struct scene scene = {.count = 1 + sample_bits(random) % MOST};
    arena_clear(arena);
    scene.bearings = bearings_begin(scene.count, arena);
    for (size_t i = 0; i < scene.count; i++) {
        scene.sectors[i] = any_sector(random, i > 0 ? &scene.sectors[i - 1] : NULL);
        bearings_enter(&scene.bearings, i, bearings_of(&scene.sectors[i]));
    }
    return scene;
}

/* Steps through what was found, in order, and says whether the number is among it. */
static bool is_found(const struct bearings *bearings, size_t count, size_t number, size_t *next)
{
    if (*next < count && bearings->found[*next] == number) {
        (*next)++;
        return true;
    }
    return false;
}

static void whatever_all_pairs_find_is_found_in_order(void **state)
{
    uint64_t random = 1;
    size_t overlaps = 0;
    for (int i = 0; i < SCENES; i++) {
        struct scene scene = any_scene(&random, *state);
        for (size_t target = 0; target < scene.count; target += 7) {
            const struct sector *wanted = &scene.sectors[target];
            size_t count = bearings_find(&scene.bearings, bearings_of(wanted)), next = 0;
            for (size_t front = 0; front < scene.count; front++) {
                bool overlap = sectors_overlap(&scene.sectors[front], wanted);
                if (!is_found(&scene.bearings, count, front, &next) && overlap)
                    fail_msg("scene %d: %zu stands before %zu and is not found", i, front, target);
                overlaps += overlap;
            }
            assert_int_equal(next, count);
        }
    }
    assert_true(overlaps > 100000);
}

static void few_are_found_that_are_far_aside(void **state)
{
    struct arena *arena = *state;
    struct bearings bearings = bearings_begin(MOST, arena);
    for (size_t i = 0; i < MOST; i++) {
        struct sector sector = sector_of(at(50, (double)i * 2 * PI / MOST), 1);
        bearings_enter(&bearings, i, bearings_of(&sector));
    }
    for (size_t i = 0; i < MOST; i++) {
        struct vec2 place = at(80, (double)i * 2 * PI / MOST);
        size_t count = bearings_find(&bearings, bearings_between((struct vec2){0, 0}, place));
        assert_in_range(count, 1, 4);
    }
}

/* Independent of slices: how near the line comes to the circle. */
static bool touches(struct vec2 from, struct vec2 to, const struct sector *sector)
{
    struct vec2 line = vec2_sub(to, from), offset = vec2_sub(sector->centre_m, from);
    double square = vec2_dot(line, line), share = square > 0 ? vec2_dot(offset, line) / square : 0;
    struct vec2 nearest = vec2_scale(fmin(fmax(share, 0), 1), line);
    return vec2_length(vec2_sub(offset, nearest)) <= sector->radius_m;
}

/* From the sensor, past it, through it, or of length zero. */
static void any_line(uint64_t *random, struct vec2 *from, struct vec2 *to)
{
    *from = at(sample_between(random, 0, 100), awkward_rad(random));
    *to = at(sample_between(random, 0, 100), sample_between(random, -PI, PI));
    switch (sample_bits(random) % 6) {
    case 0:
        *from = (struct vec2){0, 0};
        break;
    case 1:
        *to = vec2_scale(-sample_between(random, 0, 2), *from);
        break;
    case 2:
        *to = *from;
        break;
    case 3:
        *to = (struct vec2){0, 0};
        break;
    default:
        break;
    }
}

static void whatever_a_line_touches_is_found(void **state)
{
    uint64_t random = 2;
    size_t touched = 0;
    for (int i = 0; i < SCENES; i++) {
        struct scene scene = any_scene(&random, *state);
        for (int line = 0; line < 20; line++) {
            struct vec2 from, to;
            any_line(&random, &from, &to);
            size_t count = bearings_find(&scene.bearings, bearings_between(from, to)), next = 0;
            for (size_t j = 0; j < scene.count; j++) {
                bool touch = touches(from, to, &scene.sectors[j]);
                if (!is_found(&scene.bearings, count, j, &next) && touch)
                    fail_msg("scene %d: a line touches %zu, which is not found", i, j);
                touched += touch;
            }
        }
    }
    assert_true(touched > 100000);
}

static void everywhere_is_everyone_and_who_was_not_entered_is_nowhere(void **state)
{
    struct arena *arena = *state;
    struct bearings bearings = bearings_begin(130, arena);
    struct sector ahead = sector_of((struct vec2){50, 0}, 1);
    assert_int_equal(bearings_find(&bearings, bearings_everywhere), 0);
    bearings_enter(&bearings, 129, bearings_of(&ahead));
    bearings_enter(&bearings, 64, bearings_of(&ahead));
    assert_int_equal(bearings_find(&bearings, bearings_everywhere), 2);
    assert_int_equal(bearings.found[0], 64);
    assert_int_equal(bearings.found[1], 129);
    struct vec2 behind = {-50, 1}, left = {0, 50};
    assert_int_equal(bearings_find(&bearings, bearings_between(left, behind)), 0);
    assert_int_equal(bearings_find(&bearings, bearings_between(left, ahead.centre_m)), 2);
}

static void no_direction_within_the_angle_is_left_out(void **state)
{
    uint64_t random = 3;
    size_t inside = 0, apart = 0;
    (void)state;
    for (int i = 0; i < 100000; i++) {
        double ahead_rad = awkward_rad(&random), half_rad = sample_between(&random, 0, PI);
        double aside_rad = sample_between(&random, -PI, PI);
        if (sample_bits(&random) % 2 == 0)
            aside_rad = half_rad;
        struct sector place = sector_of(at(40, ahead_rad + aside_rad), 0);
        bool clear =
            bearings_apart(bearings_around(vec2_heading(ahead_rad), half_rad), bearings_of(&place));
        assert_int_equal(clear, bearings_apart(bearings_of(&place),
                                               bearings_around(vec2_heading(ahead_rad), half_rad)));
        if (fabs(aside_rad) <= half_rad)
            assert_false(clear);
        inside += fabs(aside_rad) <= half_rad;
        apart += clear;
    }
    assert_true(inside > 50000 && apart > 5000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_all_pairs_find_is_found_in_order),
        cmocka_unit_test(few_are_found_that_are_far_aside),
        cmocka_unit_test(whatever_a_line_touches_is_found),
        cmocka_unit_test(no_direction_within_the_angle_is_left_out),
        cmocka_unit_test(everywhere_is_everyone_and_who_was_not_entered_is_nowhere),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
