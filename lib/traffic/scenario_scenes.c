#include "traffic/scenario_scenes.h"

#include <inttypes.h>
#include <math.h>

enum { SCENES = 1000000000 };

/* Reads the whole number of a scene, which is below SCENES or is SCENES. */
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

static int begin_scene(struct scenario_scenes *scenes, uint64_t seed, struct diag *diag)
{
    struct arena *arena = &scenes->arena;
    arena_clear(arena);
    scenes->scenario =
        scenario_draw(&scenes->document, seed, scenes->number, scenes->ego, arena, diag);
    if (scenes->scenario == NULL)
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

int scenario_scenes_next(struct scenario_scenes *scenes, struct frame *frame, struct diag *diag)
{
    if (scenes->scenario == NULL) {
        if (scenes->number == scenes->end)
            return 0;
        if (begin_scene(scenes, frame->seed, diag) != 0)
            return -1;
    }
    scenario_fill(scenes->scenario, scenes->frame, frame);
    frame->scene = scenes->scene;
    frame->ego = scenes->scenario->ego;
    frame->frame = scenes->frame++;
    frame->last = scenes->frame == scenes->frames;
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
