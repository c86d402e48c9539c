/* What a radar reads off an object O along paths with more than one bounce (EFFECTS 7): by way of a
 * wall W that mirrors (mirror.h), and back and forth between two bodies. S is the sensor.
 *
 *     path         name               range      azimuth   range rate
 *     S-O-S        direct             R          of O      v
 *     S-W-O-S      ghost_path_out          (R+R')/2   of O      (v+v')/2
 *     S-O-W-S      ghost_path_back         (R+R')/2   of O'     (v+v')/2
 *     S-W-O-W-S    ghost_path_both         R'         of O'     v'
 *
 * R' and v' are those of the image O', d is the distance from O to the wall, E the ego. Ranges are
 * half the path's length, rates their time derivatives; the azimuth is that of the last leg.
 *
 * Amplitudes are given as the factor on the ERCS of O with which the radar equation at the ghost's
 * own range comes out right under 1/R^2: relative to the direct echo the amplitude is
 * ercs_factor (R / range)^2, that is G R/R' for one way by the wall and G^2 (R/R')^2 for both.
 * G = |Gamma| in [0, 1] is the wall's reflection coefficient. */
#ifndef GHOST_PATH_H
#define GHOST_PATH_H

#include "geometry/kinematics.h"
#include "geometry/mirror.h"

struct ghost_path {
    struct kinematics sight;
    double ercs_factor; /* >= 0 */
};

/* Direct and image are O and O' (mirror_image) as kinematics_of has them, R > 0; these paths exist
 * where mirror_bounce says so. The bistatic loss is not in. */
struct ghost_path ghost_path_out(double reflection, const struct kinematics *direct,
                                 const struct kinematics *image);
struct ghost_path ghost_path_back(double reflection, const struct kinematics *direct,
                                  const struct kinematics *image);
struct ghost_path ghost_path_both(double reflection, const struct kinematics *image);

#endif
