/* Random levels that change gradually over a distance.
 *
 * Knots stand at the whole numbers of a line or a plane. Each has a standard normal value e of its
 * own, drawn by address, and a place has a weighted sum of the values at the knots around it (MODEL
 * 14.22): on a line, between the knots k and k + 1 and t = x - k from the first of them,
 *
 *     g(x) = cos(pi t/2) e_k + sin(pi t/2) e_(k+1).
 *
 * So g is continuous, is standard normal at every place, and needs no state: it is the same
 * wherever a stream is cut. Places d knots apart have the correlation (1 - d/2) cos(pi d/2) +
 * sin(pi d/2)/pi, averaged over where the knots stand, and none from d = 2 on. In a plane weights
 * are products, and so are correlations. */
#pragma once

#include "base/random.h"

/* The value at a place of a line, |x| < 2^53. The seed, scene, sensor and item of the address tell
 * one line from another; its frame does not count, as knots are numbered in its place. */
double level_on_line(const struct random_address *line, enum random_purpose purpose, double x);

/* The value at a place (x, y) of a plane that closes after a turn of `turn` >= 2 knots in x: 0 <=
 * x <= turn, |y| < 2^31. */
double level_on_turn(const struct random_address *plane, enum random_purpose purpose, double x,
                     double y, int64_t turn);

/* The cross sections of reflectors are the mean, or the median, of the power over all levels. */
enum level_keeps { LEVEL_KEEPS_MEAN, LEVEL_KEEPS_MEDIAN };

/* The mean of a normal level in dB for which the mean of its power is 1: -(ln 10/20) sigma_db^2. */
double level_mean_db(double sigma_db);

/* The mean of a normal level in dB that keeps the mean of its power at 1, or its median. */
double level_centre_db(enum level_keeps keeps, double sigma_db);
