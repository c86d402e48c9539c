/* Direct echoes: which reflectors a look sees, and as what (MODEL 2.2 to 2.5, 5).
 *
 * Every reflector of an object either becomes an echo in the frame or is written down as lost, with
 * the first reason that applies: it faces away or mirrors past the sensor, it is out of range, out
 * of view, or blocked. */
#ifndef DIRECT_ECHOES_H
#define DIRECT_ECHOES_H

#include "ideal/look.h"

/* Every reflector of every object: adds echoes, losses and the sensor's count to the frame. */
void direct_echoes_add(struct look *look);

#endif
