/* Distances of an entry from the borders of its decisions (MODEL 11.1).
 *
 * Echoes, cells, targets and lost echoes have margins. An entry depends on decisions of several
 * kinds. The margin of a kind is the least distance from the border of such a decision, 0 on the
 * border, and absent without any. In a struct of zeros all are absent. The margins of a lost echo
 * are its distances from not being lost. */
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
    double leader_db;         /* between two echoes, the stronger one opened a cell */
    double cell_edge;         /* from the border of a cell, in half cells */
    double sign;              /* sine of the phase between sum and delta; 0 is undecided */
    double limit_db, limit_m; /* from the list's limit, in a list by amplitude or by range */
    unsigned present;         /* enum margin: the members that are not absent */
};

extern const struct record margins_record;

/* Lowers a margin to the value, or sets an absent one. Ignores values that are not finite. */
void margins_note(struct margins *margins, enum margin which, double value);

/* Notes all margins of the others. */
void margins_merge(struct margins *margins, const struct margins *others);

/* |20 log10(a/b)| of two amplitudes a >= 0 and b > 0, at most 1e4; 1e4 for a = 0. */
double margins_between_db(double a, double b);

/* Notes the margin of an azimuth's sign, for MONOPULSE_MAGNITUDE alone. */
void margins_note_sign(struct margins *margins, enum monopulse_estimator estimator,
                       struct antenna_pointers pointers);
