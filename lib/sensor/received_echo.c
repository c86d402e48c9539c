#include "sensor/received_echo.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "frame/draw_address.h"
#include "radar/carrier.h"
#include "radar/folding.h"
#include "radar/interferer.h"
#include "radar/road_mirror.h"
#include "radar/swerling.h"

#define FOG_C 10
#define AT_HOME                                                                                    \
    (EFFECT_BIT(EFFECT_WHEELS) | EFFECT_BIT(EFFECT_LIMBS) | EFFECT_BIT(EFFECT_CLUTTER) |           \
     EFFECT_BIT(EFFECT_TWO_RAY) | EFFECT_BIT(EFFECT_FLUCTUATION) | EFFECT_BIT(EFFECT_RAIN) |       \
     EFFECT_BIT(EFFECT_FOG) | EFFECT_BIT(EFFECT_AMBIGUITY) | EFFECT_BIT(EFFECT_INTERFERENCE) |     \
     EFFECT_BIT(EFFECT_COHERENCE))

static bool simulates(const struct reception *reception, enum effect effect)
{
    return (reception->effects & EFFECT_BIT(effect)) != 0;
}

bool received_echo_rolls(const struct echo *echo)
{
    return echo->moving_part == MOVING_WHEEL && echo->ground_rate_mps != 0;
}

bool received_echo_walks(const struct echo *echo)
{
    return echo->moving_part == MOVING_LIMBS && echo->ground_rate_mps != 0;
}

static uint64_t described_by_echoes(const struct frame *frame, const struct sensor *sensor)
{
    struct echo_span echoes = frame_echoes_of(frame, sensor->name);
    bool mirrors = frame->conditions.road != ROAD_UNKNOWN && sensor->mount_z_m > 0;
    uint64_t effects = 0;
    for (size_t i = 0; i < echoes.count; i++) {
        const struct echo *echo = &echoes.items[i];
        effects |= (received_echo_rolls(echo) ? EFFECT_BIT(EFFECT_WHEELS) : 0) |
                   (received_echo_walks(echo) ? EFFECT_BIT(EFFECT_LIMBS) : 0) |
                   (mirrors && echo->height_m > 0 ? EFFECT_BIT(EFFECT_TWO_RAY) : 0);
    }
    return effects;
}

static bool has_clutter(const struct frame *frame, const struct sensor *sensor)
{
    const struct conditions *conditions = &frame->conditions;
    const struct sensor_view *view = frame_view(frame, sensor->name);
    return conditions->clutter_per_m2 > 0 && conditions->clutter_ercs > 0 && view != NULL &&
           view->measured;
}

uint64_t received_echo_described(const struct frame *frame, const struct sensor *sensor)
{
    const struct conditions *conditions = &frame->conditions;
    bool receiver = sensor->receiver_bandwidth_hz > 0;
    return described_by_echoes(frame, sensor) |
           (has_clutter(frame, sensor) ? EFFECT_BIT(EFFECT_CLUTTER) : 0) |
           (sensor->fluctuation != FLUCTUATION_NONE ? EFFECT_BIT(EFFECT_FLUCTUATION) : 0) |
           (conditions->rain_mmph > 0 ? EFFECT_BIT(EFFECT_RAIN) : 0) |
           (conditions->fog_gpm3 > 0 ? EFFECT_BIT(EFFECT_FOG) : 0) |
           (sensor->cell_phase != CELL_IN_PHASE ? EFFECT_BIT(EFFECT_COHERENCE) : 0) |
           (sensor->unambiguous_range_m > 0 || sensor->unambiguous_rate_mps > 0
                ? EFFECT_BIT(EFFECT_AMBIGUITY)
                : 0) |
           (receiver && conditions->interferers.count > 0 ? EFFECT_BIT(EFFECT_INTERFERENCE) : 0);
}

/* The antenna's one-way gain is the root of its pattern in amplitude, that is, the pattern itself
 * in power. */
static double interference_of(const struct frame *frame, const struct sensor *sensor,
                              const struct interferer *other, double age_s)
{
    const struct object *ego = frame_object(frame, frame->ego);
    const struct object *carrier = frame_object(frame, other->object);
    if (carrier == NULL || carrier == ego)
        return 0;
    struct motion here = frame_motion(ego, age_s), there = frame_motion(carrier, age_s);
    struct vec2 heading = vec2_heading(here.yaw_rad);
    struct vec2 mount = vec2_turn((struct vec2){sensor->mount_x_m, sensor->mount_y_m}, heading);
    struct vec2 boresight = vec2_turn(vec2_heading(sensor->mount_yaw_rad), heading);
    struct vec2 sight = vec2_sub(vec2_sub(there.position_m, here.position_m), mount);
    double range_m = vec2_length(sight);
    double azimuth_rad = elementary_atan2(vec2_cross(boresight, sight), vec2_dot(boresight, sight));
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

/* Asphalt is assumed, concrete ITU-R P.2040's. */
static struct road_mirror_road road_of(enum road road, double carrier_hz)
{
    if (road == ROAD_ASPHALT)
        return (struct road_mirror_road){5, 0.25, 1e-3};
    double conductivity_spm = 0.0462 * elementary_pow(carrier_hz / 1e9, 0.7822);
    return (struct road_mirror_road){5.24, 17.98 * conductivity_spm / (carrier_hz / 1e9), 3e-4};
}

struct reception received_echo_begin(const struct frame *frame, const struct sensor *sensor,
                                     uint64_t effects)
{
    bool late = (effects & EFFECT_BIT(EFFECT_LATENCY)) != 0;
    double age_s = frame->time_s - suite_instant_s(sensor, frame->time_s, frame->interval_s, late);
    struct reception reception = {
        .frame = frame,
        .sensor = sensor,
        .time_s = suite_instant_s(sensor, frame->time_s, frame->interval_s,
                                  (effects & EFFECT_BIT(EFFECT_LATENCY)) != 0),
        .effects = effects & received_echo_described(frame, sensor),
        .address = draw_address_of_scan(frame, sensor->name),
    };
    if (simulates(&reception, EFFECT_TWO_RAY))
        reception.road = road_of(frame->conditions.road, sensor->carrier_hz);
    if (simulates(&reception, EFFECT_RAIN))
        reception.rain_dbpkm =
            attenuation_rain_dbpkm(attenuation_rain_law(sensor->carrier_hz, sensor->polarization),
                                   frame->conditions.rain_mmph);
    if (simulates(&reception, EFFECT_FOG))
        reception.fog_dbpkm =
            attenuation_fog_dbpkm(sensor->carrier_hz, FOG_C, frame->conditions.fog_gpm3);
    if (simulates(&reception, EFFECT_INTERFERENCE))
        for (size_t i = 0; i < frame->conditions.interferers.count; i++)
            reception.interference +=
                interference_of(frame, sensor, &frame->conditions.interferers.items[i], age_s);
    return reception;
}

void received_echo_note(const struct reception *reception, const struct selection *selection)
{
    for (enum effect effect = 0; effect < EFFECT_COUNT; effect++)
        if ((AT_HOME & EFFECT_BIT(effect)) != 0)
            effects_note(selection, effect, simulates(reception, effect));
}

/* Drawn in each frame, or that of the path and of the reflector, which is drawn once for all
 * frames. */
static double phase_of(const struct reception *reception, const struct echo *echo)
{
    const struct sensor *sensor = reception->sensor;
    struct random_address address = draw_address_in(reception->address, echo->id);
    double uniform[4];
    if (sensor->cell_phase == CELL_RANDOM_PHASE) {
        random_uniform(&address, RANDOM_PHASE, 0, uniform);
        return 2 * PI * uniform[0];
    }
    address.frame = 0;
    random_uniform(&address, RANDOM_REFLECTOR_PHASE, 0, uniform);
    return 2 * PI * (uniform[0] - carrier_phase_turns(echo->range_m, sensor->carrier_hz));
}

static void scale(struct received_echo *received, double factor, enum effect effect)
{
    received->strength *= factor;
    received->amplitude *= factor;
    if (factor != 1)
        received->effects |= EFFECT_BIT(effect);
}

/* Along the road, of a range that elevation has made slant, or not. */
static double distance_m(const struct sensor *sensor, const struct echo *echo)
{
    double up_m = fabs(echo->height_m - sensor->mount_z_m);
    if ((echo->effects & EFFECT_BIT(EFFECT_ELEVATION)) == 0)
        return echo->range_m;
    return sqrt(elementary_max(echo->range_m - up_m, 0) * (echo->range_m + up_m));
}

static void mirror(const struct reception *reception, const struct echo *echo,
                   struct received_echo *received)
{
    const struct sensor *sensor = reception->sensor;
    const struct road_mirror_ends ends = {sensor->mount_z_m, echo->height_m, echo->extent_m,
                                          distance_m(sensor, echo)};
    scale(received,
          road_mirror_amplitude_factor(&reception->road, sensor->polarization,
                                       units_wavelength_m(sensor->carrier_hz), &ends),
          EFFECT_TWO_RAY);
}

static void fluctuate(const struct reception *reception, const struct echo *echo,
                      struct received_echo *received)
{
    const struct sensor *sensor = reception->sensor;
    struct random_address address = draw_address_in(reception->address, echo->id);
    double uniform[4];
    random_uniform(&address, RANDOM_FLUCTUATION, 0, uniform);
    scale(received,
          swerling_amplitude_factor(sensor->fluctuation, sensor->fluctuation_sigma_db, uniform),
          EFFECT_FLUCTUATION);
}

static void fold(const struct sensor *sensor, struct received_echo *received)
{
    double range_m = received->range_m, rate_mps = received->range_rate_mps;
    if (sensor->unambiguous_range_m > 0)
        received->range_m = folding_range_m(range_m, sensor->unambiguous_range_m);
    if (sensor->unambiguous_rate_mps > 0)
        received->range_rate_mps = folding_range_rate_mps(rate_mps, sensor->unambiguous_rate_mps);
    if (received->range_m != range_m || received->range_rate_mps != rate_mps)
        received->effects |= EFFECT_BIT(EFFECT_AMBIGUITY);
}

/* A ghost leaves in one direction and comes back from another: each way has the root of the
 * antenna pattern (EFFECTS 7), and the pointers are those of its arrival. */
static double departure_factor(const struct antenna *antenna, const struct echo *echo,
                               double arrival_gain)
{
    if (echo->departure_rad == 0 || arrival_gain == 0)
        return 1;
    double gain = antenna_gain(antenna, echo->azimuth_rad + echo->departure_rad);
    return sqrt(elementary_max(gain, 0) / arrival_gain);
}

struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad)
{
    struct received_echo received = {
        .echo = frame_contributor(echo),
        .range_m = echo->range_m,
        .range_rate_mps = echo->range_rate_mps,
        .phase_rad = phase_rad,
        .effects = echo->effects,
        .margins = &echo->margins,
    };
    double gain = antenna_gain(&sensor->antenna, echo->azimuth_rad);
    received.strength = radar_reference_amplitude(&sensor->amplitude_law, echo->range_m) *
                        echo->ercs * departure_factor(&sensor->antenna, echo, gain);
    received.amplitude = received.strength * gain;
    return received;
}

struct received_echo received_echo_of(const struct reception *reception, const struct echo *echo)
{
    const struct sensor *sensor = reception->sensor;
    struct received_echo received = received_echo_in_free_space(sensor, echo, 0);
    if (simulates(reception, EFFECT_COHERENCE))
        received.phase_rad = phase_of(reception, echo);
    if (echo->height_m > 0 && simulates(reception, EFFECT_TWO_RAY))
        mirror(reception, echo, &received);
    if (simulates(reception, EFFECT_FLUCTUATION))
        fluctuate(reception, echo, &received);
    if (simulates(reception, EFFECT_RAIN))
        scale(&received, attenuation_amplitude_factor(reception->rain_dbpkm, echo->range_m),
              EFFECT_RAIN);
    if (simulates(reception, EFFECT_FOG))
        scale(&received, attenuation_amplitude_factor(reception->fog_dbpkm, echo->range_m),
              EFFECT_FOG);
    if (simulates(reception, EFFECT_AMBIGUITY))
        fold(sensor, &received);
    return received;
}
