#include "run/runner.h"

#include <assert.h>
#include <strings.h>
#include <unistd.h>

#include "base/text.h"
#include "documents/vehicle_set.h"
#include "frame/frame_check.h"
#include "frame/frame_order.h"
#include "score/reference_stream.h"
#include "text/data_folder.h"
#include "text/packing.h"
#include "text/path.h"
#include "text/record_write.h"
#include "text/terminal.h"

struct arena *runner_arena(struct runner *runner)
{
    return &runner->arena;
}

const struct stage *runner_stage(const struct runner *runner)
{
    return runner->stage;
}

struct diag *runner_diag(struct runner *runner)
{
    return &runner->diag;
}

struct effect_log *runner_log(struct runner *runner)
{
    return runner->log;
}

struct frame_place runner_place(const struct runner *runner)
{
    const struct frame_stream *input = runner->input;
    return input == NULL ? (struct frame_place){"the source", 0} : frame_stream_place(input);
}

void runner_notice(struct runner *runner, const char *text)
{
    for (size_t i = 0; i < runner->notices.count; i++)
        if (strcmp(runner->notices.items[i], text) == 0)
            return;
    *list_add(&runner->notices, &runner->arena) = text;
}

void runner_expect(struct runner *runner, int64_t frames)
{
    runner->expected_frames = frames;
}

int runner_write(struct runner *runner, const char *bytes, size_t length)
{
    return output_write(runner->outputs.items[0], bytes, length, &runner->diag);
}

int runner_write_text(struct runner *runner, struct text *text)
{
    int result = runner_write(runner, text->bytes, text->length);
    text_free(text);
    return result;
}

int runner_write_fitted(struct runner *runner, struct text *text)
{
    if (runner_output_is_terminal(runner))
        terminal_fit(text, terminal_columns(STDOUT_FILENO));
    return runner_write_text(runner, text);
}

int runner_write_record(struct runner *runner, const struct record *record, const void *base)
{
    struct text text = {0};
    record_write(record, base, NULL, &text);
    return runner_write_text(runner, &text);
}

/* The class with the documents that were loaded for it, so far perhaps none. */
static struct known_class *known_class(struct runner *runner, const char *class)
{
    uint32_t number = intern_word(&runner->classes, class, &runner->arena);
    if (number == runner->known.count)
        list_add(&runner->known, &runner->arena);
    return &runner->known.items[number];
}

static bool is_asked_for(const struct known_vehicle *known, const char *digest)
{
    return digest != NULL ? frame_same_name(known->vehicle->digest, digest) : known->by_class;
}

const struct vehicle *runner_vehicle(struct runner *runner, const char *folder, const char *class,
                                     const char *digest)
{
    struct known_class *known = known_class(runner, class);
    for (size_t i = 0; i < known->vehicles.count; i++)
        if (is_asked_for(&known->vehicles.items[i], digest))
            return known->vehicles.items[i].vehicle;
    const struct vehicle *vehicle =
        vehicle_set_load(class, digest, folder, &runner->arena, &runner->diag);
    if (vehicle != NULL)
        *list_add(&known->vehicles, &runner->arena) =
            (struct known_vehicle){vehicle, digest == NULL};
    return vehicle;
}

static bool reads_standard_input(const struct runner *runner)
{
    for (size_t i = 0; i < runner->common.files.count; i++)
        if (strcmp(runner->common.files.items[i], "-") == 0)
            return true;
    return runner->common.files.count == 0;
}

struct reference_stream *runner_reference_stream(struct runner *runner, const char *path,
                                                 const struct record *record, bool partial)
{
    struct reference_stream *stream = NULL;
    if (strcmp(path, "-") == 0 && reads_standard_input(runner))
        diag_fail(&runner->diag, DIAG_USAGE,
                  "\"-\" is standard input, where the frames come from; name their file");
    else
        stream = reference_stream_open(path, record, partial, runner->pause, &runner->diag);
    if (stream != NULL)
        *list_add(&runner->reference_streams, &runner->arena) = stream;
    return stream;
}

struct input *runner_input(struct runner *runner, const char *path)
{
    struct input *input = input_open(path, &runner->diag);
    if (input != NULL)
        input_before_waiting(input, runner->pause);
    return input;
}

int runner_prepare(struct runner *runner, const struct stage *stage, size_t count,
                   const char *const *words)
{
    *runner = (struct runner){.stage = stage};
    runner->state = arena_get(&runner->arena, stage->options->size);
    int result = options_read(stage, count, words, runner->state, &runner->common, &runner->arena,
                              &runner->diag);
    if (result == 0 && runner->common.sections != NULL &&
        sections_read(runner->common.sections, &runner->sections, &runner->diag) != 0)
        return diag_prefix(&runner->diag, "--sections: ");
    return result;
}

void runner_free(struct runner *runner)
{
    for (size_t i = 0; i < runner->tried.count; i++)
        runner_free(runner->tried.items[i]);
    for (size_t i = 0; i < runner->reference_streams.count; i++)
        reference_stream_close(runner->reference_streams.items[i]);
    if (runner->stage != NULL && runner->stage->release != NULL)
        runner->stage->release(runner->state);
    arena_free(&runner->arena);
}

/* The stage that writes a part of the frame, unless another one stands in its place. */
static const char *writer_of(unsigned part)
{
    if (part == PART_OBJECTS)
        return "traffic";
    if (part == PART_REFLECTORS)
        return "extract";
    if (part == PART_SENSORS || part == PART_ECHOES)
        return "ideal";
    return part == PART_CELLS ? "sensor" : "noise";
}

static int check_parts(struct runner *runner, const struct frame *frame)
{
    unsigned missing = runner->stage->reads & ~frame->present;
    if ((missing & PART_OBJECTS) != 0 && !frame_carries(frame, CARRY_OBJECTS))
        return diag_fail(&runner->diag, DIAG_DATA,
                         "objects: missing; --sections left them out of the stream");
    if (missing != 0)
        return diag_fail(&runner->diag, DIAG_DATA,
                         "%s: missing; expected glint-%s, or a stage in its place, before this one",
                         frame_part_name(missing & -missing), writer_of(missing & -missing));
    unsigned added = PART_LOST | PART_COUNTS | PART_VEHICLES | PART_VISIBILITY;
    unsigned doubled = runner->stage->writes & ~runner->stage->reads & frame->present & ~added;
    if (doubled != 0)
        return diag_fail(&runner->diag, DIAG_DATA, "%s: already there; this stage would write it",
                         frame_part_name(doubled & -doubled));
    return 0;
}

/* A frame that fails its check is an error of the stage itself (DIAG_INTERNAL), unless the stage
 * finds the cause in what it read. */
static int refuse(struct runner *runner, const struct frame *frame)
{
    const struct stage *stage = runner->stage;
    struct diag fault = runner->diag;
    runner->diag = (struct diag){0};
    if (stage->locate_fault != NULL && stage->locate_fault(runner->state, frame, runner) != 0)
        return -1;
    runner->diag = fault;
    runner->diag.code = DIAG_INTERNAL;
    return diag_prefix(&runner->diag, "wrote an invalid frame: ");
}

static int apply_sections(struct runner *runner, struct frame *frame)
{
    return runner->common.sections == NULL
               ? 0
               : sections_apply(&runner->sections, frame, &runner->diag);
}

/* Reads the objects if they leave the stream behind this step: no later program could find a fault
 * in them. */
static int read_leaving(struct frame *frame, struct diag *diag)
{
    if ((frame->present & PART_TARGETS) == 0 || frame_carries(frame, CARRY_OBJECTS))
        return 0;
    return frame_stream_read_left(frame, PART_OBJECTS, diag);
}

static bool has_header(const struct frame *frame, const struct frame_header *header)
{
    return memcmp(frame, header->bytes, sizeof header->bytes) == 0;
}

/* After every step: drops the parts that nobody needs any more; orders and checks those that the
 * stage wrote, and the header if it is not as before the step, so that a stage that writes an
 * invalid frame fails itself and not its neighbour. All else was checked when it was read or
 * written. A source has no header before its step: NULL. */
static int finish_step(struct runner *runner, struct frame *frame,
                       const struct frame_header *before)
{
    const struct stage *stage = runner->stage;
    const unsigned header = before != NULL && has_header(frame, before) ? 0 : PART_HEADER;
    const struct frame_parts written = {stage->writes | header, stage->name};
    frame->present |= stage->writes & ~sections_left_out(frame);
    if (read_leaving(frame, &runner->diag) != 0)
        return -1;
    sections_drop(frame);
    frame_alter(frame, written.parts);
    if ((stage->writes & PART_TARGETS) != 0)
        sightings_count_targets(frame);
    frame_order_parts(frame, written);
    if (frame_check_parts(frame, written, &runner->diag) != 0)
        return refuse(runner, frame);
    if (frame_carries(frame, CARRY_ACCOUNT) && (stage->writes & PART_TARGETS) != 0)
        return frame_check_account(frame, &runner->diag);
    return 0;
}

/* A stage or tool that fails without a message would look as if it had succeeded. */
static int ensure_message(struct runner *runner, int result)
{
    if (result < 0)
        diag_fail(&runner->diag, DIAG_INTERNAL, "failed without saying why");
    return result;
}

int runner_start(struct runner *runner)
{
    const struct stage *stage = runner->stage;
    return stage->start == NULL ? 0 : ensure_message(runner, stage->start(runner->state, runner));
}

int runner_next(struct runner *runner, struct frame *frame)
{
    frame_clear(frame);
    frame->version = FRAME_VERSION;
    frame->seed = runner->common.seed;
    int more = ensure_message(runner, runner->stage->next(runner->state, frame, runner));
    if (more != 1)
        return more;
    return apply_sections(runner, frame) == 0 && finish_step(runner, frame, NULL) == 0 ? 1 : -1;
}

/* A frame from another process may have passed filters that dropped echoes without a word. Where
 * no stage follows that would find out, it is told here. */
static int check_account(const struct runner *runner, const struct frame *frame, struct diag *diag)
{
    bool ends = runner->stage->sink || runner->stage->run != NULL;
    bool whole = (frame->present & (PART_TARGETS | PART_CELLS | PART_ECHOES)) != 0;
    if (!ends || !whole || !frame_carries(frame, CARRY_ACCOUNT) || runner->before != NULL ||
        runner->input == NULL)
        return 0;
    return frame_check_account(frame, diag);
}

/* Before every step: the frame becomes one of today's version, takes the seed of the command line,
 * must have the parts that the program reads, and must follow the frames before it (--complete). */
static int take_frame(struct runner *runner, struct frame *frame)
{
    if (runner->common.seed_given)
        frame->seed = runner->common.seed;
    if (runner->common.seed_given || frame->version != FRAME_VERSION)
        frame_alter(frame, PART_HEADER);
    frame->version = FRAME_VERSION;
    if (check_parts(runner, frame) != 0 || check_account(runner, frame, &runner->diag) != 0)
        return -1;
    if (apply_sections(runner, frame) != 0)
        return -1;
    if (!runner->common.complete)
        return 0;
    return frame_sequence_follow(&runner->sequence, frame, runner_place(runner), &runner->arena,
                                 &runner->diag);
}

static int check_complete(struct runner *runner)
{
    return runner->common.complete ? frame_sequence_end(&runner->sequence, &runner->diag) : 0;
}

int runner_step(struct runner *runner, struct frame *frame)
{
    const struct stage *stage = runner->stage;
    struct frame_header before;
    if (take_frame(runner, frame) != 0)
        return -1;
    memcpy(before.bytes, frame, sizeof before.bytes);
    if (ensure_message(runner, stage->step(runner->state, frame, runner)) != 0)
        return -1;
    return stage->sink ? 0 : finish_step(runner, frame, &before);
}

int runner_frame(struct runner *runner, struct frame **frame)
{
    int more = runner->frames.next(runner->frames.from, frame);
    if (more == 0)
        return check_complete(runner);
    return more > 0 && take_frame(runner, *frame) == 0 ? 1 : -1;
}

int runner_frame_ascending(struct runner *runner, struct frame **frame)
{
    int more = runner_frame(runner, frame);
    if (more <= 0 || runner->common.complete)
        return more;
    int result = frame_sequence_ascend(&runner->sequence, *frame, runner_place(runner),
                                       &runner->arena, &runner->diag);
    return result == 0 ? 1 : -1;
}

struct runner *runner_trial(struct runner *runner, const struct stage *stage, const void *options,
                            size_t size, struct effect_log *log)
{
    assert(options == NULL || stage->options->size >= size);
    struct runner *trial = arena_get(&runner->arena, sizeof *trial);
    *list_add(&runner->tried, &runner->arena) = trial;
    *trial = (struct runner){.stage = stage, .log = log, .before = runner};
    trial->state = arena_get(&trial->arena, stage->options->size);
    field_clear(stage->options, trial->state);
    if (options != NULL)
        memcpy(trial->state, options, size);
    runner_start(trial);
    return trial;
}

int runner_try(struct runner *runner, struct runner *trial, struct frame *frame)
{
    if (trial->diag.code == DIAG_OK && runner_step(trial, frame) == 0)
        return 0;
    runner->diag = trial->diag;
    return diag_prefix(&runner->diag, "glint-%s: ", trial->stage->name);
}

int runner_finish(struct runner *runner)
{
    const struct stage *stage = runner->stage;
    if (check_complete(runner) != 0)
        return -1;
    return stage->stop == NULL ? 0 : ensure_message(runner, stage->stop(runner->state, runner));
}

int runner_run_tool(struct runner *runner)
{
    return ensure_message(runner, runner->stage->run(runner->state, runner));
}

static struct output *add_output(struct runner *runner, const char *path)
{
    struct output *output = output_open(path, &runner->diag);
    if (output != NULL)
        *list_add(&runner->outputs, &runner->arena) = output;
    return output;
}

bool runner_output_ends(const struct runner *runner, const char *ending)
{
    const char *path = runner->common.output != NULL ? runner->common.output : "";
    size_t length = packing_plain_length(path), end = strlen(ending);
    return length > end && strncasecmp(path + length - end, ending, end) == 0;
}

int runner_require_ending(struct runner *runner, const char *ending)
{
    const char *path = runner->common.output != NULL ? runner->common.output : "";
    const char *name = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path;
    size_t length = packing_plain_length(name);
    bool has_ending = length > 1 && memchr(name + 1, '.', length - 1) != NULL;
    if (!has_ending || runner_output_ends(runner, ending))
        return 0;
    return diag_fail(&runner->diag, DIAG_USAGE,
                     "--output: the ending of \"%s\" is unknown; expected %s, with .gz or .zst "
                     "behind it or without",
                     path, ending);
}

bool runner_output_is_terminal(const struct runner *runner)
{
    return runner->common.output == NULL && isatty(STDOUT_FILENO);
}

struct output *runner_output(struct runner *runner)
{
    return add_output(runner, runner->common.output != NULL ? runner->common.output : "-");
}

struct output *runner_output_beside(struct runner *runner, const char *path)
{
    const char *output = runner->common.output;
    const char *beside = strcmp(path, "-") == 0 ? "/dev/stdout" : path;
    if (!path_same_file(beside,
                        output == NULL || strcmp(output, "-") == 0 ? "/dev/stdout" : output))
        return add_output(runner, path);
    diag_fail(&runner->diag, DIAG_USAGE, "%s is the output; expected another file", path);
    return NULL;
}

struct output *runner_output_in(struct runner *runner, const char *folder, const char *name)
{
    const char *path = arena_format(&runner->arena, "%s/%s", folder, name);
    if (data_folder_check("DIR", folder, &runner->diag) == 0)
        return add_output(runner, path);
    runner->diag.code = DIAG_CANNOT_CREATE;
    return NULL;
}

int runner_close_outputs(struct runner *runner, bool whole)
{
    whole = whole && runner->diag.code == DIAG_OK;
    output_close_all(runner->outputs.items, runner->outputs.count, whole, &runner->diag);
    runner->outputs.count = 0;
    return runner->diag.code == DIAG_OK ? 0 : -1;
}
