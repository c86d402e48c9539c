/* Interference by other radars (MODEL 14.17). An interferer is heard from where its object is at
 * the instant of the measurement, if that is in the sensor's view. An interferer whose object is
 * not in the frame, or is the ego, is not heard. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/units.h"
#include "radar/interferer.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->receiver_bandwidth_hz > 0 && scan->frame->conditions.interferers.count > 0;
}

/* Power of one interferer over that of the sensor's noise. The antenna's pattern in amplitude is
 * for both ways, so its one-way gain in power is the pattern itself. */
static double noise_ratio_of(const struct effect_scan *scan, const struct interferer *other)
{
    const struct frame *frame = scan->frame;
    const struct sensor *sensor = scan->sensor;
    double age_s = effect_age_s(scan);
    const struct object *ego = frame_object(frame, frame->ego);
    const struct object *carrier = frame_object(frame, other->object);
    if (carrier == NULL || carrier == ego)
        return 0;
    struct motion ego_motion = frame_motion(ego, age_s);
    struct motion other_motion = frame_motion(carrier, age_s);
    struct vec2 offset_m = vec2_sub(other_motion.position_m, ego_motion.position_m);
    ego_motion.position_m = (struct vec2){0, 0}; /* offset_m is from the ego: least rounding */
    struct sensor_pose pose = kinematics_sensor_pose(&ego_motion, sensor->mount_x_m,
                                                     sensor->mount_y_m, sensor->mount_yaw_rad);
    struct vec2 line_m = vec2_sub(offset_m, pose.position_m);
    double range_m = vec2_length(line_m);
    double azimuth_rad =
        elementary_atan2(vec2_cross(pose.boresight, line_m), vec2_dot(pose.boresight, line_m));
    if (!(range_m > 0) || !(fabs(azimuth_rad) < sensor->field_of_view_rad / 2))
        return 0;
    double pattern = antenna_gain(&sensor->antenna, azimuth_rad);
    if (!(pattern > 0))
        return 0;
    double sides = sensor->if_sampling == IF_REAL ? 2 : 1;
    double gain_db = sensor->antenna_gain_dbi + units_amplitude_db(pattern) / 2;
    double power_dbm = interferer_power_dbm(other->eirp_dbm, gain_db,
                                            units_wavelength_m(sensor->carrier_hz), range_m);
    double noise_dbm = interferer_noise_dbm(sensor->receiver_bandwidth_hz, sensor->noise_figure_db);
    double overlap =
        interferer_overlap(sides * sensor->receiver_bandwidth_hz,
                           sensor->chirp_slope_hzps - other->slope_hzps, sensor->chirp_s);
    return interferer_ratio(power_dbm, noise_dbm, overlap, other->hit_share);
}

static double interference(const struct effect_scan *scan)
{
    double ratio = 0;
    for (size_t i = 0; i < scan->frame->conditions.interferers.count; i++)
        ratio += noise_ratio_of(scan, &scan->frame->conditions.interferers.items[i]);
    return ratio;
}

const struct effect effect_interference = {
    .summary = "other radars raise the noise",
    .cause = "interferers of the conditions, receiver_bandwidth_hz of a sensor",
    .left_out_when = "there are no interferers or the sensor has no receiver_bandwidth_hz",
    .cost = "a received power per interferer",
    .home = EFFECT_HOME_SENSOR,
    .reads = PART_OBJECTS,
    .members = {{EFFECT_SENSOR(receiver_bandwidth_hz)},
                {EFFECT_CONDITION(interferers), {4, 0.2, EFFECT_EVENLY, 1, 2}}},
    .described = described,
    .interference = interference,
};
