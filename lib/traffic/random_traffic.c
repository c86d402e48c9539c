#include "traffic/random_traffic.h"

#include <assert.h>
#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/units.h"
#include "effects/effect.h"

#define LANE_M 3.5
#define TRIES 32
#define STRIP_M 300 /* half of a strip's length */

const struct random_traffic_density random_traffic_densities[] = {
    [TRAFFIC_SPARSE] = {"sparse", 0, 3, 120, 40, false},
    [TRAFFIC_MEDIUM] = {"medium", 0, 8, 60, 20, false},
    [TRAFFIC_DENSE] = {"dense", 4, 15, 25, 10, false},
};

struct class_profile {
    const char *name;
    double share, top_mps;
    bool roadside; /* the object stands beside the road */
};

static const struct class_profile profiles[] = {
    [TRAFFIC_CAR] = {"car", 0.50, 40, false},
    [TRAFFIC_VAN] = {"van", 0.10, 40, false},
    [TRAFFIC_TRUCK] = {"truck", 0.06, 25, false},
    [TRAFFIC_ARTICULATED_TRUCK] = {"articulated_truck", 0.03, 25, false},
    [TRAFFIC_BUS] = {"bus", 0.03, 25, false},
    [TRAFFIC_MOTORCYCLE] = {"motorcycle", 0.04, 40, false},
    [TRAFFIC_BICYCLE] = {"bicycle", 0.05, 8, false},
    [TRAFFIC_PEDESTRIAN] = {"pedestrian", 0.09, 2.5, false},
    [TRAFFIC_POST] = {"post", 0.04, 0, true},
    [TRAFFIC_WALL] = {"wall", 0.02, 0, true},
    [TRAFFIC_GUARDRAIL] = {"guardrail", 0.04, 0, true},
};

const char *random_traffic_class_name(enum random_traffic_class class)
{
    return profiles[class].name;
}

static enum random_traffic_class draw_class(struct random_sequence *sequence)
{
    double left = random_sequence_next(sequence);
    enum random_traffic_class class = 0;
    while (class + 1 < TRAFFIC_CLASSES && left >= profiles[class].share)
        left -= profiles[class ++].share;
    return class;
}

/* A place relative to the ego, x along the road. */
static struct vec2 draw_place(struct random_sequence *sequence, double radius_m, bool roadside)
{
    if (!roadside && random_sequence_chance(sequence, 0.3)) {
        struct vec2 direction = vec2_heading(random_sequence_between(sequence, -PI, PI));
        return vec2_scale(radius_m * sqrt(random_sequence_next(sequence)), direction);
    }
    double aside = roadside
                       ? random_sequence_sign(sequence) * random_sequence_between(sequence, 4, 12)
                       : LANE_M * (double)random_sequence_whole(sequence, -2, 2) +
                             random_sequence_between(sequence, -0.5, 0.5);
    double ahead = sqrt((radius_m - aside) * (radius_m + aside));
    return (struct vec2){ahead * random_sequence_between(sequence, -1, 1), aside};
}

/* A yaw relative to the road. */
static double draw_yaw_rad(struct random_sequence *sequence, double aside_m, bool roadside)
{
    double wanted = random_sequence_next(sequence);
    if (wanted < 0.15)
        return random_sequence_between(sequence, -PI, PI);
    if (wanted < 0.3 && !roadside)
        return random_sequence_sign(sequence) * PI / 2 +
               random_sequence_between(sequence, -0.05, 0.05);
    double along = !roadside && aside_m > LANE_M / 2 ? PI : 0;
    return along + (random_sequence_chance(sequence, 0.5)
                        ? random_sequence_between(sequence, -0.05, 0.05)
                        : 0);
}

static void draw_motion(struct random_sequence *sequence, const struct class_profile *profile,
                        struct object *object)
{
    if (profile->roadside || random_sequence_chance(sequence, 0.2))
        return;
    double speed_mps = profile->top_mps * random_sequence_next(sequence);
    double crab_rad =
        random_sequence_chance(sequence, 0.05) ? random_sequence_between(sequence, -0.2, 0.2) : 0;
    struct vec2 velocity = vec2_scale(speed_mps, vec2_heading(object->yaw_rad + crab_rad));
    object->vx_mps = velocity.x;
    object->vy_mps = velocity.y;
    if (random_sequence_chance(sequence, 0.3))
        object->yaw_rate_radps = random_sequence_between(sequence, -0.5, 0.5);
    object->travelled_m = random_sequence_between(sequence, 0, 1000);
}

/* Half of an object's extent along a direction. */
static double reach_m(const struct box *box, struct vec2 direction)
{
    return 0.5 * box->length_m * fabs(vec2_dot(box->heading, direction)) +
           0.5 * box->width_m * fabs(vec2_cross(box->heading, direction));
}

/* Two boxes are apart if and only if a line along one of their sides separates them. */
static bool overlap(const struct box *a, const struct box *b)
{
    struct vec2 between = vec2_sub(b->motion.position_m, a->motion.position_m);
    const struct vec2 sides[] = {a->heading, vec2_left(a->heading), b->heading,
                                 vec2_left(b->heading)};
    for (int i = 0; i < 4; i++)
        if (fabs(vec2_dot(between, sides[i])) > reach_m(a, sides[i]) + reach_m(b, sides[i]))
            return false;
    return true;
}

static struct box box_of(const struct random_traffic *traffic, const struct object *object)
{
    const struct random_traffic_model *model = traffic->models;
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++)
        if (strcmp(profiles[class].name, object->class) == 0)
            model += class;
    return (struct box){
        .motion = {.position_m = {object->x_m, object->y_m}},
        .heading = vec2_heading(object->yaw_rad),
        .length_m = object->length_m > 0 ? object->length_m : model->length_m,
        .width_m = object->width_m > 0 ? object->width_m : model->width_m,
    };
}

/* 0 if an object overlaps nothing, 1 if it overlaps another object, 2 for the ego. */
static int worst_overlap(const struct random_traffic *traffic, const struct frame *frame,
                         const struct object *object)
{
    struct box box = box_of(traffic, object);
    int worst = 0;
    for (size_t i = frame->objects.count; i-- > 0;) {
        struct box other = box_of(traffic, &frame->objects.items[i]);
        if (overlap(&box, &other))
            worst = i == 0 ? 2 : 1;
    }
    return worst;
}

static void place(struct random_sequence *sequence, const struct random_traffic_density *density,
                  const struct class_profile *profile, const struct object *ego,
                  struct object *object)
{
    struct vec2 local = draw_place(sequence, density->radius_m, profile->roadside);
    struct vec2 world = vec2_turn(local, vec2_heading(ego->yaw_rad));
    object->x_m = ego->x_m + world.x;
    object->y_m = ego->y_m + world.y;
    object->yaw_rad =
        units_wrap_rad(ego->yaw_rad + draw_yaw_rad(sequence, local.y, profile->roadside));
}

/* Appends an object, if a place is found for it that does not overlap the ego. */
static void add_object(const struct random_traffic *traffic, int64_t index,
                       struct random_address address, struct frame *frame)
{
    address.item = (uint64_t)index;
    struct random_sequence sequence = random_sequence_at(address, RANDOM_TRAFFIC);
    enum random_traffic_class class = draw_class(&sequence);
    struct object object = {.class = profiles[class].name};
    if (random_sequence_chance(&sequence, 0.8)) {
        object.length_m =
            traffic->models[class].length_m * random_sequence_between(&sequence, 0.85, 1.15);
        object.width_m =
            traffic->models[class].width_m * random_sequence_between(&sequence, 0.9, 1.1);
    }
    bool may_overlap = random_sequence_chance(&sequence, 0.03);
    int found = 2;
    for (int i = 0; i < TRIES && found > (may_overlap || i >= TRIES / 2 ? 1 : 0); i++) {
        place(&sequence, traffic->density, &profiles[class], &frame->objects.items[0], &object);
        found = worst_overlap(traffic, frame, &object);
    }
    if (found == 2)
        return;
    draw_motion(&sequence, &profiles[class], &object);
    char *id = arena_get(frame->arena, 24);
    snprintf(id, 24, "o%" PRId64, index);
    object.id = id;
    *list_add(&frame->objects, frame->arena) = object;
}

struct random_address random_traffic_address(const struct random_traffic *traffic, uint64_t seed,
                                             int64_t number)
{
    return (struct random_address){
        .seed = seed,
        .scene = hash_text(hash_text(HASH_START, "random"), traffic->density->name),
        .frame = (uint64_t)number,
    };
}

static struct object draw_ego(struct random_sequence *sequence, double top_mps, bool at_origin)
{
    struct object ego = {.id = "ego", .class = profiles[TRAFFIC_CAR].name};
    if (!at_origin) {
        ego.x_m = random_sequence_between(sequence, -500, 500);
        ego.y_m = random_sequence_between(sequence, -500, 500);
        ego.yaw_rad = random_sequence_between(sequence, -PI, PI);
    }
    if (random_sequence_chance(sequence, 0.15))
        return ego;
    struct vec2 velocity =
        vec2_scale(top_mps * random_sequence_next(sequence), vec2_heading(ego.yaw_rad));
    ego.vx_mps = velocity.x;
    ego.vy_mps = velocity.y;
    if (random_sequence_chance(sequence, 0.3))
        ego.yaw_rate_radps = random_sequence_between(sequence, -0.3, 0.3);
    return ego;
}

void random_traffic_fill(const struct random_traffic *traffic, int64_t number, struct frame *frame)
{
    assert(number >= 0);
    const struct random_traffic_density *density = traffic->density;
    struct random_address address = random_traffic_address(traffic, frame->seed, number);
    struct random_sequence sequence = random_sequence_at(address, RANDOM_TRAFFIC);
    bool at_origin = density->centred && random_sequence_chance(&sequence, 0.5);
    *list_add(&frame->objects, frame->arena) = draw_ego(&sequence, density->ego_mps, at_origin);
    frame->ego = frame->objects.items[0].id;
    int64_t count = random_sequence_whole(&sequence, density->least, density->most);
    for (int64_t i = 1; i <= count; i++)
        add_object(traffic, i, address, frame);
}

static void add_strip(struct frame *frame, enum roadside_kind kind, double left_m, double width_m)
{
    const struct object *ego = frame_object(frame, frame->ego);
    struct vec2 ahead = vec2_heading(ego->yaw_rad), middle = {ego->x_m, ego->y_m};
    struct roadside_strip *strip = list_add(&frame->roadside, frame->arena);
    field_clear(&roadside_strip_record, strip);
    middle = vec2_add(middle, vec2_scale(left_m, vec2_left(ahead)));
    strip->kind = kind;
    strip->width_m = width_m;
    strip->from_x_m = middle.x - STRIP_M * ahead.x;
    strip->from_y_m = middle.y - STRIP_M * ahead.y;
    strip->to_x_m = middle.x + STRIP_M * ahead.x;
    strip->to_y_m = middle.y + STRIP_M * ahead.y;
}

void random_traffic_roadside(struct random_address address, struct frame *frame)
{
    struct random_sequence sequence = random_sequence_at(address, RANDOM_STRIPS);
    for (int side = -1; side <= 1; side += 2) {
        double aside_m = random_sequence_between(&sequence, 5, 12);
        double width_m = random_sequence_between(&sequence, 1, 16);
        if (random_sequence_chance(&sequence, 0.5))
            add_strip(frame, random_sequence_chance(&sequence, 0.7) ? ROADSIDE_RAIL : ROADSIDE_KERB,
                      side * aside_m, 0);
        if (random_sequence_chance(&sequence, 0.3))
            add_strip(frame, ROADSIDE_POLES, side * (aside_m + 1), 0);
        if (random_sequence_chance(&sequence, 0.5))
            add_strip(frame, ROADSIDE_VEGETATION, side * (aside_m + 2 + width_m / 2), width_m);
    }
}

static struct interferer draw_interferer(struct random_sequence *sequence,
                                         const struct object *object)
{
    return (struct interferer){
        .object = object->id,
        .eirp_dbm = random_sequence_between(sequence, 0, 40),
        .slope_hzps =
            random_sequence_sign(sequence) * random_sequence_between(sequence, 1e12, 5e13),
        .hit_share = random_sequence_between(sequence, 0, 0.3),
    };
}

/* Draws interferers in the cyclic order of the objects, so that none is drawn twice. */
static void draw_interferers(struct random_sequence *sequence, const struct effect_random *random,
                             struct frame *frame)
{
    int64_t others = (int64_t)frame->objects.count - 1;
    int64_t count = random_sequence_whole(sequence, (int64_t)random->low, (int64_t)random->high);
    int64_t place = random_sequence_whole(sequence, 0, others > 0 ? others - 1 : 0);
    for (int64_t i = 0; i < count && i < others; i++) {
        *list_add(&frame->conditions.interferers, frame->arena) =
            draw_interferer(sequence, &frame->objects.items[1 + place]);
        place = (place + random_sequence_whole(sequence, 1, others > 1 ? others - 1 : 1)) % others;
    }
}

static double draw_number(struct random_sequence *sequence, const struct effect_random *random)
{
    if (random->law == EFFECT_EVENLY)
        return random_sequence_between(sequence, random->low, random->high);
    return random->low * elementary_pow(random->high / random->low, random_sequence_next(sequence));
}

/* The kind of a condition, which is a member of struct conditions at this offset. */
static enum field_kind kind_of(const struct effect_member *member)
{
    const struct field *field = conditions_record.fields;
    while (field->offset != member->offset)
        field++;
    return field->kind;
}

static void draw_condition(struct random_sequence *sequence, const struct effect_member *condition,
                           struct frame *frame)
{
    void *member = (char *)&frame->conditions + condition->offset;
    const struct effect_random *random = &condition->random;
    enum field_kind kind = kind_of(condition);
    if (kind == FIELD_LIST)
        draw_interferers(sequence, random, frame);
    else if (kind == FIELD_CHOICE)
        *(int *)member =
            (int)random_sequence_whole(sequence, (int64_t)random->low, (int64_t)random->high);
    else
        *(double *)member = draw_number(sequence, random);
}

void random_traffic_conditions(struct random_address address, struct frame *frame)
{
    struct random_sequence sequence = random_sequence_at(address, RANDOM_CONDITIONS);
    const struct effect_member *condition;
    bool has = false;
    for (int number = 1; (condition = effect_random_condition(number)) != NULL; number++) {
        if (condition->random.share > 0)
            has = random_sequence_chance(&sequence, condition->random.share);
        if (has)
            draw_condition(&sequence, condition, frame);
    }
}
