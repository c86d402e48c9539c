#include "effects/moving_part.h"

bool moving_part_is(const struct echo *parent, enum moving_part part)
{
    return parent->moving_part == part && parent->ground_rate_mps != 0;
}

bool moving_part_any(const struct effect_scan *scan, enum moving_part part)
{
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (moving_part_is(&scan->echoes.items[i], part))
            return true;
    return false;
}

struct echo moving_part_of(const struct echo *parent, enum path path, int64_t number, double factor,
                           enum effect_id effect)
{
    struct echo part = *parent;
    part.id.path = path;
    part.id.number = number;
    part.ercs *= factor;
    part.moving_part = MOVING_NONE;
    part.effects |= EFFECT_BIT(effect);
    part.extra = NULL;
    return part;
}
