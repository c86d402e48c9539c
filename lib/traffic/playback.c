#include "traffic/playback.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "text/document.h"
#include "text/field_check.h"

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

int playback_open(struct playback *playback, const char *source, const char *ego,
                  struct arena *arena, struct diag *diag)
{
    *playback = (struct playback){.ego = ego};
    struct scenario *scenario = scenario_load(source, arena, diag);
    if (scenario == NULL)
        return -1;
    if (playback->ego == NULL)
        playback->ego = scenario->ego;
    const struct actor *carrier = find_actor(scenario, playback->ego);
    if (carrier == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s: ego: \"%s\" is not the id of an object", source,
                         playback->ego);
    double travelled_m;
    playback->origin_m = local_origin(scenario_motion(carrier, 0, &travelled_m).position_m);
    scenario_shift(scenario, playback->origin_m);
    playback->scenario = scenario;
    playback->frames = scenario_frames(scenario);
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

void playback_frame(const struct playback *playback, int64_t number, struct frame *frame)
{
    const struct scenario *scenario = playback->scenario;
    frame->origin_x_m = playback->origin_m.x;
    frame->origin_y_m = playback->origin_m.y;
    frame->time_s = (double)number / scenario->rate_hz;
    frame->interval_s = 1 / scenario->rate_hz;
    frame->conditions = scenario->conditions;
    for (size_t i = 0; i < scenario->objects.count; i++)
        *list_add(&frame->objects, frame->arena) =
            object_of_actor(&scenario->objects.items[i], frame->time_s);
}

int playback_check(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (field_check(&object_record, object, diag) == 0)
            continue;
        diag->code = DIAG_CONFIG;
        return diag_prefix(diag, "object \"%s\" in frame %lld: ", object->id,
                           (long long)frame->frame);
    }
    return 0;
}
