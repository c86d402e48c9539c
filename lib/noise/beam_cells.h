/* Cells of an array, parted into the beams of echoes.
 *
 * The samples of several echoes at the elements get noise, and every maximum of their beams that
 * counts (array_keep) becomes a cell (MODEL 7.5). An echo belongs to the beam that receives most of
 * it; if that is less than half of its amplitude, it is lost as masked. A beam without an echo of
 * its own is labelled with the one that makes most of its amplitude, and that then labels two
 * beams. */
#pragma once

#include "effects/effect.h"

/* The cells of the sensor, for noise of a stage: those of single echoes as they are, of the others
 * one for each beam, with the shares of its echoes as weights. Range and range rate are the means
 * over these, and the azimuth is that of the beam without noise. With a scan, the member beam has
 * the place in noise; without one (NULL) no noise is added. */
struct cell_span beam_cells_of(struct frame *frame, const char *stage, const struct sensor *sensor,
                               const struct effect_scan *scan);
