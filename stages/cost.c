/* What accuracy costs: chains of stages by time and error, measured on a sample of the frames, and
 * the pipeline that holds a bound on one of the two. */
#include "run/cost.h"
#include "run/cost_search.h"
#include "run/tool.h"
#include "run/trial_options.h"

struct cost_state {
    struct trial_options options; /* first */
    const char *error, *within;
    int64_t sample; /* most frames */
    int reference;  /* enum cost_reference; -1: not given */
    bool brief, json;
    struct cost cost;
    double bound;                     /* of the error, or in microseconds */
    const struct tried_chain *chosen; /* that holds it; NULL: no bound was given */
};

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

static int read_bounds(struct cost_state *own, struct diag *diag)
{
    if (own->error != NULL && own->within != NULL)
        return diag_fail(diag, DIAG_USAGE, "--error and --within: only one bound may be given");
    if ((own->error != NULL || own->within != NULL) && own->brief)
        return diag_fail(diag, DIAG_USAGE,
                         "--brief: leaves out no effect, so nothing is found within a bound");
    if (own->error != NULL)
        return read_bound("error", own->error, "%", 0.01, &own->bound, diag);
    return own->within == NULL ? 0 : read_bound("within", own->within, "us", 1, &own->bound, diag);
}

static int begin(struct cost_state *own, struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    struct cost *cost = &own->cost;
    if (read_bounds(own, diag) != 0)
        return -1;
    cost->brief = own->brief;
    if (cost_begin(cost, &own->options, runner, own->reference == COST_ALL ? COST_ALL : COST_SIGNAL,
                   own->sample) != 0)
        return -1;
    if (own->reference == COST_SIGNAL && cost->no_signal != NULL)
        return diag_fail(diag, DIAG_USAGE, "--reference: signal: %s", cost->no_signal);
    return 0;
}

/* After the last frame: measures the chains, and finds the one that was asked for. */
static int measure(struct cost_state *own, struct diag *diag)
{
    struct cost *cost = &own->cost;
    if (cost->sample.list.count == 0)
        return diag_fail(diag, DIAG_DATA, "the stream has no frame; expected one to measure");
    if (cost_measure(cost) != 0)
        return -1;
    if (own->error == NULL && own->within == NULL)
        return 0;
    own->chosen =
        cost_search(cost, own->error != NULL ? COST_SEARCH_ERROR : COST_SEARCH_US, own->bound);
    return own->chosen != NULL ? 0 : -1;
}

static int print(const struct cost_state *own, struct runner *runner)
{
    const struct cost *cost = &own->cost;
    struct text text = {0};
    if (own->json || runner_output_ends(runner, ".json"))
        return runner_write_record(runner, &cost_table_record, &cost->table);
    cost_write(cost, own->chosen, &text);
    return runner_write_fitted(runner, &text);
}

static int cost_run(void *state, struct runner *runner)
{
    struct cost_state *own = state;
    struct diag *diag = runner_diag(runner);
    if (begin(own, runner) != 0 || runner_output(runner) == NULL)
        return -1;
    struct frame *frame;
    int more;
    while ((more = runner_frame_ascending(runner, &frame)) > 0)
        if (frame_sample_add(&own->cost.sample, frame, diag) != 0)
            return -1;
    return more < 0 || measure(own, diag) != 0 ? -1 : print(own, runner);
}

static void cost_release(void *state)
{
    cost_free(&((struct cost_state *)state)->cost);
}

static const struct field cost_options[] = {
    TRIAL_OPTIONS,
    {OPTIONAL_NAME(
         struct cost_state, error,
         "print the fastest pipeline with at most this error, in per cent as in the table: 30%"),
     .word = "PERCENT"},
    {OPTIONAL_NAME(
         struct cost_state, within,
         "print the pipeline with the least error that takes at most this CPU time a frame: 100us"),
     .word = "TIME"},
    {OPTIONAL_INTEGER(
        struct cost_state, sample, 1, 1e6,
        "measure this many frames, if there are as many; absent: 250, or fewer if the signal "
        "takes long")},
    {OPTIONAL_CHOICE(struct cost_state, reference, cost_table_references,
                     "the chain that errors are measured from; absent: signal, if there is one"),
     .absent = -1},
    {OPTIONAL_FLAG(struct cost_state, brief, "measure no chains that leave out an effect")},
    {OPTIONAL_FLAG(struct cost_state, json,
                   "write a line of JSON; an --output that ends in .json does the same")},
    {0},
};

const struct stage stage_cost = {
    .name = "cost",
    .summary = "Print what accuracy costs on these scenes: chains by time and error.",
    .details =
        "Measures CPU time and error of chains of stages on a sample of the frames. For each "
        "effect it prints how many target lists change without it, the time that leaving it out "
        "saves and the squared error that this adds. The error is the distance of a chain's lists "
        "from those of a reference, the root of an energy distance, in per cent of that of ideal "
        "echoes. At 0 %, both have the same distribution of lists. The reference is the signal if "
        "the suite has a waveform and glint-sensor-signal lies beside this program, and otherwise "
        "the chain with all effects that the suite describes. Reflectors in the frames are used as "
        "they are. The table is printed at the end of the stream; pipelines/README.md explains it.",
    .options = STAGE_OPTIONS(struct cost_state, cost_options),
    .reads = PART_OBJECTS,
    .draws = true,
    .run = cost_run,
    .release = cost_release,
};
