/* What each effect is and does. One file of this folder has one effect: rain.c has effect_rain.
 * Their order is that of frame/effects.def.
 *
 * An effect acts at its home, the stage that simulates it, through hooks. The home begins every
 * scan of a sensor here; an effect with the hook `described` is simulated in the scan if the
 * documents describe its cause and the selection allows it, and its other hooks are called in the
 * order of the chain. An effect without `described` is geometry or a decision of modules of its
 * home (occlusion, merging), which note what they simulate; its file has what it says of itself and
 * names the module.
 *
 * Hooks read the frame, documents and values; they draw by address, and their memory is the frame's
 * arena. */
#ifndef EFFECT_H
#define EFFECT_H

#include "base/random.h"
#include "documents/suite.h"
#include "frame/frame.h"

enum effect_home { EFFECT_HOME_IDEAL, EFFECT_HOME_SENSOR, EFFECT_HOME_NOISE };
enum { EFFECT_CONSTANTS = 3 };

/* What is done to a cell in noise, in this order. Azimuth and rounding follow where the target list
 * comes from the signal too. */
enum effect_step {
    EFFECT_STEP_POINTERS,  /* on sum and delta channel, before the angle is read */
    EFFECT_STEP_DEVIATION, /* of range and range rate; asked for by EFFECT_STEP_RANGE */
    EFFECT_STEP_RANGE,     /* on range and range rate */
    EFFECT_STEP_AZIMUTH,   /* between the angle that is read and the one that is reported */
    EFFECT_STEP_ROUNDING,  /* of what is reported */
    EFFECT_STEPS
};

/* One scan of one sensor, at one home. */
struct effect_scan {
    const struct frame *frame;
    const struct sensor *sensor;
    double time_s;                 /* of the measurement */
    struct echo_span echoes;       /* of ideal; none in noise */
    struct random_address address; /* draw_address_in adds an echo, or the leader of a cell */
    uint64_t effects;              /* the set of effects that are simulated */
    uint64_t receiving, measuring[EFFECT_STEPS]; /* those of them that have the hook */
    double (*constants)[EFFECT_CONSTANTS];       /* of each effect that begins */
    double interference; /* power of other radars over that of the sensor's own noise */
};

/* One echo on its way to the receiver. */
struct effect_reception {
    const struct echo *echo;        /* as ideal has it */
    double strength, amplitude;     /* linear, before and behind the antenna */
    double range_m, range_rate_mps; /* as the radar reads them */
    double phase_rad;
};

/* Echoes that an effect adds to those of ideal. */
struct effect_echoes {
    LIST_OF(struct echo) list;
};

/* What is read off one cell. */
struct effect_measurement {
    const struct cell *cell;
    struct random_address address; /* of the cell's draws */
    struct antenna_pointers pointers;
    double range_m, azimuth_rad, range_rate_mps;
    double range_sigma_m, range_rate_sigma_mps; /* standard deviations */
    uint64_t effects;                           /* that changed one of the values */
};

struct effect {
    const char *summary;
    enum effect_home home;
    const char *cause; /* the member of a document that describes it */
    const char *bound; /* when auto leaves it out: "no object has rows"; "never: ..." if it does so
                          only where nothing describes it */
    const char *cost;  /* of simulating it */

    /* Is its cause described for this scan? */
    bool (*described)(const struct effect_scan *scan);
    /* Works out what is constant in the scan: scan->constants[its number]. */
    void (*begin)(const struct effect_scan *scan, double *constants);

    /* In the sensor: echoes that it adds, by effect_add; its part of scan->interference; and what
     * it does to one echo, true if that changes the amplitude, range or range rate. */
    void (*add_echoes)(const struct effect_scan *scan, struct effect_echoes *echoes);
    double (*interference)(const struct effect_scan *scan);
    bool (*receive)(const struct effect_scan *scan, struct effect_reception *reception);

    /* In noise: what it does to one cell, true if the cell's label shall name it. */
    bool (*measure[EFFECT_STEPS])(const struct effect_scan *scan,
                                  struct effect_measurement *measurement);
};

extern const struct effect *const effect_table[EFFECT_COUNT];
extern const char *const effect_homes[]; /* by enum effect_home: names of stages */

/* Begins a scan at a home, and notes in the selection's log which of the effects there that have
 * the hook `described` it simulates. */
struct effect_scan effect_begin(const struct frame *frame, const struct sensor *sensor,
                                const struct selection *selection, enum effect_home home);

static inline bool effect_simulates(const struct effect_scan *scan, enum effect_id effect)
{
    return (scan->effects & EFFECT_BIT(effect)) != 0;
}

/* All that is added to the scan's echoes. */
struct echo_span effect_added_echoes(const struct effect_scan *scan);

/* Adds an echo, for the hook add_echoes; one out of the sensor's range or view is not made. */
void effect_add(const struct effect_scan *scan, struct effect_echoes *echoes,
                const struct echo *echo);

/* Multiplies an echo's amplitude, for the hook receive. False if the factor is 1. */
bool effect_scale(struct effect_reception *reception, double factor);

/* Does to one echo what all effects in the sensor do; the set of those that changed it. */
uint64_t effect_receive(const struct effect_scan *scan, struct effect_reception *reception);

/* The exact values of a cell, before any step. */
struct effect_measurement effect_measurement_of(const struct effect_scan *scan,
                                                const struct cell *cell);

/* One step of noise on a cell; adds to the label the effects that changed it. */
void effect_measure(const struct effect_scan *scan, enum effect_step step,
                    struct effect_measurement *measurement);

#endif
