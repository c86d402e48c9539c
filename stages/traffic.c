/* Traffic: plays a scenario document or a recorded trajectory table, frame by frame. */
#include <math.h>

#include "base/elementary.h"
#include "run/stage.h"
#include "traffic/playback.h"

struct traffic {
    const char *source;
    const char *ego;
    const char *scene;
    double radius_m;
    struct conditions conditions;
    struct playback playback;
    int64_t frame;
};

static int traffic_start(void *state, struct runner *runner)
{
    struct traffic *traffic = state;
    struct arena *arena = runner_arena(runner);
    if (playback_open(&traffic->playback, traffic->source, traffic->ego, arena,
                      runner_diag(runner)) != 0)
        return -1;
    if (traffic->scene == NULL)
        traffic->scene = playback_name(traffic->source, traffic->playback.ego, arena);
    runner_expect(runner, traffic->playback.frames);
    return 0;
}

/* Removes objects farther than radius_m from the ego. */
static void limit_radius(struct frame *frame, double radius_m)
{
    const struct object ego = *frame_object(frame, frame->ego);
    size_t kept = 0;
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (elementary_hypot(object->x_m - ego.x_m, object->y_m - ego.y_m) <= radius_m)
            frame->objects.items[kept++] = *object;
    }
    frame->objects.count = kept;
}

static int traffic_next(void *state, struct frame *frame, struct runner *runner)
{
    (void)runner;
    struct traffic *traffic = state;
    if (traffic->frame == traffic->playback.frames)
        return 0;
    playback_frame(&traffic->playback, traffic->frame, frame);
    conditions_change(&frame->conditions, &traffic->conditions);
    frame->scene = traffic->scene;
    frame->ego = traffic->playback.ego;
    frame->frame = traffic->frame++;
    frame->last = traffic->frame == traffic->playback.frames;
    if (traffic->radius_m >= 0)
        limit_radius(frame, traffic->radius_m);
    return 1;
}

static int traffic_locate_fault(void *state, const struct frame *frame, struct runner *runner)
{
    const struct traffic *traffic = state;
    if (playback_check(&traffic->playback, frame->frame, frame, runner_diag(runner)) != 0)
        return diag_prefix(runner_diag(runner), "%s: ", traffic->source);
    return 0;
}

static const struct field traffic_options[] = {
    {FIELD_NAME_OF(struct traffic, source,
                   "a scenario (a name in data/scenarios/, or a path), or a trajectory table")},
    {FIELD_NAME_OF(struct traffic, ego,
                   "the object that carries the sensors; a scenario names one, a table does not"),
     FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct traffic, scene, "name of the scene; absent: SOURCE/EGO"), FIELD_OPTIONAL},
    {FIELD_REAL_IN(struct traffic, radius_m, 0, 1e6,
                   "leave out objects farther than this from the ego"),
     FIELD_OPTIONAL, .absent = -1},
    {FIELD_RECORD_OF(struct traffic, conditions, &conditions_changes_record,
                     "over what the scenario says"),
     FIELD_OPTIONAL},
    {0},
};

static const struct record traffic_record = {
    .name = "traffic", .size = sizeof(struct traffic), .fields = traffic_options};

const struct stage stage_traffic = {
    .name = "traffic",
    .summary = "Play a scenario or a recorded trajectory table, frame by frame.",
    .details =
        "A scenario is a JSON document; a table is CSV in the columns of the INTERACTION\n"
        "data set (.csv or .csv.gz) and needs --ego. Coordinates beyond a kilometre are made\n"
        "relative to an origin near the ego, which every frame names.",
    .options = &traffic_record,
    .operand = "SOURCE",
    .writes = SECTION_OBJECTS,
    .start = traffic_start,
    .next = traffic_next,
    .locate_fault = traffic_locate_fault,
};
