/* A plan: the pipeline that frames need. Tries every stage of the chain on every frame, and beside
 * it the simpler stage that may stand in for it, and prints which stages and effects were needed.
 */
#include "run/plan.h"
#include "run/tool.h"
#include "text/output.h"

struct plan_state {
    struct suite_choice choice; /* first: the options */
    bool all;
    struct plan plan;
};

static int plan_run(void *state, struct runner *runner)
{
    struct plan_state *own = state;
    struct output *output;
    if (plan_begin(&own->plan, &own->choice, runner) != 0 ||
        (output = runner_output(runner)) == NULL)
        return -1;
    struct frame *frame;
    int more;
    while ((more = runner_frame_ascending(runner, &frame)) > 0)
        if (plan_try(&own->plan, frame) != 0)
            return -1;
    if (more < 0)
        return -1;
    plan_write(&own->plan, own->all, runner_arena(runner), output_text(output));
    return output_send(output, runner_diag(runner));
}

static const struct field plan_options[] = {
    SUITE_CHOICE_OF_IDEAL,
    {OPTIONAL_FLAG(struct plan_state, all, "also list effects that are off, each with its reason")},
    {0},
};

const struct stage stage_plan = {
    .name = "plan",
    .summary = "Print the pipeline that the scenes need.",
    .details =
        "Runs the chain on every frame, and chooses from the effects of --effects as auto does. "
        "Prints which effects the frames need and why, which stages may be replaced by simpler "
        "ones, and the pipeline without the rest. On these scenes the pipeline gives the targets "
        "of the whole chain, byte for byte. Reflectors in the frames are used as they are. The "
        "plan is printed at the end of the stream. glint-cost measures how much time other "
        "pipelines save and how much accuracy they lose.",
    .options = STAGE_OPTIONS(struct plan_state, plan_options),
    .reads = SECTION_OBJECTS,
    .draws = true,
    .run = plan_run,
};
