/* The data sheet of a suite, as text for people. */
#pragma once

#include "base/text.h"
#include "documents/suite.h"

/* Adds a sheet for every sensor, in degrees, dBsm, m and km/h; sensors that differ in nothing but
 * name and mount share one. A check that does not hold is a line that begins with "doubt:". */
void datasheet_text_add(const struct suite *suite, struct text *text);
