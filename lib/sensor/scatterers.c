#include "sensor/scatterers.h"

#include <math.h>

#include "base/elementary.h"
#include "base/poisson.h"
#include "frame/draw_address.h"
#include "radar/ground_return.h"
#include "radar/micro_doppler.h"

struct additions {
    const struct reception *reception;
    LIST_OF(struct echo) echoes;
};

static bool simulates(const struct reception *reception, enum effect effect)
{
    return (reception->effects & EFFECT_BIT(effect)) != 0;
}

static struct random_address address_at(const struct reception *reception, struct echo_id id)
{
    return draw_address_in(reception->address, id);
}

static void add(struct additions *additions, const struct echo *echo)
{
    const struct sensor *sensor = additions->reception->sensor;
    if (echo->range_m > 0 && echo->range_m >= sensor->range_min_m &&
        echo->range_m <= sensor->range_max_m && fabs(echo->azimuth_rad) < suite_border_rad(sensor))
        *list_add(&additions->echoes, additions->reception->frame->arena) = *echo;
}

static struct echo part_of(const struct echo *parent, enum path path, int64_t number, double factor,
                           enum effect effect)
{
    struct echo part = *parent;
    part.id.path = path;
    part.id.number = number;
    part.ercs *= factor;
    part.moving_part = MOVING_NONE;
    part.effects |= EFFECT_BIT(effect);
    part.extra = NULL;
    return part;
}

static void add_wheel(struct additions *additions, const struct echo *hub)
{
    struct random_address address = address_at(additions->reception, hub->id);
    double uniform[4];
    random_uniform(&address, RANDOM_WHEELS, 0, uniform);
    int64_t count = micro_doppler_wheel_count(uniform[0]);
    for (int64_t number = 1; number <= count; number++) {
        struct echo part =
            part_of(hub, PATH_WHEEL, number, MICRO_DOPPLER_WHEEL_FACTOR, EFFECT_WHEELS);
        random_uniform(&address, RANDOM_WHEELS, (uint32_t)number, uniform);
        part.range_rate_mps = micro_doppler_wheel_rate_mps(
            hub->range_rate_mps, hub->ground_rate_mps, micro_doppler_wheel_point(uniform));
        add(additions, &part);
    }
}

static void shift(struct echo *part, double offset_m)
{
    double aside_rad = part->heading_rad - part->azimuth_rad;
    double along_m = part->range_m + offset_m * elementary_cos(aside_rad);
    double across_m = offset_m * elementary_sin(aside_rad);
    part->range_m = elementary_hypot(along_m, across_m);
    part->azimuth_rad += elementary_atan2(across_m, along_m);
}

static void add_limbs(struct additions *additions, const struct echo *torso)
{
    struct random_address address = address_at(additions->reception, torso->id);
    double uniform[4];
    random_uniform(&address, RANDOM_LIMBS, 0, uniform);
    int64_t count = micro_doppler_limb_count(uniform[0]);
    for (int64_t number = 1; number <= count; number++) {
        struct echo part =
            part_of(torso, PATH_LIMB, number, MICRO_DOPPLER_LIMB_FACTOR, EFFECT_LIMBS);
        random_uniform(&address, RANDOM_LIMBS, (uint32_t)number, uniform);
        struct limb limb = micro_doppler_limb(uniform);
        part.range_rate_mps =
            micro_doppler_limb_rate_mps(torso->range_rate_mps, torso->ground_rate_mps, limb);
        shift(&part, limb.offset_m);
        add(additions, &part);
    }
}

static void add_parts(struct additions *additions)
{
    const struct reception *reception = additions->reception;
    struct echo_span echoes = frame_echoes_of(reception->frame, reception->sensor->name);
    for (size_t i = 0; i < echoes.count; i++) {
        const struct echo *echo = &echoes.items[i];
        if (received_echo_rolls(echo) && simulates(reception, EFFECT_WHEELS))
            add_wheel(additions, echo);
        if (received_echo_walks(echo) && simulates(reception, EFFECT_LIMBS))
            add_limbs(additions, echo);
    }
}

/* How fast the sensor moves, and where it looks. A body that turns keeps its velocity in its own
 * frame (motion_after), so that latency makes no difference to how the ground passes by. */
struct sensor_pose {
    struct vec2 velocity_mps, boresight;
};

static struct sensor_pose sensor_pose_of(const struct frame *frame, const struct sensor *sensor)
{
    const struct object *ego = frame_object(frame, frame->ego);
    const struct motion motion = {
        .position_m = {ego->x_m, ego->y_m},
        .velocity_mps = {ego->vx_mps, ego->vy_mps},
        .yaw_rad = ego->yaw_rad,
        .yaw_rate_radps = ego->yaw_rate_radps,
    };
    struct vec2 heading = vec2_heading(ego->yaw_rad);
    struct vec2 mount = vec2_turn((struct vec2){sensor->mount_x_m, sensor->mount_y_m}, heading);
    return (struct sensor_pose){
        .velocity_mps = motion_velocity_at(&motion, vec2_add(motion.position_m, mount)),
        .boresight = vec2_turn(vec2_heading(sensor->mount_yaw_rad), heading),
    };
}

static int64_t clutter_count(const struct reception *reception, double uniform)
{
    const struct sensor *sensor = reception->sensor;
    const struct conditions *conditions = &reception->frame->conditions;
    double area_m2 =
        ground_return_area_m2(sensor->range_min_m, sensor->range_max_m, sensor->field_of_view_rad);
    int64_t count = poisson_overdispersed_count(conditions->clutter_per_m2 * area_m2,
                                                conditions->clutter_overdispersion, uniform);
    return count < SCATTERERS_MOST_CLUTTER ? count : SCATTERERS_MOST_CLUTTER;
}

/* Its power has an exponential law. */
static struct echo clutter_at(const struct reception *reception,
                              const struct sensor_pose *sensor_pose, struct echo ground,
                              const double uniform[3])
{
    const struct sensor *sensor = reception->sensor;
    ground.range_m = ground_return_range_m(sensor->range_min_m, sensor->range_max_m, uniform[0]);
    ground.azimuth_rad = sensor->field_of_view_rad * (uniform[1] - 0.5);
    ground.range_rate_mps = ground_return_range_rate_mps(
        sensor_pose->velocity_mps, sensor_pose->boresight, ground.azimuth_rad);
    ground.ercs = reception->frame->conditions.clutter_ercs * sqrt(-elementary_log(uniform[2]));
    return ground;
}

static void add_clutter(struct additions *additions)
{
    const struct reception *reception = additions->reception;
    struct sensor_pose sensor_pose = sensor_pose_of(reception->frame, reception->sensor);
    struct echo ground = {
        .sensor = reception->sensor->name,
        .id.object = "clutter",
        .id.reflector = "ground",
        .id.path = PATH_CLUTTER,
        .time_s = reception->time_s,
        .effects = EFFECT_BIT(EFFECT_CLUTTER),
    };
    struct random_address address = address_at(reception, ground.id);
    double uniform[4];
    random_uniform(&address, RANDOM_CLUTTER, 0, uniform);
    int64_t count = clutter_count(reception, uniform[0]);
    for (ground.id.number = 1; ground.id.number <= count; ground.id.number++) {
        random_uniform(&address, RANDOM_CLUTTER, (uint32_t)ground.id.number, uniform);
        struct echo point = clutter_at(reception, &sensor_pose, ground, uniform);
        add(additions, &point);
    }
}

struct echo_span scatterers_of(const struct reception *reception)
{
    struct additions additions = {.reception = reception};
    if (simulates(reception, EFFECT_WHEELS) || simulates(reception, EFFECT_LIMBS))
        add_parts(&additions);
    if (simulates(reception, EFFECT_CLUTTER))
        add_clutter(&additions);
    return (struct echo_span){additions.echoes.items, additions.echoes.count};
}

void scatterers_count(struct frame *frame, const char *sensor, struct echo_span scatterers)
{
    for (size_t i = 0; i < scatterers.count; i++)
        frame_count_echoes(frame, sensor, scatterers.items[i].id.path, 1);
}
