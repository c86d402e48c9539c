/* Sources of recorded traffic: what all of them do with their recording. The state of one begins
 * with a recorded_source, and its table of options with RECORDED_SOURCE. */
#pragma once

#include "recorded/recording.h"
#include "run/stage.h"

struct recorded_source {
    const char *source; /* the operand */
    struct recording_options options;
    struct recording recording;
};

#define RECORDED_SOURCE(help)                                                                      \
    {FIELD_NAME_OF(struct recorded_source, source, help)},                                         \
    {                                                                                              \
        OPTIONAL_RECORD(struct recorded_source, options, &recording_options_record, "")            \
    }

/* Opens the file; NULL after a message. */
static inline struct input *recorded_source_input(const struct recorded_source *own,
                                                  struct runner *runner)
{
    struct input *input = runner_input(runner, own->source);
    if (input == NULL)
        diag_prefix(runner_diag(runner), "%s: ", own->source);
    return input;
}

static inline int recorded_source_next(void *state, struct frame *frame, struct runner *runner)
{
    struct recorded_source *own = state;
    return recording_next(&own->recording, frame, runner_diag(runner));
}

static inline int recorded_source_locate_fault(void *state, const struct frame *frame,
                                               struct runner *runner)
{
    const struct recorded_source *own = state;
    return recording_check(&own->recording, frame, runner_diag(runner));
}
