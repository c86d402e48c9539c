/* How close the decisions behind one entry of a frame came to going the other way (MODEL 11.1).
 *
 * An echo, a cell, a target and a lost echo each carry one. A member is the least over all
 * decisions of its kind that the entry rests on, 0 on the border itself, and absent where there was
 * no such decision: a struct of zeros has none. For what is listed it says how far it was from
 * changing, for what is lost how far from not being lost for its reason. */
#ifndef MARGINS_H
#define MARGINS_H

#include "radar/monopulse.h"
#include "text/field.h"

enum margin {
    MARGIN_SIGHT = 1 << 0,
    MARGIN_THRESHOLD = 1 << 1,
    MARGIN_LEADER = 1 << 2,
    MARGIN_CELL_EDGE = 1 << 3,
    MARGIN_SIGN = 1 << 4,
    MARGIN_LIMIT_DB = 1 << 5,
    MARGIN_LIMIT_M = 1 << 6,
};

struct margins {
    double sight_m;           /* of what ideal decided: angles times range */
    double threshold_db;      /* of the amplitude to the threshold */
    double leader_db;         /* between echoes of which the stronger opened a cell */
    double cell_edge;         /* in half cells */
    double sign;              /* sine of the phase between sum and delta: 0 undecided, 1 clear */
    double limit_db, limit_m; /* to the list's limit, in what orders the list */
    unsigned present;         /* enum margin: the members that are there */
};

extern const struct record margins_record;

/* Keeps the least. A value that is not finite is no margin. */
void margins_note(struct margins *margins, enum margin which, double value);

/* Keeps the least of each member. */
void margins_merge(struct margins *margins, const struct margins *others);

/* |20 log10(a/b)| of two amplitudes >= 0, b positive; at most 1e4, which also stands for a = 0. */
double margins_between_db(double a, double b);

/* How clear the sign of an azimuth was, which only the magnitude rule decides
 * (MONOPULSE_MAGNITUDE).
 */
void margins_note_sign(struct margins *margins, enum monopulse_estimator estimator,
                       struct antenna_pointers pointers);

#endif
