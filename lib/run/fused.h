/* The program glint: a whole pipeline in one process. */
#ifndef FUSED_H
#define FUSED_H

#include "run/stage.h"
#include "run/tool.h"

/* Every stage and every tool of the build, NULL at the end: made from the listing of stages/ by the
 * Makefile. */
extern const struct stage *const stages[];
extern const struct tool *const tools[];

/* glint's main. */
int fused_main(int count, char **words);

#endif
