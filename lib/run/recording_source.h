/* Functions that sources of recorded traffic share.
 *
 * The state of such a source is, or begins with, a struct recording. */
#pragma once

#include "recorded/recording.h"
#include "run/stage.h"
#include "text/input.h"
#include "text/path.h"

/* Opens the source; NULL after a message. */
static inline struct input *recording_source_input(void *state, struct runner *runner)
{
    const struct recording *recording = state;
    struct input *input = runner_input(runner, recording->source);
    if (input == NULL)
        diag_prefix(runner_diag(runner), "%s: ", recording->source);
    return input;
}

/* 1 if the source begins with this character, blanks aside; also for a pipe, which cannot be opened
 * twice. 0 if not; -1 after a message. */
static inline int recording_source_begins(const char *source, char sign, struct runner *runner)
{
    enum { ENOUGH = 4096 };
    struct diag *diag = runner_diag(runner);
    if (strcmp(source, "-") == 0 || path_is_special(source))
        return 1;
    struct input *input = runner_input(runner, source);
    char *bytes = arena_get(runner_arena(runner), ENOUGH + 1);
    long length = input != NULL ? input_read(input, bytes, ENOUGH, diag) : -1;
    input_close(input);
    if (length < 0)
        return diag_prefix(diag, "%s: ", source);
    return bytes[strspn(bytes, " \t\r\n\xef\xbb\xbf")] == sign;
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
