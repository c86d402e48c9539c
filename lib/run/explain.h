/* --explain: what a stage simulated, what it left out, and what that took, as JSON lines. */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "frame/effects.h"

/* An empty log with a clock. */
struct effect_log *explain_begin(struct arena *arena);

/* Makes the file if it is not there: who cannot write it shall hear so before a long run. */
int explain_check(const char *path, struct diag *diag);

/* Appends one line for every effect at home in the stage (alternatives of a stage share its
 * effects): in how many scans it was simulated and left out, what it took, and when auto leaves it
 * out. Stages of one pipeline may share the file: the lines go out in one write. */
int explain_append(const char *path, const char *stage, const struct effect_log *log,
                   struct diag *diag);

#endif
