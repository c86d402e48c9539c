/* Hard cases: scenes built so that a decision of the chain turns on the last digits (NUMERICS C4).
 *
 * Each case draws a sensor of the suite and places a few objects in its view:
 *
 *     threshold   one to three points in one cell whose amplitudes sum to the threshold
 *     tie         two points of equal amplitude, near enough for one cell or far apart
 *     range, rate two or three points half a cell apart from one to the next
 *     symmetry    two points at mirrored azimuths, in one cell
 *     view        a point on boresight or at the border of the field of view
 *     reach       a point at the least or the largest range
 *     touch       a point, and perhaps an object, just seen past another's corner, or along its
 *                 side
 *     facing      a car's point at an edge of its visibility range
 *     foot        a car's rear whose foot is at its end
 *     against     a point at the rear of a car, on either side of it
 *
 * Each up to a margin, which is 0 or down to a millionth of the most: amplitudes 1e-3, distances
 * in a cell and facing angles 1e-6, borders of view 1e-7, others 1e-9 to 1e-8. Built for scans at
 * the end of the frame. */
#ifndef ADVERSARIAL_TRAFFIC_H
#define ADVERSARIAL_TRAFFIC_H

#include "documents/suite.h"
#include "traffic/random_traffic.h"

/* Appends one to three cases to the frame, which has its ego, by draws for snapshot number. Ids
 * are "CASE-NUMBER-OBJECT", for instance "touch-2-1". */
void adversarial_traffic_add(const struct random_traffic *scene, const struct suite *suite,
                             int64_t number, struct frame *frame);

#endif
