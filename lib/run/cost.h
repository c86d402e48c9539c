/* What accuracy costs on a sample of frames. glint-cost prints it.
 *
 * The chains are: ideal echoes; the paper's effects; all effects that the suite describes; the same
 * without one effect, for each effect that these frames call for; and finer models. Errors are
 * measured from a reference: the signal, if the suite has a waveform and this build has
 * glint-sensor-signal, or else all effects with other seeds. */
#pragma once

#include "run/chain_trials.h"

/* The chains that every table has, by their places; effects and finer models follow. */
enum { COST_IDEAL, COST_PAPER, COST_WHOLE };

struct cost {
    struct runner *runner;
    const char *no_signal; /* why the reference is another; NULL: it is the signal */
    bool brief;            /* no chains that leave out an effect */
    struct trial_bench bench;
    struct frame_sample sample;
    struct chain_trials trials;
    struct tried_chain reference;
    struct tried_chains chains; /* but for the reference */
    struct cost_table table;
};

/* Before the first frame: prepares the chain for a suite and among the effects that are asked for,
 * and finds the reference, and how many frames the sample has: those that are given or, for 0, 250,
 * and fewer where a signal has more than 128,000 samples a frame. */
int cost_begin(struct cost *cost, const struct trial_options *options, struct runner *runner,
               enum cost_reference reference, int64_t frames);

/* After the last frame: measures the chains, and fills the table. */
int cost_measure(struct cost *cost);

/* Do chains have errors? Not if ideal echoes cannot be told from the reference. */
bool cost_has_errors(const struct cost *cost);

/* The squared error of a chain less that of the whole chain; only where chains have errors. */
struct relative_error cost_added(const struct cost *cost, const struct tried_chain *chain);

/* Sets up the whole chain without these effects. */
struct tried_chain *cost_chain_without(struct cost *cost, uint64_t left_out);

/* Measures such a chain alone, for its error. 0, or -1 after a message. */
int cost_measure_error(struct cost *cost, struct tried_chain *chain);

/* Measures such a chain beside the whole one, for its time. 0, or -1 after a message. */
int cost_measure_time(struct cost *cost, struct tried_chain *chain);

/* Writes the table under lines that say what was measured; with a chosen chain a script of these as
 * comments, with the effects that it leaves out, and of its pipeline. */
void cost_write(const struct cost *cost, const struct tried_chain *chosen, struct text *text);

void cost_free(struct cost *cost);
