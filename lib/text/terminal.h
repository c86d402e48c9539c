/* The width of a terminal, and text that fits it. */
#pragma once

#include "base/text.h"

/* The columns of the terminal at a descriptor; 0: it is none, or does not tell. */
size_t terminal_columns(int fd);

/* Breaks lines that are wider than so many columns at blanks; 0: none. Lines of tables, whose
 * columns have two blanks between them, go on behind four blanks, comments behind "# ". Words that
 * are too wide, and commands that go on behind a backslash, stay as they are. */
void terminal_fit(struct text *text, size_t columns);
