/* The page of glint-view, written with its head and columns.
 *
 * The page is lib/view/page/, which the Makefile joins into one file and embeds. Two lines of it
 * are marks, in whose places the head and the columns stand. */
#pragma once

#include "base/text.h"
#include "view/view_data.h"

extern const char view_page[]; /* ends with NUL */

/* Writes the head as JSON without any `<`, so that no name can end the script element that holds
 * it: names, scenes, sensors, and the place of each column. open_frame is the frame that the page
 * opens with; -1 leaves it to the page. */
void view_page_write_head(const struct view_data *data, int64_t open_frame, struct text *text);

/* Writes the whole page. */
void view_page_write(const struct view_data *data, int64_t open_frame, struct text *text);
