/* Traffic in which decisions turn on the last digits.
 *
 * Each case draws a sensor of the suite and places a few objects in its view:
 *
 *     threshold   one to three points in one cell whose amplitudes sum to the first threshold
 *     tie         two points of equal amplitude, near enough for one cell or far apart
 *     range, rate two or three points half a cell apart from one to the next
 *     symmetry    two points at mirrored azimuths, in one cell
 *     view        a point on boresight or at the border of the field of view
 *     reach       a point at the least or the largest range
 *     touch       a point, and perhaps an object, just seen past the corner of another object, or
 *                 along its side
 *     facing      a point reflector of a car at an edge of its visibility range
 *     foot        a car whose specular point is at the end of its rear
 *     against     a point at the rear of a car, on either side of it
 *
 * Each case misses its decision by a margin (adversarial_traffic_margin): 0, or down to a millionth
 * of the largest margin. The largest is 1e-3 of amplitudes, 1e-6 of distances in a cell and of
 * facing angles, 1e-7 of borders of view and 1e-9 to 1e-8 of others. Cases are built for scans at
 * the end of the frame. */
#pragma once

#include "documents/suite.h"
#include "traffic/random_traffic.h"

/* The other objects, and the ego, of a snapshot. */
extern const struct random_traffic_density adversarial_traffic_density;

/* The purpose of these draws, besides those of enum random_purpose. */
#define ADVERSARIAL_TRAFFIC_DRAWS ((enum random_purpose)6)

/* Appends one to three cases to the frame, which has its ego, by the draws of snapshot number. Ids
 * are "CASE-NUMBER-OBJECT", for instance "touch-2-1". */
void adversarial_traffic_add(const struct random_traffic *traffic, const struct suite *suite,
                             int64_t number, struct frame *frame);

/* A signed distance from a border at which decisions change: 0 once in eight, else of either sign,
 * with its size spread evenly in the logarithm over the six decades up to largest. */
double adversarial_traffic_margin(struct random_sequence *sequence, double largest);
