/* A stage or tool as its command line shows it. */
#pragma once

#include <stdbool.h>

struct record;
struct stage;
struct tool;

enum program_kind {
    PROGRAM_SOURCE, /* a stage that makes frames */
    PROGRAM_FILTER, /* a stage that changes frames */
    PROGRAM_SINK,   /* a stage that writes no frames */
    PROGRAM_TOOL,
};

struct program {
    enum program_kind kind;
    const char *name, *summary, *details; /* the executable is glint-NAME; details may be NULL */
    const struct record *options;
    const char *operand;    /* NULL: none */
    unsigned reads, writes; /* enum section */
    bool takes_files;       /* of frames, instead of standard input */
    bool into_folder;       /* writes files into the folder that the operand names */
};

struct program program_of_stage(const struct stage *stage);
struct program program_of_tool(const struct tool *tool);
