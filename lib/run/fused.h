/* The program glint: a whole pipeline in one process. */
#pragma once

#include "run/stage.h"
#include "run/tool.h"

/* Every stage and every tool of the build, NULL at the end: made from the listing of stages/ by the
 * Makefile. */
extern const struct stage *const stages[];
extern const struct tool *const tools[];

/* "plan" for "/usr/bin/glint-plan"; NULL for a path that does not end in glint-NAME. */
const char *fused_name(const char *path);

/* The stage, or the tool, of that name; NULL if this build has none. */
const struct stage *fused_stage(const char *name);
const struct tool *fused_tool(const char *name);

/* glint's main. */
int fused_main(int count, char **words);
