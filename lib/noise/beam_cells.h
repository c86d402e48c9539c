/* Divides the cells of an array into beams, with noise.
 *
 * A cell of several echoes has their samples at the elements. Noise is added to these, and every
 * maximum of their beams that counts (array_keep) becomes a cell (MODEL 7.5). An echo belongs to
 * the beam that receives most of its amplitude, if that is at least half, and is lost as masked
 * otherwise. A beam to which no echo belongs is labelled with the echo that makes most of its
 * amplitude. That echo then labels two beams, unless it was masked. */
#pragma once

#include "effects/effect.h"

/* Returns those of these cells of the sensor that have no samples as they are, and for each of the
 * others one cell for each beam. Its members are weighted by their shares of its amplitude, its
 * range and range rate are the means over them, its azimuth is that of the beam without noise, and
 * its member beam is the maximum in noise. Without scan (NULL) there is no noise. Masked echoes are
 * lost to the stage.
 */
struct cell_span beam_cells_of(struct frame *frame, const char *stage, const struct sensor *sensor,
                               const struct effect_scan *scan, struct cell_span cells);
