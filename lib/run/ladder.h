/* Chains of stages on a sample of frames: distances, time.
 *
 * Every chain runs with several seeds. The k-th seed of a frame is its own seed + k 2^32, modulo
 * 2^64. The reference has the odd k, from 1; all other chains share the even k, from 2. So
 * reference and chains are independent, and chains differ from each other by no draw that both
 * make.
 *
 * Times are CPU time of all that `glint` does with a frame: its line is read and checked, goes
 * through all stages, and is written. A program that stands in for stages adds its own. */
#ifndef LADDER_H
#define LADDER_H

#include "run/frame_sample.h"
#include "run/stage.h"
#include "score/list_embedding.h"
#include "score/relative_error.h"

enum { LADDER_SEEDS = 4 };

/* A chain, and what ladder_climb measures of it. */
struct ladder_chain {
    const char *effects; /* for glint-ideal */
    const struct stage *sensor, *noise;
    const char *program;         /* path of one that stands in for both; NULL: none does */
    double us_per_frame;         /* the median over seeds */
    double targets_per_scan;     /* the mean */
    struct energy_blocks blocks; /* distances from the reference's lists; not of the reference */
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
    const struct stage *extract, *ideal;

    struct ladder_lists reference[LADDER_SEEDS];
    LIST_OF(struct ladder_scan) scans;
    size_t blocks;        /* that have a scan */
    double *block_weight; /* of each: scans over those of its scene, over scenes */
    double *apart;        /* the distances of the reference's lists, a matrix for each scan */
};

/* Runs the reference. Refuses (DIAG_DATA) frames in which no sensor measures, and cells without a
 * width. */
int ladder_begin(struct ladder *ladder, struct ladder_chain *reference);

/* Runs a chain and compares it with the reference. */
int ladder_climb(struct ladder *ladder, struct ladder_chain *chain);

#endif
