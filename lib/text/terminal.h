/* The width of a terminal, and text that fits it. */
#pragma once

#include "base/text.h"

/* The columns of the terminal at a descriptor; 0: it is none, or does not tell. */
size_t terminal_columns(int fd);

/* Breaks, at blanks, the lines that are wider than so many columns; 0 breaks none. A line of a
 * table, whose columns have two blanks between them, goes on behind four blanks, a comment behind
 * "# ". Words that are too wide, and commands that continue behind a backslash, stay as they are.
 */
void terminal_fit(struct text *text, size_t columns);
