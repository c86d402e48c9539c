/* Mirror ghosts: echoes by way of walls, guardrails and vehicles.
 *
 * MODEL 14.1 has the rules, mirror.h and ghost_path.h the formulas. A sensor's `bounces` limits the
 * bounces of a path, off objects and mirrors together: 2 allows wall_object (sensor, wall, object,
 * sensor) and object_wall, its reverse; 3 also allows wall_object_wall. A path has one mirror: any
 * mirror of any body but the reflector's own.
 *
 * A point or post has a ghost if the mirror has a bounce for it (mirror_bounce), the point is
 * visible from the bounce, no body blocks a leg between sensor, bounce and point, and the ghost's
 * range and azimuth are within the sensor's limits. A one-way path, wall_object or object_wall,
 * also needs the point to be visible from the sensor, the direct leg to be free, and the wave to
 * leave no more than 90 degrees off boresight, where the antenna still has a pattern. Its ERCS is
 * that of the geometric mean of both visibilities, so that both ways round are equally strong. A
 * plane has a ghost on wall_object_wall alone, where the sensor's image has a foot on it: only
 * there does the wave return on its own path.
 *
 * A body blocks no leg that begins or ends on it. At the bounce that is the mirror's body, of which
 * the leg touches the outer face alone, and a body with a mirror in line that meets this one at an
 * end: two such mirrors are one wall, and a bounce exactly on their joint is the second one's. At
 * the point it is the reflector's body, whose visibility decides instead. The mirror's body can
 * still block the direct leg, and the reflector's body the leg between sensor and mirror. Nothing
 * passes under vehicles.
 *
 * Heights run straight along the unfolded path, and a bounce above the mirror's top or below its
 * lower edge does not exist.
 * A path that travels a leg once has the square root of the leg's factors for height, beam and soft
 * shadow, which look.h has for there and back. Planes have the curvature of direct echoes, at the
 * image's distance.
 *
 * A ghost that is not seen is not made and has no entry in lost. */
#pragma once

#include "ideal/look.h"

/* Adds all ghosts of the look's sensor to the frame, and the sensor's counts of them. An echo's
 * `mirror` is the id of the mirror's object, its `number` which of that object's mirrors, from 1.
 * auto passes over a body and a mirror that surely have no bounce (mirror_may_bounce). */
void ghost_echoes_add(struct look *look);
