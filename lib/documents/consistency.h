/* Checks that the figures of a sensor agree.
 *
 * Members need or exclude each other: a table of the antenna belongs to one of its patterns.
 * Physics relates figures of a radar: the cell in range rate takes a dwell, which must fit into the
 * cycle; the echo from the greatest range has a beat frequency, which the receiver must pass. A
 * check compares two figures. An impossible pair refuses the suite; glint --datasheet prints other
 * disagreements as doubts. */
#pragma once

#include "documents/suite.h"

enum consistency_unit {
    CONSISTENCY_S,
    CONSISTENCY_HZ,
    CONSISTENCY_M,
    CONSISTENCY_MPS,
    CONSISTENCY_RAD,
    CONSISTENCY_ONE,
};

enum consistency_kind {
    CONSISTENCY_LIMIT,  /* left above right is a doubt */
    CONSISTENCY_STRICT, /* left above right is impossible */
    CONSISTENCY_EQUAL,  /* a factor of more than 2 between them is impossible */
};

struct consistency {
    enum consistency_kind kind;
    enum consistency_unit unit;
    const char *left, *right; /* formulas of members of the document */
    double left_value, right_value;
    const char *member; /* to name in a refusal; NULL if there is none */
};

/* Figures that differ by less than this share count as equal, as they may be rounded. So many
 * digits tell all others apart. */
#define CONSISTENCY_SLACK 1e-6
#define DOUBT_ADVICE "; correct it, or go on if it is meant" /* ends a doubt of a figure */
enum { CONSISTENCY_MOST = 20, CONSISTENCY_DIGITS = 7 };

/* Refuses members that contradict each other or lack another one (DIAG_CONFIG); reads no derived
 * member. */
int consistency_members(const struct sensor *sensor, struct diag *diag);

/* Writes the checks of a sensor with derived members and tables; a check is left out if the
 * document lacks one of its sides. Returns their number, at most CONSISTENCY_MOST. */
size_t consistency_list(const struct sensor *sensor, struct consistency *checks);

bool consistency_holds(const struct consistency *check);

/* Refuses an impossible pair (DIAG_CONFIG). index: the place of the sensor in its suite. */
int consistency_check(const struct sensor *sensor, size_t index, struct diag *diag);

/* Range rates within +- this do not fold in the signal (MODEL 11.3); 0 without a waveform. */
double consistency_fold_mps(const struct sensor *sensor);
