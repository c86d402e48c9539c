/* The page of glint-view, embedded in the program. The Makefile joins lib/view/page/ into one file.
 * Two lines of it are marks, in this order, that view_head_write and view_columns_write replace. */
#pragma once

#include <stddef.h>

#define VIEW_PAGE_HEAD_MARK "@head@\n"
#define VIEW_PAGE_COLUMNS_MARK "@columns@\n"

/* NUL-terminated; the size is without the NUL. */
extern const char view_page[];
extern const size_t view_page_size;
