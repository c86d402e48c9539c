#include "traffic/scenario.h"

#include "base/elementary.h"
#include "base/intern.h"
#include "base/search.h"
#include "base/units.h"
#include "documents/vehicle.h"
#include "frame/frame_check.h"
#include "text/document.h"

static const struct field segment_fields[] = {
    {FIELD_REAL_IN(struct segment, duration_s, 0, 1e6, "the next segment begins after this time")},
    {OPTIONAL_REAL(struct segment, acceleration_mps2, -1e3, 1e3, "along the heading")},
    {OPTIONAL_REAL(struct segment, yaw_rate_radps, -1e3, 1e3, "turn rate, left positive")},
    {0},
};

static const struct record segment_record = {FIELD_TABLE(
    struct segment, segment_fields, "segment", "A time of constant acceleration and turn rate.")};

static const struct field waypoint_fields[] = {
    {FIELD_REAL_IN(struct waypoint, time_s, 0, 1e6,
                   "when the object is there; later than at the waypoint before")},
    {FIELD_REAL_IN(struct waypoint, x_m, -1e9, 1e9, "centre of the box")},
    {FIELD_REAL_IN(struct waypoint, y_m, -1e9, 1e9, "centre of the box")},
    {0},
};

static const struct record waypoint_record = {
    FIELD_TABLE(struct waypoint, waypoint_fields, "waypoint", "A place and when to be there.")};

static const struct field actor_fields[] = {
    {FIELD_NAME_OF(struct actor, id, "unique in the scenario")},
    {FIELD_NAME_OF(struct actor, class, "names the vehicle document")},
    {OPTIONAL_REAL(struct actor, length_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, width_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, height_m, 0, 1e6, "0: the default of the class")},
    {OPTIONAL_REAL(struct actor, x_m, -1e9, 1e9, "centre of the box at time 0")},
    {OPTIONAL_REAL(struct actor, y_m, -1e9, 1e9, "centre of the box at time 0")},
    {OPTIONAL_REAL(struct actor, yaw_rad, -2 * PI, 2 * PI, "heading at time 0")},
    {OPTIONAL_REAL(struct actor, speed_mps, -1e3, 1e3, "at time 0; below 0: backwards")},
    {OPTIONAL_LIST(struct actor, segments, &segment_record, "driven one after another")},
    {OPTIONAL_LIST(struct actor, waypoints, &waypoint_record, "followed instead of segments")},
    {0},
};

static const struct record actor_record = {
    FIELD_TABLE(struct actor, actor_fields, "object", "A road user or thing, and how it moves.")};

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

static int check_waypoints(const struct actor *actor, struct diag *diag)
{
    const struct waypoint *waypoints = actor->waypoints.items;
    if (actor->waypoints.count < 2)
        return diag_fail(diag, DIAG_CONFIG, "waypoints: only one; expected two or more, or none");
    for (size_t i = 1; i < actor->waypoints.count; i++)
        if (!(waypoints[i].time_s > waypoints[i - 1].time_s))
            return diag_fail(diag, DIAG_CONFIG,
                             "waypoints[%zu].time_s: %g is not after the previous waypoint's %g", i,
                             waypoints[i].time_s, waypoints[i - 1].time_s);
    if (actor->segments.count > 0)
        return diag_fail(diag, DIAG_CONFIG, "segments: expected none beside waypoints");
    if (actor->x_m != 0 || actor->y_m != 0 || actor->speed_mps != 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "waypoints: they give place and speed; expected no x_m, y_m, speed_mps");
    return 0;
}

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
        if (actors[i].waypoints.count > 0 && check_waypoints(&actors[i], diag) != 0)
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

static void shift_actor(struct actor *actor, struct vec2 origin_m)
{
    for (size_t i = 0; i < actor->waypoints.count; i++) {
        actor->waypoints.items[i].x_m -= origin_m.x;
        actor->waypoints.items[i].y_m -= origin_m.y;
    }
    if (actor->waypoints.count > 0)
        return;
    actor->x_m -= origin_m.x;
    actor->y_m -= origin_m.y;
}

void scenario_shift(struct scenario *scenario, struct vec2 origin_m)
{
    for (size_t i = 0; i < scenario->roadside.count; i++)
        roadside_shift(&scenario->roadside.items[i], vec2_scale(-1, origin_m));
    for (size_t i = 0; i < scenario->objects.count; i++)
        shift_actor(&scenario->objects.items[i], origin_m);
    for (size_t i = 0; i < scenario->roads.count; i++)
        road_shift(&scenario->roads.items[i], origin_m);
}

static struct motion drive_segments(const struct actor *actor, double time_s, double *travelled_m)
{
    struct motion body = {.position_m = {actor->x_m, actor->y_m}, .yaw_rad = actor->yaw_rad};
    double speed_mps = actor->speed_mps;
    const struct segment *segments = actor->segments.items;
    size_t next = 0;
    *travelled_m = 0;
    for (; next < actor->segments.count && time_s >= segments[next].duration_s; next++) {
        struct segment done = segments[next];
        *travelled_m += motion_drive_length_m(speed_mps, done.acceleration_mps2, done.duration_s);
        body = motion_drive(body.position_m, body.yaw_rad, speed_mps, done.acceleration_mps2,
                            done.yaw_rate_radps, done.duration_s);
        speed_mps += done.acceleration_mps2 * done.duration_s;
        time_s -= done.duration_s;
    }
    struct segment current =
        next < actor->segments.count ? segments[next] : (struct segment){.duration_s = 0};
    *travelled_m += motion_drive_length_m(speed_mps, current.acceleration_mps2, time_s);
    return motion_drive(body.position_m, body.yaw_rad, speed_mps, current.acceleration_mps2,
                        current.yaw_rate_radps, time_s);
}

static double span_duration_s(const struct actor *actor, size_t span)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    return from[1].time_s - from[0].time_s;
}

/* The mean velocity from one waypoint to the next. */
static struct vec2 span_mean_mps(const struct actor *actor, size_t span)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    struct vec2 way_m = {from[1].x_m - from[0].x_m, from[1].y_m - from[0].y_m};
    return vec2_scale(1 / span_duration_s(actor, span), way_m);
}

/* The velocity at a waypoint by finite differences: of two points at the ends, where the
 * three-point formula can start a body backwards. Next to two equal places it is 0, or the body
 * would swing. */
static struct vec2 waypoint_velocity_mps(const struct actor *actor, size_t waypoint)
{
    size_t spans = actor->waypoints.count - 1;
    if (waypoint == 0 || waypoint == spans)
        return span_mean_mps(actor, waypoint == 0 ? 0 : spans - 1);
    struct vec2 before_mps = span_mean_mps(actor, waypoint - 1);
    struct vec2 after_mps = span_mean_mps(actor, waypoint);
    if (vec2_dot(before_mps, before_mps) == 0 || vec2_dot(after_mps, after_mps) == 0)
        return (struct vec2){0, 0};
    double before_s = span_duration_s(actor, waypoint - 1);
    double after_s = span_duration_s(actor, waypoint);
    double weight = after_s / (before_s + after_s);
    return vec2_add(vec2_scale(weight, before_mps), vec2_scale(1 - weight, after_mps));
}

struct curve_state {
    struct vec2 position_m, velocity_mps, acceleration_mps2;
};

/* The curve at the fraction s of a span. */
static struct curve_state curve_at(const struct actor *actor, size_t span, double s)
{
    const struct waypoint *from = &actor->waypoints.items[span];
    struct curve_state state;
    motion_hermite((struct vec2){from[0].x_m, from[0].y_m}, waypoint_velocity_mps(actor, span),
                   (struct vec2){from[1].x_m, from[1].y_m}, waypoint_velocity_mps(actor, span + 1),
                   span_duration_s(actor, span), s, &state.position_m, &state.velocity_mps,
                   &state.acceleration_mps2);
    return state;
}

static bool is_moving(struct vec2 velocity_mps)
{
    return vec2_dot(velocity_mps, velocity_mps) >= 1e-6 * 1e-6;
}

/* Finds the yaw at the first place where the body moves, from one fraction of a span towards
 * another; false if it does not move. The steps begin tiny and double. */
static bool find_yaw(const struct actor *actor, size_t span, double from, double to,
                     double *yaw_rad)
{
    for (int halvings = 20; halvings >= 0; halvings--) {
        double s = from + ldexp(to - from, -halvings);
        struct vec2 velocity_mps = curve_at(actor, span, s).velocity_mps;
        if (is_moving(velocity_mps)) {
            *yaw_rad = elementary_atan2(velocity_mps.y, velocity_mps.x);
            return true;
        }
    }
    return false;
}

static double standing_yaw_rad(const struct actor *actor, size_t span, double s)
{
    double yaw_rad = actor->yaw_rad;
    for (size_t later = span; later + 1 < actor->waypoints.count; later++)
        if (find_yaw(actor, later, later == span ? s : 0, 1, &yaw_rad))
            return yaw_rad;
    for (size_t earlier = span + 1; earlier-- > 0;)
        if (find_yaw(actor, earlier, 1, 0, &yaw_rad))
            return yaw_rad;
    return yaw_rad;
}

/* The curve's length from the beginning of a span to the fraction s, by five-point Gauss-Legendre
 * quadrature: exact where the body goes straight without reversing. */
static double span_length_m(const struct actor *actor, size_t span, double s)
{
    static const double rule[][2] = {
        {-0.90617984593866399, 0.23692688505618909},
        {-0.53846931010568309, 0.47862867049936647},
        {0, 0.56888888888888889},
        {0.53846931010568309, 0.47862867049936647},
        {0.90617984593866399, 0.23692688505618909},
    };
    double sum_mps = 0;
    for (size_t i = 0; i < sizeof rule / sizeof rule[0]; i++) {
        struct curve_state state = curve_at(actor, span, s / 2 * (1 + rule[i][0]));
        sum_mps += rule[i][1] * vec2_length(state.velocity_mps);
    }
    return s / 2 * span_duration_s(actor, span) * sum_mps;
}

static size_t span_of(const struct actor *actor, double time_s)
{
    const struct waypoint *waypoints = actor->waypoints.items;
    return search_row(&waypoints[0].time_s, sizeof *waypoints, actor->waypoints.count - 1, time_s);
}

static struct motion follow_waypoints(const struct actor *actor, double time_s, double *travelled_m)
{
    size_t span = span_of(actor, time_s);
    double fraction = (time_s - actor->waypoints.items[span].time_s) / span_duration_s(actor, span);
    double s = elementary_max(elementary_min(fraction, 1), 0);
    *travelled_m = span_length_m(actor, span, s);
    for (size_t i = 0; i < span; i++)
        *travelled_m += span_length_m(actor, i, 1);
    struct curve_state state = curve_at(actor, span, s);
    bool moving = is_moving(state.velocity_mps);
    struct motion body = {.position_m = state.position_m};
    body.yaw_rad = moving ? elementary_atan2(state.velocity_mps.y, state.velocity_mps.x)
                          : standing_yaw_rad(actor, span, s);
    if (fraction < 0 || fraction > 1)
        return body;
    body.velocity_mps = state.velocity_mps;
    if (moving)
        body.yaw_rate_radps = vec2_cross(state.velocity_mps, state.acceleration_mps2) /
                              vec2_dot(state.velocity_mps, state.velocity_mps);
    return body;
}

struct motion scenario_motion(const struct actor *actor, double time_s, double *travelled_m)
{
    struct motion body = actor->waypoints.count > 0 ? follow_waypoints(actor, time_s, travelled_m)
                                                    : drive_segments(actor, time_s, travelled_m);
    body.yaw_rad = units_wrap_rad(body.yaw_rad);
    return body;
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
    double travelled_m;
    if (actor != NULL)
        return scenario_motion(actor, 0, &travelled_m).position_m;
    if (scenario->roads.count == 0)
        return (struct vec2){0, 0};
    const struct road_point *point = scenario->roads.items[0].points.items;
    return (struct vec2){point->x_m, point->y_m};
}

struct scenario *scenario_draw(const struct scenario_document *document,
                               struct random_address address, const char *ego, struct arena *arena,
                               struct diag *diag)
{
    struct scenario *scenario = arena_get(arena, sizeof *scenario);
    const char *line = document_draw(document->line, address, arena, diag);
    if (line == NULL) {
        diag_prefix(diag, "%s: ", document->path);
        return NULL;
    }
    if (document_take(document->path, line, &scenario_record, scenario, arena, diag) != 0)
        return NULL;
    if (scenario_check(scenario, diag) != 0) {
        diag->code = DIAG_CONFIG;
        diag_prefix(diag, "%s: ", document->path);
        return NULL;
    }
    scenario->ego = ego != NULL ? ego : scenario->ego;
    scenario->origin_m = scenario_frame_origin(ego_place(scenario));
    scenario_shift(scenario, scenario->origin_m);
    return scenario;
}

static struct object object_of(const struct actor *actor, double time_s)
{
    double travelled_m;
    struct motion motion = scenario_motion(actor, time_s, &travelled_m);
    return frame_object_in((struct object){.id = actor->id,
                                           .class = actor->class,
                                           .length_m = actor->length_m,
                                           .width_m = actor->width_m,
                                           .height_m = actor->height_m,
                                           .travelled_m = travelled_m},
                           motion);
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
    for (size_t i = 0; i < scenario->objects.count; i++)
        *list_add(&frame->objects, frame->arena) =
            object_of(&scenario->objects.items[i], frame->time_s);
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
