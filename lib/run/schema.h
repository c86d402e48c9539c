/* JSON Schemas (2020-12) of the frame and of every document, printed from the field tables. */
#ifndef SCHEMA_H
#define SCHEMA_H

#include <stdbool.h>

#include "base/text.h"

/* "frame", "scenario", ...: one a line. */
void schema_list(struct text *text);

/* False if there is no schema of that name. */
bool schema_write(const char *name, struct text *text);

#endif
