/* A table of recorded traffic, opened as glint-traffic opens it. */
#pragma once

#include "check.h"
#include "recorded/recording.h"
#include "text/input.h"

/* Opens a table with options that the test may have set; 0, or -1 after a message. */
static inline int recorded_file_try(struct recording *file, const char *path, struct arena *arena,
                                    struct diag *diag)
{
    struct input *input = input_open(path, diag);
    struct recorded_reader reader = {0};
    if (input != NULL)
        reader = recorded_table_open(input, path, arena, diag);
    file->source = path;
    return recording_open(file, reader, arena, diag);
}

static inline void recorded_file_open(struct recording *file, const char *path, const char *ego,
                                      struct arena *arena)
{
    struct diag diag = {0};
    *file = (struct recording){.source = path};
    field_clear(&recording_options_record, &file->options);
    file->options.ego = ego;
    if (recorded_file_try(file, path, arena, &diag) != 0)
        fail_msg("%s", diag.text);
}

/* The next frame; true until the end. */
static inline bool recorded_file_next(struct recording *file, struct frame *frame)
{
    struct diag diag = {0};
    frame_clear(frame);
    int more = recording_next(file, frame, &diag);
    if (more < 0)
        fail_msg("%s", diag.text);
    return more > 0;
}
