/* Apparent kinematics and strength of mirror ghosts. MODEL 14.1 has the paths of more than one
 * bounce between a sensor S, an object O and a wall W: ghost_path_out is S-W-O-S, ghost_path_back
 * S-O-W-S and ghost_path_both S-W-O-W-S.
 *
 * ercs_factor, on the ERCS of O, is what the bounces leave and the spreading over the path's two
 * ways, over that of an echo at the ghost's own range, as the receiver reckons by its delay. */
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
