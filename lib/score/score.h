/* Scores of target lists and tracks against the truth.
 *
 * A tally takes pairs of lists, one after the other, and keeps every value, so that quantiles and
 * distributions over all of them are exact. A score is computed from one or more tallies. */
#pragma once

#include "base/text.h"
#include "score/tracker_difference.h"
#include "text/field.h"

enum score_component {
    SCORE_RANGE,
    SCORE_AZIMUTH,
    SCORE_RANGE_RATE,
    SCORE_AMPLITUDE, /* up to here of targets, below of tracks */
    SCORE_POSITION,  /* distance of track and object, and size of their difference in velocity */
    SCORE_VELOCITY,
    SCORE_NEES, /* squared distance over the track's covariance; 2 on average if it is right */
    SCORE_COMPONENTS,
};

enum {
    SCORE_PAIRS = 1 << 0,
    SCORE_LISTS = 1 << 1,
    SCORE_DIFFERENCE = 1 << 2,
    SCORE_SCANS = 1 << 3,
};

/* The differences in one component, in its unit. */
struct score_differences {
    double mean, rms;   /* of listed less true, over the pairs */
    double p95, max;    /* of their sizes; p95 is the least that 95 % of them do not exceed */
    double wasserstein; /* between the two lists, unpaired */
    unsigned present;   /* SCORE_PAIRS: there are pairs; SCORE_LISTS: no list is empty */
};

struct score {
    const char *sensor; /* NULL: all sensors */
    int64_t scans;      /* pairs of lists: of one sensor in one frame, or the tracks of one frame */
    int64_t true_scans, listed_scans; /* that one side alone made, which are not compared */
    int64_t true_count, listed_count, pair_count, missed_count, false_count;
    /* Over the scans: mean, root mean square and maximum of GOSPA, the parts of its mean square,
     * and the mean of OSPA. */
    double gospa, gospa_rms, gospa_max;
    double gospa_localisation, gospa_missed, gospa_false;
    double ospa;
    double nees_low, nees_high; /* 95 % of mean NEES of as many pairs lie between; 0: few pairs */
    struct score_differences differences[SCORE_COMPONENTS];
    unsigned present; /* SCORE_SCANS: there are scans, so GOSPA and OSPA have means */
};

/* The scores of one frame: of targets by sensor, of tracks all together. */
struct score_line {
    const char *scene;
    int64_t frame;
    double time_s;
    int64_t id_switches; /* of tracks */
    struct score all;    /* of tracks */
    LIST_OF(struct score) sensors;
};

/* The scores of a stream. */
struct score_summary {
    int64_t frames;
    double cutoff, azimuth_cell_rad; /* of targets; azimuth_cell_rad 0: a twentieth of each field of
                                      * view */
    double cutoff_m;                 /* of tracks */
    int64_t id_switches;
    struct score all;
    LIST_OF(struct score) sensors;
    struct tracker_difference difference; /* of tracks */
    unsigned present;                     /* SCORE_DIFFERENCE */
};

extern const struct record score_record;
extern const struct record score_line_record, score_summary_record;
extern const struct record score_track_line_record, score_track_summary_record;

struct score_values {
    LIST_OF(double) list;
};

enum score_kind {
    SCORE_ERROR,  /* listed less true value, of pairs */
    SCORE_TRUTH,  /* values of the true list, paired or not */
    SCORE_LISTED, /* values of the scored list, paired or not */
    SCORE_KINDS,
};

struct score_tally {
    const char *sensor;
    int64_t scans, true_scans, listed_scans, truths, listed, pairs;
    double gospa_sum, gospa_max, ospa_sum;
    double localisation, missed_part, false_part; /* sums over the scans */
    struct score_values values[SCORE_KINDS][SCORE_COMPONENTS];
};

/* One tally per sensor, in the order in which sensors first come. */
struct score_tallies {
    LIST_OF(struct score_tally) list;
};

/* Adds one pair of lists to the counts and sums. squares is the sum of d^2 over its pairs. */
void score_add_scan(struct score_tally *tally, double squares, size_t pairs, size_t truths,
                    size_t listed, double cutoff);

/* Adds all values, counts and sums of the other tally. */
void score_merge(struct score_tally *tally, const struct score_tally *other, struct arena *arena);

/* Merges a scan's tally into that of its sensor. */
void score_merge_sensor(struct score_tallies *tallies, const struct score_tally *scan,
                        struct arena *arena);

/* The score of several tallies together, under the sensor's name of the first. Without any scan all
 * counts are 0, and nothing else is present. */
struct score score_of(const struct score_tally *tallies, size_t count, struct arena *arena);

/* Fills in the summary's scores, in ascending order of the sensors' names. */
void score_summarize(struct score_tallies *tallies, struct score_summary *summary,
                     struct arena *arena);

/* Mean, root mean square, 95 % and maximum of count > 0 differences, in any order, which are
 * overwritten. */
struct score_differences score_statistics(double *differences, size_t count, struct arena *arena);

/* The Wasserstein-1 distance of two samples that are not paired: the area between their cumulative
 * distributions, which is how far the values of one must move on average to become those of the
 * other. Counts > 0; both samples are sorted on the way. A sample and the same shifted by s are |s|
 * apart. */
double score_wasserstein(double *one, size_t one_count, double *other, size_t other_count,
                         struct arena *arena);

/* Writes a summary as a table for people, with a column for each sensor, and for all together where
 * there are several, and a row, with its unit, for every figure that any of them has. Angles are in
 * degrees. Missed items are also in per cent of the true ones, false ones in per cent of the listed
 * ones; "-" stands where there are none. */
void score_table_summary(const struct score_summary *summary, struct text *text,
                         struct arena *arena);
void score_table_track_summary(const struct score_summary *summary, struct text *text);
