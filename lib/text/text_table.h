/* Tables for people, with columns in line. */
#pragma once

#include "base/text.h"

/* Writes rows, which are lines of cells with tabs between them, and frees them. The mark stands
 * before every line, two spaces between columns, none at the end of a line. A column is as wide as
 * its widest cell in bytes, and at least as its width says; below 0 its cells stand at the left, as
 * in "%*s". A 0 ends the widths; further columns share the last one. Changes the widths. */
void text_table_write(struct text *rows, int *widths, const char *mark, struct text *text);
