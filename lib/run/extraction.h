/* Sizes and reflectors for the objects of a frame (MODEL 2). Both come from the document of the
 * object's class. */
#ifndef EXTRACTION_H
#define EXTRACTION_H

#include "documents/vehicle.h"
#include "run/stage.h"

/* Puts other reflectors in place of those of the vehicle's document, list by list; what it makes
 * lies in the arena. */
typedef void extraction_describe(const void *state, const struct vehicle *vehicle,
                                 struct reflector_set *set, struct arena *arena);

/* The whole step of a stage that extracts: completes the sizes of all objects, and lists every
 * object but the ego in its class's set of reflectors. The sets are those of the documents
 * (describe NULL), or as describe, called with the state, makes them. Sizes come from documents
 * that were checked, so objects are not among what the stage writes. 0, or -1 after a message. */
int extraction_step(struct frame *frame, struct runner *runner, extraction_describe *describe,
                    const void *state);

#endif
