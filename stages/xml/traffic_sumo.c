/* Traffic of SUMO: floating car data as XML, also from a pipe while SUMO runs. */
#include "recorded_sumo.h"
#include "run/recording_source.h"

static const struct field traffic_sumo_fields[] = {
    RECORDING_SOURCE("the XML that sumo --fcd-output writes, plain or gzip; - is standard input"),
    RECORDING_TYPES,
    {OPTIONAL_FLAG(struct recording, live, "write each frame before the next step arrives")},
    {0},
};

static int traffic_sumo_start(void *state, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    struct input *input = recording_source_input(state, runner);
    return input == NULL ? -1
                         : recording_open(state, recorded_sumo_open(input, arena), arena,
                                          runner_diag(runner));
}

#define SUMO_FIRST(word, class, length_m, width_m, height_m) "\n    " class ": " word
#define SUMO(word, class, length_m, width_m, height_m) ", " word

const struct stage stage_traffic_sumo = {
    .name = "traffic-sumo",
    .summary = "Play the floating car data of SUMO, frame by frame.",
    .details =
        "Velocities and yaw rates come from the places, not from SUMO's speeds: while a vehicle\n"
        "changes lanes it does not move along its heading. They are centred differences, which\n"
        "wait for the next step. With --live they are differences from the step before, each "
        "frame\n"
        "goes out before the next step arrives, and no frame is marked as the last of its scene.\n"
        "Give sumo --precision 6: with its default of two decimals velocities are coarse. If it\n"
        "writes to a pipe, also give it --no-step-log, as its log would mix with the XML.\n"
        "\n"
        "Classes and sizes come from the types (--types). Without --types, each name of a\n"
        "type must be in --class-map or in this list of names by class:"
#include "recorded/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct recording, traffic_sumo_fields),
    .operand = "SOURCE",
    .writes = PART_OBJECTS,
    .start = traffic_sumo_start,
    .next = recording_source_next,
    .locate_fault = recording_source_locate_fault,
    .release = recording_close,
};
