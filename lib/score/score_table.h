/* Scores as a table for people. Angles are in degrees.
 *
 * It has a column for each score and a row, with its unit, for every figure that any of them has.
 * Missed targets are also in per cent of the true ones, false ones in per cent of the listed ones;
 * "-" stands where there are none. Distances are in cells for targets, in metres for tracks. */
#pragma once

#include "base/text.h"
#include "score/ensemble.h"
#include "score/score.h"

/* The scores of each sensor, and of all together where there are several. */
void score_table_summary(const struct score_summary *summary, struct text *text,
                         struct arena *arena);

void score_table_track_summary(const struct score_track_summary *summary, struct text *text);

/* Energy distances of all scenes, a row each, and of all together. */
void score_table_ensemble(const struct ensemble_score *score, struct text *text);
