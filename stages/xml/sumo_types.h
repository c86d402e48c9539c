/* The vTypes of a file of SUMO, in XML. */
#pragma once

#include "recorded/recorded_row.h"

/* Adds the vTypes of a file of routes or additional elements to the types; -1 after a message. */
int sumo_types_read(struct recorded_types *types, const char *path, struct arena *arena,
                    struct diag *diag);
