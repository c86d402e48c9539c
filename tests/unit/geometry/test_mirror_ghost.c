#include "check.h"

#include "base/units.h"
#include "geometry/mirror.h"
#include "sample.h"

/* A sensor, an object and a wall, each with its own motion. */
struct scene {
    struct motion sensor;
    struct mirror_image object;
    struct mirror mirror;
};

/* The example of MODEL 14.1. */
static const struct scene STANDARD = {.object = {{30, -2}, {-5, 0}},
                                      .mirror = {.a = {-10, 4}, .b = {50, 4}}};

static struct kinematics look_at(const struct scene *scene, const struct mirror_image *thing)
{
    return kinematics_of(scene->sensor.position_m, scene->sensor.velocity_mps, (struct vec2){1, 0},
                         thing->place_m, thing->velocity_mps);
}

static struct mirror mirror_in(const struct scene *scene)
{
    const struct mirror *mirror = &scene->mirror;
    return mirror_of(mirror->a, mirror->b, mirror->body, scene->sensor.position_m);
}

static struct mirror_image image_in(const struct scene *scene)
{
    struct mirror mirror = mirror_in(scene);
    return mirror_image(&mirror, scene->object.place_m, scene->object.velocity_mps);
}

TEST(a_wall_that_reflects_nothing_has_ghosts_of_zero_and_never_nan)
{
    struct mirror_image image = image_in(&STANDARD);
    struct kinematics direct = look_at(&STANDARD, &STANDARD.object);
    struct kinematics mirrored = look_at(&STANDARD, &image);
    const double factors[] = {
        mirror_ghost_one_way(0, &direct, &mirrored, direct.azimuth_rad).ercs_factor,
        mirror_ghost_one_way(0, &direct, &mirrored, mirrored.azimuth_rad).ercs_factor,
        mirror_ghost_both_ways(0, &mirrored).ercs_factor,
    };
    for (size_t i = 0; i < COUNT(factors); i++)
        assert_close(factors[i], 0, 0);
}

static struct vec2 random_place(uint64_t *sample, double bound)
{
    return (struct vec2){sample_between(sample, -bound, bound),
                         sample_between(sample, -bound, bound)};
}

static struct scene random_scene(uint64_t *sample)
{
    struct scene scene = {
        .sensor = {.position_m = random_place(sample, 40),
                   .velocity_mps = random_place(sample, 30)},
        .object = {random_place(sample, 40), random_place(sample, 30)},
        .mirror = {.a = random_place(sample, 40), .b = random_place(sample, 40)},
    };
    scene.mirror.body = (struct motion){.position_m = random_place(sample, 40),
                                        .velocity_mps = random_place(sample, 30),
                                        .yaw_rate_radps = sample_between(sample, -1, 1)};
    return scene;
}

static struct vec2 carried(const struct motion *from, const struct motion *to, struct vec2 place)
{
    struct vec2 turn = vec2_heading(to->yaw_rad - from->yaw_rad);
    return vec2_add(to->position_m, vec2_turn(vec2_sub(place, from->position_m), turn));
}

static struct scene scene_after(const struct scene *scene, double t)
{
    struct scene later = *scene;
    later.sensor = motion_after(scene->sensor, t);
    later.object.place_m =
        vec2_add(scene->object.place_m, vec2_scale(t, scene->object.velocity_mps));
    later.mirror.body = motion_after(scene->mirror.body, t);
    later.mirror.a = carried(&scene->mirror.body, &later.mirror.body, scene->mirror.a);
    later.mirror.b = carried(&scene->mirror.body, &later.mirror.body, scene->mirror.b);
    return later;
}

static double leg_m(struct vec2 from, struct vec2 to)
{
    return vec2_length(vec2_sub(to, from));
}

enum { OUT, BOTH, PATHS };

/* Half the length of each path, added up leg by leg. False if a path does not exist or is
 * ill-conditioned. */
static bool measure(const struct scene *scene, double range_m[PATHS])
{
    struct vec2 sensor = scene->sensor.position_m, object = scene->object.place_m, bounce;
    struct mirror mirror = mirror_in(scene);
    if (leg_m(scene->mirror.a, scene->mirror.b) < 5 || !mirror_bounce(&mirror, object, &bounce) ||
        leg_m(sensor, object) < 2 || leg_m(object, bounce) < 1 || leg_m(sensor, bounce) < 1)
        return false;
    range_m[OUT] = (leg_m(sensor, bounce) + leg_m(bounce, object) + leg_m(object, sensor)) / 2;
    range_m[BOTH] = leg_m(sensor, bounce) + leg_m(bounce, object);
    return true;
}

/* The wall turns and drives, so do the sensor and the object. */
TEST(ranges_are_half_the_legs_and_rates_their_derivatives)
{
    static const double steps_s[] = {1e-3, 1e-4, 1e-5};
    uint64_t sample = 78;
    int found = 0;
    for (int i = 0; i < 30000; i++) {
        struct scene scene = random_scene(&sample);
        double range_m[PATHS], before_m[PATHS], after_m[PATHS];
        if (!measure(&scene, range_m))
            continue;
        struct mirror_image image = image_in(&scene);
        struct kinematics direct = look_at(&scene, &scene.object),
                          mirrored = look_at(&scene, &image);
        struct kinematics seen[PATHS] = {
            mirror_ghost_one_way(1, &direct, &mirrored, direct.azimuth_rad).kinematics,
            mirror_ghost_both_ways(1, &mirrored).kinematics};
        for (int path = 0; path < PATHS; path++)
            assert_near(seen[path].range_m, range_m[path], 1e-13);
        for (size_t k = 0; k < COUNT(steps_s); k++) {
            struct scene before = scene_after(&scene, -steps_s[k]);
            struct scene after = scene_after(&scene, steps_s[k]);
            if (!measure(&before, before_m) || !measure(&after, after_m))
                continue;
            found++;
            for (int path = 0; path < PATHS; path++)
                assert_close((after_m[path] - before_m[path]) / (2 * steps_s[k]),
                             seen[path].range_rate_mps,
                             3e4 * steps_s[k] * steps_s[k] + 1e-12 / steps_s[k]);
        }
    }
    assert_true(found > 3000);
}
