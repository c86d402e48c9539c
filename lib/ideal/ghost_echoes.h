/* Mirror ghosts: echoes by way of walls, guardrails and vehicles.
 *
 * MODEL 14.1 has the rules, mirror.h the formulas. A sensor's `bounces` limits the bounces of a
 * path, off objects and mirrors together: 2 allows wall_object (sensor, wall, object, sensor) and
 * its reverse object_wall; 3 also allows wall_object_wall. A path has one mirror, on any body but
 * the reflector's own. A bounce exactly on the joint of two mirrors in line belongs to the second
 * one. The mirror's body can block the direct leg, and the reflector's body can block the leg
 * between sensor and mirror. Factors on amplitude are for a leg there and back; a path that travels
 * a leg once has their square roots. */
#pragma once

#include "ideal/look.h"

/* Adds all ghosts of the look's sensor to the frame, and the sensor's counts of them. `mirror` of
 * an echo is the id of the mirror's object, `number` is that of the mirror on this object, from 1.
 * auto skips mirrors, bodies and posts that surely have no path within the sensor's range and
 * view, where both the body and its image count, and pairs that surely have no bounce
 * (mirror_may_bounce, mirror_clip). */
void ghost_echoes_add(struct look *look);
