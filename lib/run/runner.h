/* A runner: one stage at work. It owns the stage's state, options and documents, checks what goes
 * into a step and what comes out of it, and answers what stages ask for (stage.h). */
#ifndef RUNNER_H
#define RUNNER_H

#include "frame/frame_sequence.h"
#include "run/options.h"
#include "run/stage.h"
#include "text/output.h"

struct runner {
    const struct stage *stage;
    void *state;
    struct common_options common;
    struct arena arena; /* options and documents: as long as the stage */
    struct diag diag;
    struct output *output; /* of the last stage in a chain, else NULL */
    LIST_OF(const struct suite *) suites;
    LIST_OF(const struct vehicle *) vehicles; /* by class */
    struct frame_sequence completeness;       /* followed only under --complete */
    int64_t expected_frames;                  /* 0 if the source does not say */
    struct effect_log *log;                   /* NULL unless --explain was given */
    LIST_OF(struct runner *) rehearsing;      /* other stages, inside this one */
    struct reference_stream *counterpart;     /* NULL: none was asked for */
};

/* All return 0, or -1 after a message in runner->diag; runner_next returns 1 with a frame and 0 at
 * the end. */
int runner_prepare(struct runner *runner, const struct stage *stage, size_t count,
                   const char *const *words);
int runner_start(struct runner *runner);
int runner_next(struct runner *runner, struct frame *frame);
int runner_step(struct runner *runner, struct frame *frame);
int runner_finish(struct runner *runner);

void runner_free(struct runner *runner);

#endif
