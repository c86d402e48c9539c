#include "sensor/received_echo.h"

#include "base/elementary.h"
#include "effects/effect.h"

/* Factor on the strength of a ghost whose wave leaves in another direction than it arrives from:
 * each way counts with the root of the antenna pattern, and the pointers are those of the arrival.
 */
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
    received.strength = radar_strength(&sensor->amplitude_law, echo->range_m, echo->ercs) *
                        departure_factor(&sensor->antenna, echo, gain);
    received.amplitude = received.strength * gain;
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
    };
    received.effects |= effect_receive(context, &reception);
    received.strength = reception.strength;
    received.amplitude = reception.amplitude;
    received.range_m = reception.range_m;
    received.range_rate_mps = reception.range_rate_mps;
    received.phase_rad = reception.phase_rad;
    received.widening = reception.widening;
    return received;
}
