#include "support/look_scene.h"

#include "base/sort.h"
#include "frame/frame_order.h"
#include "geometry/obstruction.h"
#include "ideal/ghost_echoes.h"
#include "propagation/reflection.h"

static struct object *add_box(struct scene *scene, const char *id, double x_m, double y_m,
                              double length_m, double width_m)
{
    struct object *object = add_object(scene, id, x_m, y_m);
    object->length_m = length_m;
    object->width_m = width_m;
    return object;
}

/* Adds a mirror on the right side of an object: of one that heads along +x it faces -y. */
static void add_right_mirror(struct reflector_set *set, double reflection)
{
    *list_add(&set->mirrors, check_arena()) = (struct mirror_plane){
        .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = -0.5, .reflection = reflection};
}

static struct object *add_wall(struct scene *scene, const char *id, double from_x_m, double to_x_m,
                               double y_m)
{
    struct object *wall =
        add_box(scene, id, (from_x_m + to_x_m) / 2, y_m + 0.25, to_x_m - from_x_m, 0.5);
    add_right_mirror(add_set(scene, id), 0.9);
    return wall;
}

static struct point_reflector *add_pole(struct reflector_set *set)
{
    struct point_reflector *pole = add_point(set);
    pole->ercs = 1;
    return pole;
}

static void add_standard_pole(struct scene *scene)
{
    add_box(scene, "o", 30, -2, 0.2, 0.2)->vx_mps = -5;
    add_pole(add_set(scene, "o"));
}

static struct look ghosts_at(struct scene *scene, double time_s)
{
    struct look look;
    struct diag diag = {0};
    struct frame *frame = &scene->frame;
    frame->echoes.count = 0;
    frame->counts.count = 0;
    if (look_begin(&look, frame, &scene->sensor, &scene->selection, time_s, &diag) != 0)
        fail_msg("%s", diag.text);
    ghost_echoes_add(&look);
    sort_list(&frame->echoes, frame_order_echoes, check_arena());
    return look;
}

static const struct echo *ghost_of(const struct scene *scene, enum path path)
{
    for (size_t i = 0; i < scene->frame.echoes.count; i++)
        if (scene->frame.echoes.items[i].id.path == path)
            return &scene->frame.echoes.items[i];
    return NULL;
}

#define OUT (1 << PATH_WALL_OBJECT)
#define BACK (1 << PATH_OBJECT_WALL)
#define BOTH (1 << PATH_WALL_OBJECT_WALL)

static int paths_of(struct scene *scene)
{
    int paths = 0;
    ghosts_at(scene, 10);
    for (size_t i = 0; i < scene->frame.echoes.count; i++)
        paths |= 1 << scene->frame.echoes.items[i].id.path;
    return paths;
}

/* The case to check against of MODEL 14.1. */
SCENE_TEST(a_pole_before_a_wall_has_the_ghosts_of_the_model)
{
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    ghosts_at(scene, 10);
    static const struct {
        enum path path;
        double range_m, rate_mps, azimuth_deg, departure_deg, relative_db;
    } cases[] = {
        {PATH_WALL_OBJECT, 30.844685, -4.866171, -3.814075, 18.434949, -1.353466},
        {PATH_OBJECT_WALL, 30.844685, -4.866171, 18.434949, -3.814075, -1.353466},
        {PATH_WALL_OBJECT_WALL, 31.622777, -4.743416, 18.434949, 0, -2.706931},
    };
    assert_int_equal(scene->frame.echoes.count, COUNT(cases));
    assert_int_equal(scene->frame.counts.items[0].paths.count, COUNT(cases));
    assert_int_equal(scene->frame.lost.count, 0);
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct echo *ghost = &scene->frame.echoes.items[i];
        assert_int_equal(ghost->id.path, cases[i].path);
        assert_string_equal(ghost->id.object, "o");
        assert_string_equal(ghost->id.reflector, "pole");
        assert_string_equal(ghost->id.mirror, "w");
        assert_int_equal(ghost->id.number, 1);
        assert_close(ghost->range_m, cases[i].range_m, 1e-6);
        assert_close(ghost->range_rate_mps, cases[i].rate_mps, 1e-6);
        assert_close(ghost->azimuth_rad / DEGREE, cases[i].azimuth_deg, 1e-6);
        assert_close(ghost->departure_azimuth_rad / DEGREE, cases[i].departure_deg, 1e-6);
        double spread = sqrt(904) / ghost->range_m;
        assert_close(20 * log10(ghost->ercs * spread * spread), cases[i].relative_db, 1e-6);
        assert_close(ghost->time_s, 10, 0);
        assert_true(ghost->effects == EFFECT_BIT(EFFECT_GHOSTS));
        assert_int_equal(scene->frame.counts.items[0].paths.items[i].echoes, 1);
    }
}

SCENE_TEST(bounces_and_the_selection_say_which_ghosts_there_are)
{
    static const int paths[] = {0, 0, OUT | BACK, OUT | BACK | BOTH};
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    for (int bounces = 0; bounces <= 3; bounces++) {
        scene->sensor.bounces = bounces;
        assert_int_equal(paths_of(scene), paths[bounces]);
    }
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_GHOSTS);
    assert_int_equal(paths_of(scene), 0);
}

/* The legs of the standard case are (0, 0) to (12, 4) and on to (30, -2), and (0, 0) to (30, -2).
 */
SCENE_TEST(every_leg_must_be_free)
{
    static const struct {
        double x_m, y_m;
        int paths;
    } cases[] = {
        {6, 2, 0},        {21, 1, 0},      {15, -1, BOTH}, {15, 8, 7 << 1},
        {25, -8, 7 << 1}, {15, 1, 7 << 1}, {12, 3.9, 0},   {12, 2.9, 7 << 1},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        add_standard_pole(scene);
        add_wall(scene, "w", -10, 50, 4);
        add_box(scene, "b", cases[i].x_m, cases[i].y_m, 0.4, 0.4);
        add_set(scene, "b");
        if (paths_of(scene) != cases[i].paths)
            fail_msg("a blocker at (%g, %g) leaves %x", cases[i].x_m, cases[i].y_m,
                     paths_of(scene));
        scene->selection.allowed &= ~EFFECT_BIT(EFFECT_OCCLUSION);
        assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
        scene->frame.reflectors.items[2].blocks = false;
        scene->selection.allowed = everything.allowed;
        assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    }
}

/* A box with a pole at its far left corner, (12, 2), whose image is (12, 6). */
SCENE_TEST(an_object_hides_its_own_bounce_but_not_its_reflectors)
{
    add_wall(scene, "w", -10, 50, 4);
    struct object *box = add_box(scene, "o", 10, 0, 4, 4);
    struct reflector_set *set = add_set(scene, "o");
    struct point_reflector *point = add_pole(set);
    point->x = point->y = 0.5;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    /* From here the leg to the bounce touches the box's near corner. A smaller box clears it. */
    scene->frame.objects.items->y_m = -6;
    assert_int_equal(paths_of(scene), 0);
    box->y_m = -0.01;
    box->width_m = 3.98;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    scene->frame.objects.items->y_m = -8;
    assert_int_equal(paths_of(scene), 0);
    set->blocks = false;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
}

SCENE_TEST(no_body_mirrors_itself_and_every_mirror_has_its_ghosts)
{
    add_standard_pole(scene);
    add_right_mirror(&scene->frame.reflectors.items[0], 0.9);
    assert_int_equal(paths_of(scene), 0);
    add_wall(scene, "w", -10, 50, 4);
    add_wall(scene, "x", -10, 50, 4.6);
    struct reflector_set *inner = &scene->frame.reflectors.items[1];
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_int_equal(scene->frame.echoes.count, 3);
    inner->blocks = false;
    ghosts_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 6);
    /* Two mirrors of one body differ by their numbers. */
    add_right_mirror(inner, 0.3);
    ghosts_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 9);
    assert_string_equal(scene->frame.echoes.items[0].id.mirror, "w");
    assert_int_equal(scene->frame.echoes.items[0].id.number, 1);
    assert_string_equal(scene->frame.echoes.items[1].id.mirror, "w");
    assert_int_equal(scene->frame.echoes.items[1].id.number, 2);
    assert_near(scene->frame.echoes.items[1].ercs, scene->frame.echoes.items[0].ercs / 3, 1e-15);
}

SCENE_TEST(two_walls_in_line_are_one)
{
    for (int step = -4; step <= 4; step++) {
        clear_scene(scene);
        add_standard_pole(scene);
        add_wall(scene, "v", -12, 12, 4);
        add_box(scene, "va", 12, 4.25, 0, 0.5);
        struct reflector_set *bare = add_set(scene, "va"); /* without length */
        bare->blocks = false;
        add_right_mirror(bare, 0.9);
        add_wall(scene, "w", 12, 36, 4);
        /* As the pole moves, its bounce crosses the joint. */
        scene->frame.objects.items[1].x_m = 30 + (double)step * 0x1p-48;
        assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
        assert_int_equal(scene->frame.echoes.count, 3);
        assert_string_equal(scene->frame.echoes.items[0].id.mirror, step < 0 ? "v" : "w");
    }
}

static double raised_cosine(double full_rad, double zero_rad, double delta_rad)
{
    return 0.5 * (1 + cos(PI * (delta_rad - full_rad) / (zero_rad - full_rad)));
}

SCENE_TEST(both_one_way_ghosts_are_equally_strong)
{
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    struct point_reflector *pole = scene->frame.reflectors.items[0].points.items;
    pole->shape = VISIBILITY_RAISED_COSINE;
    pole->facing_rad = 160 * DEGREE;
    pole->full_rad = 0;
    pole->zero_rad = 60 * DEGREE;
    ghosts_at(scene, 10);
    /* The pole sees the sensor at 180 - 3.814 degrees and the bounce at 180 - 18.435. */
    double sensor = raised_cosine(0, 60, 176.185925166 - 160);
    double bounce = raised_cosine(0, 60, 161.565051177 - 160);
    const struct echo *out = ghost_of(scene, PATH_WALL_OBJECT);
    const struct echo *back = ghost_of(scene, PATH_OBJECT_WALL);
    const struct echo *both = ghost_of(scene, PATH_WALL_OBJECT_WALL);
    double one_way = 0.9 * out->range_m * out->range_m / sqrt(904 * 1000.);
    assert_close(out->ercs, sqrt(sensor * bounce) * one_way, 1e-9);
    assert_close(back->ercs, out->ercs, 0);
    assert_close(both->ercs, bounce * 0.81, 1e-9);
    assert_true((out->effects & EFFECT_BIT(EFFECT_VISIBILITY)) != 0);
    /* The pole faces away from the sensor but not from the wall. */
    pole->facing_rad = 100 * DEGREE;
    pole->zero_rad = 70 * DEGREE;
    assert_int_equal(paths_of(scene), BOTH);
    pole->zero_rad = 50 * DEGREE;
    assert_int_equal(paths_of(scene), 0);
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_VISIBILITY);
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
}

SCENE_TEST(limits_hold_for_the_ghost_and_its_last_leg)
{
    static const struct {
        double range_min_m, range_max_m, view_deg;
        int paths;
    } cases[] = {
        {0, 100, 180, OUT | BACK | BOTH},
        {0, 31.7, 180, OUT | BACK | BOTH},
        {0, 31.6, 180, OUT | BACK},
        {0, 30.8, 180, 0},
        {30.9, 100, 180, BOTH},
        {31.7, 100, 180, 0},
        {0, 100, 37, OUT | BACK | BOTH},
        {0, 100, 36, OUT},
        {0, 100, 7.7, OUT},
        {0, 100, 7.6, 0},
    };
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    for (size_t i = 0; i < COUNT(cases); i++) {
        scene->sensor.range_min_m = cases[i].range_min_m;
        scene->sensor.range_max_m = cases[i].range_max_m;
        scene->sensor.field_of_view_rad = cases[i].view_deg * DEGREE;
        if (paths_of(scene) != cases[i].paths)
            fail_msg("case %zu has the paths %x", i, paths_of(scene));
    }
    /* The antenna has no pattern behind the sensor. */
    scene->sensor.range_min_m = 0;
    scene->sensor.field_of_view_rad = PI;
    scene->sensor.mount_yaw_rad = 100 * DEGREE;
    assert_int_equal(paths_of(scene), BOTH);
}

SCENE_TEST(planes_have_a_ghost_at_the_foot_of_the_sensors_image)
{
    add_wall(scene, "w", -10, 50, 4);
    /* The image of the sensor is (0, 8). A side at (12, -8) that is turned to face it has its foot
     * there; a side that faces -x has none. */
    struct object *box = add_box(scene, "o", 0, 0, 2, 2);
    struct reflector_set *set = add_set(scene, "o");
    *list_add(&set->planes, check_arena()) = (struct plane_reflector){
        .name = "front", .from_x = 0.5, .from_y = -0.5, .to_x = 0.5, .to_y = 0.5, .ercs = 0.7};
    double turn_rad = atan2(16, -12);
    box->yaw_rad = turn_rad;
    box->x_m = 12 - cos(turn_rad);
    box->y_m = -8 - sin(turn_rad);
    box->vx_mps = 3;
    box->vy_mps = 1;
    assert_int_equal(paths_of(scene), BOTH);
    const struct echo *ghost = scene->frame.echoes.items;
    assert_close(ghost->range_m, 20, 1e-12);
    assert_close(ghost->azimuth_rad, atan2(16, 12), 1e-12);
    assert_close(ghost->range_rate_mps, 3 * 0.6 - 1 * 0.8, 1e-12);
    assert_near(ghost->ercs, 0.81 * 0.7, 1e-12);
    assert_true(ghost->effects ==
                (EFFECT_BIT(EFFECT_GHOSTS) | EFFECT_BIT(EFFECT_PLANE_REFLECTION)));
    /* With the curvature of a guardrail; then at half of 6 m, which is 2.5 m above the sensor. */
    struct plane_reflector *front = set->planes.items;
    scene->sensor.curved_sides = true;
    front->profile_radius_m = 0.04;
    ghosts_at(scene, 10);
    assert_near(ghost->ercs, 0.81 * sqrt(PI * 0.04 * 400 / 20.04 / 10), 1e-12);
    assert_true((ghost->effects & EFFECT_BIT(EFFECT_CURVATURE)) != 0);
    scene->sensor.mount_z_m = 0.5;
    front->z = 0.5;
    scene->frame.objects.items[2].height_m = 6;
    ghosts_at(scene, 10);
    assert_close(ghost->range_m, hypot(20, 2.5), 1e-12);
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_PLANE_REFLECTION);
    assert_int_equal(paths_of(scene), 0);
    scene->selection.allowed = everything.allowed;
    scene->sensor.bounces = 2;
    assert_int_equal(paths_of(scene), 0);
    scene->sensor.bounces = 3;
    box->yaw_rad = turn_rad + 0.2;
    assert_int_equal(paths_of(scene), 0);
}

/* The wave of the standard case meets the wall at an angle of cosine 10/sqrt(1000), after 0.4 of
 * its way. */
SCENE_TEST(a_material_mirrors_by_angle_and_polarization)
{
    double cosine = 10 / sqrt(1000);
    for (int upright = 0; upright < 2; upright++)
        for (enum material material = MATERIAL_CONCRETE; material <= MATERIAL_METAL; material++) {
            clear_scene(scene);
            scene->sensor.polarization =
                upright == 1 ? POLARIZATION_VERTICAL : POLARIZATION_HORIZONTAL;
            add_standard_pole(scene);
            add_wall(scene, "w", -10, 50, 4);
            struct mirror_plane *mirror = scene->frame.reflectors.items[1].mirrors.items;
            mirror->reflection = 0;
            mirror->material = material;
            struct material_permittivity permittivity = reflection_permittivity(material, 77e9);
            double _Complex part =
                reflection_fresnel(&permittivity, upright == 1 ? MATERIAL_TE : MATERIAL_TM, cosine);
            assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
            assert_near(ghost_of(scene, PATH_WALL_OBJECT_WALL)->ercs,
                        creal(part) * creal(part) + cimag(part) * cimag(part), 1e-13);
        }
}

SCENE_TEST(a_curved_mirror_spreads_the_wave_at_every_bounce)
{
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    paths_of(scene);
    double flat_one_way = ghost_of(scene, PATH_OBJECT_WALL)->ercs;
    double flat_both = ghost_of(scene, PATH_WALL_OBJECT_WALL)->ercs;
    struct mirror_plane *mirror = scene->frame.reflectors.items[1].mirrors.items;
    mirror->radius_m = 20;
    mirror->profile_radius_m = 1.5;
    paths_of(scene);
    double divergence = reflection_divergence(20, 1.5, 10 / sqrt(1000), 0.4 * 0.6 * sqrt(1000));
    assert_true(divergence < 0.5);
    assert_near(ghost_of(scene, PATH_OBJECT_WALL)->ercs, divergence * flat_one_way, 1e-14);
    assert_near(ghost_of(scene, PATH_WALL_OBJECT)->ercs, divergence * flat_one_way, 1e-14);
    assert_near(ghost_of(scene, PATH_WALL_OBJECT_WALL)->ercs, divergence * divergence * flat_both,
                1e-14);
}

SCENE_TEST(posts_have_ghosts_by_their_names)
{
    add_wall(scene, "w", -10, 50, 4);
    add_box(scene, "r", 20, -3, 40, 0.2);
    struct reflector_set *rail = add_set(scene, "r");
    rail->blocks = false;
    add_posts(rail, 10);
    scene->sensor.range_max_m = 30;
    ghosts_at(scene, 10);
    /* There are posts at x = 0, 10, 20 and 30. The last one is 30.15 m away and so out of range;
     * the ghosts of the first arrive square to boresight, at the border of the view. */
    static const char *const names[] = {"post_1", "post_1", "post_1", "post_2", "post_2", "post_2"};
    assert_int_equal(scene->frame.echoes.count, COUNT(names));
    for (size_t i = 0; i < COUNT(names); i++)
        assert_string_equal(scene->frame.echoes.items[i].id.reflector, names[i]);
    assert_close(scene->frame.echoes.items[5].range_m, sqrt(400 + 121), 1e-12);
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_ROWS);
    assert_int_equal(paths_of(scene), 0);
}

static void set_motion(struct object *object, uint64_t *sample)
{
    object->vx_mps = sample_between(sample, -20, 20);
    object->vy_mps = sample_between(sample, -3, 3);
    object->yaw_rate_radps = sample_between(sample, -0.5, 0.5);
}

/* Sensor, wall and object all move and turn. */
SCENE_TEST(rates_are_derivatives_of_ranges)
{
    uint64_t sample = 1;
    int compared = 0;
    for (int round = 0; round < 300; round++) {
        clear_scene(scene);
        add_standard_pole(scene);
        scene->frame.reflectors.items[0].points.items->x = 0.5;
        struct object *wall = add_wall(scene, "w", -10, 50, 4);
        wall->yaw_rad = sample_between(&sample, -0.1, 0.1);
        for (size_t i = 0; i < 3; i++)
            set_motion(&scene->frame.objects.items[i], &sample);
        double step_s = 1e-4, range_m[2][16], rate_mps[16];
        size_t counts[3];
        for (int side = 0; side < 2; side++) {
            ghosts_at(scene, 10 + (side - 0.5) * step_s);
            counts[side] = scene->frame.echoes.count;
            for (size_t i = 0; i < counts[side]; i++)
                range_m[side][i] = scene->frame.echoes.items[i].range_m;
        }
        ghosts_at(scene, 10);
        counts[2] = scene->frame.echoes.count;
        for (size_t i = 0; i < counts[2]; i++)
            rate_mps[i] = scene->frame.echoes.items[i].range_rate_mps;
        if (counts[0] != counts[1] || counts[0] != counts[2])
            continue;
        for (size_t i = 0; i < counts[0]; i++, compared++)
            assert_close((range_m[1][i] - range_m[0][i]) / step_s, rate_mps[i], 1e-5);
    }
    assert_true(compared > 500);
}

/* Boxes with poles at their corners and mirrors on their sides. */
static void add_mirroring_bodies(struct scene *scene, uint64_t *sample)
{
    static const char *const ids[] = {"a", "b", "c", "d", "f", "g"};
    for (size_t i = 0; i < COUNT(ids); i++) {
        struct object *box =
            add_box(scene, ids[i], sample_between(sample, -10, 60), sample_between(sample, -15, 15),
                    sample_between(sample, 0.5, 20), sample_between(sample, 0.2, 3));
        box->yaw_rad = sample_between(sample, -4, 4);
        struct reflector_set *set = add_set(scene, ids[i]);
        set->blocks = i % 3 != 0;
        struct point_reflector *point = add_pole(set);
        point->x = 0.5;
        point->y = 0.5;
        add_right_mirror(set, 0.5);
        *list_add(&set->mirrors, check_arena()) = (struct mirror_plane){
            .from_x = 0.5, .from_y = 0.5, .to_x = -0.5, .to_y = 0.5, .reflection = 0.5};
        *list_add(&set->planes, check_arena()) = (struct plane_reflector){
            .name = "rear", .from_x = -0.5, .from_y = 0.5, .to_x = -0.5, .to_y = -0.5, .ercs = 1};
        struct post_row *row = add_posts(set, 4);
        row->from_x = -0.9;
        row->to_x = 0.9;
        row->ercs = 1;
    }
}

/* Reach and view end among the bodies, some of which rise high over the sensor. */
static void limit_sensor(struct scene *scene, uint64_t *sample)
{
    struct sensor *sensor = &scene->sensor;
    sensor->range_max_m = sample_between(sample, 5, 60);
    sensor->field_of_view_rad = sample_between(sample, 0.1, PI);
    sensor->mount_z_m = sample_between(sample, 0.3, 3);
    for (size_t i = 0; i < scene->frame.objects.count; i++)
        scene->frame.objects.items[i].height_m = sample_between(sample, 0.5, 8);
    for (size_t i = 0; i < scene->frame.reflectors.count; i++)
        scene->frame.reflectors.items[i].points.items->z = sample_between(sample, 0.1, 2);
}

SCENE_TEST(auto_leaves_out_no_ghost)
{
    uint64_t sample = 2;
    size_t ghosts = 0;
    struct effect_log log = {0};
    for (int round = 0; round < 500; round++) {
        clear_scene(scene);
        add_mirroring_bodies(scene, &sample);
        if (round % 2 == 1)
            limit_sensor(scene, &sample);
        ghosts_at(scene, 10);
        size_t count = scene->frame.echoes.count;
        struct echo *all = arena_get(check_arena(), (count + 1) * sizeof *all);
        if (count > 0)
            memcpy(all, scene->frame.echoes.items, count * sizeof *all);
        scene->selection.automatic = true;
        ghosts_at(scene, 10);
        assert_int_equal(scene->frame.echoes.count, count);
        for (size_t i = 0; i < count; i++) {
            assert_int_equal(frame_order_echoes(&all[i], &scene->frame.echoes.items[i]), 0);
            assert_close(all[i].range_m, scene->frame.echoes.items[i].range_m, 0);
        }
        ghosts += count;
    }
    assert_true(ghosts > 2000);
    /* A wall too short for a bounce is left out. */
    clear_scene(scene);
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 5, 4);
    scene->selection.automatic = true;
    scene->selection.log = &log;
    ghosts_at(scene, 10);
    assert_true(log.simulated == 0 && log.left_out == EFFECT_BIT(EFFECT_GHOSTS));
}

/* A wall of 2 m whose middle mirrors the pole to the sensor. */
SCENE_TEST(auto_leaves_out_mirrors_and_bodies_out_of_reach_and_view)
{
    static const struct {
        double x_m, y_m;             /* of the pole, whose box reaches 0.1 m nearer */
        double bounce_x_m, wall_y_m; /* of the wall's middle */
        double range_m, half_view_deg;
        int paths;
        bool simulated;
        double yaw_deg; /* of the sensor */
    } cases[] = {
        /* One way 30.84 m, both ways 31.62 m, from -3.81 and 18.43 degrees. */
        {30, -2, 12, 4, 100, 90, OUT | BACK | BOTH, true, 0},
        {30, -2, 12, 4, 31, 90, OUT | BACK, true, 0},
        {30, -2, 12, 4, 30, 90, 0, true, 0},
        {30, -2, 12, 4, 29.9, 90, 0, false, 0},
        {30, -2, 12, 4, 100, 18, OUT, true, 0}, /* the wall is in view from 17.1 degrees on */
        {30, -2, 12, 4, 100, 17, OUT, true, 0},
        {30, -2, 12, 4, 100, 3.7, 0, true, 0}, /* the pole's box is in view, from 3.6 degrees on */
        {30, -2, 12, 4, 100, 3.5, 0, false, 0},
        /* One way 42.58 m, both ways 80.16 m; the wall is 40 m away. */
        {5, 0, 2.5, 40, 43, 90, OUT | BACK, true, 0},
        {5, 0, 2.5, 40, 41, 90, 0, true, 0},
        {5, 0, 2.5, 40, 39.9, 90, 0, false, 0},
        /* A sensor that looks at the wall sees a pole behind it by way of the wall alone, from 29.1
         * degrees; the wall's box is in view from 15.2 degrees on. */
        {5, -1, 20. / 9, 4, 100, 90, BOTH, true, 90},
        {5, -1, 20. / 9, 4, 100, 29, 0, true, 90},
        {5, -1, 20. / 9, 4, 100, 15.1, 0, false, 90},
        /* The wall is behind the sensor. */
        {-10, -2, -20. / 3, 4, 100, 80, 0, false, 0},
    };
    struct effect_log log = {0};
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        add_box(scene, "o", cases[i].x_m, cases[i].y_m, 0.2, 0.2);
        add_pole(add_set(scene, "o"));
        add_wall(scene, "w", cases[i].bounce_x_m - 1, cases[i].bounce_x_m + 1, cases[i].wall_y_m);
        scene->sensor.range_max_m = cases[i].range_m;
        scene->sensor.field_of_view_rad = 2 * cases[i].half_view_deg * DEGREE;
        scene->sensor.mount_yaw_rad = cases[i].yaw_deg * DEGREE;
        assert_int_equal(paths_of(scene), cases[i].paths);
        scene->selection.automatic = true;
        scene->selection.log = &log;
        log.simulated = 0;
        assert_int_equal(paths_of(scene), cases[i].paths);
        assert_int_equal((log.simulated & EFFECT_BIT(EFFECT_GHOSTS)) != 0, cases[i].simulated);
    }
}

SCENE_TEST(margins_tell_how_near_a_ghost_is_to_vanishing)
{
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_int_equal(scene->frame.echoes.items[0].margins.present, 0);
    scene->frame.sections |= CARRY_MARGINS;
    /* The nearest border is the wall's line, 4 m from the sensor; a blocker beside the direct leg;
     * a blocker beside the leg to the wall; the wall's end beyond the bounce. */
    const struct {
        double end_x_m, x_m, y_m, one_way_m, both_m;
    } cases[] = {
        {50, 15, -20, 4, 4},
        {50, 15, -2.2, 36 / sqrt(904), 4},
        {50, 6, 1, 12 / sqrt(160), 12 / sqrt(160)},
        {12.5, 15, -20, 0.5, 0.5},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        scene->frame.sections |= CARRY_MARGINS;
        add_standard_pole(scene);
        add_wall(scene, "w", -10, cases[i].end_x_m, 4);
        add_box(scene, "b", cases[i].x_m, cases[i].y_m, 0, 0);
        add_set(scene, "b");
        assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
        double one_way_m = ghost_of(scene, PATH_OBJECT_WALL)->margins.sight_m;
        assert_close(one_way_m, cases[i].one_way_m, 1e-12);
        assert_close(ghost_of(scene, PATH_WALL_OBJECT)->margins.sight_m, one_way_m, 0);
        assert_close(ghost_of(scene, PATH_WALL_OBJECT_WALL)->margins.sight_m, cases[i].both_m,
                     1e-12);
    }
}

SCENE_TEST(a_ghost_in_a_wall_that_moved_has_the_label_latency)
{
    add_standard_pole(scene);
    scene->frame.objects.items[1].vx_mps = 0;
    struct object *wall = add_wall(scene, "w", -10, 50, 4);
    ghosts_at(scene, 9);
    assert_true(scene->frame.echoes.items->effects == EFFECT_BIT(EFFECT_GHOSTS));
    wall->vy_mps = 1;
    ghosts_at(scene, 9);
    uint64_t late = EFFECT_BIT(EFFECT_GHOSTS) | EFFECT_BIT(EFFECT_LATENCY);
    assert_true(scene->frame.echoes.items->effects == late);
    /* One second earlier the wall stood at y = 3 and moved away from sensor and pole. */
    const struct echo *both = ghost_of(scene, PATH_WALL_OBJECT_WALL);
    assert_close(both->time_s, 9, 0);
    assert_close(both->range_m, sqrt(900 + 64), 1e-12);
    assert_close(both->range_rate_mps, 2 * 8 / sqrt(900 + 64), 1e-12);
}

/* The standard case with a pole 3 m above the sensor: every path is longer by that height. */
SCENE_TEST(heights_count_on_every_leg)
{
    add_standard_pole(scene);
    add_wall(scene, "w", -10, 50, 4);
    scene->sensor.mount_z_m = 0.5;
    scene->sensor.elevation_half_width_rad = 0.1;
    struct object *pole = &scene->frame.objects.items[1], *wall = pole + 1;
    pole->height_m = 4;
    wall->height_m = 2;
    scene->frame.reflectors.items[0].points.items->z = 0.875;
    /* The pole is at 3.5 m. The path is at 0.5 + 3 * 0.4 m at the wall, below its top. */
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    double direct_m = sqrt(904 + 9), image_m = sqrt(1000 + 9);
    double direct_rad = atan2(3, sqrt(904)), image_rad = atan2(3, sqrt(1000));
    double direct = exp2(-100 * direct_rad * direct_rad);
    double image = exp2(-100 * image_rad * image_rad);
    const struct echo *out = ghost_of(scene, PATH_WALL_OBJECT);
    const struct echo *both = ghost_of(scene, PATH_WALL_OBJECT_WALL);
    assert_near(out->range_m, (direct_m + image_m) / 2, 1e-15);
    assert_near(out->range_rate_mps, (-150 / direct_m - 150 / image_m) / 2, 1e-14);
    assert_near(both->range_m, image_m, 1e-15);
    assert_near(sin(both->azimuth_rad), 10 / image_m, 1e-14);
    assert_near(sin(out->azimuth_rad), -2 / direct_m, 1e-14);
    assert_near(both->ercs, 0.81 * image, 1e-12);
    assert_near(out->ercs,
                0.9 * sqrt(direct * image) * out->range_m * out->range_m / (direct_m * image_m),
                1e-12);
    assert_true((out->effects & EFFECT_BIT(EFFECT_ELEVATION)) != 0);
    assert_int_equal(out->present, 0);
    scene->sensor.elevation_view_rad = 0.5;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_near(ghost_of(scene, PATH_WALL_OBJECT)->elevation_rad, direct_rad, 1e-14);
    assert_near(ghost_of(scene, PATH_OBJECT_WALL)->elevation_rad, image_rad, 1e-14);
    assert_near(ghost_of(scene, PATH_WALL_OBJECT_WALL)->elevation_rad, image_rad, 1e-14);
    wall->height_m = 1.7 + 1e-9;
    scene->frame.sections |= CARRY_MARGINS;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_close(ghost_of(scene, PATH_OBJECT_WALL)->margins.sight_m, 1e-9, 1e-15);
    wall->height_m = 1.7 - 1e-9;
    assert_int_equal(paths_of(scene), 0);
    /* At 1.7 m the path passes under a wall whose lower edge is there. */
    struct mirror_plane *mirror = scene->frame.reflectors.items[1].mirrors.items;
    wall->height_m = 3.4;
    mirror->bottom = 0.5 - 1e-9;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_close(ghost_of(scene, PATH_OBJECT_WALL)->margins.sight_m, 3.4e-9, 1e-14);
    mirror->bottom = 0.5 + 1e-9;
    assert_int_equal(paths_of(scene), 0);
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_HEIGHT);
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    scene->selection.allowed |= EFFECT_BIT(EFFECT_HEIGHT);
    wall->height_m = 0;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    /* A low box hides nothing: the direct leg is at 2 m half way, the leg to the wall at 1.1 m. */
    struct object *box = add_box(scene, "b", 15, -1, 0.4, 0.4);
    add_set(scene, "b");
    box->height_m = 1.9;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    box->height_m = 2.1;
    assert_int_equal(paths_of(scene), BOTH);
    box->x_m = 6;
    box->y_m = 2;
    box->height_m = 1;
    assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
    assert_true((ghost_of(scene, PATH_OBJECT_WALL)->effects & EFFECT_BIT(EFFECT_HEIGHT)) != 0);
    scene->selection.allowed &= ~EFFECT_BIT(EFFECT_HEIGHT);
    assert_int_equal(paths_of(scene), 0);
}

/* The factor of a knife edge counts both ways, its root one way. */
SCENE_TEST(soft_shadows_count_once_for_every_leg)
{
    static const struct {
        double x_m, y_m;
        struct obstruction_line leg;
        double one_way, both; /* exponents of the leg's factor */
    } cases[] = {
        {15, -1.2, {{0, 0}, {30, -2}, 0, 0}, 0.5, 0},
        {6, 1.75, {{0, 0}, {12, 4}, 0, 0}, 0.5, 1},
        {21, 0.75, {{12, 4}, {30, -2}, 0, 0}, 0.5, 1},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        double ercs[2][2];
        for (int soft = 0; soft < 2; soft++) {
            clear_scene(scene);
            scene->sensor.diffraction = soft == 1;
            add_standard_pole(scene);
            add_wall(scene, "w", -10, 50, 4);
            add_box(scene, "b", cases[i].x_m, cases[i].y_m, 0.3, 0.3);
            add_set(scene, "b")->blocks = soft == 1;
            assert_int_equal(paths_of(scene), OUT | BACK | BOTH);
            ercs[soft][0] = ghost_of(scene, PATH_OBJECT_WALL)->ercs;
            ercs[soft][1] = ghost_of(scene, PATH_WALL_OBJECT_WALL)->ercs;
        }
        struct vec2 corner[4];
        struct box box = {.length_m = 0.3, .width_m = 0.3, .heading = {1, 0}};
        box.motion.position_m = (struct vec2){cases[i].x_m, cases[i].y_m};
        motion_box_outline(&box, corner);
        double factor = obstruction_of(corner, 4, (struct obstruction_heights){0, (double)INFINITY},
                                       &cases[i].leg, units_wavelength_m(77e9))
                            .factor;
        assert_true(factor > 0.01 && factor < 0.99);
        assert_near(ercs[1][0] / ercs[0][0], pow(factor, cases[i].one_way), 1e-9);
        assert_near(ercs[1][1] / ercs[0][1], pow(factor, cases[i].both), 1e-9);
    }
}
