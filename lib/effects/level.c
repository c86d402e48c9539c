/* Levels of bodies (MODEL 14.22): a constant part, a slow one over the metres that a body and the
 * ego have driven, and a fast one over aspect and range. No part depends on the frame's number, so
 * a body that stays in place keeps its level. No part depends on the sensor's name: sensors in
 * different places have different fast parts. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/hash.h"
#include "base/units.h"
#include "radar/level.h"

/* Scatterers up to LONGEST_M apart interfere. Knots of aspect are KNOT_FRINGE lambda/(2 L) apart,
 * as fringes of scatterers L apart are lambda/(2 L) wide, and those of range KNOT_RANGE_M. */
#define LONGEST_M 6
#define KNOT_FRINGE 0.7
#define KNOT_RANGE_M 0.23

/* The purposes of its draws: the part itself, or the knots of one that changes. */
enum { CONSTANT, SLOW, FAST };

/* Standard deviations of the three parts. */
static struct class_level widths_of_sensor(const struct sensor *sensor)
{
    return (struct class_level){sensor->level_constant_db, sensor->level_slow_db,
                                sensor->level_fast_db};
}

/* Those that the document of the class states, and the sensor's. */
static struct class_level widths_of(const struct effect_scan *scan, const char *class)
{
    struct class_level width = widths_of_sensor(scan->sensor);
    struct document_span documents = frame_documents_of(scan->frame, class);
    for (size_t i = 0; i < documents.count; i++) {
        const struct class_level *level = &documents.items[i].level;
        if (level->constant_db >= 0)
            width.constant_db = level->constant_db;
        if (level->slow_db >= 0)
            width.slow_db = level->slow_db;
        if (level->fast_db >= 0)
            width.fast_db = level->fast_db;
    }
    return width;
}

static bool has_width(const struct class_level *level)
{
    return level->constant_db > 0 || level->slow_db > 0 || level->fast_db > 0;
}

static bool described(const struct effect_scan *scan)
{
    struct class_level width = widths_of_sensor(scan->sensor);
    bool varies = has_width(&width);
    for (size_t i = 0; i < scan->frame->vehicles.count && !varies; i++)
        varies = has_width(&scan->frame->vehicles.items[i].level);
    return varies && frame_has_objects(scan->frame);
}

static double driven_m(const struct effect_scan *scan, const struct object *object)
{
    return object->travelled_m -
           effect_age_s(scan) * elementary_hypot(object->vx_mps, object->vy_mps);
}

static double slow_part(const struct effect_scan *scan, const struct object *body,
                        const struct random_address *address)
{
    const struct object *ego = frame_object(scan->frame, scan->frame->ego);
    double together_m = driven_m(scan, body) + driven_m(scan, ego);
    return level_on_line(address, effect_level.purposes[SLOW],
                         together_m / scan->sensor->level_slow_m);
}

/* from_m is the sensor's place. */
static double fast_part(const struct effect_scan *scan, const struct object *body,
                        struct vec2 from_m, const struct random_address *address)
{
    struct motion motion = frame_motion(body, effect_age_s(scan));
    struct vec2 sensor_m =
        vec2_turn_back(vec2_sub(from_m, motion.position_m), vec2_heading(motion.yaw_rad));
    double turns = elementary_atan2(sensor_m.y, sensor_m.x) / (2 * PI);
    if (turns < 0)
        turns += 1;
    double knots_a_turn = 4 * PI * elementary_min(body->length_m, LONGEST_M) /
                          (KNOT_FRINGE * units_wavelength_m(scan->sensor->carrier_hz));
    double knots = elementary_max(2, floor(knots_a_turn + 0.5));
    return level_on_turn(address, effect_level.purposes[FAST], knots * turns,
                         vec2_length(sensor_m) / KNOT_RANGE_M, (int64_t)knots);
}

static double level_db(const struct effect_scan *scan, const struct object *body,
                       struct vec2 from_m)
{
    struct class_level width = widths_of(scan, body->class);
    struct random_address address = {.seed = scan->address.seed,
                                     .scene = scan->address.scene,
                                     .item = hash_text(HASH_START, body->id)};
    double variance = width.constant_db * width.constant_db + width.slow_db * width.slow_db +
                      width.fast_db * width.fast_db;
    double db = level_centre_db(scan->sensor->level_keeps, sqrt(variance));
    double constant[2];
    random_gaussian_pair(&address, effect_level.purposes[CONSTANT], 0, constant);
    db += width.constant_db * constant[0];
    if (width.slow_db > 0)
        db += width.slow_db * slow_part(scan, body, &address);
    if (width.fast_db > 0)
        db += width.fast_db * fast_part(scan, body, from_m, &address);
    return db;
}

/* Factors on amplitude, by the frame's objects; 0 for objects without an echo. */
static const double *begin(const struct effect_scan *scan)
{
    const struct frame *frame = scan->frame;
    struct vec2 from_m = effect_sensor_pose(scan).position_m;
    double *factors = arena_get(frame->arena, frame->objects.count * sizeof *factors);
    for (size_t i = 0; i < scan->echoes.count; i++) {
        const struct object *body = frame_object_of(frame, &scan->echoes.items[i].id);
        if (body == NULL)
            continue;
        double *factor = &factors[body - frame->objects.items];
        if (*factor == 0)
            *factor = units_amplitude_from_db(level_db(scan, body, from_m));
    }
    return factors;
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    const struct frame *frame = scan->frame;
    const struct object *body = frame_object_of(frame, &reception->echo->id);
    if (body == NULL)
        return false;
    return effect_scale(reception, reception->constants[body - frame->objects.items]);
}

const struct effect effect_level = {
    .summary =
        "all echoes of a body are stronger or weaker together, and stay so from scan to scan",
    .cause = "level_constant_db, level_slow_db and level_fast_db of a sensor, or level of a class",
    .left_out_when = "no such member is above 0, or the frame has no objects",
    .cost = "up to seven draws per body",
    .home = EFFECT_HOME_SENSOR,
    .reads = PART_OBJECTS,
    .members = {{EFFECT_SENSOR(level_constant_db)},
                {EFFECT_SENSOR(level_slow_db)},
                {EFFECT_SENSOR(level_fast_db)}},
    .purposes = {[CONSTANT] = 19, [SLOW] = 20, [FAST] = 21},
    .described = described,
    .begin = begin,
    .receive = receive,
};
