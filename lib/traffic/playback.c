#include "traffic/playback.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "text/document.h"
#include "text/field_check.h"

static bool ends_with(const char *text, const char *outcome)
{
    size_t length = strlen(text), tail = strlen(outcome);
    return length >= tail && strcmp(text + length - tail, outcome) == 0;
}

const char *playback_name(const char *source, const char *ego, struct arena *arena)
{
    const char *slash = strrchr(source, '/');
    const char *base = slash != NULL ? slash + 1 : source;
    size_t length = strcmp(base, "-") == 0 ? 0 : strcspn(base, ".");
    if (length == 0) {
        base = "scene";
        length = strlen(base);
    }
    size_t size = length + strlen(ego) + 2;
    char *name = arena_get(arena, size);
    snprintf(name, size, "%.*s/%s", (int)length, base, ego);
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

static int open_scenario(struct playback *scene, const char *source, struct arena *arena,
                         struct diag *diag)
{
    struct scenario *scenario = scenario_load(source, arena, diag);
    if (scenario == NULL)
        return -1;
    if (scene->ego == NULL)
        scene->ego = scenario->ego;
    const struct actor *ego = find_actor(scenario, scene->ego);
    if (ego == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s: there is no object \"%s\" to be the ego", source,
                         scene->ego);
    double travelled_m;
    scene->origin_m = local_origin(scenario_motion(ego, 0, &travelled_m).position_m);
    scenario_shift(scenario, scene->origin_m);
    scene->scenario = scenario;
    scene->frames = scenario_frames(scenario);
    return 0;
}

static const struct recorded_state *find_state(const struct recorded_step *step, const char *id)
{
    for (size_t i = 0; i < step->count; i++)
        if (strcmp(step->states[i].id, id) == 0)
            return &step->states[i];
    return NULL;
}

static int open_table(struct playback *scene, const char *path, struct arena *arena,
                      struct diag *diag)
{
    struct trajectories table;
    if (scene->ego == NULL)
        return diag_fail(diag, DIAG_USAGE, "a trajectory table needs --ego ID");
    if (trajectory_read(path, arena, &table, diag) != 0)
        return diag_prefix(diag, "%s: ", path);
    if (!trajectory_has(&table, scene->ego))
        return diag_fail(diag, DIAG_DATA, "%s: there is no track \"%s\" to be the ego", path,
                         scene->ego);
    scene->steps = arena_get(arena, table.step_count * sizeof *scene->steps);
    for (size_t i = 0; i < table.step_count; i++)
        if (find_state(&table.steps[i], scene->ego) != NULL)
            scene->steps[scene->frames++] = &table.steps[i];
    const struct recorded_state *ego = find_state(scene->steps[0], scene->ego);
    scene->origin_m = local_origin((struct vec2){ego->x_m, ego->y_m});
    return 0;
}

/* The table of a bare name that is no scenario's; NULL if there is none. */
static const char *find_table(const char *name, struct arena *arena)
{
    struct diag no_scenario = {0}, no_table = {0};
    if (document_find("scenarios", name, ".json", arena, &no_scenario) != NULL)
        return NULL;
    return document_find("trajectories", name, ".csv", arena, &no_table);
}

int playback_open(struct playback *scene, const char *source, const char *ego, struct arena *arena,
                  struct diag *diag)
{
    *scene = (struct playback){.ego = ego};
    bool table = ends_with(source, ".csv") || ends_with(source, ".csv.gz");
    const char *path = table ? source : find_table(source, arena);
    return path != NULL ? open_table(scene, path, arena, diag)
                        : open_scenario(scene, source, arena, diag);
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

static void play(const struct scenario *scenario, int64_t number, struct frame *frame)
{
    frame->time_s = (double)number / scenario->rate_hz;
    frame->interval_s = 1 / scenario->rate_hz;
    frame->conditions = scenario->conditions;
    for (size_t i = 0; i < scenario->objects.count; i++)
        *list_add(&frame->objects, frame->arena) =
            object_of_actor(&scenario->objects.items[i], frame->time_s);
}

/* A recording of a single step tells no interval; a second is as good as any. */
static void replay(const struct recorded_step *step, struct vec2 origin_m, struct frame *frame)
{
    frame->time_s = (double)step->time_ms / 1000;
    frame->interval_s = step->interval_ms > 0 ? (double)step->interval_ms / 1000 : 1;
    for (size_t i = 0; i < step->count; i++)
        *list_add(&frame->objects, frame->arena) = object_of_state(&step->states[i], origin_m);
}

void playback_frame(const struct playback *scene, int64_t number, struct frame *frame)
{
    frame->origin_x_m = scene->origin_m.x;
    frame->origin_y_m = scene->origin_m.y;
    if (scene->scenario != NULL)
        play(scene->scenario, number, frame);
    else
        replay(scene->steps[number], scene->origin_m, frame);
}

static int refuse(const struct playback *scene, int64_t number, const char *id, struct diag *diag)
{
    if (scene->scenario == NULL)
        return diag_prefix(diag, "row %zu: ", find_state(scene->steps[number], id)->row);
    diag->code = DIAG_CONFIG;
    return diag_prefix(diag, "object \"%s\" in frame %lld: ", id, (long long)number);
}

int playback_check(const struct playback *scene, int64_t number, const struct frame *frame,
                   struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (field_check(&object_record, object, diag) != 0)
            return refuse(scene, number, object->id, diag);
    }
    return 0;
}
