/* Finds, reads and checks a sensor suite by name (data/sensors/).
 *
 * A document may extend another suite, by a name or by its path from here. Then it has the members
 * of that one, but for those that it states itself or sets to null; sensors are matched by their
 * names. */
#pragma once

#include "documents/suite.h"

/* Loads a suite with its tables and derived members into the arena. The digest is a 64-bit hash of
 * all values of the document and of its tables, whatever their spelling and the order of members;
 * `origin`, `sources` and `assumed` do not enter. NULL after a message (DIAG_CONFIG). */
const struct suite *suite_file_load(const char *name, struct arena *arena, struct diag *diag);
