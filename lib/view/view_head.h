/* The head of the data in the page of glint-view: all but the columns. */
#ifndef VIEW_HEAD_H
#define VIEW_HEAD_H

#include "view/view_data.h"

/* JSON without any `<`, so that no name can end the script element that it stands in: names,
 * scenes, sensors, classes, and where each column lies. open_frame is where the page is to start;
 * -1 leaves it to the page. */
void view_head_write(const struct view_data *data, int64_t open_frame, struct text *text);

#endif
