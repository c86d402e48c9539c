/* An echo's label as in the Radar Ghost data set.
 *
 * It is the data set's label_id (Kraus et al. 2021): class, main object, bounce type and bounce
 * order, a digit each. All objects count as its main one, because all ghosts are told apart. */
#ifndef RADAR_GHOST_LABEL_H
#define RADAR_GHOST_LABEL_H

#include <stdint.h>

#include "frame/frame.h"

/* class is that of the echo's object; NULL: it has none. */
int64_t radar_ghost_label_of(enum path path, const char *class);

#endif
