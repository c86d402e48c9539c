/* Ground clutter (MODEL 14.13). Points on the ground are echoes of the reflector "ground" of the
 * object "clutter", which is no object of the frame, with numbers from 1. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/random.h"
#include "geometry/kinematics.h"
#include "propagation/ground_return.h"

/* A scan has no more points than this. Those with higher numbers are left out, which thins clutter
 * alike everywhere. */
enum { MOST_POINTS = 1000 };

static bool described(const struct effect_scan *scan)
{
    const struct conditions *conditions = &scan->frame->conditions;
    const struct sensor_view *view = frame_view(scan->frame, scan->sensor->name);
    return conditions->clutter_per_m2 > 0 && conditions->clutter_ercs > 0 && view != NULL &&
           view->measured && frame_object(scan->frame, scan->frame->ego) != NULL;
}

/* The sensor's pose at the frame's time. Latency changes nothing: a body that turns keeps its
 * velocity in its own frame (motion_after), so the ground passes by as it did before. */
static struct sensor_pose pose_of(const struct effect_scan *scan)
{
    const struct sensor *sensor = scan->sensor;
    struct motion ego = frame_motion(frame_object(scan->frame, scan->frame->ego), 0);
    return kinematics_sensor_pose(&ego, sensor->mount_x_m, sensor->mount_y_m,
                                  sensor->mount_yaw_rad);
}

static int64_t point_count(const struct effect_scan *scan, double uniform)
{
    const struct sensor *sensor = scan->sensor;
    const struct conditions *conditions = &scan->frame->conditions;
    double area_m2 =
        ground_return_area_m2(sensor->range_min_m, sensor->range_max_m, sensor->field_of_view_rad);
    int64_t count = random_poisson(conditions->clutter_per_m2 * area_m2,
                                   conditions->clutter_overdispersion, uniform);
    return count < MOST_POINTS ? count : MOST_POINTS;
}

/* Draws a place, uniform over the area, and a power of exponential distribution. */
static void draw_point(const struct effect_scan *scan, const struct sensor_pose *pose,
                       const double uniform[3], struct echo *point)
{
    const struct sensor *sensor = scan->sensor;
    point->range_m = ground_return_range_m(sensor->range_min_m, sensor->range_max_m, uniform[0]);
    point->azimuth_rad = sensor->field_of_view_rad * (uniform[1] - 0.5);
    point->range_rate_mps =
        ground_return_range_rate_mps(pose->velocity_mps, pose->boresight, point->azimuth_rad);
    point->ercs = scan->frame->conditions.clutter_ercs * sqrt(-elementary_log(uniform[2]));
}

static void add_echoes(const struct effect_scan *scan, struct effect_echoes *echoes)
{
    struct sensor_pose pose = pose_of(scan);
    struct echo ground = {
        .sensor = scan->sensor->name,
        .id.object = "clutter",
        .id.reflector = "ground",
        .id.path = PATH_CLUTTER,
        .time_s = scan->time_s,
        .effects = EFFECT_BIT(EFFECT_CLUTTER),
    };
    struct random_address address = frame_draw_address_in(scan->address, ground.id);
    double uniform[4];
    random_uniform(&address, RANDOM_CLUTTER, 0, uniform);
    int64_t count = point_count(scan, uniform[0]);
    for (ground.id.number = 1; ground.id.number <= count; ground.id.number++) {
        struct echo point = ground;
        random_uniform(&address, RANDOM_CLUTTER, (uint32_t)ground.id.number, uniform);
        draw_point(scan, &pose, uniform, &point);
        effect_add(scan, echoes, &point);
    }
}

const struct effect effect_clutter = {
    .summary = "the ground and what stands on it echo",
    .cause = "clutter_per_m2 and clutter_ercs of the conditions",
    .left_out_when = "clutter_per_m2 or clutter_ercs is 0, or the frame has no objects",
    .cost = "a draw per point on the ground",
    .home = EFFECT_HOME_SENSOR,
    .described = described,
    .add_echoes = add_echoes,
};
