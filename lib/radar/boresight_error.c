#include "radar/boresight_error.h"

#include "base/elementary.h"
#include "base/units.h"

double boresight_error_reported_rad(const struct boresight_error *error, double azimuth_rad)
{
    double reported_rad = azimuth_rad + error->yaw_error_rad;
    if (error->bias_rad != 0) {
        double turns = azimuth_rad / error->bias_period_rad;
        double angle_rad = 2 * PI * turns + error->bias_phase_rad;
        reported_rad += error->bias_rad * elementary_sin(angle_rad);
    }
    return units_wrap_rad(reported_rad);
}
