/* Scenes for tests of lib/ideal: one sensor on the ego, at the origin, and objects around it. */
#pragma once

#include "base/units.h"
#include "check.h"
#include "ideal/direct_echoes.h"
#include "sample.h"

/* A frame in which object "e" carries a sensor that looks over the half plane ahead. */
struct scene {
    struct frame frame;
    struct sensor sensor;
    struct selection selection;
};

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};
static const struct selection automatic = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1,
                                           .automatic = true};

/* Makes the scene anew, without an object but the ego. */
static inline void clear_scene(struct scene *scene)
{
    arena_clear(check_arena());
    scene->frame = (struct frame){
        .scene = "s", .ego = "e", .time_s = 10, .interval_s = 1, .sections = CARRY_ACCOUNT};
    scene->frame.arena = check_arena();
    scene->sensor = (struct sensor){.name = "front",
                                    .carrier_hz = 77e9,
                                    .range_min_m = 0.1,
                                    .range_max_m = 100,
                                    .field_of_view_rad = PI,
                                    .bounces = 3};
    scene->selection = everything;
    *list_add(&scene->frame.objects, check_arena()) =
        (struct object){.id = "e", .class = "car", .length_m = 4, .width_m = 2};
}

static inline struct scene *make_scene(void)
{
    static struct scene scene;
    clear_scene(&scene);
    return &scene;
}

static inline struct object *add_object(struct scene *scene, const char *id, double x_m, double y_m)
{
    struct object *object = list_add(&scene->frame.objects, check_arena());
    *object = (struct object){
        .id = id, .class = "car", .x_m = x_m, .y_m = y_m, .length_m = 4, .width_m = 2};
    return object;
}

static inline struct reflector_set *add_set(struct scene *scene, const char *object)
{
    struct reflector_set *set = list_add(&scene->frame.reflectors, check_arena());
    *set = (struct reflector_set){.model = object, .blocks = true};
    *list_add(&set->objects, check_arena()) = object;
    return set;
}

static inline struct point_reflector *add_point(struct reflector_set *set)
{
    struct point_reflector *point = list_add(&set->points, check_arena());
    *point = (struct point_reflector){
        .name = "pole", .full_rad = PI, .zero_rad = PI, .shape = VISIBILITY_HARD, .ercs = 0.5};
    return point;
}

/* Posts from the object's rear end to its front. */
static inline struct post_row *add_posts(struct reflector_set *set, double spacing_m)
{
    struct post_row *row = list_add(&set->rows, check_arena());
    *row = (struct post_row){.name = "post",
                             .from_x = -0.5,
                             .to_x = 0.5,
                             .spacing_m = spacing_m,
                             .full_rad = PI,
                             .zero_rad = PI,
                             .shape = VISIBILITY_HARD,
                             .ercs = 0.2};
    return row;
}

/* A measurement at time_s, with its direct echoes. */
static inline struct look look_at(struct scene *scene, double time_s)
{
    struct look look;
    struct diag diag = {0};
    if (look_begin(&look, &scene->frame, &scene->sensor, &scene->selection, time_s, &diag) != 0)
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
        struct point_reflector *pole = add_point(set);
        pole->under_vehicles = sample_bits(random) % 4 == 0 ? 0.5 : 0;
        double reach = sample_bits(random) % 2 ? 0.5 : 1;
        pole->x = sample_between(random, -reach, reach);
        pole->y = sample_between(random, -reach, reach);
        pole->z = sample_bits(random) % 2 ? 0 : sample_between(random, 0.1, 2);
        pole->facing_rad = sample_between(random, -PI, PI);
        pole->zero_rad = sample_between(random, 0, PI);
        pole->inset_m = i % 3 == 0 ? sample_between(random, 0, 8) : 0;
        *list_add(&set->planes, check_arena()) =
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

#define SCENE_TEST(name) TEST_FROM(make_scene, struct scene *scene, name)
