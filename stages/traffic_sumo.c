/* Traffic of SUMO: floating car data as XML, also from a pipe while SUMO runs. */
/* needs: expat */
#include "recorded/recording.h"
#include "run/stage.h"

static const struct field traffic_sumo_fields[] = {
    RECORDING_SOURCE("the XML that sumo --fcd-output writes, plain or gzip; - is standard input"),
    RECORDING_TYPES,
    {OPTIONAL_FLAG(struct recording, live,
                   "write the frame of a step before the next step is there")},
    {0},
};

static int traffic_sumo_start(void *state, struct runner *runner)
{
    struct recording *recording = state;
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    struct input *input = runner_input(runner, recording->source);
    if (input == NULL)
        return diag_prefix(diag, "%s: ", recording->source);
    return recording_open(recording, recorded_sumo_open(input, arena), arena, diag);
}

static int traffic_sumo_next(void *state, struct frame *frame, struct runner *runner)
{
    return recording_next(state, frame, runner_diag(runner));
}

static int traffic_sumo_locate_fault(void *state, const struct frame *frame, struct runner *runner)
{
    return recording_check(state, frame, runner_diag(runner));
}

#define SUMO(word, class, length_m, width_m, height_m) "\n    " word " = " class

const struct stage stage_traffic_sumo = {
    .name = "traffic-sumo",
    .summary = "Play the floating car data of SUMO, frame by frame.",
    .details =
        "Velocities and yaw rates come from the places, not from SUMO's speeds: while a vehicle\n"
        "changes lanes it does not move along its heading. They are centred differences, which\n"
        "wait for the next step; with --live they are differences to the step before, a frame\n"
        "comes before the next step is there, and no frame is marked as the last of its scene.\n"
        "Give sumo --precision 6: with its two decimals velocities are coarse. Where it writes to\n"
        "a pipe, also give it --no-step-log: its log would get between the XML.\n"
        "\n"
        "Classes and sizes are those of the types (--types). Without them the name of a type must\n"
        "be one of these words, which --class-map adds to:"
#include "recorded/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct recording, traffic_sumo_fields),
    .operand = "SOURCE",
    .writes = SECTION_OBJECTS,
    .start = traffic_sumo_start,
    .next = traffic_sumo_next,
    .locate_fault = traffic_sumo_locate_fault,
    .release = recording_close,
};
