/* Whether the figures of a sensor agree with each other.
 *
 * A radar's physics binds figures: the cell in range rate takes a dwell that must fit the cycle,
 * the echo from the farthest range has a beat frequency that the receiver must pass. A check
 * compares two of them. Some disagreements are impossible, and the suite is refused; others are
 * doubts, which glint --datasheet prints with both sides. */
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
    CONSISTENCY_EQUAL,  /* a factor of more than 2 between them is a doubt */
};

struct consistency {
    enum consistency_kind kind;
    enum consistency_unit unit;
    const char *left, *right; /* what they are, by members of the document */
    double left_value, right_value;
    const char *member; /* the one that the left side comes from, if it is strict; the right side
                         * is a member itself */
};

enum { CONSISTENCY_MOST = 20 };

/* The checks of a sensor with its derived members, of which the document has both sides: their
 * number, at most CONSISTENCY_MOST. */
size_t consistency_list(const struct sensor *sensor, struct consistency *checks);

bool consistency_holds(const struct consistency *check);

/* Refuses the impossible (DIAG_CONFIG), with the paths of both members; index is the sensor's in
 * its suite. */
int consistency_check(const struct sensor *sensor, size_t index, struct diag *diag);

/* Range rates within +- this are read right from the signal of the waveform (MODEL 11.3); 0 without
 * one. */
double consistency_fold_mps(const struct sensor *sensor);

/* The 3 dB width of a beam on boresight: of the row of elements, where the waveform has one, else
 * of the antenna's sum pattern, two ways. */
double consistency_beam_rad(const struct sensor *sensor);
