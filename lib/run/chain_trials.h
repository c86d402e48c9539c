/* Chains tried on a sample of frames: distances and time.
 *
 * Every chain runs with several seeds. The k-th seed of frame f is its own seed + (16 f + k) 2^32,
 * modulo 2^64. The reference has the odd k, from 1; all other chains share the even k, from 2. So
 * the reference and the chains are independent, frames are too, and two chains use the same random
 * numbers where both draw them.
 *
 * The time of a frame is the CPU time to read and check its line, to run all stages, and to write
 * it. A chain may run beside another one: both take turns on every frame, so that load on the
 * machine slows both alike. */
#pragma once

#include "base/intern.h"
#include "run/progress.h"
#include "run/stage.h"
#include "score/energy_distance.h"
#include "score/relative_error.h"

enum { CHAIN_TRIALS_SEEDS = 6 };

enum { CHAIN_TRIALS_ENERGY = 1 << 0, CHAIN_TRIALS_ERROR = 1 << 1 };

struct sampled_frame {
    const char *line; /* without its newline */
    size_t length;
    uint64_t seed;
    int64_t place; /* in the stream, from 0 */
    size_t scene;  /* number in frame_sample.names */
};

/* A sample of a stream's frames, spread evenly over it. All frames are kept until there are more
 * than `most`. Then one frame is kept of each stretch of 2, later of 4, of 8 and so on. It is drawn
 * by its place in the stream alone, so that no sensor's cycle is in step with the sample. Frames
 * are kept as lines of their objects and reflectors. Zeroed but for arena and most before the first
 * frame. */
struct frame_sample {
    struct arena *arena;
    int64_t most; /* of the frames that are kept; at least 1 */
    int64_t seen, stride;
    LIST_OF(struct sampled_frame) list;
    struct intern names; /* of scenes, with their seeds */
};

int chain_trials_sample(struct frame_sample *sample, const struct frame *frame, struct diag *diag);

/* Reads a frame of the sample, in canonical order and checked. */
int chain_trials_read(const struct sampled_frame *sampled, struct frame *frame, struct diag *diag);

/* A chain, as it was measured. The first group of members says what it is, chain_trials_run
 * measures the second, and cost.h the third. */
struct tried_chain {
    const char *chain;                /* what tables call it: "auto, no ghosts" */
    const char *effects;              /* for glint-ideal */
    LIST_OF(const char *) programs;   /* after glint-ideal: "glint-sensor", "glint-noise" */
    const struct tried_chain *beside; /* runs beside it; NULL: it runs alone */

    double us_per_frame;        /* the median over seeds */
    double targets_per_scan;    /* the mean */
    struct energy_sample lists; /* the reference's and its own; not of the reference */
    double saved, saved_least;  /* share of the time of the chain beside it that it saves: the
                                 * median and the least over seeds */

    struct relative_error energy;            /* D from the reference */
    struct relative_error relative_distance; /* root of D over that of ideal echoes */
    unsigned present;                        /* CHAIN_TRIALS_ENERGY: it is not the reference itself;
                                              * CHAIN_TRIALS_ERROR: it has a relative distance */
    bool automatic;                          /* the whole chain, or that less some effects */
    uint64_t left_out; /* EFFECT_BITs of the effects that the frames call for and it leaves out */
};

/* The lists of one seed, scan by scan. */
struct trial_lists {
    LIST_OF(struct embedded_list) scans;
};

struct trial_scan {
    size_t scene;
    double share; /* weight in the mean over scenes of the means over their scans; 1 in sum */
};

/* The first group of members is the caller's, the rest zeroed. */
struct chain_trials {
    struct runner *runner; /* of the tool; its diag has the messages */
    const struct frame_sample *sample;
    const char *sensors; /* the suite */
    size_t expected;     /* chains, for the time left */

    struct progress progress; /* in frames of all chains and seeds */
    struct trial_lists reference[CHAIN_TRIALS_SEEDS];
    LIST_OF(struct trial_scan) scans;
    size_t scenes;           /* number of scenes with a scan */
    double *among_reference; /* distances between the reference's lists */
};

/* Runs the reference. Refuses (DIAG_DATA) frames in which no sensor measures, and cells without a
 * width. */
int chain_trials_begin(struct chain_trials *trials, struct tried_chain *reference);

/* Runs a chain and compares it with the reference. */
int chain_trials_run(struct chain_trials *trials, struct tried_chain *chain);

/* The energy distance of the reference from itself after its lists lost this share of all targets,
 * and the others were moved by so many cells in range; a list is not compared with its own. */
double chain_trials_spoiled(const struct chain_trials *trials, double lost, double off_cells);
