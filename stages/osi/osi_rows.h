/* Rows of the ground truth in an OSI trace. */
#pragma once

#include "recorded/recorded_row.h"

/* Takes over the input. If rear_axle is set, velocities are those of rear axles. *host becomes the
 * id of the host vehicle in the first message, or NULL; format is NULL after a message. Ids and
 * classes of a trace of glint-osi are glint's own. */
struct recorded_reader osi_rows_open(struct input *input, bool rear_axle, const char **host,
                                     struct arena *arena, struct diag *diag);
