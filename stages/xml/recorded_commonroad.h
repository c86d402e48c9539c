/* Reader of the obstacles of a CommonRoad scenario in XML. */
#pragma once

#include "recorded/recorded_row.h"

/* Takes over the input. */
struct recorded_reader recorded_commonroad_open(struct input *input, struct arena *arena);
