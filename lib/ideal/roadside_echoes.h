/* Echoes of what stands still beside the road.
 *
 * A scatterer of the frame's strips (propagation/roadside.h) becomes an echo if it is in range and
 * in view and no body hides it. The echo's object is "roadside", which is no object of the frame;
 * its reflector is the kind of the strip, its path is clutter, and its number is the same in every
 * frame of a scene and for every sensor. A scatterer is left out if its echo, with antenna and
 * level, would be more than 14 dB below the sensor's threshold at the range of its cell's middle,
 * or more than 26 dB where the road mirrors (MODEL 14.23). */
#pragma once

#include "ideal/look.h"

/* Adds the echoes to the frame, and the sensor's count of them. auto skips cells that are surely
 * out of the sensor's range or view. */
void roadside_echoes_add(struct look *look);
