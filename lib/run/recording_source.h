/* Functions that sources of recorded traffic share.
 *
 * The state of such a source is, or begins with, a struct recording. */
#pragma once

#include "recorded/recording.h"
#include "run/stage.h"

/* Opens the source; NULL after a message. */
static inline struct input *recording_source_input(void *state, struct runner *runner)
{
    const struct recording *recording = state;
    struct input *input = runner_input(runner, recording->source);
    if (input == NULL)
        diag_prefix(runner_diag(runner), "%s: ", recording->source);
    return input;
}

static inline int recording_source_next(void *state, struct frame *frame, struct runner *runner)
{
    return recording_next(state, frame, runner_diag(runner));
}

static inline int recording_source_locate_fault(void *state, const struct frame *frame,
                                                struct runner *runner)
{
    return recording_check(state, frame, runner_diag(runner));
}
