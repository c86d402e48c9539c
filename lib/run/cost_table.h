/* The table of glint-plan and glint-cost: chains and effects.
 *
 * A chain has its time and its error. An effect has what leaving it out alone does: lists that
 * change, time saved, squared error added. A plan has no errors. */
#pragma once

#include "run/trial.h"
#include "score/relative_error.h"
#include "text/field.h"

enum cost_reference { COST_SIGNAL, COST_ALL };
extern const char *const cost_table_references[];

enum { COST_ENERGY = 1 << 0, COST_ERROR = 1 << 1 }; /* members that are present */

struct cost_chain {
    const char *chain;                      /* "auto" */
    const char *effects;                    /* for glint-ideal */
    LIST_OF(const char *) programs;         /* after glint-ideal: "glint-sensor", "glint-noise" */
    double us_per_frame, us_least, us_most; /* median, and ends over rounds */
    double targets_per_scan;
    struct relative_error energy, relative_distance;
    unsigned present;
    bool close; /* a part of the whole chain, not faster in all rounds, nor surely slower */
};

struct cost_effect {
    enum effect_id effect;
    int64_t lists_changed;
    struct trial_time saved; /* of a frame */
    struct relative_error squared_error_added;
    unsigned present;          /* COST_ERROR or 0 */
    const char *called_for_by; /* in the scene's names, or in the documents' words */
    int64_t lists_called;      /* lists of which the scene's name is said; 0: documents' words */
};

/* Errors (relative distances) of the reference's own lists after they lost 30 % of all targets,
 * half of them, or after every range was moved by one cell. 0 where chains have no errors. */
struct cost_scale {
    double lost_30_percent, lost_half, one_cell_off;
};

struct cost_table {
    const char *suite;
    const char *vehicles; /* that objects were extracted with; NULL: the paper's, or none were */
    int reference;        /* enum cost_reference; -1: chains have no errors */
    int64_t frames, seen_frames, scenes, seeds, lists;
    int64_t timed_frames;
    struct cost_scale scale;
    const char *chosen;    /* the chain that is printed as a pipeline; NULL: none is */
    const char *no_signal; /* why the reference is another; NULL: nothing is said of it */
    LIST_OF(struct cost_chain) chains;
    size_t whole; /* the one of which effects leave out one each */
    LIST_OF(struct cost_effect) effects;
};

extern const struct record cost_table_record;

/* Completes the row of a chain, which has its name, but for its error: its time is that of the
 * whole chain less what it saves. A part of the whole chain is surely slower if it is so in all
 * rounds by more than the whole chain's rounds lie apart; else it has at most the whole time. */
void cost_table_chain(struct cost_chain *chain, const struct trial *trial, struct trial_time whole,
                      struct trial_time saved, bool part, struct arena *arena);

/* The same of the whole chain, which takes this time. */
void cost_table_whole(struct cost_chain *chain, const struct trial *trial, struct trial_time time,
                      struct arena *arena);

/* The row of the trial without an effect, without its error. */
struct cost_effect cost_table_effect(const struct trial_bench *bench, enum effect_id effect);

/* Takes the set of vehicles from a bench that has run. */
void cost_table_take_vehicles(struct cost_table *table, const struct trial_bench *bench);

/* Writes the number of scenes, their vehicles and the suite. */
void cost_table_write_scenes(const struct cost_table *table, struct text *text);

/* Writes the rows of chains and of these effects (EFFECT_BITs); mark stands before every line: "#
 * ". */
void cost_table_write(const struct cost_table *table, const char *mark, uint64_t shown,
                      struct text *text);

/* Writes what the chain takes instead of the whole one, with which error, and its pipeline:
 * extract, ideal with these effects, and the other programs, which get a suite that is a path as
 * well. */
void cost_table_write_pipeline(const struct cost_table *table, const struct cost_chain *chain,
                               const struct cost_chain *whole, struct text *text);
