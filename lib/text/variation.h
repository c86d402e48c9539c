/* Draws in the place of a document's distributions. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "base/random.h"

/* The line of a document (document.h) with a draw in the place of every distribution. Any value may
 * be an object whose one member names a law:
 *
 *     {"uniform": [low, high]}  {"normal": [mean, sd]}  {"choice": [value, value, ...]}
 *
 * A choice takes any values, and they may hold distributions themselves. A normal draw is at most
 * 8.57 sd from the mean. Each draw is at the given address, with the hash of the member's path
 * ("objects[1].speed_mps") in its item. NULL after a message that begins with the member. */
const char *variation_draw(const char *line, struct random_address address, struct arena *arena,
                           struct diag *diag);

/* The $defs of a JSON Schema: distributions of any value (drawn) and of numbers (drawn_number). */
extern const char variation_schema[];
