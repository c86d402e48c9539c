/* What a tool is, and what it may ask for.
 *
 * A tool is a stage with one function, run, which does the whole work: it takes frames when it
 * wants them or none at all, tries stages, opens other files, and writes several outputs. `glint`
 * runs a tool that reads frames at the end of a pipeline.
 *
 * The runner owns the outputs. None of them takes its name before all of them are whole and on the
 * disk; after a failure, or if the program is killed until then, the files that had these names
 * before are unchanged. Then the old files go before the first new one comes, so that no kill
 * leaves an old file beside a new one (text/output.h). What goes to standard output cannot be taken
 * back.
 *
 * Functions return 0, or -1 after a message in the runner's diag. Beside those below, tools may
 * call runner_arena, runner_diag and the like (stage.h). */
#pragma once

#include "run/stage.h"

struct output;
struct suite_choice;

/* Returns 1 with the next frame of the stream, 0 at its end, -1 after a message. The frame lasts
 * until the next call, and the tool may change it. A tool reads to the end, as whoever writes the
 * stream expects. */
int runner_frame(struct runner *runner, struct frame **frame);

/* The same for tools that count: refuses (DIAG_DATA) a frame that is not behind the frames of its
 * scene before it, as one that comes twice. Takes about 350 bytes a scene. */
int runner_frame_ascending(struct runner *runner, struct frame **frame);

/* The output that --output names, or standard output. NULL after a message. Open outputs before the
 * first frame, so that a place where nothing can be written is refused before the work. */
struct output *runner_output(struct runner *runner);

/* A file beside that output. NULL after a message, also if both are one file. */
struct output *runner_output_beside(struct runner *runner, const char *path);

/* A file of that name in the folder, which must exist. NULL after a message. */
struct output *runner_output_in(struct runner *runner, const char *folder, const char *name);

/* A stage that a tool tries, to see what it would do. Each call makes one more, with a state of its
 * own. Its state begins with these options, of this size; NULL stands for its defaults. The stage
 * notes its effects in log, or nowhere (NULL). It is started here and never stopped; it is freed
 * with the tool. */
struct runner *runner_trial(struct runner *runner, const struct stage *stage, const void *options,
                            size_t size, struct effect_log *log);

/* Runs one step of a tried stage on a frame, with all the checks of a run. A stage that could not
 * start fails here. */
int runner_try(struct runner *runner, struct runner *trial, struct frame *frame);
