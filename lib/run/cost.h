/* What accuracy costs on a sample of frames. glint-cost prints it.
 *
 * The chains are: ideal echoes; the paper's effects; all effects that the suite describes; the same
 * without one effect, for each effect that these frames call for; and finer models. Errors are
 * measured from a reference: the signal, if the suite has a waveform and this build has
 * glint-sensor-signal, or else all effects with other seeds. */
#pragma once

#include "run/chain_trials.h"
#include "text/field.h"

enum cost_reference { COST_SIGNAL, COST_ALL };
extern const char *const cost_references[];

/* Errors (relative distances) of the reference's own lists after they lost 30 % of all targets,
 * half of them, or after every range was moved by one cell. 0 where chains have no errors. */
struct cost_scale {
    double lost_30_percent, lost_half, one_cell_off;
};

struct cost {
    const char *suite;
    enum cost_reference reference;
    const char *no_signal; /* why the reference is another; NULL: it is the signal */
    int64_t frames, seen_frames, scenes, seeds;
    struct cost_scale scale;
    LIST_OF(struct tried_chain) chains; /* the first is that of ideal echoes */
    const char *chosen;                 /* the name of the one that was found; NULL: none was */
    bool brief;                         /* no chains that leave out an effect */
    bool bounded;                       /* a bound follows; chains run beside the whole one */
    const char *whole;        /* what tables call the chain with all effects that are allowed */
    uint64_t allowed, needed; /* EFFECT_BITs of what was asked for, and of what frames call for */
    struct runner *runner;
    struct frame_sample sample;
    struct chain_trials trials;
};

extern const struct record cost_record;

/* Before the first frame: finds the reference, and how many frames the sample has at most: those
 * that are given or, for 0, 250, and fewer where a signal has more than 128,000 samples a frame.
 * Runner, suite, reference, brief and bounded are set. Fails without the suite. */
int cost_begin(struct cost *cost, int64_t frames);

/* After the last frame: measures the chains. allowed and needed are set. */
int cost_measure(struct cost *cost);

/* The squared error of a chain less that of the whole chain; only where chains have errors. */
struct relative_error cost_added(const struct cost *cost, const struct tried_chain *chain);

/* Finds the fastest chain with an interval of the error that ends at most at this bound, or the
 * chain of the least error that takes at most this time. Leaves out one effect after the other, in
 * the order of the squared error added for the time saved, and measures each chain; effects that do
 * not save time with every seed stay. NULL after a message: no chain holds the bound (DIAG_DATA).
 */
enum cost_bound { COST_BOUND_ERROR, COST_BOUND_US };
const struct tried_chain *cost_find(struct cost *cost, enum cost_bound bound, double most);

/* A table: a line for each chain, under lines that say what was measured. */
void cost_write_table(const struct cost *cost, struct text *text);

/* A script: as comments the chain's time and error, and for every effect that it leaves out what
 * that saves and adds; then its pipeline. */
void cost_write_pipeline(const struct cost *cost, const struct tried_chain *chain,
                         struct text *text);
