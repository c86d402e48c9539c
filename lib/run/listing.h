/* What `glint --list` prints: stages, tools, effects, documents and pipelines. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

/* Adds a line for each thing of that kind: its name, and what it is in a sentence, before which an
 * effect has the stage that simulates it. A document that cannot be read has its message instead.
 * If kind is the name of an effect: its sentence, stage, cause, when auto leaves it out, and cost,
 * a line each. DIAG_USAGE for another kind. */
int listing_add(const char *kind, struct text *text, struct arena *arena, struct diag *diag);
