/* Finds, reads and checks sensor suites by name (data/sensors/). */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include "documents/suite.h"

/* The path of a document of a kind (a folder in data/) by its name. Refuses "-", because standard
 * input is the stream of frames. NULL after a message (DIAG_CONFIG). */
const char *catalogue_path(const char *kind, const char *name, struct arena *arena,
                           struct diag *diag);

/* Loads a suite with its tables and derived members. The digest is a 64-bit hash over the document
 * and every table. All of it lies in the arena; NULL after a message (DIAG_CONFIG). */
const struct suite *catalogue_suite(const char *name, struct arena *arena, struct diag *diag);

#endif
