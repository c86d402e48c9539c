/* SVG drawing of one frame, to scale, for reports. Light colours, no scripts. */
#pragma once

#include "base/text.h"
#include "view/view_frame.h"

/* Draws the ego, the objects, the targets with their reflection centres, and echoes lost for a
 * notable reason (view_frame_loss_is_notable). x points right. */
void view_svg_write(const struct frame *frame, struct view_models *models, struct text *text);

/* Draws a note that the stream is empty. */
void view_svg_write_empty(struct text *text);
