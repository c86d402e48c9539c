/* What --explain says of effects: simulated, left out, their time. */
#pragma once

#include "frame/effects.h"

struct common_options;

/* An empty log whose times are measured. */
struct effect_log *explain_begin(struct arena *arena);

/* Creates the file if it is not there, so that one that cannot be written is refused before the run
 * and not after it. */
int explain_check(const char *path, struct diag *diag);

/* Appends one line for every effect that is at home in the stage or in the one that it stands in
 * for: in how many scans it was simulated and left out, how much time it took, and when auto leaves
 * it out. Lines are JSON, or with --text rows under a head with the stage's name. The time is null
 * or "-" where none was taken: the effect is simulated together with others, or was left out. The
 * lines go out in one write, so stages of one pipeline may share the file. */
int explain_append(const struct common_options *common, const char *stage,
                   const struct effect_log *log, struct diag *diag);
