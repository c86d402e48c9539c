/* What accuracy costs on a sample of frames. glint-plan --cost prints it.
 *
 * The ladder of chains begins with ideal echoes, the paper's effects and all that the suite
 * describes; leaves out, one at a time, the effects that these frames call for; and ends with finer
 * models. Errors are from a reference: the signal where the suite has a waveform and the program
 * glint-sensor-signal lies beside this one, else all that the suite describes, with other seeds. */
#ifndef COST_H
#define COST_H

#include "run/ladder.h"
#include "text/field.h"

/* The stages of which chains are made. */
struct cost_stages {
    const struct stage *extract, *ideal, *sensor, *noise, *perfect, *none, *smear;
};

enum { COST_ENERGY = 1 << 0, COST_ERROR = 1 << 1 };

/* A chain, as it was measured. */
struct cost_chain {
    const char *chain; /* what tables call it: "auto, no ghosts" */
    const char *effects;
    LIST_OF(const char *) programs; /* after glint-ideal: "glint-sensor", "glint-noise" */
    double us_per_frame, targets_per_scan;
    struct relative_error energy, error; /* D from the reference; over that of ideal echoes */
    unsigned present;                    /* COST_ENERGY: it is not the reference itself;
                                          * COST_ERROR: ideal echoes are told from the reference */
    bool automatic;                      /* the whole chain, but for some effects */
    uint64_t left_out; /* EFFECT_BITs of the effects that the frames call for and it leaves out */
    struct energy_blocks blocks;
};

enum cost_reference { COST_SIGNAL, COST_ALL };
extern const char *const cost_references[];

struct cost {
    const char *suite;
    enum cost_reference reference;
    const char *signal;    /* the path of its program; NULL: there is none */
    const char *no_signal; /* why the reference is another; NULL: it is the signal */
    int64_t frames, seen_frames, scenes, blocks;
    LIST_OF(struct cost_chain) chains; /* the first is that of ideal echoes */
    const char *chosen;                /* the name of the one that was found; NULL: none was */
    bool brief;                        /* no chains that leave out an effect */
    const char *whole;        /* what tables call the chain with all effects that are allowed */
    uint64_t allowed, needed; /* EFFECT_BITs of what was asked for, and of what frames call for */
    struct runner *runner;
    struct cost_stages stages;
    struct frame_sample sample;
    struct ladder ladder;
};

extern const struct record cost_record;

/* Before the first frame: finds the reference, and how many frames the sample has at most: those
 * that are given or, for 0, 250, and fewer where a signal has more than 128,000 samples a frame.
 * Runner, suite, stages, reference and brief are set. Fails without the suite. */
int cost_begin(struct cost *cost, int64_t frames);

/* After the last frame: measures the ladder. allowed and needed are set. */
int cost_measure(struct cost *cost);

/* How much more error a chain has than the whole chain; only where ideal echoes have one. */
struct relative_error cost_added(const struct cost *cost, const struct cost_chain *chain);

/* Finds the fastest chain whose error is at most this with its whole interval, or the chain of the
 * least error that takes at most this time. Effects are left out one by one, first those that save
 * the most time for the error that they add, and every chain is measured. NULL after a message: no
 * chain holds the bound (DIAG_DATA). */
enum cost_bound { COST_BOUND_ERROR, COST_BOUND_US };
const struct cost_chain *cost_find(struct cost *cost, enum cost_bound bound, double most);

#endif
