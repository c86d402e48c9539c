/* Distances of an entry from the borders of its decisions (MODEL 11.1).
 *
 * Echoes, cells, targets and lost echoes each have margins. A margin is the least distance from the
 * border of all decisions of one kind that the entry depends on, and is 0 on the border itself. It
 * is absent if there was no decision of that kind; in a struct of zeros all are. Margins of a lost
 * echo are the distances from not being lost for its reason. */
#pragma once

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
_Static_assert(MARGIN_LIMIT_M < 1U << 31, "a set of margins is an unsigned");

struct margins {
    double sight_m;           /* of range, view, visibility and sight lines; angles times range */
    double threshold_db;      /* between the amplitude and the threshold */
    double leader_db;         /* between two echoes of which the stronger opened a cell */
    double cell_edge;         /* from the border of a cell, in half cells */
    double sign;              /* sine of the phase between sum and delta; 0 is undecided */
    double limit_db, limit_m; /* from the list's limit, in the value that orders the list */
    unsigned present;         /* enum margin: the members that are not absent */
};

extern const struct record margins_record;

/* Lowers a margin to the value, or sets it if it is absent. A value that is not finite is ignored.
 */
void margins_note(struct margins *margins, enum margin which, double value);

/* Notes all margins of the others. */
void margins_merge(struct margins *margins, const struct margins *others);

/* |20 log10(a/b)| of two amplitudes a >= 0 and b > 0, at most 1e4; 1e4 for a = 0. */
double margins_between_db(double a, double b);

/* Notes the margin of an azimuth's sign. Only MONOPULSE_MAGNITUDE decides about a sign. */
void margins_note_sign(struct margins *margins, enum monopulse_estimator estimator,
                       struct antenna_pointers pointers);
