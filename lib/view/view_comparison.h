/* Another stream's targets and a tracker's tracks, beside the frames.
 *
 * Truths are the targets of the other stream, each with the number of the listed target that
 * glint-score pairs it with. Missed objects are tracks without an id and a place. Frames that the
 * other stream lacks have neither, and say so. */
#pragma once

#include "score/reference_stream.h"
#include "view/view_data.h"

struct view_comparison {
    struct reference_stream *truth, *tracks; /* NULL: not asked for */
    struct track_memory memory;
};

/* Adds what the other streams have for the frame, after view_data_add. Refuses (DIAG_DATA) what
 * glint-score and glint-score-tracks refuse. */
int view_comparison_add(struct view_comparison *comparison, struct view_data *data,
                        const struct frame *frame, struct diag *diag);

/* Reads the other streams on to their ends. */
int view_comparison_finish(struct view_comparison *comparison, struct diag *diag);
