#include "traffic/playback.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "text/document.h"
#include "text/field_check.h"

/* A frame stands for at most 1e6 s. */
#define MOST_INTERVAL_MS 1000000000LL

static bool ends_with(const char *text, const char *suffix)
{
    size_t length = strlen(text), tail = strlen(suffix);
    return length >= tail && strcmp(text + length - tail, suffix) == 0;
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

/* The origin of the frames' coordinates: in whole metres near the ego if it is more than a
 * kilometre away (as in UTM), else that of the source. */
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

static int open_scenario(struct playback *playback, const char *source, struct arena *arena,
                         struct diag *diag)
{
    struct scenario *scenario = scenario_load(source, arena, diag);
    if (scenario == NULL)
        return -1;
    if (playback->ego == NULL)
        playback->ego = scenario->ego;
    const struct actor *ego = find_actor(scenario, playback->ego);
    if (ego == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s: ego: \"%s\" is not the id of an object", source,
                         playback->ego);
    double travelled_m;
    playback->origin_m = local_origin(scenario_motion(ego, 0, &travelled_m).position_m);
    scenario_shift(scenario, playback->origin_m);
    playback->scenario = scenario;
    playback->frames = scenario_frames(scenario);
    return 0;
}

static const struct recorded_state *find_state(const struct recorded_step *step, const char *id)
{
    for (size_t i = 0; i < step->count; i++)
        if (strcmp(step->states[i].id, id) == 0)
            return &step->states[i];
    return NULL;
}

static int open_table(struct playback *playback, const char *path, struct arena *arena,
                      struct diag *diag)
{
    struct trajectories table;
    if (playback->ego == NULL)
        return diag_fail(diag, DIAG_USAGE,
                         "%s: a trajectory table has no ego of its own; expected --ego TRACK_ID",
                         path);
    if (trajectory_read(path, arena, &table, diag) != 0)
        return diag_prefix(diag, "%s: ", path);
    if (!trajectory_has(&table, playback->ego))
        return diag_fail(diag, DIAG_DATA, "%s: ego: \"%s\" is not the track_id of a row", path,
                         playback->ego);
    playback->steps = arena_get(arena, table.step_count * sizeof *playback->steps);
    for (size_t i = 0; i < table.step_count; i++) {
        const struct recorded_state *state = find_state(&table.steps[i], playback->ego);
        if (state == NULL)
            continue;
        if (table.steps[i].interval_ms > MOST_INTERVAL_MS)
            return diag_fail(diag, DIAG_DATA,
                             "%s: row %zu, column \"timestamp_ms\": %lld ms between two steps; "
                             "expected at most %lld",
                             path, state->row, (long long)table.steps[i].interval_ms,
                             MOST_INTERVAL_MS);
        playback->steps[playback->frames++] = &table.steps[i];
    }
    const struct recorded_state *ego = find_state(playback->steps[0], playback->ego);
    playback->origin_m = local_origin((struct vec2){ego->x_m, ego->y_m});
    return 0;
}

/* The path of the table with a name that no scenario has; NULL if there is none. */
static const char *find_table(const char *name, struct arena *arena)
{
    struct diag no_scenario = {0}, no_table = {0};
    if (document_find("scenarios", name, ".json", arena, &no_scenario) != NULL)
        return NULL;
    return document_find("trajectories", name, ".csv", arena, &no_table);
}

int playback_open(struct playback *playback, const char *source, const char *ego,
                  struct arena *arena, struct diag *diag)
{
    *playback = (struct playback){.ego = ego};
    bool table = ends_with(source, ".csv") || ends_with(source, ".csv.gz");
    const char *path = table ? source : find_table(source, arena);
    return path != NULL ? open_table(playback, path, arena, diag)
                        : open_scenario(playback, source, arena, diag);
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

/* A recording of a single step has no interval; any value will do, so it is 1 s. */
static void replay(const struct recorded_step *step, struct vec2 origin_m, struct frame *frame)
{
    frame->time_s = (double)step->time_ms / 1000;
    frame->interval_s = step->interval_ms > 0 ? (double)step->interval_ms / 1000 : 1;
    for (size_t i = 0; i < step->count; i++)
        *list_add(&frame->objects, frame->arena) = object_of_state(&step->states[i], origin_m);
}

void playback_frame(const struct playback *playback, int64_t number, struct frame *frame)
{
    frame->origin_x_m = playback->origin_m.x;
    frame->origin_y_m = playback->origin_m.y;
    if (playback->scenario != NULL)
        play(playback->scenario, number, frame);
    else
        replay(playback->steps[number], playback->origin_m, frame);
}

static int refuse(const struct playback *playback, int64_t number, const char *id,
                  struct diag *diag)
{
    if (playback->scenario == NULL)
        return diag_prefix(diag, "row %zu: ", find_state(playback->steps[number], id)->row);
    diag->code = DIAG_CONFIG;
    return diag_prefix(diag, "object \"%s\" in frame %lld: ", id, (long long)number);
}

int playback_check(const struct playback *playback, int64_t number, const struct frame *frame,
                   struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (field_check(&object_record, object, diag) != 0)
            return refuse(playback, number, object->id, diag);
    }
    return 0;
}
