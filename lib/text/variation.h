/* Documents whose values are drawn from distributions, by address.
 *
 * Any value of a document may be an object with one member that names a law:
 *
 *     {"uniform": [low, high]}  {"normal": [mean, sd]}  {"choice": [value, value, ...]}
 *
 * A choice takes any values, and they may hold distributions themselves. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "base/random.h"

/* The line of a document (document_line) with a draw in the place of every distribution, in the
 * arena; NULL after a message that begins with the member. Each draw is at the given address, with
 * the hash of the member's path ("objects[1].speed_mps") in its item. A normal draw is at most 8.57
 * sd from the mean. */
const char *variation_draw(const char *line, struct random_address address, struct arena *arena,
                           struct diag *diag);
