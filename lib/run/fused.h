/* The program glint: a whole pipeline in one process. */
#pragma once

#include "run/stage.h"

/* Every stage and tool of the build, NULL at the end: the Makefile makes it from the listing of
 * stages/. */
extern const struct stage *const stages[];

/* "plan" for "/usr/bin/glint-plan"; NULL for a path that does not end in glint-NAME. */
const char *fused_name(const char *path);

/* The stage or tool of that name; NULL if this build has none. */
const struct stage *fused_stage(const char *name);

/* glint's main. */
int fused_main(int count, char **words);
