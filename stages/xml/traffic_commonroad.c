/* Traffic of CommonRoad: the obstacles of a scenario in XML, 2018b or 2020a. */
#include "commonroad_rows.h"
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
                         : recording_open(state, commonroad_rows_open(input, arena), arena,
                                          runner_diag(runner));
}

#define COMMONROAD_FIRST(word, class) "\n    " class ": " word
#define COMMONROAD(word, class) ", " word

const struct stage stage_traffic_commonroad = {
    .name = "traffic-commonroad",
    .summary = "Play the obstacles of a CommonRoad scenario, frame by frame.",
    .details =
        "The XML is of version 2018b or 2020a. The ego is the obstacle with the id of --ego;\n"
        "planning problems are not read. If a value is an interval or a position is a region, its\n"
        "middle is used. The body is the box around the parts of the shape. Its velocity is read\n"
        "from velocity, along the orientation, and velocityY, to its left, or from velocity and\n"
        "slipAngle. If the file lacks these, or its positions are not the middles of boxes, then\n"
        "velocities are centred differences of places; so are yaw rates that the file lacks.\n"
        "Static obstacles are in every frame. Environment obstacles, phantom obstacles and\n"
        "occupancy sets are left out. The whole XML is read before the first frame, because it\n"
        "lists the whole motion of one obstacle after the other.\n"
        "\n"
        "Classes, each with the types of obstacles that are read as it:"
#include "commonroad_classes.def"
    ,
    .options = STAGE_OPTIONS(struct recording, traffic_commonroad_fields),
    .operand = "SOURCE",
    .writes = PART_OBJECTS,
    .start = traffic_commonroad_start,
    .next = recording_source_next,
    .locate_fault = recording_source_locate_fault,
    .release = recording_close,
};
