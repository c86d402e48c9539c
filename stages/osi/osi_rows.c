#include "osi_rows.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/text.h"
#include "base/vec2.h"
#include "osi_message.h"
#include "text/file_format.h"
#include "text/input.h"

enum { LENGTH_SIZE = 4, PIECE = 64 * 1024, LONGEST = 1 << 27 };

/* Objects whose types OSI numbers apart from each other. */
enum object_kind { MOVING, VEHICLE, STATIONARY };

enum { TYPE_VEHICLE = 2 }; /* of a moving object, which then has a type as a vehicle too */

struct trace {
    struct input *input;
    bool rear_axle;    /* velocities are those of rear axles */
    bool ahead, begun; /* the message has rows to give; a message has been read */
    size_t place;      /* of the message in the file */
    struct text bytes; /* of the message */
    struct arena arena;
    struct osi_message message;
    int64_t time_ns;
    size_t given;                        /* number of moving objects given, and then of stills */
    LIST_OF(struct recorded_row) stills; /* from the last message with stationary objects */
    struct arena still_arena;
};

/* ---- objects become rows ---- */

static const struct type {
    enum object_kind kind;
    int32_t number;
    const char *word;
} types[] = {
#define OSI(kind, number, word, class) {kind, number, word},
#include "osi_classes.def"
    {MOVING, 0, "unknown"},        {MOVING, 1, "other"},        {VEHICLE, 0, "unknown_vehicle"},
    {VEHICLE, 1, "other_vehicle"}, {VEHICLE, 20, "watercraft"}, {VEHICLE, 21, "aircraft"},
};

static const char *word_of(enum object_kind kind, int32_t number, struct arena *arena)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].kind == kind && types[i].number == number)
            return types[i].word;
    if (kind == STATIONARY)
        return NULL;
    return arena_format(arena, "%s_%d", kind == MOVING ? "moving" : "vehicle", (int)number);
}

/* The reference of glint-osi among those of an object, or NULL: the id and the class of the object
 * in glint's frames, of which OSI has only a number and a type. */
static const Osi3__ExternalReference *own_reference(Osi3__ExternalReference *const *references,
                                                    size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const Osi3__ExternalReference *one = references[i];
        if (one->type != NULL && strcmp(one->type, "glint.object") == 0 && one->n_identifier == 2 &&
            recorded_row_name_fits(one->identifier[0]) &&
            recorded_row_name_fits(one->identifier[1]))
            return one;
    }
    return NULL;
}

/* A number in a part of the base: 0 if the part lacks it, and not taken without the part. */
#define NUMBER(part, number, low, high, member)                                                    \
    {                                                                                              \
#part "." #number, base->part != NULL ? base->part->number : 0, low, high,                 \
            base->part != NULL ? &row->member : NULL                                               \
    }

/* Makes the height of the centre that of the road. A pitch is positive with the nose down. */
static void take_height(const Osi3__Base *base, struct recorded_row *row)
{
    row->z_m = base->position->has_z ? row->z_m - row->height_m / 2 : (double)NAN;
    if (base->orientation != NULL)
        row->pitch_rad = -base->orientation->pitch;
}

/* Takes the values that moving and stationary objects share; false after a message. */
static bool take_body(const struct trace *trace, const char *kind, const Osi3__Identifier *id,
                      const Osi3__Base *base, struct recorded_row *row, struct diag *diag)
{
    *row = recorded_row_unsaid;
    if (id == NULL || base == NULL || base->position == NULL) {
        diag_fail(diag, DIAG_DATA, "byte %zu: %s: %s is missing; expected one in each",
                  trace->place, kind, id == NULL ? "id" : "base.position");
        return false;
    }
    const struct {
        const char *name;
        double value, low, high, *taken;
    } numbers[] = {
        NUMBER(position, x, -1e9, 1e9, x_m),
        NUMBER(position, y, -1e9, 1e9, y_m),
        NUMBER(position, z, -1e9, 1e9, z_m),
        NUMBER(dimension, length, 0, 1e6, length_m),
        NUMBER(dimension, width, 0, 1e6, width_m),
        NUMBER(dimension, height, 0, 1e6, height_m),
        NUMBER(orientation, yaw, -1e3, 1e3, yaw_rad),
        NUMBER(velocity, x, -1e4, 1e4, vx_mps),
        NUMBER(velocity, y, -1e4, 1e4, vy_mps),
        NUMBER(orientation_rate, yaw, -1e3, 1e3, yaw_rate_radps),
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (numbers[i].taken != NULL)
            *numbers[i].taken = numbers[i].value + 0.0; /* never -0 */
        if (numbers[i].value >= numbers[i].low && numbers[i].value <= numbers[i].high)
            continue;
        diag_fail(diag, DIAG_DATA,
                  "byte %zu: %s %" PRIu64 ": base.%s is %.9g; expected a number in [%g, %g]",
                  trace->place, kind, id->value, numbers[i].name, numbers[i].value, numbers[i].low,
                  numbers[i].high);
        return false;
    }
    take_height(base, row);
    return true;
}

/* Adds the velocity of the centre relative to the rear axle, given by its place in the body's axes.
 * False if the place is out of bounds. */
static bool move_velocity(struct recorded_row *row, const Osi3__Vector3d *to_rear)
{
    if (!(fabs(to_rear->x) <= 1e3 && fabs(to_rear->y) <= 1e3))
        return false;
    if (isnan(row->yaw_rad) || isnan(row->yaw_rate_radps))
        return true;
    struct vec2 heading = vec2_heading(row->yaw_rad);
    row->vx_mps += row->yaw_rate_radps * (to_rear->x * heading.y + to_rear->y * heading.x);
    row->vy_mps -= row->yaw_rate_radps * (to_rear->x * heading.x - to_rear->y * heading.y);
    return true;
}

/* The id of an object: its number, but in a trace of glint-osi the name behind it. */
static const char *name_of(const Osi3__Identifier *id, Osi3__ExternalReference *const *references,
                           size_t count, struct arena *arena)
{
    const Osi3__ExternalReference *own = own_reference(references, count);
    return own != NULL ? arena_text(arena, own->identifier[0], strlen(own->identifier[0]))
                       : arena_format(arena, "%" PRIu64, id->value);
}

/* In a trace of glint-osi the class is glint's own, and the word is taken if it is not known. */
static void take_own_class(Osi3__ExternalReference *const *references, size_t count,
                           struct recorded_row *row, struct arena *arena)
{
    const Osi3__ExternalReference *own = own_reference(references, count);
    if (own == NULL)
        return;
    row->likely = row->class;
    row->class = arena_text(arena, own->identifier[1], strlen(own->identifier[1]));
}

/* An object of an unknown type with a classification of vehicles, which only vehicles have, is a
 * vehicle. */
static void set_class(const Osi3__MovingObject *object, struct recorded_row *row,
                      struct arena *arena)
{
    const Osi3__MovingObject__VehicleClassification *vehicle = object->vehicle_classification;
    bool is_vehicle = object->type == TYPE_VEHICLE || (object->type == 0 && vehicle != NULL);
    int32_t type = object->type;
    if (is_vehicle)
        type = vehicle != NULL ? vehicle->type : 0;
    row->class = word_of(is_vehicle ? VEHICLE : MOVING, type, arena);
    if (type == 0)
        row->untold = arena_format(
            arena, "moving_object %s: %s is missing or unknown; expected %s", row->id,
            is_vehicle ? "vehicle_classification.type" : "type",
            is_vehicle
                ? "a type of vehicles"
                : "TYPE_VEHICLE, TYPE_PEDESTRIAN or TYPE_ANIMAL, or a vehicle_classification");
}

static int give_moving(struct trace *trace, const Osi3__MovingObject *object,
                       struct recorded_row *row, struct diag *diag)
{
    const Osi3__MovingObject__VehicleAttributes *attributes = object->vehicle_attributes;
    struct arena *arena = &trace->arena;
    if (!take_body(trace, "moving_object", object->id, object->body, row, diag))
        return -1;
    row->id = name_of(object->id, object->source_reference, object->n_source_reference, arena);
    if (trace->rear_axle && attributes != NULL && attributes->bbcenter_to_rear != NULL &&
        !move_velocity(row, attributes->bbcenter_to_rear))
        return diag_fail(diag, DIAG_DATA,
                         "byte %zu: moving_object %s: bbcenter_to_rear is (%.9g, %.9g); expected "
                         "numbers in [-1e3, 1e3]",
                         trace->place, row->id, attributes->bbcenter_to_rear->x,
                         attributes->bbcenter_to_rear->y);
    set_class(object, row, arena);
    take_own_class(object->source_reference, object->n_source_reference, row, arena);
    return RECORDED_ROW;
}

/* Keeps the stationary objects of a message, if it has any: traces need not repeat them. */
static int keep_stills(struct trace *trace, struct diag *diag)
{
    struct arena *arena = &trace->still_arena;
    if (trace->message.truth->n_stationary_object > 0) {
        arena_clear(arena);
        memset(&trace->stills, 0, sizeof trace->stills);
    }
    for (size_t i = 0; i < trace->message.truth->n_stationary_object; i++) {
        const Osi3__StationaryObject *object = trace->message.truth->stationary_object[i];
        int32_t type = object->classification != NULL ? object->classification->type : 0;
        const char *word = word_of(STATIONARY, type, arena);
        struct recorded_row row;
        if (word == NULL)
            continue;
        if (!take_body(trace, "stationary_object", object->id, object->body, &row, diag))
            return -1;
        row.id = name_of(object->id, object->source_reference, object->n_source_reference, arena);
        row.class = word;
        take_own_class(object->source_reference, object->n_source_reference, &row, arena);
        row.vx_mps = row.vy_mps = row.yaw_rate_radps = 0;
        row.stands = true;
        *list_add(&trace->stills, arena) = row;
    }
    return 0;
}

/* ---- messages ---- */

/* Reads count bytes into the trace's text. Returns their number, less at the end of the file; -1
 * after a message. */
static long read_bytes(struct trace *trace, size_t count, struct diag *diag)
{
    struct text *bytes = &trace->bytes;
    bytes->length = 0;
    while (bytes->length < count) {
        size_t piece = count - bytes->length < PIECE ? count - bytes->length : PIECE;
        long got = input_read(trace->input, text_room(bytes, piece), piece, diag);
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        bytes->length += (size_t)got;
    }
    return (long)bytes->length;
}

static int fail_at_end(const struct trace *trace, struct diag *diag)
{
    char last[80] = "no message is whole";
    if (trace->begun)
        snprintf(last, sizeof last, "the last whole message is that of %.12g s",
                 recorded_row_seconds(trace->time_ns));
    return diag_fail(diag, DIAG_DATA, "byte %zu: the trace ends inside a message; %s", trace->place,
                     last);
}

static int unpack(struct trace *trace, struct diag *diag)
{
    size_t length = trace->bytes.length;
    arena_clear(&trace->arena);
    trace->message = osi_message_unpack(trace->bytes.bytes, length, &trace->arena);
    return trace->message.truth != NULL
               ? 0
               : diag_fail(diag, DIAG_DATA,
                           "byte %zu: a message of %zu bytes without a ground truth; expected a "
                           "GroundTruth, or a SensorView or SensorData with global_ground_truth, "
                           "behind its length",
                           trace->place, length);
}

static int read_time(struct trace *trace, struct diag *diag)
{
    const int64_t most_s = 9000000000, second_ns = 1000000000;
    const Osi3__Timestamp *time = trace->message.time;
    if (time == NULL)
        return diag_fail(diag, DIAG_DATA, "byte %zu: timestamp is missing; expected one in each",
                         trace->place);
    if (time->seconds < -most_s || time->seconds > most_s || time->nanos >= second_ns)
        return diag_fail(diag, DIAG_DATA,
                         "byte %zu: timestamp is %" PRId64 " s and %" PRIu32
                         " ns; expected seconds in [-9e9, 9e9] and less than 1e9 ns",
                         trace->place, time->seconds, time->nanos);
    trace->time_ns = time->seconds * second_ns + time->nanos;
    return 0;
}

/* Refuses a message that is too long. The first four bytes of a text or a log make such a length;
 * some more bytes let file_format_explain recognize the format. */
static int refuse_length(struct trace *trace, size_t length, struct diag *diag)
{
    struct diag ignored = {0};
    input_read(trace->input, text_room(&trace->bytes, PIECE), PIECE, &ignored);
    return diag_fail(diag, DIAG_DATA,
                     "byte %zu: the length of a message is %zu; expected at most %d bytes",
                     trace->place, length, LONGEST);
}

/* Reads the next message: 1; 0 at the end; -1 after a message. */
static int read_message(struct trace *trace, struct diag *diag)
{
    trace->place += trace->begun ? LENGTH_SIZE + trace->bytes.length : 0;
    long got = read_bytes(trace, LENGTH_SIZE, diag);
    if (got == 0 && !trace->begun)
        return diag_fail(diag, DIAG_DATA, "the trace is empty; expected messages of OSI");
    if (got <= 0)
        return (int)got;
    if (got < LENGTH_SIZE)
        return fail_at_end(trace, diag);
    size_t length = text_half_word(trace->bytes.bytes);
    if (length > LONGEST)
        return refuse_length(trace, length, diag);
    got = read_bytes(trace, length, diag);
    if (got < 0)
        return -1;
    if ((size_t)got < length)
        return fail_at_end(trace, diag);
    trace->begun = trace->ahead = true;
    trace->given = 0;
    return unpack(trace, diag) == 0 && read_time(trace, diag) == 0 && keep_stills(trace, diag) == 0
               ? 1
               : -1;
}

/* ---- the reader ---- */

static int explain(const struct trace *trace, struct diag *diag)
{
    size_t length;
    const char *head = input_head(trace->input, &length);
    file_format_explain("osi", head, length, diag);
    return -1;
}

static int next_event(void *state, struct recorded_row *row, struct diag *diag)
{
    struct trace *trace = state;
    int more = trace->ahead ? 1 : read_message(trace, diag);
    if (more <= 0)
        return more < 0 ? explain(trace, diag) : RECORDED_END;
    size_t moving = trace->message.truth->n_moving_object, given = trace->given++;
    int event = RECORDED_ROW;
    if (given < moving)
        event = give_moving(trace, trace->message.truth->moving_object[given], row, diag);
    else if (given < moving + trace->stills.count)
        *row = trace->stills.items[given - moving];
    else
        event = RECORDED_STEP;
    trace->ahead = event != RECORDED_STEP;
    row->time_ns = trace->time_ns;
    row->place = trace->place;
    return event;
}

static void close_trace(void *state)
{
    struct trace *trace = state;
    input_close(trace->input);
    text_free(&trace->bytes);
    arena_free(&trace->arena);
    arena_free(&trace->still_arena);
}

static const struct recorded_word words[] = {
#define OSI(kind, number, word, class) RECORDED_WORD(word, class)
#include "osi_classes.def"
    {0},
};

static const struct recorded_format format = {
    .name = "an OSI trace",
    .id_name = "id of an object",
    .place = "byte",
    .by_time = true,
    .marks_steps = true,
    .words = words,
    .next = next_event,
    .close = close_trace,
};

/* The name of the host, if the message has one. */
static const char *host_of(const struct osi_message *message, struct arena *arena)
{
    const Osi3__GroundTruth *truth = message->truth;
    if (message->host == NULL)
        return NULL;
    for (size_t i = 0; i < truth->n_moving_object; i++) {
        const Osi3__MovingObject *one = truth->moving_object[i];
        if (one->id != NULL && one->id->value == message->host->value)
            return name_of(one->id, one->source_reference, one->n_source_reference, arena);
    }
    return name_of(message->host, NULL, 0, arena);
}

struct recorded_reader osi_rows_open(struct input *input, bool rear_axle, const char **host,
                                     struct arena *arena, struct diag *diag)
{
    struct trace *trace = arena_get(arena, sizeof *trace);
    trace->input = input;
    trace->rear_axle = rear_axle;
    if (read_message(trace, diag) < 0) {
        explain(trace, diag);
        close_trace(trace);
        return (struct recorded_reader){0};
    }
    *host = host_of(&trace->message, arena);
    return (struct recorded_reader){&format, trace};
}
