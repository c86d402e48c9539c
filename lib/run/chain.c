#include "run/chain.h"

#include <stdio.h>

#include "frame/frame_text.h"
#include "run/frame_stream.h"
#include "run/progress.h"
#include "text/document.h"
#include "text/input.h"
#include "text/list_cache.h"

struct chain {
    struct runner *runners;
    size_t count, stages; /* the last runner may be a tool; all others are stages */
    struct frame frame;
    struct arena arena; /* the frame's */
    struct list_cache list_cache;
    struct frame_stream input; /* of the first runner, unless it is a source */
    bool tool_has_frame;       /* its messages are about this frame */
    struct progress progress;
};

/* "glint-NAME: MESSAGE" to stderr, if there is a message. */
static void complain(const struct runner *runner, const struct diag *diag)
{
    char program[128];
    snprintf(program, sizeof program, "glint-%s", runner->stage->name);
    if (diag->text[0] != '\0')
        diag_print(program, diag);
}

/* Prints the notices that are new. */
static void print_notices(struct runner *runner)
{
    for (size_t i = 0; i < runner->notices.count; i++) {
        struct diag notice = {0};
        snprintf(notice.text, sizeof notice.text, "%s", runner->notices.items[i]);
        complain(runner, &notice);
    }
    runner->notices.count = 0;
}

static bool failed(const struct runner *runner)
{
    return runner->diag.code != DIAG_OK;
}

/* Prints what the stages have to say, the reason of a failure last. Returns the exit code. */
static int complain_of_all(struct runner *runners, size_t count)
{
    int code = DIAG_OK;
    for (size_t i = 0; i < count; i++) {
        print_notices(&runners[i]);
        if (!failed(&runners[i]))
            complain(&runners[i], &runners[i].diag);
    }
    for (size_t i = 0; i < count; i++) {
        if (!failed(&runners[i]))
            continue;
        complain(&runners[i], &runners[i].diag);
        code = (int)runners[i].diag.code;
    }
    return code;
}

static struct runner *last(struct chain *chain)
{
    return &chain->runners[chain->count - 1];
}

/* Puts the place in front of a message: the line that the first runner reads, or the frame that a
 * later one was given. */
static void name_place(const struct chain *chain, struct runner *runner)
{
    if (runner == &chain->runners[0])
        frame_stream_name_line(&chain->input, &runner->diag);
    else
        diag_prefix(&runner->diag, "scene \"%s\", frame %lld: ", chain->frame.scene,
                    (long long)chain->frame.frame);
}

static int write_frame(struct chain *chain)
{
    struct runner *runner = last(chain);
    if (runner->stage->sink || runner->stage->run != NULL)
        return 0;
    struct output *output = runner->outputs.items[0];
    if (frame_text_write(&chain->frame, output_text(output), &runner->diag) != 0) {
        name_place(chain, runner);
        return -1;
    }
    return output_send(output, &runner->diag);
}

static int first_frame(struct chain *chain)
{
    struct runner *first = &chain->runners[0];
    int more = first->stage->next != NULL
                   ? runner_next(first, &chain->frame)
                   : frame_stream_next(&chain->input, &chain->frame, &first->diag);
    if (more < 0)
        name_place(chain, first);
    return more;
}

/* Shows the share of the frames that a source expects, or of the file's size; nothing for a pipe,
 * or where a terminal shows the output itself. */
static void show_progress(struct chain *chain)
{
    const struct runner *first = &chain->runners[0], *end = last(chain);
    if (end->outputs.count > 0 && output_prints(end->outputs.items[0]))
        return;
    double expected = (double)first->expected_frames, count = (double)chain->progress.count;
    progress_show(&chain->progress,
                  expected > 0 ? count / expected : frame_stream_share(&chain->input));
}

/* One frame through all stages: 1, 0 if there was none, -1 if one of them failed. */
static int run_frame(struct chain *chain)
{
    int more = first_frame(chain);
    if (more <= 0)
        return more;
    size_t index = chain->runners[0].stage->next != NULL ? 1 : 0;
    for (; index < chain->stages; index++) {
        struct runner *runner = &chain->runners[index];
        if (runner_step(runner, &chain->frame) != 0) {
            name_place(chain, runner);
            return -1;
        }
    }
    int result = write_frame(chain);
    if (progress_step(&chain->progress))
        show_progress(chain);
    return result == 0 ? 1 : -1;
}

static bool any_failed(const struct chain *chain)
{
    for (size_t i = 0; i < chain->count; i++)
        if (failed(&chain->runners[i]))
            return true;
    return false;
}

/* Gives the tool's runner its next frame. For the tool the stream ends where a stage fails. */
static int next_frame(void *from, struct frame **frame)
{
    struct chain *chain = from;
    *frame = &chain->frame;
    int more = any_failed(chain) ? 0 : run_frame(chain);
    if (more <= 0)
        progress_end(&chain->progress);
    if (more < 0 && !failed(last(chain)))
        more = 0;
    chain->tool_has_frame = more > 0;
    return more;
}

static void run_tool(struct chain *chain)
{
    struct runner *tool = last(chain);
    tool->frames = (struct frame_source){next_frame, chain};
    if (runner_run_tool(tool) != 0 && chain->tool_has_frame)
        name_place(chain, tool);
}

/* Sends on what the chain has made before it waits for a frame, which may depend on it. A failure
 * ends the chain with the next frame. */
static void send_on(void *with)
{
    struct runner *runner = last(with);
    for (size_t i = 0; i < runner->outputs.count; i++)
        output_flush(runner->outputs.items[i], &runner->diag);
}

/* Runners whose command line was refused stay in the chain, as programs that fail do in a pipe. */
static void start(struct chain *chain)
{
    for (size_t i = 0; i < chain->stages; i++)
        if (!failed(&chain->runners[i]))
            runner_start(&chain->runners[i]);
    struct runner *end = last(chain);
    if (end->stage->run == NULL && !failed(end))
        runner_output(end);
}

static void run(struct chain *chain)
{
    progress_begin(&chain->progress, "frames");
    if (chain->stages == chain->count)
        while (!any_failed(chain) && run_frame(chain) > 0)
            continue;
    else if (!failed(last(chain)))
        run_tool(chain);
    progress_end(&chain->progress);
}

/* The stages after the rightmost failure see the end of the stream, one after the other, as they
 * would in a pipe. */
static void finish(struct chain *chain)
{
    size_t first = chain->count;
    while (first > 0 && !failed(&chain->runners[first - 1]))
        first--;
    for (size_t i = first; i < chain->stages; i++)
        runner_finish(&chain->runners[i]);
    runner_close_outputs(last(chain), !any_failed(chain));
}

/* Objects are most of a line. They are not read where no stage of the chain names them; a stage
 * that needs them for some frames asks for them (suite_choice_step). */
static unsigned unread_parts(const struct runner *runners, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct stage *stage = runners[i].stage;
        if (stage_kind(stage) != STAGE_FILTER ||
            ((stage->reads | stage->writes) & PART_OBJECTS) != 0)
            return 0;
    }
    return PART_OBJECTS;
}

int chain_run(struct runner *runners, size_t count)
{
    struct chain chain = {.runners = runners, .count = count};
    chain.stages = runners[count - 1].stage->run != NULL ? count - 1 : count;
    chain.input.paths = runners[0].common.files.items;
    chain.input.count = runners[0].common.files.count;
    chain.input.unread = unread_parts(runners, count);
    chain.frame.arena = &chain.arena;
    chain.frame.list_cache = &chain.list_cache;
    chain.input.pause = (struct input_pause){send_on, &chain};
    for (size_t i = 0; i < count; i++) {
        runners[i].pause = chain.input.pause;
        runners[i].before = i > 0 ? &runners[i - 1] : NULL;
        runners[i].input = runners[0].stage->next != NULL ? NULL : &chain.input;
    }
    start(&chain);
    for (size_t i = 0; i < count; i++)
        print_notices(&runners[i]);
    run(&chain);
    finish(&chain);
    int code = complain_of_all(runners, count);
    for (size_t i = 0; i < count; i++) {
        runners[i].pause = (struct input_pause){0};
        runners[i].input = NULL;
    }
    frame_stream_close(&chain.input);
    arena_free(&chain.arena);
    arena_free(&chain.list_cache.arena);
    return code;
}

/* --help and --version, through an output that checks its close. */
static int print_about(struct runner *runner)
{
    struct text text = {0};
    if (runner->common.help)
        options_help(runner->stage, &text);
    else
        text_format(&text, "glint-%s (glint) %s\n", runner->stage->name, GLINT_VERSION);
    output_print(text.bytes, text.length, &runner->diag);
    text_free(&text);
    if (failed(runner))
        complain(runner, &runner->diag);
    return (int)runner->diag.code;
}

int chain_main(const struct stage *stage, int count, char **words)
{
    struct runner runner;
    size_t given = count > 0 ? (size_t)count - 1 : 0;
    const char *const *options = (const char *const *)words + 1;
    document_guard_memory();
    input_guard_descriptors();
    runner_prepare(&runner, stage, given, options);
    int code = (int)runner.diag.code;
    if (failed(&runner))
        complain(&runner, &runner.diag);
    else
        code = runner.common.help || runner.common.version ? print_about(&runner)
                                                           : chain_run(&runner, 1);
    runner_free(&runner);
    return code;
}
