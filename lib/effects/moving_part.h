/* Echoes of parts that move on their own: rolling wheels, limbs.
 *
 * They are echoes of the object and reflector that they were made for, their parent, on the path
 * wheel or limb, with numbers from 1; they have its height, time, effects and margins, and a part
 * of its cross section. Their parent is a direct echo, and stays as it is. */
#ifndef MOVING_PART_H
#define MOVING_PART_H

#include "effects/effect.h"

/* Does this echo have such a part that moves along the sight line? Else all parts would have its
 * own rate, and nothing is made. */
bool moving_part_is(const struct echo *parent, enum moving_part part);

/* Does any echo of the scan? */
bool moving_part_any(const struct effect_scan *scan, enum moving_part part);

/* The part of that number, at its parent's place and rate, with factor times its cross section. */
struct echo moving_part_of(const struct echo *parent, enum path path, int64_t number, double factor,
                           enum effect_id effect);

#endif
