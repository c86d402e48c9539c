/* Scores: how lists differ from the truth, over one pair of lists or many.
 *
 * A tally takes in pairs of lists, one after the other, and keeps every value, so that quantiles
 * and distributions over all of them are exact; a score is what is read off it. */
#ifndef SCORE_H
#define SCORE_H

#include "field.h"
#include "gospa.h"

enum score_component {
    SCORE_RANGE,
    SCORE_AZIMUTH,
    SCORE_RANGE_RATE,
    SCORE_AMPLITUDE,
    SCORE_COMPONENTS,
};

enum { SCORE_PAIRS = 1 << 0, SCORE_LISTS = 1 << 1 };

/* Of one component, in its unit. */
struct score_differences {
    double mean, rms, p95, max; /* listed less true, over the pairs */
    double wasserstein;         /* of the two lists, unpaired */
    unsigned told;              /* SCORE_PAIRS, SCORE_LISTS: there were any */
};

struct score {
    const char *sensor; /* NULL: all of them */
    int64_t scans;      /* pairs of lists */
    int64_t true_count, listed_count, pair_count, missed_count, false_count;
    /* Over the scans: mean, root mean square and maximum of GOSPA, the parts of its mean square,
     * and the mean of OSPA. */
    double gospa, gospa_rms, gospa_max;
    double gospa_localisation, gospa_missed, gospa_false;
    double ospa;
    struct score_differences differences[SCORE_COMPONENTS];
};

/* The scores of one frame, and of a stream. */
struct score_line {
    const char *scene;
    int64_t frame;
    double time_s;
    LIST_OF(struct score) sensors;
};

struct score_summary {
    int64_t frames, true_frames, listed_frames; /* on both sides, on one alone */
    double cutoff, azimuth_cell_rad;
    struct score all;
    LIST_OF(struct score) sensors;
};

extern const struct record score_line_record, score_summary_record;

struct score_values {
    LIST_OF(double) list;
};

struct score_tally {
    const char *sensor;
    int64_t scans, truths, listed, pairs;
    double gospa_sum, gospa_max, ospa_sum;
    double localisation, missed_part, false_part; /* sums */
    struct score_values apart[SCORE_COMPONENTS];  /* of pairs */
    struct score_values truth[SCORE_COMPONENTS], list[SCORE_COMPONENTS];
};

/* Counts one pair of lists. squares is the sum of d^2 over its pairs. */
void score_count(struct score_tally *tally, double squares, size_t pairs, size_t truths,
                 size_t listed, double cutoff);

void score_add(struct score_values *values, double value, struct arena *arena);

/* Adds all that the other tally holds. */
void score_merge(struct score_tally *tally, const struct score_tally *other, struct arena *arena);

/* What a tally of at least one scan amounts to. */
struct score score_of(const struct score_tally *tally, struct arena *arena);

#endif
