/* Mirror ghosts: echoes by way of walls, guardrails and vehicles.
 *
 * MODEL 14.1 has the rules, mirror.h the formulas. A sensor's `bounces` limits the
 * bounces of a path, off objects and mirrors together: 2 allows wall_object (sensor, wall, object,
 * sensor) and object_wall, its reverse; 3 also allows wall_object_wall. A path has one mirror: any
 * mirror of any body but the reflector's own. A bounce exactly on the joint of two mirrors in line
 * is the second one's. The mirror's body can block the direct leg, and the reflector's body the leg
 * between sensor and mirror. look.h has factors for there and back: a path that travels a leg once
 * has their square roots. */
#pragma once

#include "ideal/look.h"

/* Adds all ghosts of the look's sensor to the frame, and the sensor's counts of them. An echo's
 * `mirror` is the id of the mirror's object, its `number` which of that object's mirrors, from 1.
 * auto passes over bodies and mirrors that surely have no path within the sensor's range and view,
 * and pairs of both that surely have no bounce (mirror_may_bounce). */
void ghost_echoes_add(struct look *look);
