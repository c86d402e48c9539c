/* Direct echoes of one sensor, or why there is none.
 *
 * Every reflector of an object either becomes an echo of the frame or is listed in lost. The reason
 * is the first that applies (MODEL 2.5): the reflector faces away or has no specular point, is out
 * of range, out of view, or blocked. */
#pragma once

#include "ideal/look.h"

/* Adds the echo or the loss of every reflector of every object to the frame, and the sensor's
 * counts of pairs and direct echoes. */
void direct_echoes_add(struct look *look);
