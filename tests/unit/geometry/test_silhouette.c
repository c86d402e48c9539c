#include "check.h"

#include "base/units.h"
#include "geometry/obstruction.h"
#include "geometry/silhouette.h"
#include "sample.h"

/* A box as the sensor at the origin sees it. */
struct box {
    struct vec2 centre_m, half_m, heading;
};

static struct silhouette seen(const struct box *box)
{
    return silhouette_of(
        box->half_m, box->heading,
        vec2_turn_back(vec2_sub((struct vec2){0, 0}, box->centre_m), box->heading));
}

/* A place in the box, by fractions of its half sides. */
static struct vec2 place_in(const struct box *box, double ahead, double aside)
{
    struct vec2 own = {ahead * box->half_m.x, aside * box->half_m.y};
    return vec2_add(box->centre_m, vec2_turn(own, box->heading));
}

static bool blocks(const struct box *box, struct vec2 place)
{
    const struct vec2 corners[] = {place_in(box, 1, 1), place_in(box, -1, 1), place_in(box, -1, -1),
                                   place_in(box, 1, -1)};
    return obstruction_blocks(corners, 4, (struct vec2){0, 0}, place);
}

TEST(a_box_before_another_overlaps_it_and_a_wider_one_covers_it)
{
    static const struct {
        struct vec2 front_m, front_half_m, behind_m, behind_half_m;
        bool overlaps, covers;
    } cases[] = {
        {{10, 0}, {2, 1}, {30, 0}, {2, 1}, true, true},    /* before it */
        {{30, 0}, {2, 1}, {10, 0}, {2, 1}, false, false},  /* behind it */
        {{10, 0}, {2, 1}, {30, 0}, {2, 5}, true, false},   /* narrower */
        {{12, 0}, {3, 3}, {10, 0}, {2, 1}, true, false},   /* begins beside its end */
        {{10, 1.2}, {2, 1}, {30, 0}, {2, 1}, true, false}, /* from 0.2 m at 12 m on */
        {{10, 3}, {2, 1}, {30, 0}, {2, 1}, false, false},  /* from 2 m at 12 m on */
        {{10, -3}, {2, 1}, {30, 0}, {2, 1}, false, false}, /* to the other side */
        {{-10, 0}, {2, 1}, {30, 0}, {2, 1}, false, false}, /* on the other side */
        {{1, 0}, {2, 1}, {-30, 0}, {2, 1}, true, false},   /* the sensor is in it */
        {{-3, 0}, {2, 1}, {30, 0}, {2, 1}, true, false},   /* or near: it is 90 degrees wide */
        {{-10, 0}, {2, 1}, {1, 0}, {20, 20}, true, false}, /* the sensor is in the other */
        {{10, 0}, {0, 0}, {30, 0}, {0, 0}, true, false},   /* two points in line */
        {{10, 1}, {0, 0}, {30, 0}, {0, 0}, false, false},  /* and not in line */
        {{10, 0}, {0, 1}, {30, 2.9}, {0, 0}, true, true},  /* a wall from corner to corner */
        {{10, 0}, {0, 1}, {30, 3.1}, {0, 0}, false, false},
    };
    static const double turned_rad[] = {0, PI / 2, 2.5, -1};
    for (size_t i = 0; i < COUNT(cases); i++)
        for (int j = 0; j < 4; j++) {
            struct vec2 turn = vec2_heading(turned_rad[j]);
            struct box front = {vec2_turn(cases[i].front_m, turn), cases[i].front_half_m, turn};
            struct box behind = {vec2_turn(cases[i].behind_m, turn), cases[i].behind_half_m, turn};
            struct silhouette one = seen(&front), other = seen(&behind);
            bool overlaps = silhouette_overlaps(&one, &other);
            if (overlaps != cases[i].overlaps ||
                (overlaps && silhouette_covers(&one, &other)) != cases[i].covers)
                fail_msg("case %zu, turned by %g", i, turned_rad[j]);
        }
}

static struct vec2 at(double distance_m, double angle_rad)
{
    return vec2_scale(distance_m, vec2_heading(angle_rad));
}

static struct box any_box(uint64_t *random, double far_m)
{
    double turned_rad = (double)sample_integer(random, 4) * PI / 2;
    if (sample_bits(random) % 2 == 0)
        turned_rad = sample_between(random, -PI, PI);
    return (struct box){at(sample_between(random, 0, far_m), sample_between(random, -PI, PI)),
                        {sample_between(random, 0, 8), sample_between(random, 0, 2)},
                        vec2_heading(turned_rad)};
}

TEST(no_line_that_touches_is_called_clear_and_none_that_passes_hidden)
{
    uint64_t random = 1;
    int touched = 0, clear = 0, covered = 0;
    for (int i = 0; i < 300000; i++) {
        struct box front = any_box(&random, 40), behind = any_box(&random, 40);
        if (i % 2 == 0) /* about in line, and farther off */
            behind.centre_m = vec2_scale(sample_between(&random, 1, 3), front.centre_m);
        struct vec2 place =
            place_in(&behind, sample_between(&random, -1, 1), sample_between(&random, -1, 1));
        struct silhouette one = seen(&front), other = seen(&behind);
        bool overlaps = silhouette_overlaps(&one, &other);
        bool covers = overlaps && silhouette_covers(&one, &other);
        bool touch = blocks(&front, place);
        if (touch && !overlaps)
            fail_msg("pair %d: a sight line touches, and the boxes are called apart", i);
        if (!touch && covers)
            fail_msg("pair %d: a sight line passes, and the box is called hidden", i);
        touched += touch;
        clear += !overlaps;
        covered += covers;
    }
    assert_true(touched > 30000);
    assert_true(clear > 100000);
    assert_true(covered > 10000);
}

/* A line through a corner, exact but for rounding, is neither called clear nor hidden. */
TEST(a_place_in_line_with_a_corner_is_unsure)
{
    uint64_t random = 2;
    int corners = 0;
    for (int i = 0; i < 100000; i++) {
        struct box front = any_box(&random, i % 2 == 0 ? 40 : 1e6);
        struct silhouette one = seen(&front);
        if (vec2_same(one.right_m, one.left_m))
            continue;
        for (int corner = 0; corner < 4; corner++) {
            struct vec2 edge = place_in(&front, corner < 2 ? 1 : -1, corner % 2 ? 1 : -1);
            bool outermost = vec2_length(vec2_sub(edge, one.right_m)) < 1e-5 ||
                             vec2_length(vec2_sub(edge, one.left_m)) < 1e-5;
            struct silhouette other =
                silhouette_of_place(vec2_scale(sample_between(&random, 1, 3), edge));
            if (!silhouette_overlaps(&one, &other) ||
                (outermost && silhouette_covers(&one, &other)))
                fail_msg("box %d: a line through a corner is called clear of it, or hidden", i);
            corners += outermost;
        }
    }
    assert_true(corners > 100000);
}

TEST(a_box_is_no_nearer_and_no_farther_than_said)
{
    uint64_t random = 3;
    for (int i = 0; i < 100000; i++) {
        struct box box = any_box(&random, 40);
        struct silhouette all = seen(&box);
        double ahead = sample_between(&random, -1, 1), aside = sample_between(&random, -1, 1);
        double distance_m = vec2_length(place_in(&box, ahead, aside));
        assert_true(all.nearest_m < distance_m && distance_m < all.farthest_m);
    }
    struct box box = {{30, -4}, {3, 1}, vec2_heading(PI)};
    assert_close(seen(&box).nearest_m, hypot(27, 3), 1e-5);
    assert_close(seen(&box).farthest_m, hypot(33, 5), 1e-5);
}

TEST(a_box_that_reaches_between_two_directions_is_not_outside_of_them)
{
    uint64_t random = 4;
    int inside = 0, outside = 0;
    for (int i = 0; i < 100000; i++) {
        struct box box = any_box(&random, 40);
        double right_rad = sample_between(&random, -PI, PI);
        double wide_rad = sample_between(&random, 0, PI - 1e-3);
        struct vec2 right = vec2_heading(right_rad), left = vec2_heading(right_rad + wide_rad);
        struct vec2 place =
            place_in(&box, sample_between(&random, -1, 1), sample_between(&random, -1, 1));
        struct silhouette all = seen(&box), one = silhouette_of_place(place);
        bool between = vec2_cross(right, place) >= 0 && vec2_cross(place, left) >= 0;
        assert_true(silhouette_outside(&one, right, left) == !between);
        assert_false(between && silhouette_outside(&all, right, left));
        inside += between;
        outside += silhouette_outside(&all, right, left);
    }
    assert_true(inside > 20000 && outside > 20000);
}
