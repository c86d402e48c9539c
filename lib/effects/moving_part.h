/* Echoes of rolling wheels and of limbs.
 *
 * A direct echo, the parent, stays as it is; its parts are echoes of the same object and reflector
 * on the path wheel or limb, with numbers from 1. A part has its parent's height, time, effects and
 * margins, and a share of its cross section. */
#pragma once

#include "effects/effect.h"

/* Has the echo such a part, which moves along the sight line? Otherwise all parts would have the
 * echo's own range rate, and none is made. */
bool moving_part_is(const struct echo *parent, enum moving_part part);

/* Has any echo of the scan such a part? */
bool moving_part_any(const struct effect_scan *scan, enum moving_part part);

/* Part `number` at its parent's place and range rate, with factor times its parent's ERCS. Adds the
 * effect to its label. */
struct echo moving_part_of(const struct echo *parent, enum path path, int64_t number, double factor,
                           enum effect_id effect);
