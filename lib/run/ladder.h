/* Chains of stages on a sample of frames: distances, time.
 *
 * Every chain runs with several seeds. The k-th seed of a frame is its own seed + k 2^32, modulo
 * 2^64. The reference has the odd k, from 1; all other chains share the even k, from 2. So
 * reference and chains are independent, and chains differ from each other by no draw that both
 * make.
 *
 * Times are CPU time of all that `glint` does with a frame: its line is read and checked, goes
 * through all stages, and is written. */
#pragma once

#include "run/frame_sample.h"
#include "run/progress.h"
#include "run/stage.h"
#include "score/list_embedding.h"
#include "score/relative_error.h"

enum { LADDER_SEEDS = 4 };

enum { LADDER_ENERGY = 1 << 0, LADDER_ERROR = 1 << 1 };

/* A chain, as it was measured. The first group of members says what it is, ladder_climb measures
 * the second, and cost.h the third. */
struct ladder_chain {
    const char *chain;              /* what tables call it: "auto, no ghosts" */
    const char *effects;            /* for glint-ideal */
    LIST_OF(const char *) programs; /* after glint-ideal: "glint-sensor", "glint-noise" */

    double us_per_frame;         /* the median over seeds */
    double targets_per_scan;     /* the mean */
    struct energy_blocks blocks; /* distances from the reference's lists; not of the reference */

    struct relative_error energy, error; /* D from the reference; over that of ideal echoes */
    unsigned present;                    /* LADDER_ENERGY: it is not the reference itself;
                                          * LADDER_ERROR: ideal echoes are told from it */
    bool automatic;                      /* the whole chain, but for some effects */
    uint64_t left_out; /* EFFECT_BITs of the effects that the frames call for and it leaves out */
};

/* The lists of one seed, scan by scan. */
struct ladder_lists {
    LIST_OF(struct embedded_list) scans;
};

struct ladder_scan {
    size_t scene, block;
    double share; /* of its block */
};

/* The first group of members is the caller's, the rest zeroed. */
struct ladder {
    struct runner *runner; /* of the tool; its diag has the messages */
    const struct frame_sample *sample;
    const char *sensors; /* the suite */
    size_t expected;     /* chains, for the time left */

    struct progress progress; /* in frames of all chains and seeds */
    struct ladder_lists reference[LADDER_SEEDS];
    LIST_OF(struct ladder_scan) scans;
    size_t blocks;        /* that have a scan */
    double *block_weight; /* of each: scans over those of its scene, over scenes */
};

/* Runs the reference. Refuses (DIAG_DATA) frames in which no sensor measures, and cells without a
 * width. */
int ladder_begin(struct ladder *ladder, struct ladder_chain *reference);

/* Runs a chain and compares it with the reference. */
int ladder_climb(struct ladder *ladder, struct ladder_chain *chain);
