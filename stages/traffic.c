/* Traffic: plays a scenario document or a recorded table, frame by frame. */
#include "run/recording_source.h"
#include "text/document.h"
#include "traffic/scenario_scenes.h"

struct traffic {
    struct recording recording; /* first: its source and options are those of scenarios too */
    bool recorded;              /* is it one? */
    const char *scenes;
    struct scenario_scenes scenario;
    struct conditions conditions; /* that the options change, of a scenario */
};

static int start_scenario(struct traffic *traffic, struct runner *runner)
{
    const struct recording_options *options = &traffic->recording.options;
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    if (options->rate_hz > 0 || options->from_s > -9e9 || options->to_s < 9e9 ||
        options->class_map != NULL || options->class_default != NULL)
        return diag_fail(diag, DIAG_USAGE,
                         "%s: a scenario has rate, times and classes of its own; --rate-hz, "
                         "--from-s, --to-s, --class-map and --class-default are for recordings",
                         traffic->recording.source);
    struct scenario_scenes *scenes = &traffic->scenario;
    scenes->ego = options->ego;
    scenes->title = options->scene;
    scenes->radius_m = options->radius_m;
    scenes->flow = 1;
    scenes->name = recording_name(traffic->recording.source, arena);
    if (scenario_scenes_choose(scenes, traffic->scenes, diag) != 0 ||
        scenario_read(traffic->recording.source, &scenes->document, arena, diag) != 0)
        return -1;
    return recording_conditions(options, &traffic->conditions, arena, diag);
}

static int start_table(struct traffic *traffic, const char *path, struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    if (traffic->scenes != NULL)
        return diag_fail(diag, DIAG_USAGE, "%s: --scenes is for scenarios; a recording has none",
                         path);
    struct input *input = runner_input(runner, path);
    if (input == NULL)
        return diag_prefix(diag, "%s: ", path);
    traffic->recorded = true;
    traffic->recording.source = path;
    struct recorded_reader reader = recorded_table_open(input, path, runner_arena(runner), diag);
    return recording_open(&traffic->recording, reader, runner_arena(runner), diag);
}

/* A bare name is a scenario's, or else a table's. A file is a table unless it begins as JSON. */
static int traffic_start(void *state, struct runner *runner)
{
    struct traffic *traffic = state;
    struct arena *arena = runner_arena(runner);
    const char *path = traffic->recording.source;
    struct diag unknown = {0};
    bool bare = strpbrk(path, "./") == NULL;
    int scenario = bare ? document_find(NULL, "scenarios", path, ".json", arena, &unknown) != NULL
                        : recording_source_begins(path, '{', runner);
    if (bare && !scenario)
        path = document_find(NULL, "trajectories", path, ".csv", arena, &unknown);
    if (scenario < 0)
        return -1;
    return scenario || path == NULL ? start_scenario(traffic, runner)
                                    : start_table(traffic, path, runner);
}

static int traffic_next(void *state, struct frame *frame, struct runner *runner)
{
    struct traffic *traffic = state;
    if (traffic->recorded)
        return recording_next(&traffic->recording, frame, runner_diag(runner));
    int more = scenario_scenes_next(&traffic->scenario, frame, runner_diag(runner));
    if (more != 1)
        return more;
    runner_expect(runner, scenario_scenes_frames(&traffic->scenario));
    conditions_change(&frame->conditions, &traffic->conditions);
    return 1;
}

static int traffic_locate_fault(void *state, const struct frame *frame, struct runner *runner)
{
    const struct traffic *traffic = state;
    if (traffic->recorded)
        return recording_check(&traffic->recording, frame, runner_diag(runner));
    if (scenario_check_frame(frame, runner_diag(runner)) != 0)
        return diag_prefix(runner_diag(runner), "%s: ", traffic->recording.source);
    return 0;
}

static void traffic_release(void *state)
{
    struct traffic *traffic = state;
    recording_close(&traffic->recording);
    scenario_scenes_close(&traffic->scenario);
}

static const struct field traffic_options[] = {
    {FIELD_NAME_OF(struct recording, source,
                   "a scenario (a name in data/scenarios/, or a path), or a recorded table")},
    {OPTIONAL_NAME(struct traffic, scenes,
                   "play scenes A to B - 1 of a scenario, each with draws of its own; absent: 0:1"),
     .word = "A:B"},
    {OPTIONAL_RECORD(struct recording, options, &recording_options_record, "")},
    {0},
};

#define FIRST(format, word, class) "\n    " format class ": " word
#define NEXT(word) ", " word
#define INTERACTION_FIRST(word, class) FIRST("INTERACTION  ", word, class)
#define INTERACTION(word, class) NEXT(word)
#define HIGHD_FIRST(word, class) FIRST("highD        ", word, class)
#define HIGHD(word, class) NEXT(word)
#define IND_FIRST(word, class) FIRST("inD          ", word, class)
#define IND(word, class) NEXT(word)
#define NGSIM_FIRST(word, class) FIRST("NGSIM        ", word, class)
#define NGSIM(word, class) NEXT(word)
#define ESMINI_FIRST(word, class) FIRST("esmini       ", word, class)
#define ESMINI(word, class) NEXT(word)
#define SUMO_FIRST(word, class, length_m, width_m, height_m) FIRST("SUMO         ", word, class)
#define SUMO(word, class, length_m, width_m, height_m) NEXT(word)

const struct stage stage_traffic = {
    .name = "traffic",
    .summary = "Play a scenario or a recorded table, frame by frame.",
    .details =
        "A scenario is a JSON document; a table is CSV, plain or gzip, in the columns of highD,\n"
        "inD, rounD, exiD, uniD, INTERACTION, NGSIM, SUMO or of esmini's log, and needs --ego.\n"
        "Frame rate and classes are read from the files beside it if the format has them there.\n"
        "Coordinates beyond a kilometre become relative to an origin near the ego; every frame\n"
        "states this origin.\n"
        "\n"
        "Velocities and yaw rates that a table lacks are centred differences, which wait for\n"
        "the next step. --rate-hz interpolates between steps by cubic curves. Tables of SUMO\n"
        "whose vehicles have types of their own are for glint-traffic-sumo --types.\n"
        "\n"
        "Classes by format, each with the words, or sizes, that are read as it:"
#include "recorded/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct traffic, traffic_options),
    .operand = "SOURCE",
    .writes = PART_OBJECTS,
    .start = traffic_start,
    .next = traffic_next,
    .locate_fault = traffic_locate_fault,
    .release = traffic_release,
};
