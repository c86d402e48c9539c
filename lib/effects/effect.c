#include "effects/effect.h"

#include <assert.h>

#include "base/elementary.h"
#include "propagation/attenuation.h"
#include "propagation/micro_doppler.h"
#include "radar/scan_timing.h"

const struct effect *const effect_table[EFFECT_COUNT] = {
#define EFFECT(id, name) &effect_##name,
#include "frame/effects.def"
};

const char *const effect_homes[] = {
    [EFFECT_HOME_IDEAL] = "ideal",
    [EFFECT_HOME_SENSOR] = "sensor",
    [EFFECT_HOME_NOISE] = "noise",
    NULL,
};

const struct effect_member *effect_random_condition(int number)
{
    assert(number >= 1);
    for (int i = 0; i < EFFECT_COUNT; i++)
        for (const struct effect_member *member = effect_table[i]->members; member->size > 0;
             member++)
            if (member->random.number == number)
                return member;
    return NULL;
}

/* Removes the first effect from a set that is not empty, and returns it. */
static enum effect_id take_first(uint64_t *set)
{
    enum effect_id first = (enum effect_id)__builtin_ctzll(*set);
    *set &= *set - 1;
    return first;
}

/* Adds an effect to those that the scan simulates, and begins it. */
static void add_effect(struct effect_scan *scan, enum effect_id id)
{
    const struct effect *effect = effect_table[id];
    scan->effects |= EFFECT_BIT(id);
    if (effect->add_echoes != NULL)
        scan->adding |= EFFECT_BIT(id);
    if (effect->receive != NULL)
        scan->receiving |= EFFECT_BIT(id);
    for (int step = 0; step < EFFECT_STEPS; step++)
        if (effect->measure[step] != NULL)
            scan->measuring[step] |= EFFECT_BIT(id);
    if (effect->interference != NULL)
        scan->interference += effect->interference(scan);
    if (effect->begin == NULL)
        return;
    if (scan->constants == NULL)
        scan->constants = arena_get(scan->frame->arena, EFFECT_COUNT * sizeof *scan->constants);
    scan->constants[id] = effect->begin(scan);
}

/* The instant whose world the sensor shows: that of its scan, less its latency. */
static double shown_instant_s(const struct frame *frame, const struct sensor *sensor,
                              const struct selection *selection)
{
    double instant_s = frame->time_s;
    scan_timing_instant_s(sensor->cycle_s, frame->time_s, frame->interval_s, &instant_s);
    return instant_s - (effects_enabled(selection, EFFECT_LATENCY) ? sensor->latency_s : 0);
}

static bool has_member_of(const struct effect *effect, enum effect_owner owner)
{
    for (const struct effect_member *member = effect->members; member->size > 0; member++)
        if (member->owner == owner)
            return true;
    return false;
}

static bool is_set(const struct effect_member *member, const void *document)
{
    const char *bytes = (const char *)document + member->offset;
    for (size_t i = 0; i < member->size; i++)
        if (bytes[i] != 0)
            return true;
    return false;
}

/* Is any member of this owner, whose values lie in the document, set? */
static bool describes(enum effect_owner owner, const void *document, const struct effect *effect)
{
    for (const struct effect_member *member = effect->members; member->size > 0; member++)
        if (member->owner == owner && is_set(member, document))
            return true;
    return false;
}

static bool is_described(const struct effect *effect, const struct effect_scan *scan)
{
    if (effect->described != NULL)
        return effect->described(scan);
    return describes(EFFECT_OWNER_SENSOR, scan->sensor, effect) ||
           describes(EFFECT_OWNER_CONDITIONS, &scan->frame->conditions, effect) ||
           describes(EFFECT_OWNER_FRAME, scan->frame, effect);
}

uint64_t effect_missing(const struct sensor *sensor)
{
    uint64_t missing = 0;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (has_member_of(effect_table[i], EFFECT_OWNER_SENSOR) &&
            !describes(EFFECT_OWNER_SENSOR, sensor, effect_table[i]))
            missing |= EFFECT_BIT(i);
    return missing;
}

uint64_t effect_of_scenes(void)
{
    uint64_t effects = 0;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (effect_table[i]->members[0].size > 0 &&
            !has_member_of(effect_table[i], EFFECT_OWNER_SENSOR))
            effects |= EFFECT_BIT(i);
    return effects;
}

unsigned effect_reads(const struct frame *frame, const struct sensor *sensor,
                      const struct selection *selection, enum effect_home home)
{
    const struct effect_scan scan = {.frame = frame, .sensor = sensor};
    unsigned parts = 0;
    for (enum effect_id id = 0; id < EFFECT_COUNT; id++) {
        const struct effect *effect = effect_table[id];
        if (effect->reads != 0 && effect->home == home && effects_enabled(selection, id) &&
            is_described(effect, &scan))
            parts |= effect->reads;
    }
    return parts;
}

struct effect_scan effect_begin(const struct frame *frame, const struct sensor *sensor,
                                const struct selection *selection, enum effect_home home)
{
    struct effect_scan scan = {
        .frame = frame,
        .sensor = sensor,
        .time_s = shown_instant_s(frame, sensor, selection),
        .address = frame_draw_address_of_scan(frame, sensor->name),
    };
    if (home == EFFECT_HOME_SENSOR)
        scan.echoes = frame_echoes_of(frame, sensor->name);
    for (enum effect_id id = 0; id < EFFECT_COUNT; id++) {
        const struct effect *effect = effect_table[id];
        if (effect->home != home || !effect_has_cause(effect))
            continue;
        bool simulated = effects_enabled(selection, id) && is_described(effect, &scan);
        effects_note(selection, id, simulated);
        if (simulated)
            add_effect(&scan, id);
    }
    return scan;
}

double effect_age_s(const struct effect_scan *scan)
{
    return scan->frame->time_s - scan->time_s;
}

struct sensor_pose effect_sensor_pose(const struct effect_scan *scan)
{
    const struct sensor *sensor = scan->sensor;
    const struct object *ego = frame_object(scan->frame, scan->frame->ego);
    assert(ego != NULL);
    struct motion motion = frame_motion(ego, effect_age_s(scan));
    return kinematics_sensor_pose(&motion, sensor->mount_x_m, sensor->mount_y_m,
                                  sensor->mount_yaw_rad);
}

struct echo_span effect_added_echoes(const struct effect_scan *scan)
{
    struct effect_echoes echoes = {0};
    for (uint64_t set = scan->adding; set != 0;)
        effect_table[take_first(&set)]->add_echoes(scan, &echoes);
    return (struct echo_span){echoes.list.items, echoes.list.count};
}

void effect_add(const struct effect_scan *scan, struct effect_echoes *echoes,
                const struct echo *echo)
{
    const struct sensor *sensor = scan->sensor;
    if (echo->range_m > 0 && echo->range_m >= sensor->range_min_m &&
        echo->range_m <= suite_range_max_m(sensor, echo->azimuth_rad) &&
        fabs(echo->azimuth_rad) < antenna_border_rad(sensor->field_of_view_rad))
        *list_add(&echoes->list, scan->frame->arena) = *echo;
}

bool effect_scale(struct effect_reception *reception, double factor)
{
    reception->strength *= factor;
    reception->amplitude *= factor;
    return factor != 1;
}

const double *effect_constant(const struct effect_scan *scan, double value)
{
    double *constant = arena_get(scan->frame->arena, sizeof *constant);
    *constant = value;
    return constant;
}

bool effect_attenuate(const struct effect_scan *scan, struct effect_reception *reception)
{
    (void)scan;
    double factor = attenuation_amplitude_factor(*reception->constants, reception->echo->range_m);
    return effect_scale(reception, factor);
}

uint64_t effect_receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    uint64_t effects = 0;
    for (uint64_t set = scan->receiving; set != 0;) {
        enum effect_id id = take_first(&set);
        reception->constants = scan->constants != NULL ? scan->constants[id] : NULL;
        if (effect_table[id]->receive(scan, reception))
            effects |= EFFECT_BIT(id);
    }
    return effects;
}

struct effect_measurement effect_measurement_of(const struct effect_scan *scan,
                                                const struct cell *cell)
{
    struct effect_measurement measurement = {
        .cell = cell,
        .pointers = frame_cell_pointers(cell),
        .range_m = cell->range_m,
        .azimuth_rad = cell->azimuth_rad,
        .elevation_rad = cell->elevation_rad,
        .range_rate_mps = cell->range_rate_mps,
        .amplitude = elementary_hypot(cell->sum_re, cell->sum_im),
        .sign_undecided = cell->sign_undecided,
        .effects = cell->effects,
        .margins = cell->margins,
    };
    if (scan == NULL)
        return measurement;
    measurement.address = frame_draw_address_in(scan->address, cell->members.items[0].id);
    measurement.range_sigma_m = scan->sensor->range_sigma_m;
    measurement.range_rate_sigma_mps = scan->sensor->range_rate_sigma_mps;
    return measurement;
}

void effect_measure(const struct effect_scan *scan, enum effect_step step,
                    struct effect_measurement *measurement)
{
    for (uint64_t set = scan->measuring[step]; set != 0;) {
        enum effect_id id = take_first(&set);
        if (effect_table[id]->measure[step](scan, measurement))
            measurement->effects |= EFFECT_BIT(id);
    }
}

bool effect_has_moving_part(const struct echo *parent, enum moving_part part)
{
    return parent->moving_part == part && micro_doppler_share(parent->ground_rate_mps) > 0;
}

bool effect_any_moving_part(const struct effect_scan *scan, enum moving_part part)
{
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (effect_has_moving_part(&scan->echoes.items[i], part))
            return true;
    return false;
}

struct echo effect_part_of_echo(const struct echo *parent, enum path path, int64_t number,
                                double factor, enum effect_id effect)
{
    struct echo part = *parent;
    part.id.path = path;
    part.id.number = number;
    part.ercs *= factor * micro_doppler_share(parent->ground_rate_mps);
    part.moving_part = MOVING_NONE;
    part.effects |= EFFECT_BIT(effect);
    part.extra = NULL;
    return part;
}
