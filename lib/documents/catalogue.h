/* Sensor suites by name: found, read with their tables, and checked (data/sensors/). */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include "documents/suite.h"

/* The path of a document of that kind (a folder in data/), by its name; "-" is refused, for
 * standard input is the stream of frames itself. NULL after a message (DIAG_CONFIG). */
const char *catalogue_path(const char *kind, const char *name, struct arena *arena,
                           struct diag *diag);

/* A suite with the tables it names, its derived members, and its digest: a 64-bit hash over the
 * document and every table. All it holds lies in the arena; NULL after a message (DIAG_CONFIG). */
const struct suite *catalogue_suite(const char *name, struct arena *arena, struct diag *diag);

#endif
