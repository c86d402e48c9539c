/* Apparent kinematics and strength of mirror ghosts. A radar at S sees an object O along paths with
 * more than one bounce: by way of a wall W that mirrors (mirror.h; MODEL 14.1).
 *
 *     path         function           range      azimuth    range rate
 *     S-O-S        (direct)           R          of O       v
 *     S-W-O-S      ghost_path_out     (R+R')/2   of O       (v+v')/2
 *     S-O-W-S      ghost_path_back    (R+R')/2   of O'      (v+v')/2
 *     S-W-O-W-S    ghost_path_both    R'         of O'      v'
 *
 * R' and v' are range and range rate of the image O' of O in the wall. Ranges are half the path's
 * length, range rates their time derivatives; the azimuth is that of the last leg.
 *
 * The amplitude is given as a factor on the ERCS of O: with it, the radar equation at the ghost's
 * own range gives the ghost's amplitude under 1/R^2. Relative to the direct echo that amplitude is
 * ercs_factor (R / range)^2, which is G R/R' for one way by the wall and G^2 (R/R')^2 for both. G =
 * |Gamma| in [0, 1] is the wall's reflection coefficient. */
#ifndef GHOST_PATH_H
#define GHOST_PATH_H

#include "geometry/kinematics.h"
#include "geometry/mirror.h"

struct ghost_path {
    struct kinematics kinematics;
    double ercs_factor; /* >= 0 */
};

/* direct and image are the kinematics of O and of O' (mirror_image), at ranges R > 0; mirror_bounce
 * says whether these paths exist. The loss at a bistatic angle is not included. */
struct ghost_path ghost_path_out(double reflection, const struct kinematics *direct,
                                 const struct kinematics *image);
struct ghost_path ghost_path_back(double reflection, const struct kinematics *direct,
                                  const struct kinematics *image);
struct ghost_path ghost_path_both(double reflection, const struct kinematics *image);

#endif
