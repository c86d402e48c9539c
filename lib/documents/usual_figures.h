/* Figures of a sensor that no automotive radar has.
 *
 * Such a figure is possible, but probably in another unit: a cycle_s of 40 is one in milliseconds.
 * The bounds are wide: published radars of 24 to 140 GHz lie within them, most by a factor of two.
 */
#pragma once

#include "documents/suite.h"

struct usual_figure {
    const char *member; /* of the sensor's document */
    const char *unit;   /* with a space before it */
    double value;       /* in this unit, and outside of least to most */
    double least, most;
};

enum { USUAL_FIGURES_MOST = 40 };

/* Writes the figures of a sensor that are not usual, in the order of the document's members; absent
 * members and zeros are usual. Returns their number, at most USUAL_FIGURES_MOST. */
size_t usual_figures_list(const struct sensor *sensor, struct usual_figure *unusual);
