/* Traffic of CommonRoad: the obstacles of a scenario in XML, 2018b or 2020a. */
/* needs: expat */
#include "recorded/recording.h"
#include "run/stage.h"

static const struct field traffic_commonroad_fields[] = {
    RECORDING_SOURCE("a scenario of CommonRoad, plain or gzip; - is standard input"),
    {0},
};

static int traffic_commonroad_start(void *state, struct runner *runner)
{
    struct recording *recording = state;
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    struct input *input = runner_input(runner, recording->source);
    if (input == NULL)
        return diag_prefix(diag, "%s: ", recording->source);
    return recording_open(recording, recorded_commonroad_open(input, arena), arena, diag);
}

static int traffic_commonroad_next(void *state, struct frame *frame, struct runner *runner)
{
    return recording_next(state, frame, runner_diag(runner));
}

static int traffic_commonroad_locate_fault(void *state, const struct frame *frame,
                                           struct runner *runner)
{
    return recording_check(state, frame, runner_diag(runner));
}

#define COMMONROAD(word, class) "\n    " word " = " class

const struct stage stage_traffic_commonroad = {
    .name = "traffic-commonroad",
    .summary = "Play the obstacles of a CommonRoad scenario, frame by frame.",
    .details =
        "The XML is of version 2018b or 2020a. An ego is an obstacle by its id; planning problems\n"
        "have no motion. A value is exact or an interval, a position a point or a region: their\n"
        "middles count. The body is the box around the parts of the shape. Its velocity is that\n"
        "of the file: velocity along the orientation, velocityY to its left or slipAngle; it is\n"
        "taken from the places where the box's middle is not the point that positions are of.\n"
        "Velocities and yaw rates that the file lacks are centred differences. Obstacles that\n"
        "stand still are there in every step. Obstacles of the environment, phantoms and\n"
        "occupancy sets are left out. As the XML has one obstacle after the other, it is read\n"
        "whole before the first frame.\n"
        "\n"
        "What types of obstacles mean:"
#include "recorded/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct recording, traffic_commonroad_fields),
    .operand = "SOURCE",
    .writes = SECTION_OBJECTS,
    .start = traffic_commonroad_start,
    .next = traffic_commonroad_next,
    .locate_fault = traffic_commonroad_locate_fault,
    .release = recording_close,
};
