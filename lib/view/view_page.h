/* The page of glint-view, written with its head and columns.
 *
 * The page is lib/view/page/, which the Makefile joins into one file and embeds. Two lines of it
 * are marks, in whose places the head and the columns stand. */
#pragma once

#include "base/text.h"
#include "view/view_data.h"

extern const char view_page[]; /* ends with NUL */

/* The place of a column in the text of view_page_write_columns. */
struct view_column_place {
    const char *name;
    const char *type; /* "f4", "u1", "u2" or "u4": kind and bytes of its numbers */
    int64_t count;    /* how many numbers it has */
    int64_t begin;    /* index of its first character */
};

/* Fills in the places of all COLUMN_COUNT columns. Real numbers take single precision, whole
 * numbers as few bytes as the largest of the column allows. */
void view_page_places(const struct view_columns *columns, struct view_column_place *places);

/* Writes all columns in base64, each beginning at a multiple of 16 characters. */
void view_page_write_columns(const struct view_columns *columns, struct text *text);

/* Writes the head as JSON without any `<`, so that no name can end the script element that holds
 * it: names, scenes, sensors, and the place of each column. open_frame is the frame that the page
 * opens with; -1 leaves it to the page. */
void view_page_write_head(const struct view_data *data, int64_t open_frame, struct text *text);

/* Writes the whole page. */
void view_page_write(const struct view_data *data, int64_t open_frame, struct text *text);
