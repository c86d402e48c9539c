/* A plan: the pipeline that frames need. Tries every stage of the chain on every frame, and beside
 * it the simpler stage that may stand in for it, and prints which stages and effects were needed.
 * Or, with a bound or for a table, measures what accuracy costs on a sample of the frames. */
#include "run/plan.h"
#include "run/cost.h"
#include "run/fused.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "text/output.h"
#include "text/record_text.h"

static const struct {
    const char *program, *stand_in;
    enum section section;
} chain[PLAN_POSITIONS] = {
    [PLAN_IDEAL] = {"glint-ideal", NULL, SECTION_ECHOES},
    [PLAN_SENSOR] = {"glint-sensor", "glint-sensor-perfect", SECTION_CELLS},
    [PLAN_NOISE] = {"glint-noise", "glint-noise-none", SECTION_TARGETS},
};

struct plan_state {
    struct suite_choice choice; /* first: the options, and ideal's when it is tried */
    bool all, cost, brief, json;
    const char *error, *within;
    const char *request; /* the effects that were asked for; "auto" if all may be simulated */
    int64_t frames;      /* of the sample */
    int reference;       /* enum cost_reference; -1: not given */
    struct plan plan;
    struct runner *extract, *tried[PLAN_POSITIONS], *stand_in[PLAN_POSITIONS];
    struct cost measured;
    double bound; /* of the error, or in microseconds */
    const struct ladder_chain *chosen;
};

static int64_t no_clock(void)
{
    return 0;
}

static int begin(struct plan_state *own, struct runner *runner)
{
    struct plan *plan = &own->plan;
    struct sensors request;
    struct selection selection;
    struct diag *diag = runner_diag(runner);
    const struct suite *suite = runner_suite(runner, own->choice.sensors);
    if (suite == NULL || suite_choice_request(&own->choice, suite, &request, diag) != 0 ||
        effects_read(request.effects, &selection, diag) != 0)
        return -1;
    own->choice.effects = plan_request(selection.allowed, runner_arena(runner));
    own->request = strcmp(own->choice.effects, "auto") == 0 ? "auto" : request.effects;
    plan->sensors = own->choice.sensors;
    plan->allowed = selection.allowed;
    for (int i = 0; i < PLAN_POSITIONS; i++)
        plan->positions[i] = (struct plan_position){
            .program = chain[i].program,
            .stand_in = chain[i].stand_in,
            .section = chain[i].section,
            .log.clock_ns = no_clock,
        };
    own->extract = runner_trial(runner, fused_stage("extract"), NULL, NULL);
    for (int i = 0; i < PLAN_POSITIONS; i++) {
        own->tried[i] =
            runner_trial(runner, fused_stage(fused_name(chain[i].program)),
                         i == PLAN_IDEAL ? &own->choice : NULL, &plan->positions[i].log);
        if (chain[i].stand_in != NULL)
            own->stand_in[i] =
                runner_trial(runner, fused_stage(fused_name(chain[i].stand_in)), NULL, NULL);
    }
    return 0;
}

static int try_stage(struct plan_state *own, int at, struct frame *frame, struct runner *runner)
{
    struct plan_position *position = &own->plan.positions[at];
    struct frame copy = *frame;
    frame_drop(&copy, SECTION_LOST | SECTION_COUNTS);
    if (runner_try(runner, own->tried[at], frame) != 0)
        return -1;
    if (position->stand_in == NULL || position->differs)
        return 0;
    if (runner_try(runner, own->stand_in[at], &copy) != 0)
        return -1;
    plan_compare(position, frame, &copy, runner_arena(runner));
    return 0;
}

static int try_chain(struct plan_state *own, struct frame *frame, struct runner *runner)
{
    own->plan.frames++;
    frame_drop(frame, SECTION_SENSORS | SECTION_ECHOES | SECTION_CELLS | SECTION_TARGETS |
                          SECTION_LOST | SECTION_COUNTS | SECTION_VISIBILITY);
    frame->sections = CARRY_BY_DEFAULT;
    if ((frame->present & SECTION_REFLECTORS) == 0 && runner_try(runner, own->extract, frame) != 0)
        return -1;
    for (int i = 0; i < PLAN_POSITIONS; i++)
        if (try_stage(own, i, frame, runner) != 0)
            return -1;
    return 0;
}

/* Reads "10%" as 0.1 and "100us" as 100, a number with this unit. */
static int read_bound(const char *option, const char *text, const char *unit, double scale,
                      double *bound, struct diag *diag)
{
    size_t length = strlen(text), ending = strlen(unit);
    if (length > ending && strcmp(text + length - ending, unit) == 0 &&
        field_read_number(text, length - ending, bound) == 0 && *bound >= 0) {
        *bound *= scale;
        return 0;
    }
    return diag_fail(diag, DIAG_USAGE, "--%s: \"%s\"; expected a number with its unit, as 10%s",
                     option, text, unit);
}

static int begin_cost(struct plan_state *own, struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    if (own->error != NULL && own->within != NULL)
        return diag_fail(diag, DIAG_USAGE, "--error and --within: only one bound may be given");
    bool bounded = own->error != NULL || own->within != NULL;
    if (bounded && own->brief)
        return diag_fail(diag, DIAG_USAGE,
                         "--brief: leaves out no effect, so nothing is found within a bound");
    if ((own->error != NULL &&
         read_bound("error", own->error, "%", 0.01, &own->bound, diag) != 0) ||
        (own->within != NULL && read_bound("within", own->within, "us", 1, &own->bound, diag) != 0))
        return -1;
    own->cost = own->cost || bounded;
    own->json = own->json || runner_output_ends(runner, ".json");
    if (!own->cost && (own->brief || own->json || own->frames > 0 || own->reference >= 0))
        return diag_fail(
            diag, DIAG_USAGE,
            "--brief, --json or an --output of .json, --frames and --reference: only with "
            "--cost");
    own->measured = (struct cost){
        .runner = runner,
        .suite = own->choice.sensors,
        .reference = own->reference == COST_ALL ? COST_ALL : COST_SIGNAL,
        .brief = own->brief,
    };
    if (own->cost && cost_begin(&own->measured, own->frames) != 0)
        return -1;
    if (own->cost && own->reference == COST_SIGNAL && own->measured.no_signal != NULL)
        return diag_fail(diag, DIAG_USAGE, "--reference: signal: %s", own->measured.no_signal);
    return 0;
}

/* Finds the effects that the frames of the sample call for. */
static int try_sample(struct plan_state *own, struct runner *runner)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    const struct ladder_sample *sample = &own->measured.sample;
    int result = 0;
    for (size_t i = 0; result == 0 && i < sample->list.count; i++)
        if (ladder_sample_read(&sample->list.items[i], &frame, runner_diag(runner)) != 0 ||
            try_chain(own, &frame, runner) != 0)
            result = diag_prefix(runner_diag(runner), "scene \"%s\", frame %lld: ", frame.scene,
                                 (long long)frame.frame);
    arena_free(&arena);
    return result;
}

/* After the last frame: measures the chains, and finds the one that was asked for. */
static int measure(struct plan_state *own, struct runner *runner)
{
    struct cost *cost = &own->measured;
    ladder_sample_divide(&cost->sample);
    if (cost->sample.list.count == 0)
        return 0;
    if (try_sample(own, runner) != 0)
        return -1;
    cost->allowed = own->plan.allowed;
    cost->whole = own->request;
    cost->needed = plan_effects(&own->plan);
    if (cost_measure(cost) != 0)
        return -1;
    if (own->error != NULL)
        own->chosen = cost_find(cost, COST_BOUND_ERROR, own->bound);
    if (own->within != NULL)
        own->chosen = cost_find(cost, COST_BOUND_US, own->bound);
    return own->chosen != NULL || (own->error == NULL && own->within == NULL) ? 0 : -1;
}

static void print(const struct plan_state *own, struct arena *arena, struct text *text)
{
    const struct cost *cost = &own->measured;
    if (!own->cost)
        plan_write(&own->plan, own->all, arena, text);
    else if (cost->chains.count == 0)
        return;
    else if (own->json)
        record_text_write(&cost_record, cost, NULL, text);
    else if (own->chosen != NULL)
        cost_write_pipeline(cost, own->chosen, text);
    else
        cost_write_table(cost, text);
}

static int plan_run(void *state, struct runner *runner)
{
    struct plan_state *own = state;
    struct diag *diag = runner_diag(runner);
    if (begin(own, runner) != 0 || begin_cost(own, runner) != 0)
        return -1;
    struct output *output = runner_output(runner);
    if (output == NULL)
        return -1;
    struct frame *frame;
    int more;
    while ((more = runner_frame(runner, &frame)) > 0)
        if ((own->cost ? ladder_sample_add(&own->measured.sample, frame, diag)
                       : try_chain(own, frame, runner)) != 0)
            return -1;
    if (more < 0 || (own->cost && measure(own, runner) != 0))
        return -1;
    struct text text = {0};
    print(own, runner_arena(runner), &text);
    int result = output_write(output, text.bytes, text.length, diag);
    text_free(&text);
    return result;
}

static const struct field plan_options[] = {
    SUITE_CHOICE_OF_IDEAL,
    {OPTIONAL_FLAG(struct plan_state, all, "list effects that are off too, each with its reason")},
    {OPTIONAL_FLAG(struct plan_state, cost,
                   "measure what accuracy costs: a table of chains by time and error")},
    {OPTIONAL_NAME(struct plan_state, error,
                   "print the cheapest pipeline whose error is at most this: 10%"),
     .word = "PERCENT"},
    {OPTIONAL_NAME(struct plan_state, within,
                   "print the most accurate pipeline that takes at most this for a frame: 100us"),
     .word = "TIME"},
    {OPTIONAL_INTEGER(
        struct plan_state, frames, 1, 1e6,
        "how many frames are measured at most; absent: 250, or fewer where the signal takes long")},
    {OPTIONAL_CHOICE(struct plan_state, reference, cost_references,
                     "what errors are measured from; absent: the signal where there is one"),
     .absent = -1},
    {OPTIONAL_FLAG(struct plan_state, brief, "measure no chains that leave out an effect")},
    {OPTIONAL_FLAG(struct plan_state, json,
                   "write the costs as a line of JSON, as to an --output that ends in .json")},
    {0},
};

const struct tool tool_plan = {
    .name = "plan",
    .summary = "Print the pipeline that the scenes need, or what accuracy costs on them.",
    .details =
        "Runs the chain on every frame, choosing effects as auto does among those that are\n"
        "asked for. Prints which effects were needed and why, for which stages a simpler one\n"
        "can stand in, and the pipeline without the others. On these scenes it gives the\n"
        "targets of the whole chain, byte for byte. Of the frames, only the objects are used,\n"
        "and their reflectors if they are there. Prints at the end of the stream.\n"
        "\n"
        "With --cost, --error or --within it measures chains of stages on a sample of the\n"
        "frames: CPU time, and error. The error is the energy distance of a chain's lists from\n"
        "those of a reference, in per cent of that of ideal echoes: 0 % is not told from the\n"
        "reference. The reference is the signal, if the suite has a waveform and\n"
        "glint-sensor-signal lies beside this program, or all that the suite describes.\n"
        "pipelines/README.md says how to read the table.",
    .options = STAGE_OPTIONS(struct plan_state, plan_options),
    .reads = SECTION_OBJECTS,
    .run = plan_run,
};
