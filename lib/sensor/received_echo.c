#include "sensor/received_echo.h"

#include "base/elementary.h"
#include "effects/effect.h"

/* A_phi = sqrt(A_phi(departure) A_phi(arrival)) of a wave that passes a wall one way (MODEL 14.1).
 * The product is the same for a path and its reverse, so that their levels tie to the last bit. */
static double one_way_gain(double departure_gain, double arrival_gain)
{
    return sqrt(elementary_max(departure_gain, 0) * elementary_max(arrival_gain, 0));
}

/* Scales a ghost by the antenna on both ways; its pointers remain those of the arrival. */
static void weigh_departure(const struct antenna *antenna, const struct echo *echo,
                            double arrival_gain, struct received_echo *received)
{
    double departure_gain = antenna_gain(antenna, echo->departure_azimuth_rad);
    received->amplitude = received->strength * one_way_gain(departure_gain, arrival_gain);
    if (arrival_gain > 0)
        received->strength = received->amplitude / arrival_gain;
}

struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad)
{
    struct received_echo received = {
        .echo = frame_contributor(echo),
        .range_m = echo->range_m,
        .range_rate_mps = echo->range_rate_mps,
        .elevation_rad = echo->elevation_rad,
        .phase_rad = phase_rad,
        .effects = echo->effects,
        .margins = &echo->margins,
    };
    double gain = antenna_gain(&sensor->antenna, echo->azimuth_rad);
    received.strength = radar_strength(&sensor->amplitude_law, echo->range_m, echo->ercs);
    received.amplitude = received.strength * gain;
    if (echo->id.path == PATH_WALL_OBJECT || echo->id.path == PATH_OBJECT_WALL)
        weigh_departure(&sensor->antenna, echo, gain, &received);
    return received;
}

struct received_echo received_echo_of(const struct effect_scan *context, const struct echo *echo)
{
    struct received_echo received = received_echo_in_free_space(context->sensor, echo, 0);
    if (context->receiving == 0)
        return received;
    struct effect_reception reception = {
        .echo = echo,
        .strength = received.strength,
        .amplitude = received.amplitude,
        .range_m = received.range_m,
        .range_rate_mps = received.range_rate_mps,
        .elevation_rad = received.elevation_rad,
    };
    received.effects |= effect_receive(context, &reception);
    received.strength = reception.strength;
    received.amplitude = reception.amplitude;
    received.range_m = reception.range_m;
    received.range_rate_mps = reception.range_rate_mps;
    received.elevation_rad = reception.elevation_rad;
    received.phase_rad = reception.phase_rad;
    received.widening = reception.widening;
    return received;
}
