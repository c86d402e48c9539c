/* Rows of SUMO's floating car data in XML. */
#pragma once

#include "recorded/recorded_row.h"

/* Takes over the input. */
struct recorded_reader sumo_rows_open(struct input *input, struct arena *arena);
