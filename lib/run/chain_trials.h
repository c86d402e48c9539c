/* How far chains are from a reference, on sampled frames.
 *
 * Every chain runs with several seeds, one in each round of its times. The k-th seed of frame f is
 * its own seed + (16 f + k) 2^32, modulo 2^64. The reference has the odd k, from 1; all other
 * chains share the even k, from 2. So the reference and the chains are independent, frames are too,
 * and two chains use the same random numbers where both draw them. */
#pragma once

#include "run/cost_table.h"
#include "run/progress.h"
#include "score/energy_distance.h"

enum { CHAIN_TRIALS_SEEDS = TRIAL_ROUNDS };

/* The lists of one seed, scan by scan. */
struct trial_lists {
    LIST_OF(struct embedded_list) scans;
};

/* The first members are the caller's, and the name in row; lists are those of the reference and its
 * own, latest those of the frame at hand. The caller may complete the row. */
struct tried_chain {
    struct trial *trial, own; /* one of the bench, or its own */
    bool automatic;           /* the whole chain, or that less some effects */
    uint64_t left_out; /* EFFECT_BITs of the effects that frames call for and it leaves out */
    struct cost_chain row;
    struct trial_time saved; /* of the whole chain's time */
    struct energy_sample lists;
    struct trial_lists latest[CHAIN_TRIALS_SEEDS];
};

struct trial_scan {
    size_t scene;
    double share; /* weight in the mean over scenes of the means over their scans; 1 in sum */
};

/* The first group of members is the caller's, the rest zeroed. */
struct chain_trials {
    struct trial_bench *bench;
    const struct frame_sample *sample;

    struct progress progress; /* in frames of all seeds */
    struct trial_lists reference[CHAIN_TRIALS_SEEDS];
    LIST_OF(struct trial_scan) scans;
    size_t scenes;           /* number of scenes with a scan */
    double *among_reference; /* distances between the reference's lists; NULL: it runs */
    size_t scene;            /* of the frame at hand */
    struct arena kept;       /* of the lists of the frame at hand */
};

struct tried_chains {
    LIST_OF(struct tried_chain *) list;
};

/* Runs the reference, of which row.targets_per_scan is set. Refuses (DIAG_DATA) frames in which no
 * sensor measures, and cells without a width. */
int chain_trials_begin(struct chain_trials *trials, struct tried_chain *reference);

/* Runs chains in turns, in a pass of this kind (trial.h), and compares them with the reference. If
 * trials without an effect are among them, the first is the whole chain. */
int chain_trials_run(struct chain_trials *trials, const struct tried_chains *chains, unsigned pass);

/* Runs a chain in turns with the whole one for its time alone: its lists are not kept. */
int chain_trials_time(struct chain_trials *trials, struct tried_chain *chain);

/* The energy distance of the reference from itself after its lists lost this share of all targets,
 * and the others were moved by so many cells in range; a list is not compared with its own. */
double chain_trials_spoiled(const struct chain_trials *trials, double lost, double off_cells);
