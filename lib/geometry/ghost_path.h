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
 * The wave spreads over both of its ways, R and R', and every bounce on the wall leaves G in [0, 1]
 * of its amplitude. What the receiver makes of it, A_ref of radar_equation.h, goes by the delay and
 * so by the ghost's own range. So ercs_factor, on the ERCS of O, is the spreading of an echo at
 * that range over the path's own: G ((R+R')/2)^2/(R R') for one way by the wall, G^2 for both.
 * Under 1/R^2 the amplitude relative to the direct echo's is G R/R' and G^2 (R/R')^2. */
#pragma once

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
