/* Echoes of what stands still beside the road.
 *
 * The scatterers of the frame's strips (propagation/roadside.h) in range and in view that no body
 * hides become echoes of the object "roadside", which is none of the frame, with the kind of the
 * strip as reflector and the path clutter. A scatterer has the same number in every frame of a
 * scene and for every sensor. Those are left out whose echo would be more than 14 dB below the
 * sensor's threshold at the range of their cell's middle, or more than 26 dB where the road
 * mirrors; the antenna and the level count (MODEL 14.23). */
#pragma once

#include "ideal/look.h"

/* Adds the echoes to the frame, and the sensor's count of them. auto skips cells that are surely
 * out of the sensor's range or view. */
void roadside_echoes_add(struct look *look);
