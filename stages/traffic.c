/* Traffic: plays a scenario document or a recorded trajectory table, frame by frame. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document.h"
#include "stage.h"
#include "trajectory.h"
#include "units.h"

struct traffic {
    const char *source;
    const char *ego;
    const char *scene;
    double radius_m;
    struct scenario *scenario; /* or a table: */
    struct trajectories table;
    size_t first_step, end_step; /* in which the ego was recorded */
    struct vec2 origin_m;
    int64_t frame;
};

static bool ends_with(const char *text, const char *ending)
{
    size_t length = strlen(text), tail = strlen(ending);
    return length >= tail && strcmp(text + length - tail, ending) == 0;
}

/* "highway/ego" for data/highway.csv.gz: the source and the ego. */
static const char *scene_name(const struct traffic *traffic, struct arena *arena)
{
    const char *slash = strrchr(traffic->source, '/');
    const char *base = slash != NULL ? slash + 1 : traffic->source;
    size_t length = strcmp(base, "-") == 0 ? 0 : strcspn(base, ".");
    if (length == 0) {
        base = "scene";
        length = strlen(base);
    }
    size_t size = length + strlen(traffic->ego) + 2;
    char *name = arena_get(arena, size);
    snprintf(name, size, "%.*s/%s", (int)length, base, traffic->ego);
    return name;
}

/* Coordinates beyond a kilometre (UTM, say) get an origin in whole metres near the ego. */
static struct vec2 local_origin(struct vec2 ego_m)
{
    bool near = fabs(ego_m.x) <= 1000 && fabs(ego_m.y) <= 1000;
    return near ? (struct vec2){0, 0} : (struct vec2){round(ego_m.x), round(ego_m.y)};
}

static const struct actor *find_actor(const struct scenario *scenario, const char *id)
{
    for (size_t i = 0; i < scenario->objects.count; i++)
        if (strcmp(scenario->objects.items[i].id, id) == 0)
            return &scenario->objects.items[i];
    return NULL;
}

static int start_scenario(struct traffic *traffic, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    struct scenario *scenario = catalogue_scenario(traffic->source, arena, diag);
    if (scenario == NULL)
        return -1;
    if (traffic->ego == NULL)
        traffic->ego = scenario->ego;
    const struct actor *ego = find_actor(scenario, traffic->ego);
    if (ego == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s: there is no object \"%s\" to be the ego",
                         traffic->source, traffic->ego);
    double travelled_m;
    traffic->origin_m = local_origin(scenario_motion(ego, 0, &travelled_m).position_m);
    scenario_shift(scenario, traffic->origin_m);
    traffic->scenario = scenario;
    runner_expect(runner, scenario_frames(scenario));
    return 0;
}

static const struct recorded_state *find_state(const struct recorded_step *step, const char *id)
{
    for (size_t i = 0; i < step->count; i++)
        if (strcmp(step->states[i].id, id) == 0)
            return &step->states[i];
    return NULL;
}

static int start_table(struct traffic *traffic, struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    if (traffic->ego == NULL)
        return diag_fail(diag, DIAG_USAGE, "a trajectory table needs --ego ID");
    if (trajectory_read(traffic->source, runner_arena(runner), &traffic->table, diag) != 0)
        return diag_prefix(diag, "%s: ", traffic->source);
    if (!trajectory_has(&traffic->table, traffic->ego))
        return diag_fail(diag, DIAG_DATA, "%s: there is no track \"%s\" to be the ego",
                         traffic->source, traffic->ego);
    const struct recorded_step *steps = traffic->table.steps;
    while (find_state(&steps[traffic->first_step], traffic->ego) == NULL)
        traffic->first_step++;
    for (size_t i = traffic->first_step; i < traffic->table.step_count; i++)
        if (find_state(&steps[i], traffic->ego) != NULL)
            traffic->end_step = i + 1;
    const struct recorded_state *ego = find_state(&steps[traffic->first_step], traffic->ego);
    traffic->origin_m = local_origin((struct vec2){ego->x_m, ego->y_m});
    runner_expect(runner, (int64_t)(traffic->end_step - traffic->first_step));
    return 0;
}

/* A table by its ending, or a bare name that is no scenario's but a table's. */
static bool find_table(struct traffic *traffic, struct arena *arena)
{
    const char *name = traffic->source;
    if (ends_with(name, ".csv") || ends_with(name, ".csv.gz"))
        return true;
    struct diag ignored[2] = {{0}};
    const char *table = document_find("trajectories", name, ".csv", arena, &ignored[0]);
    if (table == NULL || !ends_with(table, ".csv") ||
        document_find("scenarios", name, ".json", arena, &ignored[1]) != NULL)
        return false;
    traffic->source = table;
    return true;
}

static int traffic_start(void *state, struct runner *runner)
{
    struct traffic *traffic = state;
    bool table = find_table(traffic, runner_arena(runner));
    if ((table ? start_table : start_scenario)(traffic, runner) != 0)
        return -1;
    if (traffic->scene == NULL)
        traffic->scene = scene_name(traffic, runner_arena(runner));
    return 0;
}

static struct object object_of_actor(const struct actor *actor, double time_s)
{
    double travelled_m;
    struct motion motion = scenario_motion(actor, time_s, &travelled_m);
    return (struct object){
        .id = actor->id,
        .class = actor->class,
        .x_m = motion.position_m.x,
        .y_m = motion.position_m.y,
        .yaw_rad = units_wrap_rad(motion.yaw_rad),
        .vx_mps = motion.velocity_mps.x,
        .vy_mps = motion.velocity_mps.y,
        .yaw_rate_radps = motion.yaw_rate_radps,
        .length_m = actor->length_m,
        .width_m = actor->width_m,
        .height_m = actor->height_m,
        .travelled_m = travelled_m,
    };
}

static struct object object_of_state(const struct recorded_state *state, struct vec2 origin_m)
{
    return (struct object){
        .id = state->id,
        .class = state->class,
        .x_m = state->x_m - origin_m.x,
        .y_m = state->y_m - origin_m.y,
        .yaw_rad = state->yaw_rad,
        .vx_mps = state->vx_mps,
        .vy_mps = state->vy_mps,
        .yaw_rate_radps = state->yaw_rate_radps,
        .length_m = state->length_m,
        .width_m = state->width_m,
        .travelled_m = state->travelled_m,
    };
}

static int next_of_scenario(const struct traffic *traffic, struct frame *frame)
{
    const struct scenario *scenario = traffic->scenario;
    int64_t frames = scenario_frames(scenario);
    if (traffic->frame == frames)
        return 0;
    frame->time_s = (double)traffic->frame / scenario->rate_hz;
    frame->interval_s = 1 / scenario->rate_hz;
    frame->last = traffic->frame == frames - 1;
    for (size_t i = 0; i < scenario->objects.count; i++)
        *list_add(&frame->objects, frame->arena) =
            object_of_actor(&scenario->objects.items[i], frame->time_s);
    return 1;
}

static int next_of_table(struct traffic *traffic, struct frame *frame)
{
    const struct recorded_step *step = NULL;
    while (step == NULL && traffic->first_step < traffic->end_step) {
        step = &traffic->table.steps[traffic->first_step++];
        if (find_state(step, traffic->ego) == NULL)
            step = NULL;
    }
    if (step == NULL)
        return 0;
    frame->time_s = (double)step->time_ms / 1000;
    frame->interval_s = step->interval_ms > 0 ? (double)step->interval_ms / 1000 : 1;
    frame->last = traffic->first_step == traffic->end_step;
    for (size_t i = 0; i < step->count; i++)
        *list_add(&frame->objects, frame->arena) =
            object_of_state(&step->states[i], traffic->origin_m);
    return 1;
}

/* Only what lies within radius_m of the ego. */
static void limit_radius(struct frame *frame, double radius_m)
{
    const struct object ego = *frame_object(frame, frame->ego);
    size_t kept = 0;
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (hypot(object->x_m - ego.x_m, object->y_m - ego.y_m) <= radius_m)
            frame->objects.items[kept++] = *object;
    }
    frame->objects.count = kept;
}

static int traffic_next(void *state, struct frame *frame, struct runner *runner)
{
    (void)runner;
    struct traffic *traffic = state;
    int more = traffic->scenario != NULL ? next_of_scenario(traffic, frame)
                                         : next_of_table(traffic, frame);
    if (more == 0)
        return 0;
    frame->scene = traffic->scene;
    frame->frame = traffic->frame++;
    frame->ego = traffic->ego;
    frame->origin_x_m = traffic->origin_m.x;
    frame->origin_y_m = traffic->origin_m.y;
    if (traffic->radius_m > 0)
        limit_radius(frame, traffic->radius_m);
    return 1;
}

static const struct field traffic_options[] = {
    {FIELD_NAME_OF(struct traffic,                                                source,
     "a scenario (a name in data/scenarios/, or a path), or a trajectory table")},
    {FIELD_NAME_OF(struct traffic, ego, "the object that carries the sensors"), FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct traffic,                                                scene, "name of the scene instead of SOURCE/EGO"),
     FIELD_OPTIONAL},
    {FIELD_REAL_IN(struct traffic,                                     radius_m, 0, 1e6,
     "leave out what is farther from the ego; 0: nothing"),
     FIELD_OPTIONAL},
    {0                                                                          },
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
};
