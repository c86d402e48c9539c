/* A program of glint that lies beside the running one. It runs in a process of its own, from a text
 * to a text. */
#ifndef SIDE_PROGRAM_H
#define SIDE_PROGRAM_H

#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

/* Its path, in the arena; NULL if there is no such program beside this one. */
const char *side_program_find(const char *name, struct arena *arena);

/* Runs it with these words, of which the first is its name and the last is NULL, and with input as
 * its standard input; appends its standard output, and adds its CPU time. Fails with its exit
 * code, if that is one of diag.h, else with DIAG_INTERNAL; its own message has gone to stderr. */
int side_program_run(const char *path, char *const *words, const struct text *input,
                     struct text *output, int64_t *cpu_ns, struct diag *diag);

#endif
