/* What becomes of the echoes that share a resolution cell (MODEL 6, 8): weighted means of range and
 * rate, and the noise-free sum and delta pointers. */
#ifndef RESOLUTION_CELL_H
#define RESOLUTION_CELL_H

#include "sensor/received_echo.h"

/* Strongest first; ties by the frame's total order. For sort_items. */
int resolution_cell_compare(const void *left, const void *right);

/* Adds up count received echoes, strongest first, which are the cell's members in this order;
 * memory for them comes from the arena. The amplitude is the sum of theirs (equation 5's
 * denominator, the upper bound of what the cell can return), range and rate are the means of
 * equation (4), the pointers are equation (8) without noise, within 2 ulp of the sum of their terms
 * while these cancel to no less than 1e-15 of their sizes (NUMERICS 13), the azimuth is read off
 * them by the sensor's estimator. False if both pointers are zero, so that there is no azimuth.
 *
 * Without superpose, the pointers are those of one echo of the received echoes' whole strength at
 * their mean azimuth: for a cell of one received echo that is the same to the bit. */
bool resolution_cell_of(const struct sensor *sensor, const struct received_echo *received_echoes,
                        size_t count, bool superpose, struct arena *arena, struct cell *cell);

#endif
