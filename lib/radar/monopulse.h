/* The angle that a monopulse radar reads off its two channels (MODEL 7.2, 7.4, 8). */
#ifndef MONOPULSE_H
#define MONOPULSE_H

#include <stdbool.h>

#include "radar/antenna.h"

enum monopulse_estimator {
    /* The paper's: magnitude from |delta| and |sum| (the additive sensing ratio, equation 7), sign
     * from the phase between them. Discontinuous where the sign is undecided. Under PHASE_ELEMENT
     * one ulp also decides for a side, unflagged, where nearly equal echoes lie within about 1
     * degree to both sides of boresight: the angle is then below 7e-4 rad (NUMERICS 11). */
    MONOPULSE_MAGNITUDE,
    /* The real ratio -Im(delta conj(sum)) / |sum|^2: the same for one target, continuous for
     * several. */
    MONOPULSE_RATIO,
};

struct monopulse_angle {
    bool valid; /* false if both pointers are zero: there is no angle to report */
    /* The phase does not tell left from right. The ratio needs no sign, unless the sum is exactly
     * 0. A delta of exactly 0 has none to decide. */
    bool sign_undecided;
    double azimuth_rad; /* [-pi/2, pi/2]; positive where the sign is undecided; 0 if invalid */
};

struct monopulse_angle monopulse_angle(const struct antenna *antenna,
                                       enum monopulse_estimator estimator,
                                       struct antenna_pointers pointers);

/* How far the magnitude rule was from the other sign: |Im(delta conj(sum))| / (|delta| |sum|), from
 * 0, undecided, to 1. NaN where a pointer is zero and there is no sign. */
double monopulse_sign_margin(struct antenna_pointers pointers);

/* The additive sensing ratio (|delta| - |sum|) / (|delta| + |sum|) in [-1, 1], equation (7).
 * For figures and tests: the pair itself carries more digits. Not both may be zero. */
double monopulse_asr(struct antenna_pointers pointers);

#endif
