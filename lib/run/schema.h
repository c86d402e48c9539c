/* JSON Schemas (2020-12), printed from the tables of fields. There is one of the frame and one of
 * every document. */
#pragma once

#include "base/text.h"

/* The name of a schema, "frame" and so on, by its number from 0; NULL after the last. */
const char *schema_name(size_t index);

/* Writes the schema of that number. */
void schema_write(size_t index, struct text *text);
