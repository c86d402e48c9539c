/* Random traffic: independent snapshots, each a scene of one frame, or moving scenes of some
 * seconds. */
#include <inttypes.h>

#include "base/elementary.h"
#include "documents/vehicle.h"
#include "run/stage.h"
#include "traffic/random_traffic.h"
#include "traffic/scenario_scenes.h"

#define RADIUS_M 250.0

struct traffic_random {
    int density;
    int64_t frames, first; /* -1: not given */
    double rate_hz, seconds;
    const char *scene, *scenes;
    bool draw_conditions, roadside;
    struct random_traffic snapshot;
    int64_t made;
    struct scenario_scenes moving; /* with --seconds */
};

static const char *const densities[] = {"sparse", "medium", "dense", NULL};

/* Moving scenes are scenes of a scenario with roads whose values are all drawn. */
static int start_moving(struct traffic_random *traffic, const char *name, struct runner *runner)
{
    static const double flows[] = {
        [TRAFFIC_SPARSE] = 0.3, [TRAFFIC_MEDIUM] = 1, [TRAFFIC_DENSE] = 2};
    struct scenario_scenes *moving = &traffic->moving;
    struct diag *diag = runner_diag(runner);
    if (traffic->frames >= 0 || traffic->first >= 0)
        return diag_fail(diag, DIAG_USAGE,
                         "--%s: is for snapshots; with --seconds, choose scenes by --scenes A:B",
                         traffic->frames >= 0 ? "frames" : "first");
    *moving = (struct scenario_scenes){
        .name = name,
        .radius_m = RADIUS_M,
        .flow = flows[traffic->density],
        .rate_hz = traffic->rate_hz,
        .duration_s =
            elementary_max(0, round(traffic->seconds * traffic->rate_hz) - 1) / traffic->rate_hz};
    if (scenario_scenes_choose(moving, traffic->scenes != NULL ? traffic->scenes : "0:10", diag) !=
        0)
        return -1;
    return scenario_read("random-roads", &moving->document, runner_arena(runner), diag);
}

static int traffic_random_start(void *state, struct runner *runner)
{
    struct traffic_random *traffic = state;
    const char *name =
        arena_format(runner_arena(runner), "%s-%s", traffic->seconds > 0 ? "moving" : "random",
                     densities[traffic->density]);
    traffic->scene = traffic->scene != NULL ? traffic->scene : name;
    if (traffic->seconds > 0)
        return start_moving(traffic, name, runner);
    if (traffic->scenes != NULL)
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--scenes: is for moving scenes (--seconds); choose snapshots by --first "
                         "and --frames");
    traffic->frames = traffic->frames >= 0 ? traffic->frames : 100;
    traffic->first = traffic->first >= 0 ? traffic->first : 0;
    struct random_traffic *snapshot = &traffic->snapshot;
    snapshot->density = &random_traffic_densities[traffic->density];
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++) {
        const struct vehicle *vehicle =
            runner_vehicle(runner, NULL, random_traffic_class_name(class), NULL);
        if (vehicle == NULL)
            return -1;
        snapshot->models[class] = (struct random_traffic_model){vehicle->length_m, vehicle->width_m,
                                                                &vehicle->reflectors};
    }
    runner_expect(runner, traffic->frames);
    return 0;
}

/* The road and the weather hold for the whole scene; other radars would come and go with their
 * vehicles, so there are none. */
static int next_moving(struct traffic_random *traffic, struct frame *frame, struct runner *runner)
{
    struct scenario_scenes *moving = &traffic->moving;
    moving->title = arena_format(frame->arena, "%s/%" PRIu64, traffic->scene, frame->seed);
    int more = scenario_scenes_next(moving, frame, runner_diag(runner));
    if (more != 1)
        return more;
    runner_expect(runner, scenario_scenes_frames(moving));
    if (traffic->draw_conditions)
        random_traffic_conditions(moving->draws, frame);
    frame->conditions.interferers.count = 0;
    if (!traffic->roadside)
        frame->roadside.count = 0;
    return 1;
}

static int traffic_random_next(void *state, struct frame *frame, struct runner *runner)
{
    struct traffic_random *traffic = state;
    if (traffic->seconds > 0)
        return next_moving(traffic, frame, runner);
    if (traffic->made == traffic->frames)
        return 0;
    int64_t number = traffic->first + traffic->made++;
    frame->scene =
        arena_format(frame->arena, "%s/%" PRIu64 "/%" PRId64, traffic->scene, frame->seed, number);
    frame->time_s = (double)number / traffic->rate_hz;
    frame->interval_s = 1 / traffic->rate_hz;
    frame->last = true;
    random_traffic_fill(&traffic->snapshot, number, frame);
    struct random_address address = random_traffic_address(&traffic->snapshot, frame->seed, number);
    if (traffic->draw_conditions)
        random_traffic_conditions(address, frame);
    if (traffic->roadside)
        random_traffic_roadside(address, frame);
    return 1;
}

static int traffic_random_locate_fault(void *state, const struct frame *frame,
                                       struct runner *runner)
{
    const struct traffic_random *traffic = state;
    return traffic->seconds > 0 ? scenario_check_frame(frame, runner_diag(runner)) : 0;
}

static void traffic_random_release(void *state)
{
    struct traffic_random *traffic = state;
    scenario_scenes_close(&traffic->moving);
}

static const struct field traffic_random_options[] = {
    {OPTIONAL_CHOICE(struct traffic_random, density, densities,
                     "number and distance of objects; absent: medium"),
     .absent = TRAFFIC_MEDIUM},
    {OPTIONAL_INTEGER(struct traffic_random, frames, 0, 1e9, "number of snapshots; absent: 100"),
     .absent = -1},
    {OPTIONAL_INTEGER(struct traffic_random, first, 0, 1e9,
                      "number of the first snapshot; absent: 0"),
     .absent = -1},
    {OPTIONAL_REAL(struct traffic_random, seconds, 1e-4, 1e5,
                   "make moving scenes of this length in place of snapshots")},
    {OPTIONAL_NAME(struct traffic_random, scene,
                   "first part of scene names; absent: moving-DENSITY or random-DENSITY")},
    {OPTIONAL_NAME(struct traffic_random, scenes, "make moving scenes A to B - 1; absent: 0:10"),
     .word = "A:B"},
    {OPTIONAL_REAL(struct traffic_random, rate_hz, 1, 1e4,
                   "frame number n is at time n / rate; absent: 20 Hz"),
     .absent = 20},
    {OPTIONAL_FLAG(struct traffic_random, draw_conditions,
                   "also draw road, weather and, in snapshots, other radars")},
    {OPTIONAL_FLAG(struct traffic_random, roadside,
                   "also draw rails, poles, kerbs and vegetation beside the road")},
    {0},
};

const struct stage stage_traffic_random = {
    .name = "traffic-random",
    .summary = "Make random traffic: independent snapshots, or moving scenes.",
    .details =
        "A snapshot is a scene of one frame, with objects of all classes around an ego: 0 to 3\n"
        "within 120 m (sparse), 0 to 8 within 60 m (medium, the default), 4 to 15 within 25 m\n"
        "(dense). It depends only on seed, density and its number, so --first and --frames may\n"
        "split a set anywhere.\n"
        "\n"
        "With --seconds, vehicles drive without collisions on scenarios/random-roads.json. Their\n"
        "flows are those of that file (medium), 0.3 times these (sparse) or twice (dense). A "
        "scene\n"
        "has the objects within 250 m of the ego, and ends early if the ego leaves its road.",
    .options = STAGE_OPTIONS(struct traffic_random, traffic_random_options),
    .writes = PART_OBJECTS,
    .start = traffic_random_start,
    .next = traffic_random_next,
    .locate_fault = traffic_random_locate_fault,
    .release = traffic_random_release,
};
