/* A summary for people: what the sensors reported, and what became of the other reflectors; of
 * traffic that no sensor has seen, its objects. */
#include "export/stream_counts.h"
#include "frame/frame_text.h"
#include "run/tool.h"
#include "text/output.h"

struct summary {
    const char *copy; /* a file that gets the frames, too; NULL: none does */
    struct stream_counts counts;
};

static int write_copy(struct output *copy, const struct frame *frame, struct diag *diag)
{
    if (copy == NULL)
        return 0;
    return frame_text_write(frame, output_text(copy), diag) == 0 ? output_send(copy, diag) : -1;
}

static int summary_run(void *state, struct runner *runner)
{
    struct summary *summary = state;
    struct diag *diag = runner_diag(runner);
    struct output *copy = NULL;
    summary->counts.arena = runner_arena(runner);
    if (runner_output(runner) == NULL)
        return -1;
    if (summary->copy != NULL && (copy = runner_output_beside(runner, summary->copy)) == NULL)
        return diag_prefix(diag, "--copy: ");
    struct frame *frame;
    int more;
    while ((more = runner_frame_ascending(runner, &frame)) > 0)
        if (stream_counts_add(&summary->counts, frame, diag) != 0 ||
            write_copy(copy, frame, diag) != 0)
            return -1;
    struct text text = {0};
    if (more == 0)
        stream_counts_write(&summary->counts, &text);
    return more == 0 ? runner_write_fitted(runner, &text) : -1;
}

static void summary_release(void *state)
{
    struct summary *summary = state;
    arena_free(&summary->counts.open_names);
}

static const struct field summary_options[] = {
    {OPTIONAL_NAME(struct summary, copy, "write the frames to this file, too"), .word = "FILE"},
    {0},
};

const struct stage stage_summary = {
    .name = "summary",
    .summary = "Count targets by sensor and class, or the objects of traffic.",
    .details =
        "A target is counted by its strongest contributor: under the class of that contributor's "
        "object, or as ghost, clutter or false alarm. Shares are in per cent of all targets. If "
        "glint-ideal was given --sections account, the output also says how many of the reflectors "
        "that a sensor looked for are in a target, and how many are lost for each reason. Frames "
        "that no sensor has seen, as those of glint-traffic, are counted by their objects: each "
        "object once in its scene, by class. The frames of a scene must ascend, so that none is "
        "counted twice. The output comes at the end of the stream. With "
        "--copy one run both counts the frames and stores them in a file.",
    .options = STAGE_OPTIONS(struct summary, summary_options),
    .reads = PART_OBJECTS,
    .run = summary_run,
    .release = summary_release,
};
