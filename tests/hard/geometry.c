/* Which side, which foot, what is in the way: hard cases 22 and 26 to 34, decided exactly. */
#include "hard.h"

#include "base/units.h"
#include "geometry/kinematics.h"
#include "geometry/mirror.h"
#include "geometry/obstruction.h"
#include "geometry/predicates.h"
#include "ideal/direct_echoes.h"

__extension__ typedef __int128 wide;

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};

static int sign_of(double value)
{
    return (value > 0) - (value < 0);
}

static double between_powers(uint64_t *random, int low, int high)
{
    int exponent = low + (int)(sample_bits(random) % (uint64_t)(high - low));
    return ldexp(sample_between(random, 1, 2), exponent);
}

static struct vec2 draw_place(uint64_t *random, double bound_m)
{
    double x = sample_between(random, -bound_m, bound_m);
    return (struct vec2){x, sample_between(random, -bound_m, bound_m)};
}

/* Rounds a place to a multiple of unit_m, so that the sums below stay exact. */
static struct vec2 on_grid(struct vec2 place, double unit_m)
{
    return (struct vec2){round(place.x / unit_m) * unit_m, round(place.y / unit_m) * unit_m};
}

TEST(a_length_is_within_its_bound)
{
    uint64_t random = 22;
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(x, 320);
    MPFR_DECL_INIT(y, 320);
    MPFR_DECL_INIT(exact, 320);
    for (int i = 0; i < hard_points(1000000); i++) {
        bool local = i % 2;
        struct vec2 way = {between_powers(&random, local ? -40 : -1022, local ? 23 : 1022),
                           between_powers(&random, local ? -40 : -1022, local ? 23 : 1022)};
        mpfr_set_d(x, way.x, MPFR_RNDN);
        mpfr_set_d(y, way.y, MPFR_RNDN);
        double length_m = local ? vec2_length(way) : elementary_hypot(way.x, way.y);
        mpfr_hypot(exact, x, y, MPFR_RNDN);
        ours = fmax(ours, error_ulp(length_m, exact));
        naive = fmax(naive, error_ulp(sqrt(way.x * way.x + way.y * way.y), exact));
    }
    hard_case("22", "lengths in range, and of any size", "ulp", naive, ours, 1.2);
}

static struct vec2 posts_of_a_row_without_length(int64_t *count)
{
    const struct box box = {.motion.position_m = {3, 4}, .heading = {0.6, 0.8}, .length_m = 2};
    const struct post_row row = {.from_x = 0.5, .to_x = 0.5, .spacing_m = 4};
    int64_t first;
    reflectors_posts_within(&box, &row, (struct vec2){0, 0}, 100, &first, count);
    return reflectors_post_place(&box, &row, first);
}

/* Hard case 26: every question about something of size 0 has one fixed answer, which is no NaN. */
TEST(what_has_no_size_has_a_fixed_answer)
{
    const struct vec2 o = {0, 0}, p = {1, 0}, q = {2, 0}, up = {0, 1}, off = {1, 1};
    const struct vec2 point[] = {p, p, p, p}, line[] = {p, p, off, off}, flat[] = {o, o, q, q};
    struct vec2 foot;
    int64_t posts;
    struct vec2 post = posts_of_a_row_without_length(&posts);
    struct kinematics here = kinematics_of(p, up, up, p, o);
    struct motion still = motion_drive(p, 1, 0, 0, 0, 0);
    const double no_length = vec2_length(o);
    const struct {
        double naive, ours, fixed;
    } rows[] = {
        {1, obstruction_segments_touch(p, p, p, p), 1},
        {0, obstruction_segments_touch(p, p, q, q), 0},
        {1, obstruction_segments_touch(p, p, o, q), 1},
        {1, obstruction_segments_touch(o, q, p, p), 1},
        {0, obstruction_segments_touch(off, off, o, q), 0},
        {0, obstruction_segments_touch(o, p, q, q), 0},
        {1, obstruction_segments_touch(q, q, o, q), 1},
        {0, obstruction_blocks(point, 4, o, q), 1},
        {0, obstruction_blocks(point, 4, up, off), 0},
        {0, obstruction_blocks(point, 4, p, p), 1},
        {0, obstruction_blocks(line, 4, o, (struct vec2){2, 1}), 1},
        {0, obstruction_blocks(line, 4, o, up), 0},
        {0, obstruction_blocks(flat, 4, p, (struct vec2){9, 0}), 1},
        {0, obstruction_blocks(flat, 4, (struct vec2){3, 0}, (struct vec2){9, 0}), 0},
        {0, predicates_orientation(p, p, off), 0},
        {0, predicates_orientation(off, p, p), 0},
        {0, predicates_orientation(p, off, p), 0},
        {0, predicates_orientation(p, p, p), 0},
        {0, predicates_along(p, p, up), 0},
        {0, predicates_along(o, off, o), 0},
        {no_length / no_length, mirror_specular_point(p, p, up, 0, o, &foot), 0},
        {no_length / no_length, mirror_specular_point(p, p, up, 0, p, &foot), 0},
        {1, mirror_specular_point(p, q, p, 0, p, &foot), 0},
        {1, mirror_specular_point(p, q, p, 0.75, (struct vec2){1.5, -1}, &foot), 0},
        {1, mirror_specular_point(o, (struct vec2){1e-170, 0}, p, 0, (struct vec2){0, -1}, &foot),
         0},
        {0, here.range_m, 0},
        {no_length / no_length, here.azimuth_rad, 0},
        {no_length / no_length, here.range_rate_mps, 0},
        {no_length / no_length, directivity_angle_rad(o, up), 0},
        {no_length / no_length, directivity_angle_rad(o, vec2_scale(-1, o)), 0},
        {no_length / no_length, directivity_visibility(VISIBILITY_LINEAR, 1, 1, 1), 1},
        {no_length / no_length, directivity_visibility(VISIBILITY_RAISED_COSINE, 0, 0, 0), 1},
        {1, (double)posts, 1},
        {no_length / no_length, post.x, 3.6},
        {no_length / no_length, still.position_m.x, 1},
        {no_length / no_length, motion_drive_length_m(0, 0, 0), 0},
        {no_length / no_length, units_si(0), 1},
    };
    double naive = 0, ours = 0;
    for (size_t i = 0; i < COUNT(rows); i++) {
        naive += rows[i].naive != rows[i].fixed;
        ours += rows[i].ours != rows[i].fixed;
    }
    hard_case("26", "37 answers about what has no size", "wrong", naive, ours, 0);
}

static int plain_sign(struct vec2 a, struct vec2 b, struct vec2 c)
{
    return sign_of((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/* Triples of points: a corner of the grid beside the diagonal, and steps of an integer lattice
 * along a line. */
TEST(near_collinear_points_have_their_side)
{
    uint64_t random = 27;
    double naive = 0, ours = 0;
    for (int i = 0; i < 256; i++)
        for (int j = 0; j < 256; j++) {
            struct vec2 a = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53}, b = {12, 12}, c = {24, 24};
            naive += plain_sign(a, b, c) != sign_of(j - i);
            ours += predicates_orientation(a, b, c) != sign_of(j - i) ||
                    predicates_orientation(b, c, a) != sign_of(j - i);
        }
    for (int i = 0; i < hard_points(1000000); i++) {
        int64_t x = sample_integer(&random, INT64_C(1) << 40);
        int64_t y = sample_integer(&random, INT64_C(1) << 40);
        int64_t step_x = sample_integer(&random, INT64_C(1) << 32);
        int64_t step_y = sample_integer(&random, INT64_C(1) << 32);
        int64_t m = sample_integer(&random, 1 << 18), n = sample_integer(&random, 1 << 18);
        int64_t bx = m * step_x, by = m * step_y;
        int64_t cx = n * step_x + sample_integer(&random, 1);
        int64_t cy = n * step_y + sample_integer(&random, 1);
        wide left = (wide)bx * cy, right = (wide)by * cx;
        int exact = (left > right) - (left < right);
        struct vec2 a = {(double)x, (double)y}, b = {(double)(x + bx), (double)(y + by)};
        struct vec2 c = {(double)(x + cx), (double)(y + cy)};
        naive += plain_sign(a, b, c) != exact;
        ours +=
            predicates_orientation(a, b, c) != exact || predicates_orientation(c, b, a) != -exact;
    }
    hard_case("27", "sides of 1e6 near-collinear triples", "wrong", naive, ours, 0);
}

static int exact_sign(struct vec2 a, struct vec2 b, struct vec2 c, mpfr_t *work)
{
    const double first[] = {a.x, b.x, c.x}, second[] = {b.y, c.y, a.y};
    const double third[] = {a.y, b.y, c.y}, fourth[] = {b.x, c.x, a.x};
    mpfr_set_zero(work[0], 1);
    for (int i = 0; i < 3; i++) {
        mpfr_set_d(work[1], first[i], MPFR_RNDN);
        mpfr_mul_d(work[1], work[1], second[i], MPFR_RNDN);
        mpfr_add(work[0], work[0], work[1], MPFR_RNDN);
        mpfr_set_d(work[1], third[i], MPFR_RNDN);
        mpfr_mul_d(work[1], work[1], fourth[i], MPFR_RNDN);
        mpfr_sub(work[0], work[0], work[1], MPFR_RNDN);
    }
    return mpfr_sgn(work[0]);
}

/* Hard case 28: all 62 196 triples of the first 73 points, written as multiples and as
 * quotients. */
TEST(decimal_road_points_have_their_side)
{
    struct vec2 road[2][73];
    for (int k = 0; k < 73; k++) {
        road[0][k] = (struct vec2){(k + 1) * 0.1, (k + 1) * 0.3};
        road[1][k] = (struct vec2){(k + 1) / 10.0, 3 * (k + 1) / 10.0};
    }
    double naive = 0, ours = 0;
    mpfr_t work[2];
    mpfr_inits2(320, work[0], work[1], (mpfr_ptr)NULL);
    for (int spelling = 0; spelling < 2; spelling++)
        for (int i = 0; i < 73; i++)
            for (int j = i + 1; j < 73; j++)
                for (int k = j + 1; k < 73; k++) {
                    struct vec2 *p = road[spelling];
                    int exact = exact_sign(p[i], p[j], p[k], work);
                    naive += plain_sign(p[i], p[j], p[k]) != exact;
                    ours += predicates_orientation(p[i], p[j], p[k]) != exact;
                }
    mpfr_clears(work[0], work[1], (mpfr_ptr)NULL);
    hard_case("28", "sides of decimal road points", "wrong", naive, ours, 0);
}

static bool strict_cross(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return plain_sign(p, q, a) * plain_sign(p, q, b) < 0 &&
           plain_sign(a, b, p) * plain_sign(a, b, q) < 0;
}

/* Touch by the parameters at which the lines p-q and a-b meet, with contracted products as some
 * builds have them. */
static bool parametric_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    struct vec2 r = vec2_sub(q, p), s = vec2_sub(b, a), w = vec2_sub(a, p);
    double det = fma(r.x, s.y, -(r.y * s.x));
    double t = fma(w.x, s.y, -(w.y * s.x)) / det, u = fma(w.x, r.y, -(w.y * r.x)) / det;
    return t >= 0 && t <= 1 && u >= 0 && u <= 1;
}

/* Hard cases 29 and 30: rays aimed exactly at a corner of a turned car. On the grid of 2^-36 m the
 * target, as far behind the corner as the sensor is before it, is exact. */
TEST(no_ray_leaks_through_a_corner)
{
    uint64_t random = 29;
    double strict = 0, parametric = 0, ours = 0;
    for (int i = 0; i < hard_points(1000000); i++) {
        const struct box box = {.motion.position_m = draw_place(&random, 20),
                                .heading = vec2_heading(sample_between(&random, -PI, PI)),
                                .length_m = sample_between(&random, 3, 12),
                                .width_m = sample_between(&random, 1.5, 2.5)};
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        for (int k = 0; k < 4; k++)
            corner[k] = on_grid(corner[k], 0x1p-36);
        int k = i % 4;
        struct vec2 sensor = on_grid(draw_place(&random, 50), 0x1p-36);
        struct vec2 target = vec2_add(corner[k], vec2_sub(corner[k], sensor));
        struct vec2 before = corner[(k + 3) % 4], after = corner[(k + 1) % 4];
        strict += !strict_cross(sensor, target, before, corner[k]) &&
                  !strict_cross(sensor, target, corner[k], after);
        parametric += !parametric_touch(sensor, target, before, corner[k]) &&
                      !parametric_touch(sensor, target, corner[k], after);
        ours += !obstruction_segments_touch(sensor, target, before, corner[k]) ||
                !obstruction_segments_touch(sensor, target, corner[k], after) ||
                !obstruction_blocks(corner, 4, sensor, target);
    }
    hard_case("29", "rays through a corner that leak", "wrong", strict, ours, 0);
    hard_case("30", "the same, products contracted", "wrong", parametric, ours, 0);
}

/* Hard case 31: two rails of at least 4 m that share a rounded vertex, and rays that pass it within
 * rounding from 1 m on to either side. */
TEST(no_ray_leaks_through_a_joint)
{
    uint64_t random = 31;
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(1000000); i++) {
        struct vec2 along = vec2_heading(sample_between(&random, -PI, PI));
        struct vec2 joint = draw_place(&random, 100);
        struct vec2 a = vec2_sub(joint, vec2_scale(sample_between(&random, 4, 8), along));
        struct vec2 b = vec2_add(joint, vec2_scale(sample_between(&random, 4, 8), along));
        struct vec2 own = {sample_between(&random, -3, 3), sample_between(&random, 1, 50)};
        struct vec2 sensor = vec2_add(joint, vec2_turn(own, along));
        struct vec2 target = vec2_sub(joint, vec2_sub(sensor, joint));
        naive += !strict_cross(sensor, target, a, joint) && !strict_cross(sensor, target, joint, b);
        ours += !obstruction_segments_touch(sensor, target, a, joint) &&
                !obstruction_segments_touch(sensor, target, joint, b);
    }
    hard_case("31", "rays through a rail's joint that leak", "wrong", naive, ours, 0);
}

/* A frame in which the object "e" carries a sensor, and the other objects of the frame. */
struct scene {
    struct frame frame;
    struct sensor sensor;
};

static void begin_scene(struct scene *scene, struct vec2 sensor, double yaw_rad)
{
    scene->frame.arena = check_arena();
    frame_clear(&scene->frame);
    scene->frame.scene = "s";
    scene->frame.ego = "e";
    scene->frame.interval_s = 1;
    scene->frame.sections |= CARRY_ACCOUNT;
    scene->sensor = (struct sensor){.name = "front", .range_max_m = 1000, .field_of_view_rad = PI};
    *list_add(&scene->frame.objects, scene->frame.arena) = (struct object){
        .id = "e", .class = "car", .x_m = sensor.x, .y_m = sensor.y, .yaw_rad = yaw_rad};
}

/* Adds an object with a reflector set of its own. */
static struct reflector_set *add_object(struct scene *scene, struct object object)
{
    *list_add(&scene->frame.objects, scene->frame.arena) = object;
    struct reflector_set *set = list_add(&scene->frame.reflectors, scene->frame.arena);
    *set = (struct reflector_set){.model = object.id, .blocks = true};
    *list_add(&set->objects, scene->frame.arena) = object.id;
    return set;
}

static void add_point(struct scene *scene, struct reflector_set *set, double x, double y)
{
    *list_add(&set->points, scene->frame.arena) = (struct point_reflector){.name = "p",
                                                                           .x = x,
                                                                           .y = y,
                                                                           .full_rad = PI,
                                                                           .zero_rad = PI,
                                                                           .shape = VISIBILITY_HARD,
                                                                           .ercs = 1};
}

static void add_plane(struct scene *scene, struct reflector_set *set, double from, double to)
{
    *list_add(&set->planes, scene->frame.arena) = (struct plane_reflector){
        .name = "w", .from_x = from, .from_y = -0.5, .to_x = to, .to_y = -0.5, .ercs = 1};
}

static void look(struct scene *scene)
{
    struct look seen;
    assert_done(look_begin, &seen, &scene->frame, &scene->sensor, &everything, 0);
    direct_echoes_add(&seen);
}

static size_t lost_for(const struct scene *scene, enum loss reason)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->frame.lost.count; i++)
        if (frame_loss_of(scene->frame.lost.items[i].reason) == reason)
            count += scene->frame.lost.items[i].echoes.count;
    return count;
}

TEST(no_object_hides_its_own_outline)
{
    uint64_t random = 32;
    struct scene scene = {0};
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(200000) / 20; i++) {
        begin_scene(&scene, (struct vec2){0, 0}, 0);
        struct object car = {.id = "a",
                             .class = "car",
                             .x_m = sample_between(&random, 10, 100),
                             .y_m = sample_between(&random, -9, 9),
                             .yaw_rad = sample_between(&random, -PI, PI),
                             .length_m = 4.5,
                             .width_m = 1.8};
        struct reflector_set *set = add_object(&scene, car);
        const struct box box = {.motion.position_m = {car.x_m, car.y_m},
                                .heading = vec2_heading(car.yaw_rad),
                                .length_m = 4.5,
                                .width_m = 1.8};
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        for (int k = 0; k < 20; k++) {
            double part = sample_between(&random, -0.5, 0.5), side = k % 2 ? 0.5 : -0.5;
            double x = k % 4 < 2 ? part : side, y = k % 4 < 2 ? side : part;
            add_point(&scene, set, x, y);
            naive +=
                obstruction_blocks(corner, 4, (struct vec2){0, 0}, motion_box_place(&box, x, y));
        }
        look(&scene);
        ours += (double)(20 - scene.frame.echoes.count);
    }
    hard_case("32", "points hidden by their own outline", "wrong", naive, ours, 0);
}

/* Hard case 29 in a scene: a point as far behind a corner of a car as the sensor is before it. The
 * car stands along the axes at a place of few binary digits, so the corner is exact. */
TEST(no_point_is_seen_through_a_corner)
{
    uint64_t random = 29;
    struct scene scene = {0};
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(100000); i++) {
        struct vec2 sensor = on_grid(draw_place(&random, 50), 0x1p-36);
        struct object car = {.id = "a", .class = "car", .length_m = 4.5, .width_m = 1.75};
        struct vec2 place = on_grid(draw_place(&random, 20), 0x1p-4);
        car.x_m = place.x;
        car.y_m = place.y;
        const struct box box = {.motion.position_m = place,
                                .heading = vec2_heading(0),
                                .length_m = car.length_m,
                                .width_m = car.width_m};
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        int k = i % 4;
        struct vec2 hidden = vec2_add(corner[k], vec2_sub(corner[k], sensor));
        begin_scene(&scene, sensor, 0);
        add_object(&scene, car);
        struct object point = {.id = "b", .x_m = hidden.x, .y_m = hidden.y};
        add_point(&scene, add_object(&scene, point), 0, 0);
        scene.frame.reflectors.items[1].blocks = false;
        look(&scene);
        bool plain_blocks = false;
        for (int side = 0; side < 4; side++)
            plain_blocks |= strict_cross(sensor, hidden, corner[side], corner[(side + 1) % 4]);
        bool in_view = lost_for(&scene, LOSS_BLOCKED) + scene.frame.echoes.count > 0;
        naive += in_view && !plain_blocks;
        ours += (double)scene.frame.echoes.count;
    }
    hard_case("hidden", "points behind a corner that become targets", "wrong", naive, ours, 0);
}

/* The number of feet on two sides that a plain test finds, ends included. */
static int plain_feet(struct vec2 a, struct vec2 joint, struct vec2 b, struct vec2 sensor)
{
    struct vec2 first = vec2_sub(joint, a), second = vec2_sub(b, joint);
    bool before = vec2_dot(vec2_sub(sensor, joint), first) <= 0;
    bool beyond = vec2_dot(vec2_sub(sensor, joint), second) >= 0;
    return before + beyond;
}

/* A wall in two pieces: two sides of one object, or of two objects whose ends coincide as
 * doubles. */
static struct vec2 build_wall(struct scene *scene, uint64_t *random, bool straight, double yaw_rad)
{
    struct object one = {.id = "a",
                         .class = "wall",
                         .x_m = sample_between(random, -900, 900),
                         .y_m = sample_between(random, -900, 900),
                         .yaw_rad = yaw_rad,
                         .length_m = sample_between(random, 4, 40),
                         .width_m = 1};
    double part = sample_between(random, -0.4, 0.4);
    struct vec2 heading = vec2_heading(yaw_rad);
    struct vec2 centre = on_grid((struct vec2){one.x_m, one.y_m}, straight ? 0x1p-10 : 0x1p-40);
    if (straight)
        one.length_m = 16;
    one.x_m = centre.x;
    one.y_m = centre.y;
    const struct box box = {{.position_m = centre}, heading, one.length_m, 1};
    struct object two = one;
    two.id = "b";
    two.length_m = straight ? 8 : sample_between(random, 4, 40);
    struct vec2 apart = vec2_scale((one.length_m + two.length_m) / 2, heading);
    two.x_m += apart.x;
    two.y_m += apart.y;
    const struct box next = {{.position_m = {two.x_m, two.y_m}}, heading, two.length_m, 1};
    struct vec2 end = motion_box_place(&box, 0.5, -0.5);
    struct reflector_set *set = add_object(scene, one);
    if (vec2_same(end, motion_box_place(&next, -0.5, -0.5))) {
        add_plane(scene, set, -0.5, 0.5);
        set = add_object(scene, two);
        add_plane(scene, set, -0.5, 0.5);
        return end;
    }
    add_plane(scene, set, -0.5, part);
    add_plane(scene, set, part, 0.5);
    return motion_box_place(&box, part, -0.5);
}

/* Hard case 33: the sensor stands before the joint but for rounding; every eighth wall is straight
 * and has the sensor exactly before its joint. */
TEST(every_joint_has_one_foot)
{
    uint64_t random = 33;
    struct scene scene = {0};
    double naive = 0, ours = 0, objects = 0;
    for (int i = 0; i < hard_points(1000000); i++) {
        bool straight = i % 8 == 0;
        double yaw_rad = straight ? 0 : sample_between(&random, -PI, PI);
        begin_scene(&scene, (struct vec2){0, 0}, yaw_rad + PI / 2);
        struct vec2 joint = build_wall(&scene, &random, straight, yaw_rad);
        struct vec2 along = vec2_heading(yaw_rad);
        double range_m = straight ? 32 : sample_between(&random, 1, 200);
        struct vec2 sensor = vec2_sub(joint, vec2_scale(range_m, vec2_left(along)));
        scene.frame.objects.items[0].x_m = sensor.x;
        scene.frame.objects.items[0].y_m = sensor.y;
        struct vec2 a = vec2_sub(joint, vec2_scale(4, along));
        naive += plain_feet(a, joint, vec2_add(joint, vec2_scale(5, along)), sensor) != 1;
        look(&scene);
        ours += scene.frame.echoes.count != 1;
        objects += scene.frame.objects.count == 3;
    }
    assert_true(objects > 0.2 * hard_points(1000000));
    hard_case("33", "joints of a wall without just one foot", "wrong", naive, ours, 0);
}

/* Hard case 33 where ends differ: two boxes whose ends coincide only up to rounding, and a sensor
 * 1e-12 m beside the joint. */
TEST(a_joint_up_to_rounding_has_one_foot_beside_it)
{
    uint64_t random = 133;
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(1000000); i++) {
        struct vec2 along = vec2_heading(sample_between(&random, -PI, PI)), foot;
        double lengths_m[] = {sample_between(&random, 4, 40), sample_between(&random, 4, 40)};
        struct box one = {{.position_m = draw_place(&random, 900)}, along, lengths_m[0], 1};
        struct box two = {
            {.position_m = vec2_add(one.motion.position_m,
                                    vec2_scale((lengths_m[0] + lengths_m[1]) / 2, along))},
            along,
            lengths_m[1],
            1};
        struct vec2 end = motion_box_place(&one, 0.5, -0.5);
        struct vec2 begin = motion_box_place(&two, -0.5, -0.5);
        double range_m = sample_between(&random, 1, 200);
        struct vec2 before = vec2_sub(end, vec2_scale(range_m, vec2_left(along)));
        struct vec2 beside = vec2_add(before, vec2_scale(i % 2 ? 1e-12 : -1e-12, along));
        struct vec2 from = motion_box_place(&one, -0.5, -0.5);
        struct vec2 to = motion_box_place(&two, 0.5, -0.5);
        naive += mirror_specular_point(from, end, along, 0, before, &foot) +
                     mirror_specular_point(begin, to, along, 0, before, &foot) !=
                 1;
        ours += mirror_specular_point(from, end, along, 0, beside, &foot) +
                    mirror_specular_point(begin, to, along, 0, beside, &foot) !=
                1;
    }
    hard_case("33 apart", "ends that differ: at, and 1e-12 m beside", "wrong", naive, ours, 0);
}

/* A side along an axis, and another object whose corner or side lies exactly on the sight line to
 * its foot. */
TEST(an_outline_along_the_sight_line_blocks_the_foot)
{
    uint64_t random = 34;
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(1000000); i++) {
        struct vec2 a = {sample_between(&random, 20, 60), sample_between(&random, 1, 9)};
        struct vec2 b = {a.x, sample_between(&random, -9, -1)}, along = {0, -1}, foot;
        struct vec2 sensor = {sample_between(&random, -9, 9), sample_between(&random, -1, 1)};
        double aside_m = i % 2 ? 1.8 : -1.8;
        struct vec2 corner[] = {{12, sensor.y},
                                {16, i % 3 ? sensor.y : sensor.y + aside_m},
                                {16, sensor.y + aside_m},
                                {12, sensor.y + aside_m}};
        if (i % 4 > 1) {
            struct vec2 *all[] = {&a, &b, &sensor, &corner[0], &corner[1], &corner[2], &corner[3]};
            for (size_t k = 0; k < COUNT(all); k++)
                *all[k] = vec2_left(*all[k]);
            along = vec2_left(along);
        }
        assert_true(mirror_specular_point(a, b, along, 0, sensor, &foot));
        struct vec2 edge = vec2_sub(b, a);
        double part = vec2_dot(vec2_sub(sensor, a), edge) / vec2_dot(edge, edge);
        struct vec2 plain = vec2_add(a, vec2_scale(part, edge));
        naive += !obstruction_blocks(corner, 4, sensor, plain);
        ours += !obstruction_blocks(corner, 4, sensor, foot);
    }
    hard_case("foot", "outlines along its sight line missed", "wrong", naive, ours, 0);
}

/* How far the foot is off the line of sight, in ulp of the largest coordinate or distance. */
static double foot_error_ulp(struct vec2 a, struct vec2 b, struct vec2 sensor, struct vec2 foot,
                             mpfr_t *w)
{
    double sizes[] = {fabs(a.x), fabs(a.y), fabs(b.x), fabs(b.y), fabs(sensor.x), fabs(sensor.y)};
    double most = 0;
    for (size_t i = 0; i < COUNT(sizes); i++)
        most = fmax(most, sizes[i]);
    int exponent;
    frexp(most, &exponent);
    /* across = (a.y - b.y, b.x - a.x); off = (foot - sensor) x across / |across| */
    mpfr_set_d(w[0], a.y, MPFR_RNDN);
    mpfr_sub_d(w[0], w[0], b.y, MPFR_RNDN);
    mpfr_set_d(w[1], b.x, MPFR_RNDN);
    mpfr_sub_d(w[1], w[1], a.x, MPFR_RNDN);
    mpfr_set_d(w[2], foot.x, MPFR_RNDN);
    mpfr_sub_d(w[2], w[2], sensor.x, MPFR_RNDN);
    mpfr_set_d(w[3], foot.y, MPFR_RNDN);
    mpfr_sub_d(w[3], w[3], sensor.y, MPFR_RNDN);
    mpfr_mul(w[2], w[2], w[1], MPFR_RNDN);
    mpfr_mul(w[3], w[3], w[0], MPFR_RNDN);
    mpfr_sub(w[2], w[2], w[3], MPFR_RNDN);
    mpfr_hypot(w[3], w[0], w[1], MPFR_RNDN);
    mpfr_div(w[2], w[2], w[3], MPFR_RNDN);
    mpfr_mul_2si(w[2], w[2], 53 - exponent, MPFR_RNDN);
    return fabs(mpfr_get_d(w[2], MPFR_RNDN));
}

TEST(a_turned_foot_is_off_its_sight_line_by_rounding_alone)
{
    uint64_t random = 35;
    double naive = 0, ours = 0;
    mpfr_t w[4];
    mpfr_inits2(320, w[0], w[1], w[2], w[3], (mpfr_ptr)NULL);
    for (int i = 0; i < hard_points(1000000); i++) {
        struct vec2 along = vec2_heading(sample_between(&random, -PI, PI)), foot;
        struct vec2 a = draw_place(&random, i % 2 ? 50 : 1000);
        double length_m = between_powers(&random, -3, 8);
        struct vec2 b = vec2_add(a, vec2_scale(length_m, along));
        struct vec2 own = {sample_between(&random, 0.1, 0.9) * length_m,
                           -between_powers(&random, -7, 8)};
        struct vec2 sensor = vec2_add(a, vec2_turn(own, along));
        assert_true(mirror_specular_point(a, b, along, 0, sensor, &foot));
        struct vec2 edge = vec2_sub(b, a);
        double part = vec2_dot(vec2_sub(sensor, a), edge) / vec2_dot(edge, edge);
        struct vec2 plain = vec2_add(a, vec2_scale(part, edge));
        naive = fmax(naive, foot_error_ulp(a, b, sensor, plain, w));
        ours = fmax(ours, foot_error_ulp(a, b, sensor, foot, w));
    }
    mpfr_clears(w[0], w[1], w[2], w[3], (mpfr_ptr)NULL);
    hard_case("foot, turned", "foot off the line of sight", "ulp", naive, ours, 2);
}

/* Hard case 34: points at the sensor's own place, and beside it by anything from 2^-1074 m up. */
TEST(nothing_at_range_zero_is_infinite)
{
    uint64_t random = 36;
    double naive = 0, ours = 0;
    const struct radar_equation law = {.exponent = 2,
                                       .calibration_ercs = 1,
                                       .calibration_range_m = 100,
                                       .range_floor_m = 0.5,
                                       .threshold = 1};
    for (int i = 0; i < hard_points(1000000); i++) {
        struct vec2 sensor = i % 3 ? (struct vec2){0, 0} : draw_place(&random, 1e3);
        struct vec2 beside = {ldexp(1, -(i % 1075)), i % 2 ? 0 : ldexp(-1, -(i % 1074))};
        struct vec2 point = i % 4 ? vec2_add(sensor, beside) : sensor;
        struct kinematics sight = kinematics_of(
            sensor, draw_place(&random, 50), (struct vec2){1, 0}, point, draw_place(&random, 50));
        struct vec2 line = vec2_sub(point, sensor);
        naive += !isfinite(line.y / vec2_length(line)) || !isfinite(1 / vec2_dot(line, line));
        ours += !isfinite(sight.range_m) || !isfinite(sight.azimuth_rad) ||
                !isfinite(sight.range_rate_mps) ||
                !isfinite(radar_reference_amplitude(&law, sight.range_m));
    }
    hard_case("34", "not finite at coincident points", "wrong", naive, ours, 0);
}

/* Hard case 34 in a look without a blind range: a point at the sensor's own place is out of range,
 * and one beside it has a finite echo. */
TEST(a_look_at_its_own_place_is_out_of_range)
{
    uint64_t random = 37;
    struct scene scene = {0};
    double ours = 0;
    int looks = hard_points(100000);
    for (int i = 0; i < looks; i++) {
        struct vec2 place = draw_place(&random, 1e3);
        begin_scene(&scene, place, sample_between(&random, -PI, PI));
        add_point(&scene,
                  add_object(&scene, (struct object){.id = "a", .x_m = place.x, .y_m = place.y}), 0,
                  0);
        look(&scene);
        ours += scene.frame.echoes.count != 0 || lost_for(&scene, LOSS_OUT_OF_RANGE) != 1;
    }
    hard_case("34 look", "looks at the sensor's own place", "wrong", looks, ours, 0);
}

/* A sensor inside a turned box sees a point that is inside with it and not a point outside. */
TEST(a_sensor_inside_an_object_sees_the_inside_alone)
{
    uint64_t random = 38;
    struct scene scene = {0};
    double naive = 0, ours = 0;
    for (int i = 0; i < hard_points(100000); i++) {
        struct object around = {
            .id = "a", .yaw_rad = sample_between(&random, -PI, PI), .length_m = 12, .width_m = 3};
        struct box box = {.heading = vec2_heading(around.yaw_rad), .length_m = 12, .width_m = 3};
        struct vec2 sensor = motion_box_place(&box, sample_between(&random, -0.45, -0.05),
                                              sample_between(&random, -0.4, 0.4));
        begin_scene(&scene, sensor, around.yaw_rad);
        add_object(&scene, around);
        struct vec2 inside = motion_box_place(&box, sample_between(&random, 0.05, 0.45), 0.1);
        struct vec2 beyond = vec2_add(sensor, vec2_scale(40, vec2_sub(inside, sensor)));
        add_point(&scene,
                  add_object(&scene, (struct object){.id = "b", .x_m = inside.x, .y_m = inside.y}),
                  0, 0);
        add_point(&scene,
                  add_object(&scene, (struct object){.id = "c", .x_m = beyond.x, .y_m = beyond.y}),
                  0, 0);
        scene.frame.reflectors.items[1].blocks = false;
        look(&scene);
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        int crossed = 0;
        for (int k = 0; k < 4; k++)
            crossed += strict_cross(corner[k], corner[(k + 1) % 4], inside, beyond);
        naive += crossed != 0;
        ours += scene.frame.echoes.count != 1 || lost_for(&scene, LOSS_BLOCKED) != 1 ||
                scene.frame.echoes.items[0].id.object[0] != 'b';
    }
    hard_case("inside", "a sensor inside an object sees out", "wrong", naive, ours, 0);
}
