#include "recorded/recording.h"

#include "frame/frame_check.h"
#include "recorded/recorded_store.h"
#include "recorded/recording_notes.h"
#include "traffic/scenario.h"

/* ---- opening ---- */

static const struct field recording_fields[] = {
    {OPTIONAL_NAME(struct recording_options, ego,
                   "id of the ego; ID,ID,... or all: a scene for each; \\, is a comma in an id"),
     .word = "ID", .high = 1e6},
    {OPTIONAL_NAME(struct recording_options, scene, "name of the scene; absent: SOURCE/EGO")},
    {OPTIONAL_REAL(struct recording_options, radius_m, 0, 1e6,
                   "leave out objects farther than this from the ego"),
     .absent = -1},
    {OPTIONAL_REAL(struct recording_options, rate_hz, 1e-3, 1e6,
                   "resample to this rate; absent: the source's own steps"),
     .absent = -1},
    {OPTIONAL_REAL(struct recording_options, from_s, -9e9, 9e9, "begin at this time of the source"),
     .absent = -9e9},
    {OPTIONAL_REAL(struct recording_options, to_s, -9e9, 9e9, "end with this time of the source"),
     .absent = 9e9},
    {OPTIONAL_NAME(struct recording_options, class_map,
                   "classes for words of the source: WORD=CLASS,WORD=CLASS,..."),
     .word = "MAP", .high = 1e6},
    {OPTIONAL_NAME(struct recording_options, class_default,
                   "the class of all unknown words; absent: they are refused"),
     .word = "CLASS"},
    {OPTIONAL_NAME(struct recording_options, conditions,
                   "road and weather, in place of the source's own: '{\"rain_mmph\": 20}'; "
                   "schemas/scenario.json lists the members"),
     .word = "JSON", .high = 1e6},
    {0},
};

const struct record recording_options_record = {
    .name = "recording", .size = sizeof(struct recording_options), .fields = recording_fields};

/* A comma ends an id, unless a backslash stands before it; two backslashes mean one. */
static int choose_egos(struct recording *recording, const char *egos, struct diag *diag)
{
    if (egos == NULL && recording->host == NULL)
        return diag_fail(diag, DIAG_USAGE,
                         "a recording has no ego of its own; expected --ego ID, ID,ID,... or all");
    if (egos == NULL) {
        intern_word(&recording->wanted, recording->host, recording->arena);
        return 0;
    }
    recording->all = strcmp(egos, "all") == 0;
    if (recording->all)
        return 0;
    struct text id = {0};
    for (const char *at = egos, *end = at + strlen(at); at <= end; at++) {
        if (at < end && *at != ',') {
            at += *at == '\\' && (at[1] == ',' || at[1] == '\\');
            text_add(&id, at, 1);
            continue;
        }
        if (id.length == 0)
            diag_fail(diag, DIAG_USAGE, "--ego: \"%s\" has an empty id", egos);
        else
            intern_number(&recording->wanted, id.bytes, id.length, recording->arena);
        id.length = 0;
    }
    text_free(&id);
    return diag->code == DIAG_OK ? 0 : -1;
}

static int check_options(const struct recording *recording, struct diag *diag)
{
    const struct recording_options *options = &recording->options;
    const struct recorded_steps *steps = &recording->steps;
    if (steps->live && !steps->reader.format->marks_steps)
        return diag_fail(diag, DIAG_USAGE, "--live: %s does not say where a step ends",
                         steps->reader.format->name);
    if (steps->live && options->rate_hz > 0)
        return diag_fail(diag, DIAG_USAGE, "--live: --rate-hz would wait for the next step");
    return options->from_s <= options->to_s
               ? 0
               : diag_fail(diag, DIAG_USAGE, "--to-s: %g is before --from-s, which is %g",
                           options->to_s, options->from_s);
}

static int prepare(struct recording *recording, struct diag *diag)
{
    const struct recording_options *options = &recording->options;
    struct recorded_steps *steps = &recording->steps;
    if (choose_egos(recording, options->ego, diag) != 0 || check_options(recording, diag) != 0 ||
        recording_conditions(options, &recording->conditions, recording->arena, diag) != 0)
        return -1;
    bool stored = !steps->reader.format->by_time;
    steps->plausibility.forward = steps->reader.format->of_sumo;
    if (stored)
        steps->reader = recorded_store_open(steps->reader, options->rate_hz, &steps->plausibility,
                                            recording->arena, diag);
    if (steps->reader.format == NULL ||
        recorded_classes_begin(&steps->classes, steps->reader.format, options->class_map,
                               options->class_default, recording->arena, diag) != 0 ||
        recorded_classes_add(&steps->classes, &recording->types, diag) != 0)
        return -1;
    if (!stored)
        return 0;
    if (recorded_steps_judge(steps, diag) != 0)
        return -1;
    recorded_store_rewind(steps->reader);
    return 0;
}

int recording_conditions(const struct recording_options *options, struct conditions *changes,
                         struct arena *arena, struct diag *diag)
{
    const char *said = options->conditions != NULL ? options->conditions : "{}";
    const struct text text = {.bytes = (char *)said, .length = strlen(said)};
    if (document_parse("--conditions", &text, &conditions_changes_record, changes, arena, diag) ==
        0)
        return 0;
    diag->code = DIAG_USAGE;
    return -1;
}

const char *recording_name(const char *source, struct arena *arena)
{
    const char *slash = strrchr(source, '/');
    const char *base = slash != NULL ? slash + 1 : source;
    size_t length = strcmp(base, "-") == 0 ? 0 : strcspn(base, ".");
    return length == 0 ? "scene" : arena_text(arena, base, length);
}

int recording_open(struct recording *recording, struct recorded_reader reader, struct arena *arena,
                   struct diag *diag)
{
    const struct recording_options *options = &recording->options;
    recording->arena = arena;
    recording->name = recording_name(recording->source, arena);
    /* Times of frames are compared after rounding to microseconds. So a part that ends at one
     * microsecond and a part that begins at the next share no frame and lose none. */
    recording->from_ns = (int64_t)round(options->from_s * 1e6) * 1000 - 500;
    const int64_t to_ns = (int64_t)round(options->to_s * 1e6) * 1000 + 499;
    recording->steps.reader = reader;
    recording->steps.live = recording->live;
    recording->steps.to_ns = options->rate_hz > 0 ? INT64_MAX : to_ns;
    recording->resampling = (struct resampling){.steps = &recording->steps,
                                                .rate_hz = options->rate_hz,
                                                .from_ns = recording->from_ns,
                                                .to_ns = to_ns};
    bool ready = reader.format != NULL && prepare(recording, diag) == 0;
    return ready ? 0 : diag_prefix(diag, "%s: ", recording->source);
}

/* ---- steps ---- */

/* --ego all means every object that could carry a radar. */
static bool is_ego(const struct recording *recording, const struct recorded_state *state)
{
    static const char *const others[] = {"pedestrian", "guardrail", "wall", "post"};
    uint32_t number;
    const struct object *object = &state->object;
    if (!recording->all)
        return intern_find(&recording->wanted, object->id, strlen(object->id), &number);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(object->class, others[i]) == 0)
            return false;
    return true;
}

static void fill_grid(struct recording *recording)
{
    const struct recorded_step *step = recording->step;
    size_t count = step->states.count;
    struct vec2 *places = arena_room(&recording->step_arena, count * sizeof *places);
    for (size_t i = 0; i < count; i++) {
        const struct object *object = &step->states.items[i].object;
        places[i] = (struct vec2){object->x_m, object->y_m};
    }
    recording->grid =
        neighbour_grid_of(places, count, recording->options.radius_m, &recording->step_arena);
}

static bool is_moving(const struct object *object)
{
    return object->vx_mps != 0 || object->vy_mps != 0 || object->travelled_m > 0;
}

/* Reads the next step that has egos. */
static int take_step(struct recording *recording, struct diag *diag)
{
    bool resampled = recording->options.rate_hz > 0;
    do {
        int more = resampled ? resampling_next(&recording->resampling, &recording->step, diag)
                             : recorded_steps_next(&recording->steps, &recording->step, diag);
        if (more <= 0)
            return more;
        arena_clear(&recording->step_arena);
        memset(&recording->step_egos, 0, sizeof recording->step_egos);
        recording->ego = 0;
        if (recording->step->time_ns < recording->from_ns)
            continue;
        recording->steps_taken++;
        for (size_t i = 0; i < recording->step->states.count && !recording->moves; i++)
            recording->moves = is_moving(&recording->step->states.items[i].object);
        for (uint32_t i = 0; i < recording->step->states.count; i++)
            if (is_ego(recording, &recording->step->states.items[i]))
                *list_add(&recording->step_egos, &recording->step_arena) = i;
    } while (recording->step_egos.count == 0);
    if (recording->options.radius_m >= 0)
        fill_grid(recording);
    return 1;
}

/* ---- frames ---- */

/* z/2 is the second visit of z, and z/2/1 the first one of z/2, whose id ends in a number. */
static const char *scene_name(const struct recording *recording, const struct recorded_ego *ego)
{
    const char *given = recording->options.scene, *name = given != NULL ? given : recording->name;
    bool named = given == NULL || recording->all || recording->wanted.list.count > 1;
    if (named)
        name = arena_format(recording->arena, "%s/%s", name, ego->id);
    const char *end = strrchr(ego->id, '/');
    bool numbered = end != NULL && end[1] > '0' && end[1 + strspn(end + 1, "0123456789")] == '\0';
    if (ego->visits > 1 || (named && numbered))
        name = arena_format(recording->arena, "%s/%lld", name, (long long)ego->visits);
    return name;
}

static struct recorded_ego *ego_of(struct recording *recording, const struct recorded_state *state)
{
    const struct object *object = &state->object;
    uint32_t number = intern_word(&recording->ids, object->id, recording->arena);
    if (number == recording->egos.count)
        *list_add(&recording->egos, recording->arena) =
            (struct recorded_ego){.id = intern_text(&recording->ids, number)};
    struct recorded_ego *ego = &recording->egos.items[number];
    size_t missed = recording->steps_taken - ego->step - 1;
    ego->step = recording->steps_taken;
    ego->moves = ego->moves || is_moving(object);
    if (ego->visits > 0 && ego->since_ns == state->since_ns)
        return ego;
    ego->missed += ego->visits > 0 ? missed : 0;
    ego->jumps += ego->visits > 0 && missed == 0;
    ego->visits++;
    ego->since_ns = state->since_ns;
    ego->frames = 0;
    ego->origin_m = scenario_frame_origin((struct vec2){object->x_m, object->y_m});
    ego->scene = scene_name(recording, ego);
    return ego;
}

static void add_object(struct frame *frame, const struct recorded_state *state)
{
    struct object *object = list_add(&frame->objects, frame->arena);
    *object = state->object;
    object->x_m -= frame->origin_x_m;
    object->y_m -= frame->origin_y_m;
}

/* Writes the numbers of the states within the radius of the ego; returns their count. */
static size_t find_near(const struct recording *recording, const struct recorded_state *ego,
                        uint32_t *found, struct arena *arena)
{
    size_t count = recording->step->states.count;
    if (recording->options.radius_m >= 0)
        return neighbour_grid_find(&recording->grid,
                                   (struct vec2){ego->object.x_m, ego->object.y_m}, found, arena);
    for (size_t i = 0; i < count; i++)
        found[i] = (uint32_t)i;
    return count;
}

static struct recorded_level level_of(const struct recorded_state *state)
{
    const struct object *object = &state->object;
    return (struct recorded_level){.place_m = {object->x_m, object->y_m},
                                   .heading = vec2_heading(object->yaw_rad),
                                   .z_m = state->z_m,
                                   .tall_m = state->stands ? object->height_m : 0,
                                   .slope = state->slope};
}

/* Leaves only the bodies on the ego's road; returns their count, and counts the others. */
static size_t leave_level(struct recording *recording, const struct recorded_state *ego,
                          uint32_t *found, size_t count, struct arena *arena)
{
    const struct recorded_state *states = recording->step->states.items;
    struct recorded_level *levels = arena_room(arena, count * sizeof *levels);
    bool *on = arena_room(arena, count * sizeof *on);
    size_t own = 0, left = 0;
    for (size_t i = 0; i < count; i++) {
        levels[i] = level_of(&states[found[i]]);
        if (&states[found[i]] == ego)
            own = i;
    }
    recorded_levels_mark(levels, count, own, on, arena);
    for (size_t i = 0; i < count; i++) {
        const char *id = states[found[i]].object.id;
        if (on[i])
            found[left++] = found[i];
        else
            intern_word(&recording->apart, id, recording->arena);
    }
    recording->apart_frames += left < count;
    return left;
}

static void add_objects(struct recording *recording, const struct recorded_state *ego,
                        struct frame *frame)
{
    const struct recorded_state *states = recording->step->states.items;
    uint32_t *found = arena_room(frame->arena, recording->step->states.count * sizeof *found);
    size_t count = find_near(recording, ego, found, frame->arena);
    if (!isnan(ego->z_m))
        count = leave_level(recording, ego, found, count, frame->arena);
    for (size_t i = 0; i < count; i++)
        add_object(frame, &states[found[i]]);
}

static void fill(struct recording *recording, const struct recorded_state *state,
                 struct frame *frame)
{
    const struct recorded_step *step = recording->step;
    struct recorded_ego *ego = ego_of(recording, state);
    frame->scene = ego->scene;
    frame->ego = ego->id;
    frame->frame = ego->frames++;
    frame->last = state->leaves;
    frame->time_s = recorded_row_seconds(step->time_ns);
    /* A recording of a single step has no interval; any value will do, so it is 1 s. */
    frame->interval_s = step->interval_ns > 0 ? recorded_row_seconds(step->interval_ns) : 1;
    frame->origin_x_m = ego->origin_m.x;
    frame->origin_y_m = ego->origin_m.y;
    conditions_change(&frame->conditions, &recording->conditions);
    add_objects(recording, state, frame);
}

/* Refuses an ego that never came, for its id may be misspelt. */
static int check_egos(const struct recording *recording, struct diag *diag)
{
    const struct recorded_format *format = recording->steps.reader.format;
    bool cut = recording->options.from_s > -9e9 || recording->options.to_s < 9e9;
    for (uint32_t i = 0; i < recording->wanted.list.count; i++) {
        uint32_t number;
        const struct intern_name *name = &recording->wanted.list.items[i];
        if (!intern_find(&recording->ids, name->text, name->length, &number))
            return diag_fail(diag, DIAG_DATA, "--ego: \"%s\" is no %s%s", name->text,
                             format->id_name, cut ? " between --from-s and --to-s" : "");
    }
    if (recording->all && recording->egos.count == 0)
        return diag_fail(diag, DIAG_DATA, "--ego: there are no vehicles");
    return 0;
}

int recording_next(struct recording *recording, struct frame *frame, struct diag *diag)
{
    int more = 1;
    if (recording->ego == recording->step_egos.count)
        more = take_step(recording, diag);
    if (more == 0)
        more = check_egos(recording, diag);
    if (more == 0)
        recording_notes(recording, diag);
    if (more < 0)
        return diag_prefix(diag, "%s: ", recording->source);
    if (more > 0) {
        size_t place = recording->step_egos.items[recording->ego++];
        fill(recording, &recording->step->states.items[place], frame);
    }
    return more;
}

int recording_check(const struct recording *recording, const struct frame *frame, struct diag *diag)
{
    if (strlen(frame->scene) > FIELD_NAME_SIZE)
        return diag_fail(diag, DIAG_DATA,
                         "%s: ego %.80s...: its scene's name is too long; see --scene",
                         recording->source, frame->ego);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (frame_check_object(object, diag) == 0)
            continue;
        const struct recorded_state *state = recorded_steps_find(recording->step, object->id);
        return diag_prefix(diag, "%s: %s %zu: ", recording->source,
                           recording->steps.reader.format->place, state->place);
    }
    return 0;
}

void recording_close(void *recording)
{
    struct recording *own = recording;
    recorded_steps_close(&own->steps);
    resampling_close(&own->resampling);
    arena_free(&own->step_arena);
}
