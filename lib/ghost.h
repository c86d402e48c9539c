/* What a radar reads off an object O along paths with more than one bounce (EFFECTS 7): by way of a
 * wall W that mirrors (mirror.h), and back and forth between two bodies. S is the sensor.
 *
 *     path         name               range      azimuth   range rate
 *     S-O-S        direct             R          of O      v
 *     S-W-O-S      ghost_out          (R+R')/2   of O      (v+v')/2
 *     S-O-W-S      ghost_back         (R+R')/2   of O'     (v+v')/2
 *     S-W-O-W-S    ghost_both         R'         of O'     v'
 *     S-O-W-O-S    ghost_behind       R+d        of O      v + dd/dt
 *     S-O-E-O-S    ghost_double       2R         of O      2v
 *
 * R' and v' are those of the image O', d is the distance from O to the wall, E the ego. Ranges are
 * half the path's length, rates their time derivatives; the azimuth is that of the last leg.
 *
 * Amplitudes are given as the factor on the ERCS of O with which the radar equation at the ghost's
 * own range comes out right under 1/R^2: relative to the direct echo the amplitude is
 * ercs_factor (R / range)^2, that is G R/R' for one way by the wall and G^2 (R/R')^2 for both.
 * G = |Gamma| in [0, 1] is the wall's reflection coefficient. */
#ifndef GHOST_H
#define GHOST_H

#include "mirror.h"
#include "sight.h"

struct ghost {
    struct sight sight;
    double ercs_factor; /* >= 0 */
};

/* Direct and image are O and O' (mirror_image) as sight_of has them, R > 0; these paths exist where
 * mirror_bounce says so. The bistatic loss is not in (ghost_bistatic_factor). */
struct ghost ghost_out(double reflection, const struct sight *direct, const struct sight *image);
struct ghost ghost_back(double reflection, const struct sight *direct, const struct sight *image);
struct ghost ghost_both(double reflection, const struct sight *image);

/* O lights its own image from 2 d away; there is such a path where reflection_foot of O exists.
 * Relative to direct G sqrt(sigma / (4 pi)) / (2 d), and at most G: the first is derived in the way
 * of ghost_double, the bound is assumed. object is O itself with its velocity. No amplitude if
 * R = 0. */
struct ghost ghost_behind(double reflection, double ercs, const struct sight *direct,
                          const struct mirror_image *object, const struct mirror_image *image);

/* Relative to direct sqrt(sigma sigma_ego) / (4 pi R^2), at most the 1/4 of two flat faces. */
struct ghost ghost_double(double ercs, double ego_ercs, const struct sight *direct);

/* What is left of a vehicle's amplitude when the legs to the sensor and to the bounce enclose the
 * angle b: 10^(-(6/20) sin(1.65 b/2)) cos(b/2)^(1/4) (3GPP TR 38.901, 7.9.2). In [0, 1]. */
double ghost_bistatic_factor(struct vec2 sensor_m, struct vec2 bounce_m, struct vec2 point_m);

#endif
