#include "traffic/scenario.h"

#include "base/elementary.h"
#include "base/intern.h"
#include "documents/vehicle.h"
#include "frame/frame_check.h"
#include "text/document.h"
#include "text/record_write.h"
#include "text/variation.h"

static const struct field scenario_fields[] = {
    {FIELD_NAME_OF(struct scenario, origin, "who made this, and from what")},
    {FIELD_NAME_OF(struct scenario, ego, "id of the object that carries the sensors")},
    {FIELD_REAL_IN(struct scenario, rate_hz, 0.1, 1e4, "frames in a second")},
    {FIELD_REAL_IN(struct scenario, duration_s, 0, 1e6, "the last frame is not later")},
    {OPTIONAL_RECORD(struct scenario, conditions, &conditions_record, "road and weather")},
    {OPTIONAL_LIST(struct scenario, roadside, &roadside_strip_record,
                   "what stands still beside the road and is no object")},
    {FIELD_LIST_OF(struct scenario, objects, &actor_record,
                   "all objects, the ego too unless it is one of roads")},
    {OPTIONAL_LIST(struct scenario, roads, &roadway_record,
                   "traffic that comes and goes by itself")},
    {OPTIONAL_REAL(struct scenario, warmup_s, 0, 3600,
                   "how long roads fill before time 0; absent: 60 s"),
     .absent = 60},
    {0},
};

const struct record scenario_record = {
    FIELD_TABLE(struct scenario, scenario_fields, "scenario", "Objects and how each one moves.")};

/* Adds the ids to names; the number of an id is then that of its object. */
static int check_ids(const struct scenario *scenario, struct intern *names, struct arena *arena,
                     struct diag *diag)
{
    const struct actor *actors = scenario->objects.items;
    for (size_t i = 0; i < scenario->objects.count; i++) {
        uint32_t number = intern_word(names, actors[i].id, arena);
        if (number < i)
            return diag_fail(diag, DIAG_CONFIG,
                             "objects[%zu].id: \"%s\" is the id of objects[%u] already", i,
                             actors[i].id, (unsigned)number);
        if (vehicle_check_class(actors[i].class, diag) != 0)
            return diag_prefix(diag, "objects[%zu].class: ", i);
        if (actor_check(&actors[i], diag) != 0)
            return diag_prefix(diag, "objects[%zu].", i);
    }
    return 0;
}

static int check_names(const struct scenario *scenario, struct arena *arena, struct diag *diag)
{
    size_t count = scenario->objects.count;
    struct intern names = intern_begin(count, arena);
    if (check_ids(scenario, &names, arena, diag) != 0)
        return -1;
    for (size_t i = 0; i < scenario->conditions.interferers.count; i++) {
        const char *id = scenario->conditions.interferers.items[i].object;
        if (intern_word(&names, id, arena) >= count)
            return diag_fail(
                diag, DIAG_CONFIG,
                "conditions.interferers[%zu].object: \"%s\" is not the id of an object", i, id);
    }
    bool scripted = intern_word(&names, scenario->ego, arena) < count;
    if (scripted && scenario->arriving_ego != NULL)
        return diag_fail(diag, DIAG_CONFIG,
                         "ego: \"%s\" is an object; expected another id, as arrivals have ego_m",
                         scenario->ego);
    return scripted || scenario->roads.count > 0
               ? 0
               : diag_fail(diag, DIAG_CONFIG, "ego: \"%s\" is not the id of an object",
                           scenario->ego);
}

/* Refuses a road with the id of another, or whose vehicles could have that of an object. */
static int check_road_id(const struct scenario *scenario, size_t number, struct diag *diag)
{
    const char *id = scenario->roads.items[number].id;
    size_t length = strlen(id);
    for (size_t i = 0; i < number; i++)
        if (strcmp(scenario->roads.items[i].id, id) == 0)
            return diag_fail(diag, DIAG_CONFIG, "id: \"%s\" is the id of roads[%zu] already", id,
                             i);
    for (size_t i = 0; i < scenario->objects.count; i++)
        if (strncmp(scenario->objects.items[i].id, id, length) == 0 &&
            scenario->objects.items[i].id[length] == '.')
            return diag_fail(
                diag, DIAG_CONFIG,
                "id: objects[%zu].id, \"%s\", begins like the ids of this road's vehicles", i,
                scenario->objects.items[i].id);
    return 0;
}

static int check_roads(struct scenario *scenario, struct diag *diag)
{
    int egos = 0;
    for (size_t i = 0; i < scenario->roads.count; i++)
        if (check_road_id(scenario, i, diag) != 0 ||
            road_check(&scenario->roads.items[i], &egos, diag) != 0)
            return diag_prefix(diag, "roads[%zu].", i);
    scenario->arriving_ego = egos > 0 ? scenario->ego : NULL;
    return egos <= 1 ? 0
                     : diag_fail(diag, DIAG_CONFIG,
                                 "roads: %d arrivals have ego_m; expected one or none", egos);
}

int scenario_check(struct scenario *scenario, struct diag *diag)
{
    struct arena arena = {0};
    int result = check_roads(scenario, diag) == 0 ? check_names(scenario, &arena, diag) : -1;
    arena_free(&arena);
    return result;
}

void scenario_shift(struct scenario *scenario, struct vec2 origin_m)
{
    for (size_t i = 0; i < scenario->roadside.count; i++)
        roadside_shift(&scenario->roadside.items[i], vec2_scale(-1, origin_m));
    for (size_t i = 0; i < scenario->objects.count; i++)
        actor_shift(&scenario->objects.items[i], origin_m);
    for (size_t i = 0; i < scenario->roads.count; i++)
        road_shift(&scenario->roads.items[i], origin_m);
}

/* The factor covers durations that are meant to be n / rate_hz but are a few ulp shorter. */
int64_t scenario_frames(const struct scenario *scenario)
{
    return (int64_t)floor(scenario->duration_s * scenario->rate_hz * (1 + 1e-15)) + 1;
}

double scenario_time_s(const struct scenario *scenario, int64_t number)
{
    return (double)number / scenario->rate_hz;
}

const struct actor *scenario_object(const struct scenario *scenario, const char *id)
{
    for (size_t i = 0; i < scenario->objects.count; i++)
        if (strcmp(scenario->objects.items[i].id, id) == 0)
            return &scenario->objects.items[i];
    return NULL;
}

int scenario_read(const char *name, struct scenario_document *document, struct arena *arena,
                  struct diag *diag)
{
    struct text bytes = {0};
    document->path = document_find(NULL, "scenarios", name, ".json", arena, diag);
    document->line = NULL;
    if (document->path != NULL && document_bytes(document->path, &bytes, diag) == 0)
        document->line = document_line(document->path, &bytes, "scenario", arena, diag);
    text_free(&bytes);
    return document->line != NULL ? 0 : -1;
}

/* The nearest whole metre within the bounds of places, which the centre of a body may exceed. */
static double origin_near(double place_m)
{
    const double most_m = 1e9;
    return fabs(place_m) < most_m ? round(place_m) + 0.0 : copysign(most_m, place_m); /* no -0 */
}

struct vec2 scenario_frame_origin(struct vec2 ego_m)
{
    bool near = fabs(ego_m.x) <= 1000 && fabs(ego_m.y) <= 1000;
    return near ? (struct vec2){0, 0} : (struct vec2){origin_near(ego_m.x), origin_near(ego_m.y)};
}

/* Where the ego is at time 0 if it is an object, else where the first road begins. */
static struct vec2 ego_place(const struct scenario *scenario)
{
    const struct actor *actor = scenario_object(scenario, scenario->ego);
    if (actor != NULL)
        return actor_start(actor);
    if (scenario->roads.count == 0)
        return (struct vec2){0, 0};
    const struct road_point *point = scenario->roads.items[0].points.items;
    return (struct vec2){point->x_m, point->y_m};
}

/* Refuses strips that the shift has moved out of the bounds of places. */
static int check_strips(const struct scenario *scenario, struct diag *diag)
{
    for (size_t i = 0; i < scenario->roadside.count; i++)
        if (record_write_check(&roadside_strip_record, &scenario->roadside.items[i], ~0U, diag) !=
            0)
            return diag_prefix(diag, "roadside[%zu], relative to the ego: ", i);
    return 0;
}

/* Moves the scene to the origin of its frames, and computes what its frames share. */
static int place_scene(struct scenario *scenario, struct arena *arena, struct diag *diag)
{
    scenario->origin_m = scenario_frame_origin(ego_place(scenario));
    scenario_shift(scenario, scenario->origin_m);
    for (size_t i = 0; i < scenario->objects.count; i++)
        actor_prepare(&scenario->objects.items[i], arena);
    return check_strips(scenario, diag);
}

struct scenario *scenario_draw(const struct scenario_document *document,
                               struct random_address address, const char *ego, struct arena *arena,
                               struct diag *diag)
{
    struct scenario *scenario = arena_get(arena, sizeof *scenario);
    const char *line = variation_draw(document->line, address, arena, diag);
    if (line == NULL) {
        diag_prefix(diag, "%s: ", document->path);
        return NULL;
    }
    if (document_take(document->path, line, &scenario_record, scenario, arena, diag) != 0)
        return NULL;
    int result = scenario_check(scenario, diag);
    scenario->ego = ego != NULL ? ego : scenario->ego;
    if (result == 0 && place_scene(scenario, arena, diag) == 0)
        return scenario;
    diag->code = DIAG_CONFIG;
    diag_prefix(diag, "%s: ", document->path);
    return NULL;
}

static void place_object(const struct actor *actor, double time_s, struct object *object)
{
    double travelled_m;
    struct motion motion = actor_motion(actor, time_s, &travelled_m);
    *object = (struct object){.id = actor->id,
                              .class = actor->class,
                              .x_m = motion.position_m.x,
                              .y_m = motion.position_m.y,
                              .yaw_rad = motion.yaw_rad,
                              .vx_mps = motion.velocity_mps.x,
                              .vy_mps = motion.velocity_mps.y,
                              .yaw_rate_radps = motion.yaw_rate_radps,
                              .length_m = actor->length_m,
                              .width_m = actor->width_m,
                              .height_m = actor->height_m,
                              .travelled_m = travelled_m};
}

void scenario_fill(const struct scenario *scenario, int64_t number, struct frame *frame)
{
    frame->origin_x_m = scenario->origin_m.x;
    frame->origin_y_m = scenario->origin_m.y;
    frame->time_s = scenario_time_s(scenario, number);
    frame->interval_s = 1 / scenario->rate_hz;
    frame->conditions = scenario->conditions;
    frame->roadside.items = scenario->roadside.items;
    frame->roadside.count = scenario->roadside.count;
    frame->objects.count = frame->objects.room = scenario->objects.count;
    frame->objects.items =
        arena_room(frame->arena, frame->objects.count * sizeof *frame->objects.items);
    for (size_t i = 0; i < frame->objects.count; i++)
        place_object(&scenario->objects.items[i], frame->time_s, &frame->objects.items[i]);
}

int scenario_check_frame(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (frame_check_object(object, diag) == 0)
            continue;
        diag->code = DIAG_CONFIG;
        return diag_prefix(diag, "object \"%s\" in frame %lld: ", object->id,
                           (long long)frame->frame);
    }
    return 0;
}
