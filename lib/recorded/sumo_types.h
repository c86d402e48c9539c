/* Own types of SUMO, and the vTypes of a file.
 *
 * The tags of such a file are read here, in memory, because glint-traffic takes --types for tables
 * too and is linked without an XML parser. */
#pragma once

#include "recorded/recorded_classes.h"

/* SUMO's classes and default types, with its sizes of them; ends with a word NULL. */
extern const struct recorded_word sumo_types_words[];

/* Adds the vTypes of a file of SUMO's routes or additional elements; -1 after a message. */
int sumo_types_read(struct recorded_classes *classes, const char *path, struct diag *diag);
