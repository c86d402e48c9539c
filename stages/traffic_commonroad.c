/* Traffic of CommonRoad: the obstacles of a scenario in XML, 2018b or 2020a. */
/* needs: expat */
#include "run/recording_source.h"

static const struct field traffic_commonroad_fields[] = {
    RECORDING_SOURCE("a scenario of CommonRoad, plain or gzip; - is standard input"),
    {0},
};

static int traffic_commonroad_start(void *state, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    struct input *input = recording_source_input(state, runner);
    return input == NULL ? -1
                         : recording_open(state, recorded_commonroad_open(input, arena), arena,
                                          runner_diag(runner));
}

#define COMMONROAD_FIRST(word, class) "\n    " class ": " word
#define COMMONROAD(word, class) ", " word

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
    .next = recording_source_next,
    .locate_fault = recording_source_locate_fault,
    .release = recording_close,
};
