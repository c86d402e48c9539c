/* Rows of the obstacles in a CommonRoad scenario. */
#pragma once

#include "recorded/recorded_row.h"

/* Takes over the input. */
struct recorded_reader commonroad_rows_open(struct input *input, struct arena *arena);
