/* What an effect is, and how stages call its hooks.
 *
 * One file of this folder defines one effect: rain.c has effect_rain. frame/effects.def lists
 * all effects in the order of the chain.
 *
 * An effect's home is the stage that simulates it. The home begins every scan of a sensor with
 * effect_begin and then calls the hooks of the effects that the scan simulates, in the order of the
 * chain. A scan simulates an effect if the selection allows it and the documents describe its
 * cause. An effect without a described cause is geometry or a decision (occlusion, merging):
 * modules of its home simulate and note it, and its file has its texts and names the module.
 *
 * Hooks read the frame, the documents and the values that are passed to them, draw random numbers
 * by address (base/random.h) and take memory from the frame's arena. */
#pragma once

#include "base/random.h"
#include "documents/suite.h"
#include "frame/frame.h"
#include "geometry/kinematics.h"

enum effect_home { EFFECT_HOME_IDEAL, EFFECT_HOME_SENSOR, EFFECT_HOME_NOISE };

/* The steps in which the noise stage measures a cell, in this order. glint-sensor-signal measures
 * targets in the signal, and takes only the last two steps. */
enum effect_step {
    EFFECT_STEP_POINTERS, /* changes the sum and delta pointers, before the angle is read */
    EFFECT_STEP_SIGMA,    /* sets the standard deviations that EFFECT_STEP_NOISE then uses */
    EFFECT_STEP_NOISE,    /* adds noise to the range, azimuth and range rate that were read */
    EFFECT_STEP_ANGLES,   /* changes azimuth and elevation to those that are reported */
    EFFECT_STEP_ROUNDING, /* rounds what is reported */
    EFFECT_STEPS
};

/* One scan of one sensor, at one home. */
struct effect_scan {
    const struct frame *frame;
    const struct sensor *sensor;
    double time_s;           /* of the measurement */
    struct echo_span echoes; /* those of ideal; none in noise */
    struct random_address
        address;      /* of the scan; frame_draw_address_in adds an echo or the leader of a cell */
    uint64_t effects; /* the set of effects that are simulated */
    uint64_t adding, receiving, measuring[EFFECT_STEPS]; /* those with these hooks */
    const double **constants; /* of each effect, by effect_id; NULL: no effect has any */
    double interference;      /* power of other radars over that of the sensor's own noise */
};

/* One echo on its way through the receiver. */
struct effect_reception {
    const struct echo *echo;        /* as ideal or add_echoes made it */
    double strength, amplitude;     /* linear, before and after the antenna */
    double range_m, range_rate_mps; /* as the radar reads them */
    double elevation_rad;           /* from which the wave arrives, as a mean by power */
    double phase_rad;
    double widening;         /* the response is 1 + widening times as wide as at rest */
    const double *constants; /* of the effect whose hook is called, from its hook begin */
};

/* Echoes that effects add to those of ideal. */
struct effect_echoes {
    LIST_OF(struct echo) list;
};

/* What a sensor measures of one cell, which may become a target. */
struct effect_measurement {
    const struct cell *cell;
    struct random_address address; /* of the cell's draws */
    struct antenna_pointers pointers;
    double range_m, azimuth_rad, elevation_rad, range_rate_mps;
    /* Standard deviations: of the added noise, later as the sensor estimates them. */
    double range_sigma_m, range_rate_sigma_mps, azimuth_sigma_rad, elevation_sigma_rad;
    double amplitude; /* linear */
    bool sign_undecided;
    bool looks_merged; /* do the pointers differ from those of a single echo by more than noise? */
    uint64_t effects;  /* the effects that changed one of the values */
    struct margins margins;
};

/* How random scenes draw a condition (traffic/random_traffic.h): evenly from low to high, or evenly
 * in its logarithm. */
enum effect_random_law { EFFECT_EVENLY, EFFECT_BY_LOGARITHM };

struct effect_random {
    /* The place among the draws, from 1. All come from one sequence, so a new condition takes the
     * number after the greatest one: what was drawn before stays. */
    int number;
    double share; /* of scenes that have it; 0: those that have the condition drawn before it */
    enum effect_random_law law;
    double low, high; /* of a number or a choice, or of the length of a list */
};

/* A member of the sensor, of the scene's conditions or of the frame. */
enum effect_owner { EFFECT_OWNER_SENSOR, EFFECT_OWNER_CONDITIONS, EFFECT_OWNER_FRAME };

struct effect_member {
    size_t offset, size;
    enum effect_owner owner;
    struct effect_random random; /* of a condition */
};

#define EFFECT_MEMBER(type, member)                                                                \
    .offset = offsetof(type, member), .size = sizeof(((type *)0)->member)
#define EFFECT_SENSOR(member) EFFECT_MEMBER(struct sensor, member), .owner = EFFECT_OWNER_SENSOR
#define EFFECT_CONDITION(member)                                                                   \
    EFFECT_MEMBER(struct conditions, member), .owner = EFFECT_OWNER_CONDITIONS
#define EFFECT_FRAME(member) EFFECT_MEMBER(struct frame, member), .owner = EFFECT_OWNER_FRAME

struct effect {
    /* Texts for people, all without a period. */
    const char *summary;       /* a sentence: "rain attenuates echoes" */
    const char *cause;         /* the members of documents that describe it */
    const char *left_out_when; /* a clause after "auto leaves it out when"; NULL: auto never does */
    const char *cost;          /* of simulating it, after "costs": "a draw per echo" */
    /* What of a scene calls for it, with {object}, {mirror} and {by}, which blocks an echo:
     * "{mirror} mirrors {object}"; NULL: what documents describe does so in every scene. */
    const char *scene;
    /* Of the parts of a target that the effect marked, those that `scene` is about; NULL: all
     * echoes of objects. */
    bool (*is_own)(const struct echo_id *part);

    enum effect_home home;
    unsigned reads; /* parts of the frame (enum frame_part) beside those of the home */
    bool of_paper;  /* does the model of Buehren and Yang have it? (MODEL 11) */

    /* The members, at most 4, that describe the effect. They do so for a scan if any bit of one is
     * set; with the hook `described` if that returns true. Ideal decides for its own effects. */
    struct effect_member members[5];
    bool (*described)(const struct effect_scan *scan);
    /* The purposes of its draws, at most 3: numbers of its own, or those of base/random.h. */
    enum random_purpose purposes[4];

    /* Works out constants of the scan, which lie in the frame's arena. The hook receive finds them
     * in reception->constants. */
    const double *(*begin)(const struct effect_scan *scan);

    /* In the sensor. Adds echoes by effect_add. */
    void (*add_echoes)(const struct effect_scan *scan, struct effect_echoes *echoes);
    /* In the sensor. The effect's share of scan->interference. */
    double (*interference)(const struct effect_scan *scan);
    /* In the sensor. Changes one echo; true if that changed amplitude, range or range rate. */
    bool (*receive)(const struct effect_scan *scan, struct effect_reception *reception);

    /* In noise. Does its part of a step; true if the effect belongs into the cell's label. */
    bool (*measure[EFFECT_STEPS])(const struct effect_scan *scan,
                                  struct effect_measurement *measurement);
};

/* effect_rain and all others. */
#define EFFECT(id, name) extern const struct effect effect_##name;
#include "frame/effects.def"

extern const struct effect *const effect_table[EFFECT_COUNT];
extern const char *const effect_homes[]; /* names of stages, by enum effect_home */

/* The effects that members of sensors describe, and no member of this one. */
uint64_t effect_missing(const struct sensor *sensor);

/* The effects that the scene alone describes, whatever the sensor. */
uint64_t effect_of_scenes(void);

/* Does the effect have members or the hook `described`? */
static inline bool effect_has_cause(const struct effect *effect)
{
    return effect->described != NULL || effect->members[0].size > 0;
}

/* The condition that random scenes draw as this number >= 1; NULL: they draw fewer. */
const struct effect_member *effect_random_condition(int number);

/* The parts of the frame that the effects of this home read if a scan of the sensor simulates
 * them. */
unsigned effect_reads(const struct frame *frame, const struct sensor *sensor,
                      const struct selection *selection, enum effect_home home);

/* Begins a scan at a home. Notes in the selection's log, for each effect of this home that has a
 * cause, whether the scan simulates it. */
struct effect_scan effect_begin(const struct frame *frame, const struct sensor *sensor,
                                const struct selection *selection, enum effect_home home);

/* Does the scan simulate an effect that has a cause? */
static inline bool effect_simulates(const struct effect_scan *scan, enum effect_id effect)
{
    return (scan->effects & EFFECT_BIT(effect)) != 0;
}

/* How long before the frame's time the measurement was. */
double effect_age_s(const struct effect_scan *scan);

/* Where the sensor was and how it moved at the measurement, in the frame's coordinates. The frame
 * must have its ego. */
struct sensor_pose effect_sensor_pose(const struct effect_scan *scan);

/* All echoes that effects add to those of the scan. */
struct echo_span effect_added_echoes(const struct effect_scan *scan);

/* Adds an echo, for the hook add_echoes, unless it is out of the sensor's range or view. */
void effect_add(const struct effect_scan *scan, struct effect_echoes *echoes,
                const struct echo *echo);

/* Multiplies an echo's strength and amplitude, for the hook receive. False if the factor is 1. */
bool effect_scale(struct effect_reception *reception, double factor);

/* One constant, for the hook begin. */
const double *effect_constant(const struct effect_scan *scan, double value);

/* The hook receive of an effect whose only constant is the attenuation of the air, in dB/km. */
bool effect_attenuate(const struct effect_scan *scan, struct effect_reception *reception);

/* Calls the hooks receive on one echo. Returns the set of effects that changed it. */
uint64_t effect_receive(const struct effect_scan *scan, struct effect_reception *reception);

/* The cell's values and margins, and the amplitude of its sum pointer. Without a scan (NULL) the
 * address and the standard deviations, which the steps need, are 0. */
struct effect_measurement effect_measurement_of(const struct effect_scan *scan,
                                                const struct cell *cell);

/* Calls the hooks of one step, and adds the effects that changed a value to its label. */
void effect_measure(const struct effect_scan *scan, enum effect_step step,
                    struct effect_measurement *measurement);

/* Echoes of rolling wheels and of limbs. A direct echo, the parent, stays as it is. Its parts are
 * echoes of the same object and reflector on the path wheel or limb, with numbers from 1. A part
 * has its parent's height, time, effects and margins, and a share of its cross section.
 *
 * Does the echo have such a part, and is its range rate by motion over ground above
 * MICRO_DOPPLER_STILL_MPS? No part is made of one that is slower. */
bool effect_has_moving_part(const struct echo *parent, enum moving_part part);

/* Has any echo of the scan such a part? */
bool effect_any_moving_part(const struct effect_scan *scan, enum moving_part part);

/* Part `number` at its parent's place and range rate, with factor times its parent's ERCS, less at
 * low speed (propagation/micro_doppler.h). Adds the effect to its label. */
struct echo effect_part_of_echo(const struct echo *parent, enum path path, int64_t number,
                                double factor, enum effect_id effect);
