/* Sets of vehicle documents, each known by a word.
 *
 * The set "detailed" is data/detailed/vehicles. The set "paper" is data/vehicles, where classes are
 * looked up that another set does not have. A bare name (no slash, no dot) means a set; anything
 * else is the path of a folder. */
#pragma once

#include "documents/vehicle.h"
#include "text/document.h"

/* The folder that a word or path means, for vehicle_load; *folder is NULL for NULL and for "paper",
 * as no folder then stands before the others. The message about an unknown word (DIAG_CONFIG) names
 * the option or member that has it, and the known words. 0, or -1 after a message. */
int vehicle_set_folder(const char *named_by, const char *word, const char **folder,
                       struct arena *arena, struct diag *diag);

/* The document of a class that has this digest: that of vehicle_load, or else of any set. If none
 * has it, or for NULL, that of vehicle_load. NULL after a message. */
const struct vehicle *vehicle_set_load(const char *class, const char *digest, const char *folder,
                                       struct arena *arena, struct diag *diag);

/* The words of the sets beside "paper" that have a document of the class, or of all that there are
 * (NULL), in the order of bytes. 0, or -1 after a message. */
int vehicle_set_list(const char *class, struct document_names *sets, struct arena *arena,
                     struct diag *diag);
