/* Where a draw belongs (random.h): the seed and scene of the frame, the sensor, and what the echo
 * is of. A cell draws by its leader. */
#ifndef DRAW_ADDRESS_H
#define DRAW_ADDRESS_H

#include "base/random.h"
#include "frame/frame.h"

/* Of a whole scan, without a subject, and of a subject in it. */
struct random_address draw_address_of_scan(const struct frame *frame, const char *sensor);
struct random_address draw_address_in(struct random_address scan, struct echo_id id);

struct random_address draw_address_of(const struct frame *frame, const char *sensor,
                                      struct echo_id id);

#endif
