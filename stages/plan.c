/* A plan: the pipeline that frames need. Tries every stage of the chain on every frame, and beside
 * it the simpler stage that may stand in for it, and prints which stages and effects were needed.
 */
#include "run/plan.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "text/output.h"

extern const struct stage stage_extract, stage_ideal, stage_sensor, stage_sensor_perfect,
    stage_noise, stage_noise_none;

static const struct {
    const struct stage *stage, *stand_in;
    enum section section;
} chain[PLAN_POSITIONS] = {
    [PLAN_IDEAL] = {&stage_ideal, NULL, SECTION_ECHOES},
    [PLAN_SENSOR] = {&stage_sensor, &stage_sensor_perfect, SECTION_CELLS},
    [PLAN_NOISE] = {&stage_noise, &stage_noise_none, SECTION_TARGETS},
};

struct plan_state {
    struct suite_choice choice; /* first: the options, and ideal's when it is tried */
    struct plan plan;
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
    plan->sensors = own->choice.sensors;
    plan->allowed = selection.allowed;
    for (int i = 0; i < PLAN_POSITIONS; i++)
        plan->positions[i] = (struct plan_position){
            .stage = chain[i].stage->name,
            .stand_in = chain[i].stand_in != NULL ? chain[i].stand_in->name : NULL,
            .section = chain[i].section,
            .log.clock_ns = no_clock,
        };
    return 0;
}

static int try_stage(struct plan_state *own, int at, struct frame *frame, struct runner *runner)
{
    struct plan_position *position = &own->plan.positions[at];
    struct frame copy = *frame;
    frame_drop(&copy, SECTION_LOST | SECTION_COUNTS);
    if (runner_try_stage(runner, chain[at].stage, at == PLAN_IDEAL ? &own->choice : NULL,
                         &position->log, frame) != 0)
        return -1;
    if (position->stand_in == NULL || position->differs)
        return 0;
    if (runner_try_stage(runner, chain[at].stand_in, NULL, NULL, &copy) != 0)
        return -1;
    plan_compare(position, frame, &copy, runner_arena(runner));
    return 0;
}

static int try_chain(struct plan_state *own, struct frame *frame, struct runner *runner)
{
    own->plan.frames++;
    frame_drop(frame, SECTION_SENSORS | SECTION_ECHOES | SECTION_CELLS | SECTION_TARGETS |
                          SECTION_LOST | SECTION_COUNTS);
    if ((frame->present & SECTION_REFLECTORS) == 0 &&
        runner_try_stage(runner, &stage_extract, NULL, NULL, frame) != 0)
        return -1;
    for (int i = 0; i < PLAN_POSITIONS; i++)
        if (try_stage(own, i, frame, runner) != 0)
            return -1;
    return 0;
}

static int write_plan(const struct plan *plan, struct output *output, struct diag *diag)
{
    struct text text = {0};
    plan_write(plan, &text);
    int result = output_write(output, text.bytes, text.length, diag);
    text_free(&text);
    return result;
}

static int plan_run(void *state, struct runner *runner)
{
    struct plan_state *own = state;
    if (begin(own, runner) != 0)
        return -1;
    struct output *output = runner_output(runner);
    if (output == NULL)
        return -1;
    struct frame *frame;
    int more;
    while ((more = runner_frame(runner, &frame)) > 0)
        if (try_chain(own, frame, runner) != 0)
            return -1;
    return more == 0 ? write_plan(&own->plan, output, runner_diag(runner)) : -1;
}

static const struct field plan_options[] = {
    SUITE_CHOICE_OF_IDEAL,
    {0},
};

static const struct record plan_record = {
    .name = "plan", .size = sizeof(struct plan_state), .fields = plan_options};

const struct tool tool_plan = {
    .name = "plan",
    .summary = "Print the pipeline that the scenes need, ready to paste.",
    .details =
        "Runs the chain on every frame, choosing effects as auto does among those that are\n"
        "asked for. Prints which effects were needed and why, for which stages a simpler one\n"
        "can stand in, and the pipeline without the others. On these scenes it gives the\n"
        "targets of the whole chain, byte for byte. Of the frames, only the objects are used,\n"
        "and their reflectors if they are there.",
    .options = &plan_record,
    .reads = SECTION_OBJECTS,
    .run = plan_run,
};
