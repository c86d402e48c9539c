/* The page of glint-view: lib/view/page/ joined into one file and embedded by the Makefile. Two
 * lines of it are marks, in this order, to be replaced by what view_data.h writes. */
#ifndef VIEW_PAGE_H
#define VIEW_PAGE_H

#include <stddef.h>

#define VIEW_PAGE_HEAD_MARK "@head@\n"
#define VIEW_PAGE_COLUMNS_MARK "@columns@\n"

/* NUL-terminated; size is without the NUL. */
extern const char view_page[];
extern const size_t view_page_size;

#endif
