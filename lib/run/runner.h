/* Runs one stage or one tool: options, checks and outputs. A runner owns the state, the options,
 * the documents and the outputs, checks the frames that go in and come out, and does what stages
 * and tools ask for (stage.h, tool.h). */
#pragma once

#include "base/intern.h"
#include "frame/frame_sequence.h"
#include "run/frame_stream.h"
#include "run/options.h"
#include "run/stage.h"
#include "run/tool.h"
#include "text/output.h"

/* The source of a tool's frames: next gives 1 and a frame, 0 at the end, or -1 after a message in
 * the tool's diag. */
struct frame_source {
    int (*next)(void *from, struct frame **frame);
    void *from;
};

/* A vehicle document, and whether its class was asked for without a digest. */
struct known_vehicle {
    const struct vehicle *vehicle;
    bool by_class;
};

/* The documents of one class. */
struct known_class {
    LIST_OF(struct known_vehicle) vehicles;
};

struct runner {
    const struct stage *stage;
    void *state;
    struct common_options common;
    struct sections_change sections; /* of common.sections */
    struct arena arena;              /* of options and documents: as long as the runner */
    struct diag diag;
    LIST_OF(struct output *) outputs; /* only the last runner of a chain has any */
    struct frame_source frames;       /* of a tool; set by the chain */
    struct input_pause pause;         /* before a wait for input; set by the chain */
    const struct frame_stream *input; /* what the chain reads; NULL: it begins with a source */
    const struct runner *before; /* runs before this one in the same process; NULL: none does */
    LIST_OF(const struct suite *) suites;
    LIST_OF(const char *)
    notices;                           /* runner_notice */
    struct intern classes;             /* those that stages asked for */
    LIST_OF(struct known_class) known; /* by number in classes */
    struct frame_sequence sequence;    /* of the frames so far, under --complete */
    int64_t expected_frames;           /* 0 if the source does not say */
    struct effect_log *log;            /* of a stage that a tool tries; NULL: none */
    char effects[FIELD_NAME_SIZE + 1]; /* those of the latest frame, and what they select */
    struct selection selection;
    LIST_OF(struct runner *) tried; /* of the stages that a tool tries */
    LIST_OF(struct reference_stream *) reference_streams;
};

/* A runner is prepared with the words of its command line, started, given its frames (runner_next
 * for a source, runner_step for the others) and finished; a tool is only prepared and run. It is
 * freed in any case. All return 0, or -1 after a message in runner->diag; runner_next returns 1
 * with a frame and 0 at the end. */
int runner_prepare(struct runner *runner, const struct stage *stage, size_t count,
                   const char *const *words);
int runner_start(struct runner *runner);
int runner_next(struct runner *runner, struct frame *frame);
int runner_step(struct runner *runner, struct frame *frame);
int runner_finish(struct runner *runner);
int runner_run_tool(struct runner *runner);

/* Closes the outputs: all are written to the disk, and then take their names. After a failure, or
 * if they are not whole because another runner failed, none does and nothing is left of them. */
int runner_close_outputs(struct runner *runner, bool whole);

void runner_free(struct runner *runner);
