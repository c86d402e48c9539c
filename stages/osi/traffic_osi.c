/* Traffic of OSI: the ground truth of a trace, message by message, also while it is written. */
#include "osi_rows.h"
#include "run/recording_source.h"

struct traffic_osi {
    struct recording recording; /* first: its options are the stage's */
    bool rear_axle_velocity;
};

static const struct field traffic_osi_fields[] = {
    RECORDING_SOURCE("an OSI trace (.osi), plain or gzip; - is standard input"),
    {OPTIONAL_FLAG(struct traffic_osi, rear_axle_velocity,
                   "velocities are those of rear axles, as from esmini; absent: of box centres")},
    {OPTIONAL_FLAG(struct recording, live, "write each frame before the next message arrives")},
    {0},
};

/* The host that the trace names is the ego unless --ego says another one. */
static int traffic_osi_start(void *state, struct runner *runner)
{
    const struct traffic_osi *own = state;
    struct recording *recording = state;
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    struct input *input = recording_source_input(state, runner);
    if (input == NULL)
        return -1;
    struct recorded_reader reader =
        osi_rows_open(input, own->rear_axle_velocity, &recording->host, arena, diag);
    return recording_open(recording, reader, arena, diag);
}

#define OSI_FIRST(kind, number, word, class) "\n    " class ": " word
#define OSI(kind, number, word, class) ", " word

const struct stage stage_traffic_osi = {
    .name = "traffic-osi",
    .summary = "Play the ground truth of an OSI trace, frame by frame.",
    .details =
        "A trace holds messages GroundTruth, or SensorView or SensorData with "
        "global_ground_truth,\n"
        "each after its length in four bytes; the traces of glint-osi are such.\n"
        "Without --ego the host vehicle is the ego, if the trace names it. Places are the centres\n"
        "of boxes; yaws count counter-clockwise from x. Velocities and yaw rates that the trace\n"
        "lacks are centred differences, which wait for the next message, or with --live "
        "differences\n"
        "from the message before. A trailer is an object of its own. Stationary objects of the\n"
        "classes below stay until a message has others; other types are left out.\n"
        "\n"
        "Classes, each with the types of OSI that are read as it:"
#include "osi_classes.def"
    ,
    .options = STAGE_OPTIONS(struct traffic_osi, traffic_osi_fields),
    .operand = "SOURCE",
    .writes = PART_OBJECTS,
    .start = traffic_osi_start,
    .next = recording_source_next,
    .locate_fault = recording_source_locate_fault,
    .release = recording_close,
};
