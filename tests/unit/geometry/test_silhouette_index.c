#include "check.h"

#include "base/units.h"
#include "geometry/obstruction.h"
#include "geometry/silhouette.h"
#include "sample.h"

enum { MOST = 150, SCENES = 2000 };

/* Boxes around a sensor, with their index. The tests compare what the index finds with an exact
 * test of every box. */
struct scene {
    struct vec2 corners[MOST][4];
    struct silhouette seen[MOST];
    size_t count;
    struct silhouette_index index;
};

static struct vec2 at(double distance_m, double angle_rad)
{
    return vec2_scale(distance_m, vec2_heading(angle_rad));
}

/* Directions on and beside the borders of sectors, among them the one where angles wrap. */
static double awkward_rad(uint64_t *random)
{
    double border_rad = (double)sample_integer(random, 8) * PI / 8;
    return sample_bits(random) % 2 != 0 ? border_rad
                                        : border_rad + sample_between(random, -1e-9, 1e-9);
}

static struct silhouette silhouette_at(struct vec2 place_m, struct vec2 half_m, struct vec2 heading)
{
    return silhouette_of(half_m, heading, vec2_turn_back(vec2_scale(-1, place_m), heading));
}

/* A place anywhere, or in line with a corner of another box; a box without a size is only this
 * place. */
static struct vec2 random_place(uint64_t *random, const struct vec2 *corners)
{
    double angle_rad =
        sample_bits(random) % 4 == 0 ? awkward_rad(random) : sample_between(random, -PI, PI);
    double distance_m = sample_between(random, 0, sample_bits(random) % 2 == 0 ? 10 : 250);
    if (corners != NULL && sample_bits(random) % 4 == 0)
        return vec2_scale(sample_between(random, 0.5, 2), corners[sample_bits(random) % 4]);
    return at(distance_m, angle_rad);
}

static void add_box(uint64_t *random, struct scene *scene, size_t i)
{
    struct vec2 place_m = random_place(random, i > 0 ? scene->corners[i - 1] : NULL);
    struct vec2 half_m = {sample_between(random, 0, 9), sample_between(random, 0, 3)};
    struct vec2 heading = vec2_heading(awkward_rad(random));
    if (sample_bits(random) % 4 == 0)
        half_m = (struct vec2){0, 0};
    for (int corner = 0; corner < 4; corner++) {
        double ahead = corner == 0 || corner == 3 ? 1 : -1, aside = corner < 2 ? 1 : -1;
        scene->corners[i][corner] = vec2_add(
            place_m, vec2_turn((struct vec2){ahead * half_m.x, aside * half_m.y}, heading));
    }
    scene->seen[i] = silhouette_at(place_m, half_m, heading);
    silhouette_index_enter(&scene->index, i, silhouette_span_of(&scene->seen[i]));
}

static struct scene random_scene(uint64_t *random)
{
    struct scene scene = {.count = 1 + sample_bits(random) % MOST};
    arena_clear(check_arena());
    scene.index = silhouette_index_begin(scene.count, check_arena());
    for (size_t i = 0; i < scene.count; i++)
        add_box(random, &scene, i);
    return scene;
}

/* Steps through the numbers found, in ascending order; true if the number is among them. */
static bool is_found(const struct silhouette_index *index, size_t count, size_t number,
                     size_t *next)
{
    if (*next < count && index->found[*next] == number) {
        (*next)++;
        return true;
    }
    return false;
}

TEST(every_body_before_a_corner_is_found_in_order)
{
    static const struct vec2 sensor = {0, 0};
    uint64_t random = 1;
    size_t blocked = 0;
    for (int i = 0; i < SCENES; i++) {
        struct scene scene = random_scene(&random);
        for (size_t behind = 0; behind < scene.count; behind += 7) {
            size_t next = 0;
            size_t count =
                silhouette_index_find(&scene.index, silhouette_span_of(&scene.seen[behind]));
            for (size_t front = 0; front < scene.count; front++) {
                struct vec2 corner = scene.corners[behind][sample_bits(&random) % 4];
                bool block = obstruction_blocks(scene.corners[front], 4, sensor, corner);
                if (!is_found(&scene.index, count, front, &next) && block)
                    fail_msg("scene %d: %zu stands before %zu and is not found", i, front, behind);
                blocked += block;
            }
            assert_int_equal(next, count);
        }
    }
    assert_true(blocked > 100000);
}

TEST(a_search_in_one_direction_finds_few_bodies)
{
    struct silhouette_index index = silhouette_index_begin(MOST, check_arena());
    for (size_t i = 0; i < MOST; i++) {
        struct vec2 heading = vec2_heading((double)i * 2 * PI / MOST);
        struct silhouette box =
            silhouette_at(vec2_scale(50, heading), (struct vec2){1, 1}, heading);
        silhouette_index_enter(&index, i, silhouette_span_of(&box));
    }
    for (size_t i = 0; i < MOST; i++) {
        struct vec2 place = at(80, (double)i * 2 * PI / MOST);
        size_t count =
            silhouette_index_find(&index, silhouette_span_between((struct vec2){0, 0}, place));
        assert_in_range(count, 1, 4);
    }
}

/* A line from the sensor, past it, through it, or of length zero. */
static void random_line(uint64_t *random, struct vec2 *from, struct vec2 *to)
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

TEST(every_body_that_a_line_touches_is_found)
{
    uint64_t random = 2;
    size_t touched = 0;
    for (int i = 0; i < SCENES; i++) {
        struct scene scene = random_scene(&random);
        for (int line = 0; line < 20; line++) {
            struct vec2 from, to;
            random_line(&random, &from, &to);
            size_t count = silhouette_index_find(&scene.index, silhouette_span_between(from, to)),
                   next = 0;
            for (size_t j = 0; j < scene.count; j++) {
                bool touch = obstruction_blocks(scene.corners[j], 4, from, to);
                if (!is_found(&scene.index, count, j, &next) && touch)
                    fail_msg("scene %d: a line touches %zu, which is not found", i, j);
                touched += touch;
            }
        }
    }
    assert_true(touched > 100000);
}

TEST(everywhere_finds_all_entries_and_nothing_else)
{
    struct silhouette_index index = silhouette_index_begin(130, check_arena());
    struct vec2 heading = {1, 0}, ahead_m = {50, 0};
    struct silhouette ahead = silhouette_at(ahead_m, (struct vec2){1, 1}, heading);
    assert_int_equal(silhouette_index_find(&index, silhouette_everywhere), 0);
    silhouette_index_enter(&index, 129, silhouette_span_of(&ahead));
    silhouette_index_enter(&index, 64, silhouette_span_of(&ahead));
    assert_int_equal(silhouette_index_find(&index, silhouette_everywhere), 2);
    assert_int_equal(index.found[0], 64);
    assert_int_equal(index.found[1], 129);
    struct vec2 behind = {-50, 1}, left = {0, 50};
    assert_int_equal(silhouette_index_find(&index, silhouette_span_between(left, behind)), 0);
    assert_int_equal(silhouette_index_find(&index, silhouette_span_between(left, ahead_m)), 2);
}
