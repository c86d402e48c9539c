/* A plan: the pipeline that frames need. Leaves out every effect alone on every frame, and puts a
 * simpler stage in place of each that has one. Prints what changes lists of targets, and the
 * pipeline without the rest. */
#include "run/plan.h"
#include "run/tool.h"
#include "run/trial_options.h"

struct plan_state {
    struct trial_options options; /* first */
    bool all, json;
    struct plan plan;
};

static int print(const struct plan_state *own, struct runner *runner)
{
    struct text text = {0};
    if (own->json || runner_output_ends(runner, ".json"))
        return runner_write_record(runner, &cost_table_record, &own->plan.table);
    plan_write(&own->plan, own->all, &text);
    return runner_write_fitted(runner, &text);
}

static int plan_run(void *state, struct runner *runner)
{
    struct plan_state *own = state;
    if (plan_begin(&own->plan, &own->options, runner) != 0 || runner_output(runner) == NULL)
        return -1;
    struct frame *frame;
    int more;
    while ((more = runner_frame_ascending(runner, &frame)) > 0)
        if (plan_try(&own->plan, frame) != 0)
            return -1;
    return more < 0 || plan_end(&own->plan) != 0 ? -1 : print(own, runner);
}

static void plan_release(void *state)
{
    plan_free(&((struct plan_state *)state)->plan);
}

static const struct field plan_options[] = {
    TRIAL_OPTIONS,
    {OPTIONAL_FLAG(struct plan_state, all,
                   "also list idle effects, and the documents' reason for each that is on or off")},
    {OPTIONAL_FLAG(struct plan_state, json,
                   "write a line of JSON; an --output that ends in .json does the same")},
    {0},
};

const struct stage stage_plan = {
    .name = "plan",
    .summary = "Print the pipeline that the scenes need.",
    .details =
        "Runs the chain on every frame, and again without each effect of --effects. Prints how "
        "many "
        "lists of targets change without the effect, what of the scenes calls for it, and its "
        "share of the time; which stages simpler ones may replace; and the pipeline without all "
        "that changes no list. That pipeline has run over all frames: it gives the targets of the "
        "whole chain, byte for byte. Reflectors in the frames are used as they are. The frames' "
        "objects stay in memory, and the plan comes at the end of the stream. "
        "pipelines/README.md explains it; glint-cost measures pipelines with an error.",
    .options = STAGE_OPTIONS(struct plan_state, plan_options),
    .reads = PART_OBJECTS,
    .draws = true,
    .run = plan_run,
    .release = plan_release,
};
