/* An interferer is heard where its object stands in the frame, if it is in view. One that has left
 * the scene, or is the ego, is not heard. */
#include "effects/effect.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/sensor_pose.h"
#include "radar/interferer.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->receiver_bandwidth_hz > 0 && scan->frame->conditions.interferers.count > 0;
}

/* The antenna's one-way gain is the root of its pattern in amplitude, that is, the pattern itself
 * in power. */
static double ratio_of(const struct effect_scan *scan, const struct interferer *other)
{
    const struct frame *frame = scan->frame;
    const struct sensor *sensor = scan->sensor;
    double age_s = frame->time_s - scan->time_s;
    const struct object *ego = frame_object(frame, frame->ego);
    const struct object *carrier = frame_object(frame, other->object);
    if (carrier == NULL || carrier == ego)
        return 0;
    struct motion here = frame_motion(ego, age_s), there = frame_motion(carrier, age_s);
    struct vec2 apart_m = vec2_sub(there.position_m, here.position_m);
    here.position_m = (struct vec2){0, 0}; /* as rounding is least from there */
    struct sensor_pose pose =
        sensor_pose_on(&here, sensor->mount_x_m, sensor->mount_y_m, sensor->mount_yaw_rad);
    struct vec2 sight = vec2_sub(apart_m, pose.position_m);
    double range_m = vec2_length(sight);
    double azimuth_rad =
        elementary_atan2(vec2_cross(pose.boresight, sight), vec2_dot(pose.boresight, sight));
    if (!(range_m > 0) || !(fabs(azimuth_rad) < sensor->field_of_view_rad / 2))
        return 0;
    double pattern = antenna_gain(&sensor->antenna, azimuth_rad);
    if (!(pattern > 0))
        return 0;
    double gain_db = sensor->antenna_gain_dbi + units_amplitude_db(pattern) / 2;
    return interferer_ratio(
        interferer_power_dbm(other->eirp_dbm, gain_db, units_wavelength_m(sensor->carrier_hz),
                             range_m),
        interferer_noise_dbm(sensor->receiver_bandwidth_hz, sensor->noise_figure_db),
        interferer_overlap(sensor->receiver_bandwidth_hz,
                           sensor->chirp_slope_hzps - other->slope_hzps, sensor->chirp_s),
        other->hit_share);
}

static double interference(const struct effect_scan *scan)
{
    double ratio = 0;
    for (size_t i = 0; i < scan->frame->conditions.interferers.count; i++)
        ratio += ratio_of(scan, &scan->frame->conditions.interferers.items[i]);
    return ratio;
}

const struct effect effect_interference = {
    .summary = "other radars raise the noise",
    .home = EFFECT_HOME_SENSOR,
    .cause = "interferers of the conditions, receiver_bandwidth_hz of a sensor",
    .bound = "no interferer is described",
    .cost = "a power per interferer",
    .described = described,
    .interference = interference,
};
