#include "traffic/scenario_scenes.h"

#include <inttypes.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "frame/frame.h"

enum { SCENES = 1000000000 };

/* Reads the number of a scene, a whole number from 0 to SCENES. */
static bool read_number(const char *text, size_t length, int64_t *number)
{
    double value;
    if (field_read_number(text, length, &value) != 0 || !(value >= 0 && value <= SCENES) ||
        value != floor(value))
        return false;
    *number = (int64_t)value;
    return true;
}

int scenario_scenes_choose(struct scenario_scenes *scenes, const char *range, struct diag *diag)
{
    const char *colon = range != NULL ? strchr(range, ':') : NULL;
    scenes->numbered = range != NULL;
    scenes->first = 0;
    scenes->end = 1;
    if (range != NULL &&
        !(colon != NULL && read_number(range, (size_t)(colon - range), &scenes->first) &&
          read_number(colon + 1, strlen(colon + 1), &scenes->end) && scenes->first < scenes->end))
        return diag_fail(diag, DIAG_USAGE,
                         "--scenes: \"%s\"; expected A:B, for scenes A to B - 1, 0 <= A < B <= %d",
                         range, SCENES);
    scenes->number = scenes->first;
    return 0;
}

/* Sets rate, duration and flow that the scenes replace. */
static void change_scenario(const struct scenario_scenes *scenes)
{
    struct scenario *scenario = scenes->scenario;
    if (scenes->rate_hz > 0) {
        scenario->rate_hz = scenes->rate_hz;
        scenario->duration_s = scenes->duration_s;
    }
    for (size_t i = 0; i < scenario->roads.count; i++)
        road_scale_flow(&scenario->roads.items[i], scenes->flow);
}

/* Fills the roads of the scene, and checks that its ego is there. */
static int begin_roads(struct scenario_scenes *scenes, struct diag *diag)
{
    const struct scenario *scenario = scenes->scenario;
    int result = road_traffic_begin(&scenes->roads, scenario->roads.items, scenario->roads.count,
                                    scenario->warmup_s, scenario->arriving_ego, scenes->draws,
                                    &scenes->arena, diag);
    scenes->on_road = scenario_object(scenario, scenario->ego) == NULL;
    if (result == 0 && scenes->on_road && !road_traffic_has(&scenes->roads, scenario->ego))
        result = diag_fail(diag, scenes->ego != NULL ? DIAG_USAGE : DIAG_CONFIG,
                           "%s: \"%s\" is neither an object nor on a road at time 0",
                           scenes->ego != NULL ? "--ego" : "ego", scenario->ego);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", scenes->document.path);
}

static int begin_scene(struct scenario_scenes *scenes, uint64_t seed, struct diag *diag)
{
    struct arena *arena = &scenes->arena;
    arena_clear(arena);
    const char *place = arena_format(arena, "%s/%" PRId64, scenes->name, scenes->number);
    scenes->draws = (struct random_address){.seed = seed, .scene = hash_text(HASH_START, place)};
    scenes->scenario = scenario_draw(&scenes->document, scenes->draws, scenes->ego, arena, diag);
    if (scenes->scenario != NULL)
        change_scenario(scenes);
    if (scenes->scenario == NULL || begin_roads(scenes, diag) != 0)
        return scenes->numbered ? diag_prefix(diag, "scene %" PRId64 ": ", scenes->number) : -1;
    scenes->scene = scenes->title != NULL
                        ? scenes->title
                        : arena_format(arena, "%s/%s", scenes->name, scenes->scenario->ego);
    if (scenes->numbered)
        scenes->scene = arena_format(arena, "%s/%" PRId64, scenes->scene, scenes->number);
    scenes->frame = 0;
    scenes->frames = scenario_frames(scenes->scenario);
    return 0;
}

/* Advances the roads to the next frame. False if there is none, or if the ego has left. */
static bool goes_on(struct scenario_scenes *scenes)
{
    const struct scenario *scenario = scenes->scenario;
    if (scenes->frame == scenes->frames)
        return false;
    road_traffic_advance(&scenes->roads, scenario_time_s(scenario, scenes->frame));
    return !scenes->on_road || road_traffic_has(&scenes->roads, scenario->ego);
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

int scenario_scenes_next(struct scenario_scenes *scenes, struct frame *frame, struct diag *diag)
{
    if (scenes->scenario == NULL) {
        if (scenes->number == scenes->end)
            return 0;
        if (begin_scene(scenes, frame->seed, diag) != 0)
            return -1;
    }
    scenario_fill(scenes->scenario, scenes->frame, frame);
    road_traffic_fill(&scenes->roads, frame);
    frame->scene = scenes->scene;
    frame->ego = scenes->scenario->ego;
    if (scenes->radius_m >= 0)
        limit_radius(frame, scenes->radius_m);
    frame->frame = scenes->frame++;
    frame->last = !goes_on(scenes);
    if (frame->last) {
        scenes->scenario = NULL;
        scenes->number++;
    }
    return 1;
}

int64_t scenario_scenes_frames(const struct scenario_scenes *scenes)
{
    return scenes->frames * (scenes->end - scenes->first);
}

void scenario_scenes_close(struct scenario_scenes *scenes)
{
    arena_free(&scenes->arena);
}
