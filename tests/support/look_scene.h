/* Scenes for tests of lib/ideal: one sensor on the ego, at the origin, and objects around it.
 *
 * make_scene and remove_scene are a cmocka setup and teardown. */
#pragma once

#include "base/units.h"
#include "check.h"
#include "ideal/direct_echoes.h"
#include "sample.h"

/* A frame in which object "e" carries a sensor that looks over the half plane ahead. */
struct scene {
    struct arena arena;
    struct frame frame;
    struct sensor sensor;
};

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};
static const struct selection automatic = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1,
                                           .automatic = true};

/* Makes the scene anew, without an object but the ego. */
static inline void clear_scene(struct scene *scene)
{
    arena_clear(&scene->arena);
    scene->frame = (struct frame){
        .scene = "s", .ego = "e", .time_s = 10, .interval_s = 1, .sections = CARRY_ACCOUNT};
    scene->frame.arena = &scene->arena;
    scene->sensor = (struct sensor){
        .name = "front", .range_max_m = 100, .field_of_view_rad = PI, .range_min_m = 0.1};
    *list_add(&scene->frame.objects, &scene->arena) =
        (struct object){.id = "e", .class = "car", .length_m = 4, .width_m = 2};
}

static inline int make_scene(void **state)
{
    struct scene *scene = check_make(state, sizeof *scene);
    clear_scene(scene);
    return 0;
}

static inline int remove_scene(void **state)
{
    struct scene *scene = *state;
    arena_free(&scene->arena);
    free(scene);
    return 0;
}

static inline struct object *add_object(struct scene *scene, const char *id, double x_m, double y_m)
{
    struct object *object = list_add(&scene->frame.objects, &scene->arena);
    *object = (struct object){
        .id = id, .class = "car", .x_m = x_m, .y_m = y_m, .length_m = 4, .width_m = 2};
    return object;
}

static inline struct reflector_set *add_set(struct scene *scene, const char *object)
{
    struct reflector_set *set = list_add(&scene->frame.reflectors, &scene->arena);
    *set = (struct reflector_set){.model = object, .blocks = true};
    *list_add(&set->objects, &scene->arena) = object;
    return set;
}

static inline struct point_reflector *add_point(struct scene *scene, struct reflector_set *set)
{
    struct point_reflector *point = list_add(&set->points, &scene->arena);
    *point = (struct point_reflector){
        .name = "pole", .full_rad = PI, .zero_rad = PI, .shape = VISIBILITY_HARD, .ercs = 0.5};
    return point;
}

/* A measurement at time_s, with its direct echoes. */
static inline struct look look_at(struct scene *scene, double time_s)
{
    struct look look;
    struct diag diag = {0};
    if (look_begin(&look, &scene->frame, &scene->sensor, &everything, time_s, &diag) != 0)
        fail_msg("%s", diag.text);
    direct_echoes_add(&look);
    return look;
}

/* Adds bodies of all heights around the sensor, which overlap and stand at the borders of its range
 * and view. */
static inline void add_random_bodies(struct scene *scene, uint64_t *random)
{
    static const char *const ids[] = {"a", "b", "c", "d", "f", "g", "h", "i", "j", "k", "l",
                                      "m", "n", "o", "p", "q", "r", "s", "t", "u", "v", "w"};
    struct sensor *sensor = &scene->sensor;
    sensor->mount_yaw_rad = sample_between(random, -PI, PI);
    sensor->field_of_view_rad = sample_between(random, 0.1, sample_bits(random) % 2 ? 2 * PI : 1);
    sensor->mount_z_m = sample_bits(random) % 2 ? sample_between(random, 0.2, 2) : 0;
    sensor->diffraction = sample_bits(random) % 4 == 0;
    sensor->carrier_hz = 24e9;
    double spread_m = sample_bits(random) % 2 ? 20 : 120;
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        struct reflector_set *set = add_set(scene, ids[i]);
        set->blocks = i % 4 != 0;
        set->raised = sample_bits(random) % 4 == 0;
        struct point_reflector *pole = add_point(scene, set);
        pole->under_vehicles = sample_bits(random) % 4 == 0 ? 0.5 : 0;
        double reach = sample_bits(random) % 2 ? 0.5 : 1;
        pole->x = sample_between(random, -reach, reach);
        pole->y = sample_between(random, -reach, reach);
        pole->z = sample_bits(random) % 2 ? 0 : sample_between(random, 0.1, 2);
        pole->facing_rad = sample_between(random, -PI, PI);
        pole->zero_rad = sample_between(random, 0, PI);
        pole->inset_m = i % 3 == 0 ? sample_between(random, 0, 8) : 0;
        *list_add(&set->planes, &scene->arena) =
            (struct plane_reflector){.name = "side",
                                     .from_x = 0.5,
                                     .from_y = 0.5,
                                     .to_x = -0.5,
                                     .to_y = 0.5,
                                     .margin_m = i % 2 == 0 ? 0.2 : 0,
                                     .ercs = 0.8};
        struct object *object = add_object(scene, ids[i], sample_between(random, -1, 1) * spread_m,
                                           sample_between(random, -1, 1) * spread_m);
        object->yaw_rad = sample_between(random, -PI, PI);
        object->height_m = sample_between(random, 0.3, 4);
    }
}

#define SCENE_TEST(name) TEST_WITH(make_scene, remove_scene, struct scene *scene, name)
