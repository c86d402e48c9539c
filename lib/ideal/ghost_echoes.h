/* Mirror ghosts: what a sensor sees by way of walls, guardrails and the sides of vehicles
 * (EFFECTS 7; mirror.h and ghost_path.h have the formulas).
 *
 * A sensor's `bounces` says how many a path may have, off objects and mirrors together: 2 allows
 * wall_object (sensor, wall, object, sensor) and object_wall, its reverse; 3 allows
 * wall_object_wall too. Every mirror of every other body than the reflector's own counts, and none
 * twice on a path: there is no recursion.
 *
 * A ghost of a point or post exists where the mirror has a bounce for it (mirror_bounce), the point
 * is visible from the bounce, the ways between sensor, bounce and point are free, and range and
 * arrival are within the sensor's limits. Paths with a direct way need the point visible on it and
 * that way free too, and their other end less than 90 degrees off boresight, where the antenna
 * still has a pattern. Their cross section is that of the geometric mean of both visibilities, so
 * that both ways round are equally strong. A plane has a ghost where the sensor's image has a foot
 * on it, on wall_object_wall alone: only there does the wave come back on itself.
 *
 * No way is blocked by what it begins or ends on: neither by the mirror's own body, of which it
 * touches the outer face alone (nor by one with a mirror in line that meets this one at an end: two
 * such are one wall, and a bounce exactly on their joint is the second one's), nor by the
 * reflector's, whose visibility decides. But the mirror's body can stand in a direct way, and the
 * reflector's between sensor and mirror. Nothing passes under vehicles.
 *
 * Heights run straight along the unfolded path, and a bounce above the mirror's top is none. What a
 * height, a beam or a soft shadow takes of a way there and back (look.h), a path that goes that way
 * once loses the root of. Planes have the curvature of direct echoes, at the image's distance.
 *
 * A ghost that is not seen is not made: it has no entry in lost. */
#ifndef GHOST_ECHOES_H
#define GHOST_ECHOES_H

#include "ideal/look.h"

/* Every ghost of the look's sensor: adds echoes and the sensor's counts to the frame, after
 * look_around. An echo's mirror is the id of the mirror's object, its number which of the mirrors
 * there, from 1. Under auto a body and a mirror that can have nothing to do with each other
 * (mirror_may_bounce) are passed over at once. */
void ghost_echoes_add(struct look *look);

#endif
