#include "captured.h"
#include "run/chain.h"
#include "run_bench.h"

/* Stages of a user, each of which spoils a part of the frame. Stages behind it read the part, and
 * leave it out of what the chain writes. */
static void spoil_header(struct frame *frame)
{
    frame->interval_s = (double)NAN;
}

static void spoil_objects(struct frame *frame)
{
    frame->objects.items[1].vx_mps = (double)INFINITY;
}

static void spoil_reflectors(struct frame *frame)
{
    struct reflector_set *set = &frame->reflectors.items[0];
    memset(&set->points, 0, sizeof set->points);
    list_add(&set->points, frame->arena)->name = "glare";
    set->points.items[0].ercs = -1;
}

static void spoil_sensors(struct frame *frame)
{
    frame->sensors.list.items[1].name = frame->sensors.list.items[0].name;
}

static void spoil_echoes(struct frame *frame)
{
    frame->echoes.items[3].range_m = -1;
}

static void repeat_echo(struct frame *frame)
{
    frame->echoes.items[1] = frame->echoes.items[0];
}

static void spoil_cells(struct frame *frame)
{
    frame->cells.items[1].members.items[0].weight = 2;
}

static void empty_cell(struct frame *frame)
{
    frame->cells.items[0].members.count = 0;
}

static void spoil_counts(struct frame *frame)
{
    frame->counts.items[0].pairs = -1;
}

static void spoil_targets(struct frame *frame)
{
    frame->targets.items[0].contributors.count = 0;
}

struct fault {
    void (*spoil)(struct frame *frame);
    unsigned part;
    size_t place; /* number of the stage in the chain */
    const char *message;
};

static const struct fault faults[] = {
    {spoil_header, 0, 1, "interval_s: nan is outside [1e-9, 1e6] s"},
    {spoil_objects, PART_OBJECTS, 1, "objects[1].vx_mps: inf is outside [-10000, 10000] m/s"},
    {spoil_reflectors, PART_REFLECTORS, 2, "reflectors[0].points[0].ercs: -1 is outside [0, 1000]"},
    {spoil_sensors, PART_SENSORS, 3, "sensors.list: \"left\" stands twice"},
    {spoil_echoes, PART_ECHOES, 3, "echoes[3].range_m: -1 is outside [0, 1e6] m"},
    {repeat_echo, PART_ECHOES, 3,
     "echoes: sensor \"left\", object \"left\", reflector \"corner_rl\" stands twice"},
    {spoil_counts, PART_COUNTS, 3, "counts[0].pairs: -1 is outside [0, 1e12]"},
    {spoil_cells, PART_CELLS, 4, "cells[1].members[0].weight: 2 is outside [0, 1]"},
    {empty_cell, PART_CELLS, 4, "cells[0].members: empty; expected the leader"},
    {spoil_header, 0, 4, "interval_s: nan is outside [1e-9, 1e6] s"},
    {spoil_targets, PART_TARGETS, 5, "targets[0].contributors: empty; expected a label"},
};

/* The fault of the process that runs the chain. */
static const struct fault *planted;

static int plant(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)runner;
    planted->spoil(frame);
    return 0;
}

/* The chain, with a place for the fault's stage at each of its own. */
struct link {
    const char *name;
    size_t count;
    const char *words[2];
};

static const struct link links[] = {{"traffic", 1, {"two-vehicles"}},
                                    {"extract", 0, {0}},
                                    {"ideal", 2, {"--sensors", "srr24-pair-every-frame"}},
                                    {"sensor", 0, {0}},
                                    {"noise", 0, {0}}};

static int run_spoiled(const void *with)
{
    static const struct field no_fields[] = {{0}};
    planted = with;
    const struct stage spoiling = {.name = "spoiling",
                                   .options = STAGE_OPTIONS(int, no_fields),
                                   .reads = planted->part,
                                   .writes = planted->part,
                                   .step = plant};
    struct runner runners[COUNT(links) + 1], *next = runners;
    for (size_t i = 0; i <= COUNT(links); i++) {
        if (i == planted->place)
            runner_prepare(next++, &spoiling, 0, NULL);
        if (i < COUNT(links))
            runner_prepare(next++, stage_by_name(links[i].name), links[i].count, links[i].words);
    }
    int code = chain_run(runners, COUNT(runners));
    for (size_t i = 0; i < COUNT(runners); i++)
        runner_free(&runners[i]);
    return code;
}

TEST(a_fault_of_one_stage_is_told_in_its_name_whatever_stands_behind_it)
{
    for (size_t i = 0; i < COUNT(faults); i++) {
        static struct captured captured;
        char expected[256];
        capture(&captured, run_spoiled, &faults[i]);
        snprintf(
            expected, sizeof expected,
            "glint-spoiling: scene \"two-vehicles/ego\", frame 0: wrote an invalid frame: %s\n",
            faults[i].message);
        assert_string_equal(captured.err, expected);
        assert_int_equal(captured.code, DIAG_INTERNAL);
        assert_string_equal(captured.out, "");
    }
}
