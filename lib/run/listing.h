/* What `glint --list` prints: stages, tools, effects, documents and pipelines. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

/* Adds a line for each thing of that kind: its name, and what it is in a sentence (of an effect
 * also where it is simulated and what it costs, in indented lines). A document that cannot be read
 * has its message instead. DIAG_USAGE for another kind. */
int listing_add(const char *kind, struct text *text, struct arena *arena, struct diag *diag);
