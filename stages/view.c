/* An HTML page that plays the stream and shows which echoes made each target. */
#include "documents/vehicle_set.h"
#include "frame/frame_sequence.h"
#include "run/stage.h"
#include "view/view_page.h"

struct view {
    int64_t frame;
    const char *truth, *tracks;
    const char *vehicles; /* as in extraction.h */
    bool found;           /* the frame that was asked for */
    struct view_data data;
    struct frame_sequence sequence;
};

static int open_beside(const char *path, const struct record *record,
                       struct reference_stream **stream, struct runner *runner)
{
    if (path == NULL)
        return 0;
    *stream = runner_reference_stream(runner, path, record, true);
    return *stream != NULL ? 0 : -1;
}

#define PICTURES                                                                                   \
    "the button \"Save map as SVG\" of the page saves a frame as it is shown, and "                \
    "scripts/figures --frame N of the source tree draws frame N of a stream"

/* Refuses an output that shows no page. */
static int check_output(struct runner *runner)
{
    if (runner_output_is_terminal(runner))
        return diag_fail(
            runner_diag(runner), DIAG_USAGE,
            "standard output is a terminal, which shows no page; write it to a file: -o FILE");
    if (runner_output_ends(runner, ".svg"))
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--output: a page is HTML, expected .html; " PICTURES);
    return runner_require_ending(runner, ".html");
}

static int view_start(void *state, struct runner *runner)
{
    struct view *view = state;
    view_data_begin(&view->data, runner_arena(runner));
    if (vehicle_set_folder("--vehicles", view->vehicles, &view->data.models.folder,
                           runner_arena(runner), runner_diag(runner)) != 0)
        return -1;
    struct document_names known = {0}; /* refuses a GLINT_DATA where no class could be found */
    if (document_list("vehicles", ".json", &known, runner_arena(runner), runner_diag(runner)) != 0)
        return -1;
    if (check_output(runner) != 0)
        return -1;
    if (open_beside(view->truth, &frame_record, &view->data.truth, runner) != 0)
        return -1;
    return open_beside(view->tracks, &track_list_record, &view->data.tracks, runner);
}

/* Frames of --truth and --tracks are matched by scene and number, so they must ascend. */
static int check_order(struct view *view, const struct frame *frame, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    if (view->truth == NULL && view->tracks == NULL)
        return frame_sequence_once(&view->sequence, frame, runner_place(runner), arena, diag);
    if (frame_sequence_ascend(&view->sequence, frame, runner_place(runner), arena, diag) != 0)
        return -1;
    return frame_sequence_one_seed(&view->sequence, diag);
}

static int view_step(void *state, struct frame *frame, struct runner *runner)
{
    struct view *view = state;
    if (check_order(view, frame, runner) != 0 ||
        view_frame_check_vehicles(&view->data.models, frame, runner_diag(runner)) != 0)
        return -1;
    view->found = view->found || view->frame == frame->frame;
    return view_data_add(&view->data, frame, runner_diag(runner));
}

/* Refuses a stream without the frame that was asked for. A stream without any frame has a page,
 * too. */
static int check_found(const struct view *view, struct runner *runner)
{
    if (view->found || view->frame < 0)
        return 0;
    return diag_fail(runner_diag(runner), DIAG_DATA, "no frame %lld in the stream",
                     (long long)view->frame);
}

static int view_stop(void *state, struct runner *runner)
{
    struct view *view = state;
    struct text text = {0};
    if (check_found(view, runner) != 0 || view_data_finish(&view->data, runner_diag(runner)) != 0)
        return -1;
    view_page_write(&view->data, view->frame, &text);
    return runner_write_text(runner, &text);
}

static const struct field view_fields[] = {
    {OPTIONAL_INTEGER(struct view, frame, 0, 0x1p53, "number of the frame at which the page opens"),
     .absent = -1},
    {OPTIONAL_NAME(struct view, vehicles,
                   "the vehicle documents that were given to glint-extract, if any"),
     .word = "SET"},
    {OPTIONAL_NAME(struct view, truth,
                   "frames with the true targets, to show which are missed and which are false"),
     .word = "FILE"},
    {OPTIONAL_NAME(struct view, tracks, "a tracker's tracks, in the format of glint-score-tracks"),
     .word = "FILE"},
    {0},
};

static const struct field_gone gone_options[] = {
    {"svg", PICTURES},
    {"only", "the page has all scenes of the stream; choose one in its list"},
    {NULL, NULL},
};

const struct stage stage_view = {
    .name = "view",
    .summary = "Write an HTML page that plays the stream.",
    .details =
        "The page is one file that needs no network: open it in a browser. Its map can be saved "
        "as a picture, SVG. An --output that ends in .html.gz is compressed. Without --frame the "
        "page opens at the frame with most to see. If glint-ideal was given --sections account, "
        "the page also shows why a reflector is in no target. With --truth the page also shows "
        "the targets of another stream of the same scenes, paired with those of this one as "
        "glint-score pairs them. With --tracks it shows a tracker's tracks, paired with the "
        "objects in view. The output is written at the end of the stream.",
    .options = &(const struct record){.name = "options",
                                      .size = sizeof(struct view),
                                      .fields = view_fields,
                                      .gone = gone_options},
    .sink = true,
    .start = view_start,
    .step = view_step,
    .stop = view_stop,
};
