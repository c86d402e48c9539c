/* Names, scenes and column places that the page reads first. */
#pragma once

#include "view/view_data.h"

/* Writes the head as JSON without any `<`, so that no name can end the script element that holds
 * it: names, scenes, sensors, and the place of each column. open_frame is the frame that
 * the page opens with; -1 leaves it to the page. */
void view_head_write(const struct view_data *data, int64_t open_frame, struct text *text);
