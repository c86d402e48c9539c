#include "noise/detection_quality.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/kinematics.h"
#include "radar/detection.h"
#include "radar/monopulse.h"

/* Echoes from the least power to BAND times that power tell how many weak echoes a scan has; ALWAYS
 * more are expected in every scan. */
static const double BAND = 10, ALWAYS = 0.25;

/* The probability that an echo of which this power is left with noise has passed the first
 * threshold, which acts before the noise. Its amplitude without the noise is complex Gaussian,
 * given the one with it. */
static double passed_first(const struct existence *existence, double power)
{
    if (existence->first_threshold == 0)
        return 1;
    return detection_in_noise(sqrt(power), sqrt(existence->first_threshold), sqrt(existence->rise));
}

/* The density of echoes at this power over that of false alarms, where one echo is expected in the
 * band, evenly over decibels. */
static double odds_of_one(const struct existence *existence, double power)
{
    double least = existence->least_false_alarm, search = existence->search_noise;
    if (existence->false_alarms == 0 || power < least)
        return (double)INFINITY;
    if (power < existence->least_echo)
        return 0;
    double echo = passed_first(existence, power) / (power * elementary_log(BAND));
    if (echo == 0)
        return 0;
    /* By logarithms, as the density of false alarms may be below the least double. */
    double log_noise = elementary_log(existence->false_alarms / search) - (power - least) / search;
    return elementary_exp(elementary_log(echo) - log_noise);
}

static bool is_weak(const struct existence *existence, double power)
{
    return power <= BAND * existence->weakest;
}

/* Bayes' rule, where ALWAYS and the sum of the probabilities of the other detections in the band is
 * the number of echoes expected there; by iteration that begins with all detections as echoes. */
void detection_quality_weigh(const struct existence *existence, struct detection_evidence *scan,
                             size_t count)
{
    enum { STEPS = 8 };
    for (size_t i = 0; i < count; i++)
        scan[i].odds = odds_of_one(existence, scan[i].power);
    for (size_t i = 0; i < count; i++)
        scan[i].existence = 1;
    for (int step = 0; step < STEPS; step++) {
        double weak = ALWAYS;
        for (size_t i = 0; i < count; i++)
            weak += is_weak(existence, scan[i].power) ? scan[i].existence : 0;
        for (size_t i = 0; i < count; i++) {
            double own = is_weak(existence, scan[i].power) ? scan[i].existence : 0;
            scan[i].existence = 1 / (1 + 1 / ((weak - own) * scan[i].odds));
        }
    }
}

double detection_quality_power(const struct detection_source *source,
                               const struct effect_measurement *measurement)
{
    double ratio = measurement->amplitude / source->noise;
    return ratio * ratio;
}

struct detection_source detection_quality_source(const struct sensor *sensor,
                                                 struct cell_span cells,
                                                 const struct effect_scan *scan)
{
    double interference = 0;
    for (size_t i = 0; i < cells.count; i++)
        interference = elementary_max(interference, cells.items[i].interference);
    double search = sensor->pointer_sigma > 0 ? sensor->search_sigma / sensor->pointer_sigma : 0;
    struct existence existence = {.rise = 1 + interference, .search_noise = search * search};
    return (struct detection_source){.sensor = sensor,
                                     .scan = scan,
                                     .noise = sensor->pointer_sigma,
                                     .existence = existence,
                                     .range_rate_interval_mps = 2 * sensor->unambiguous_rate_mps};
}

/* The power of the echo is that of the amplitude less the mean power of the noise in it, relative
 * to the rise of the noise. */
static void estimate_range(const struct detection_source *source,
                           struct effect_measurement *measurement, double noise)
{
    const struct sensor *sensor = source->sensor;
    double amplitude = measurement->amplitude;
    double power = elementary_max(amplitude * amplitude - noise * noise, 0);
    double strength = sqrt(power / source->existence.rise);
    double range_m = sensor->range_sigma_m, rate_mps = sensor->range_rate_sigma_mps;
    bool noisy = effect_simulates(source->scan, EFFECT_RANGE_NOISE);
    if (effect_simulates(source->scan, EFFECT_ACCURACY)) {
        range_m = measurement_sigma_at(&sensor->range_error, strength);
        rate_mps = measurement_sigma_at(&sensor->range_rate_error, strength);
    }
    range_m = suite_range_sigma_m(sensor, measurement->range_m, range_m);
    measurement->range_sigma_m = noisy ? range_m : 0;
    measurement->range_rate_sigma_mps = noisy ? rate_mps : 0;
}

/* The quadrature of a single echo is beyond 3 standard deviations with 0.27 %. The angle of several
 * echoes is off by as much in phase as in quadrature, on average over their phases (MODEL 14.21).
 */
static const double SINGLE = 3;

/* What several echoes do to the pointers, in standard deviations of noise; 0 for a single one. */
static double several_in_pointers(const struct effect_measurement *measurement, double noise)
{
    double quadrature = monopulse_quadrature(measurement->pointers, noise);
    return fabs(quadrature) > SINGLE ? quadrature : 0;
}

/* The amplitude of all that an array receives beside a beam's own echo, over the RMS of the noise
 * in the beam; 0 if noise alone may be as strong. */
static double several_in_elements(const struct array *array, const struct array_maximum *beam,
                                  double noise)
{
    struct array_others expected = array_noise_beside(array, noise);
    if (beam->others <= expected.mean + SINGLE * expected.sigma)
        return 0;
    return sqrt(beam->others - expected.mean) / noise;
}

double detection_quality_widening(const struct sensor *sensor,
                                  struct effect_measurement *measurement, double noise)
{
    double several = 0;
    if (sensor->beams.count == 0)
        several = several_in_pointers(measurement, noise);
    else if (measurement->cell->beam != NULL)
        several = several_in_elements(&sensor->beams, measurement->cell->beam, noise);
    measurement->looks_merged = several != 0;
    return elementary_hypot(1, several);
}

/* The standard deviation is at most that of an azimuth anywhere in the field of view. */
static void estimate_azimuth(const struct detection_source *source,
                             struct effect_measurement *measurement, double noise)
{
    const struct sensor *sensor = source->sensor;
    const struct array_maximum *beam = measurement->cell->beam;
    double ratio = measurement->amplitude / noise, sigma_rad = 0;
    if (noise > 0 && beam != NULL)
        sigma_rad = beam->sigma * noise / elementary_cos(measurement->azimuth_rad);
    else if (noise > 0)
        sigma_rad = suite_azimuth_sigma_rad(sensor, measurement->azimuth_rad, ratio * ratio);
    if (source->channels)
        sigma_rad *= detection_quality_widening(sensor, measurement, noise);
    double floor_rad = suite_azimuth_floor_rad(sensor, measurement->azimuth_rad);
    if (effect_simulates(source->scan, EFFECT_ANGLE_NOISE))
        measurement->azimuth_sigma_rad = elementary_min(elementary_hypot(sigma_rad, floor_rad),
                                                        sensor->field_of_view_rad / sqrt(12));
}

static void estimate_elevation(const struct detection_source *source,
                               struct effect_measurement *measurement)
{
    double amplitude = measurement->amplitude / sqrt(source->existence.rise);
    if (effect_simulates(source->scan, EFFECT_ELEVATION_NOISE))
        measurement->elevation_sigma_rad = suite_elevation_sigma_rad(source->sensor, amplitude);
}

void detection_quality_estimate(struct detection_source *source, bool first_threshold,
                                struct effect_measurement *measurements, size_t count)
{
    struct existence *existence = &source->existence;
    const struct sensor *sensor = source->sensor;
    bool final = effect_simulates(source->scan, EFFECT_FINAL_THRESHOLD);
    double least = sensor->threshold / source->noise, noise = 0;
    double first = (final ? sensor->lowered_threshold : sensor->threshold) / source->noise;
    existence->least_false_alarm = least * least;
    existence->weakest = existence->least_false_alarm * existence->rise;
    if (effect_simulates(source->scan, EFFECT_FALSE_ALARMS))
        existence->false_alarms = sensor->false_alarms;
    if (first_threshold)
        existence->first_threshold = first * first * existence->rise;
    if (final)
        existence->least_echo = existence->weakest;
    if (effect_simulates(source->scan, EFFECT_ANGLE_NOISE))
        noise = source->noise * sqrt(existence->rise);
    source->channels = noise > 0;
    for (size_t i = 0; i < count; i++) {
        estimate_range(source, &measurements[i], noise);
        estimate_azimuth(source, &measurements[i], noise);
        estimate_elevation(source, &measurements[i]);
    }
}

/* Rounds to a part of the unit, as digits that nobody needs make long lines. */
static double to_part(double value, double parts)
{
    return round(value * parts) / parts;
}

/* A standard deviation combined with that of rounding to multiples of step. */
static double rounded_sigma(const struct detection_source *source, double sigma, double step)
{
    bool rounds = source->scan != NULL && effect_simulates(source->scan, EFFECT_QUANTISATION);
    return rounds ? elementary_hypot(sigma, step / sqrt(12)) : sigma;
}

static void add_errors(const struct detection_source *source,
                       const struct effect_measurement *measurement, struct quality *quality)
{
    const struct sensor *sensor = source->sensor;
    quality->range_sd_m = rounded_sigma(source, measurement->range_sigma_m, sensor->range_step_m);
    quality->range_rate_sd_mps =
        rounded_sigma(source, measurement->range_rate_sigma_mps, sensor->range_rate_step_mps);
    quality->azimuth_sd_rad =
        rounded_sigma(source, measurement->azimuth_sigma_rad, sensor->azimuth_step_rad);
    quality->present |= QUALITY_ERRORS;
    if (sensor->elevation_view_rad > 0) {
        quality->elevation_sd_rad =
            rounded_sigma(source, measurement->elevation_sigma_rad, sensor->elevation_step_rad);
        quality->present |= QUALITY_ELEVATION;
    }
    quality->looks_merged = measurement->looks_merged;
    if (source->channels)
        quality->present |= QUALITY_POINTERS;
}

/* The amplitude of an ERCS of 1 at the measured place. Noise may turn an azimuth beyond the table
 * of an antenna, which has no gain there: then with the gain at the border of the view. */
static double reference_amplitude(const struct sensor *sensor, double range_m, double azimuth_rad)
{
    double within_rad = elementary_min(elementary_max(azimuth_rad, -PI / 2), PI / 2);
    double reference =
        radar_amplitude(&sensor->amplitude_law, &sensor->antenna, range_m, within_rad, 1);
    if (reference > 0)
        return reference;
    double border_rad = copysign(antenna_border_rad(sensor->field_of_view_rad), azimuth_rad);
    return radar_amplitude(&sensor->amplitude_law, &sensor->antenna, range_m, border_rad, 1);
}

static void add_strength(const struct detection_source *source,
                         const struct effect_measurement *measurement, struct quality *quality)
{
    const struct sensor *sensor = source->sensor;
    double ratio = measurement->amplitude / source->noise;
    double reference = reference_amplitude(sensor, measurement->range_m, measurement->azimuth_rad);
    if (reference > 0) {
        quality->rcs_dbsm =
            to_part(10 + units_amplitude_db(measurement->amplitude / reference), 1e3);
        quality->present |= QUALITY_RCS;
    }
    if (source->noise == 0)
        return;
    quality->snr_db = to_part(units_amplitude_db(ratio / sqrt(source->existence.rise)), 1e3);
    quality->present |= QUALITY_NOISE;
}

static void add_labels(const struct detection_source *source, const struct target *target,
                       struct quality *quality)
{
    const struct contributor *parts = target->contributors.items;
    double interval_mps = source->range_rate_interval_mps;
    for (size_t i = 1; i < target->contributors.count; i++) {
        bool same = frame_same_object(&parts[i].id, &parts[0].id);
        quality->merged_objects |= !same;
        quality->merged_reflectors |=
            !same || !frame_same_name(parts[i].id.reflector, parts[0].id.reflector);
    }
    quality->present |= QUALITY_MERGED;
    if (interval_mps == 0)
        return;
    double excess_mps = frame_strongest(target)->range_rate_mps - target->range_rate_mps;
    quality->range_rate_interval_mps = interval_mps;
    quality->ambiguity_number = (int64_t)round(excess_mps / interval_mps);
    quality->present |= QUALITY_FOLDS;
}

/* Adds places and speeds, rounded to 0.1 mm and 0.1 mm/s, at the instant of the measurement. */
static void add_places(const struct frame *frame, const struct target *target,
                       struct quality *quality)
{
    const double parts = 1e4;
    const struct sensor_view *view = frame_view(frame, target->sensor);
    const struct object *ego = frame_object(frame, frame->ego);
    struct vec2 sight = vec2_heading(target->azimuth_rad);
    struct vec2 place_m = frame_target_place(target);
    struct vec2 centre_m = vec2_add((struct vec2){view->mount_x_m, view->mount_y_m},
                                    vec2_turn(place_m, vec2_heading(view->mount_yaw_rad)));
    quality->x_sensor_m = to_part(place_m.x, parts);
    quality->y_sensor_m = to_part(place_m.y, parts);
    quality->x_centre_m = to_part(centre_m.x, parts);
    quality->y_centre_m = quality->y_rear_axle_m = to_part(centre_m.y, parts);
    quality->present |= QUALITY_MOUNT;
    if (ego == NULL)
        return;
    struct motion motion = frame_motion(ego, view->age_s);
    struct sensor_pose pose =
        kinematics_sensor_pose(&motion, view->mount_x_m, view->mount_y_m, view->mount_yaw_rad);
    struct vec2 world_m = vec2_add(pose.position_m, vec2_turn(place_m, pose.boresight));
    double own_mps = vec2_dot(pose.velocity_mps, vec2_turn(sight, pose.boresight));
    quality->x_rear_axle_m = to_part(centre_m.x - frame_rear_axle_x_m(frame, ego), parts);
    quality->x_world_m = to_part(world_m.x, parts);
    quality->y_world_m = to_part(world_m.y, parts);
    quality->range_rate_over_ground_mps = to_part(target->range_rate_mps + own_mps, parts);
    quality->present |= QUALITY_EGO;
}

struct quality detection_quality_of(const struct detection_source *source,
                                    const struct effect_measurement *measurement,
                                    const struct target *target, const struct frame *frame)
{
    struct quality quality = {0};
    add_strength(source, measurement, &quality);
    add_errors(source, measurement, &quality);
    add_labels(source, target, &quality);
    add_places(frame, target, &quality);
    return quality;
}
