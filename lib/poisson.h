/* How many of something rare there are: the Poisson law by inversion, one uniform draw per count.
 *
 * The count is the least n whose cumulative probability reaches the uniform draw, so it never falls
 * when the draw grows. The steps stand within 1e-14 of their places for means up to 30 and within
 * 1e-12 up to 700; the work grows with the count. */
#ifndef POISSON_H
#define POISSON_H

/* mean in [0, 700], 0 means none; uniform in (0, 1). */
int poisson_draw(double mean, double uniform);

/* The largest count that a uniform draw of random.h can lead to. */
int poisson_most(double mean);

#endif
