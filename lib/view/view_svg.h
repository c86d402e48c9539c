/* One frame as a still for reports: an SVG drawing to scale, light, without scripts. */
#ifndef VIEW_SVG_H
#define VIEW_SVG_H

#include "base/text.h"
#include "view/view_frame.h"

/* The ego, everything that lies near the sensors or made a target, the targets with the reflection
 * centres behind them, and what was nearly one. x points right. */
void view_svg_write(const struct frame *frame, struct view_models *models, struct text *text);

/* What stands in for a drawing of an empty stream. */
void view_svg_write_empty(struct text *text);

#endif
