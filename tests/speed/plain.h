/* The floor under the physics: the time of the paper's radar when it is written down plainly, with
 * no library, no labels, no checks, no options and no care for hard cases. */
#pragma once

#include <stddef.h>

enum { PLAIN_CENTRES = 66 };

struct plain_vehicle {
    double x_m, y_m, yaw_rad, speed_mps, length_m, width_m;
};

struct plain_target {
    double range_m, azimuth_rad, range_rate_mps, amplitude;
};

/* The targets that a radar at (0, 0), moving along x at 30 m/s, reports of these vehicles: of the
 * reflection centres that face it (at most PLAIN_CENTRES) those that no vehicle hides, merged into
 * resolution cells, with a monopulse angle each. Returns how many targets there are, at most
 * PLAIN_CENTRES. */
size_t plain_targets(const struct plain_vehicle *vehicles, size_t count,
                     struct plain_target *targets);
