/* Scores as a table for people. It has a column for each score and a row for every figure that any
 * of them has. */
#ifndef SCORE_TABLE_H
#define SCORE_TABLE_H

#include "base/text.h"
#include "score/ensemble.h"
#include "score/score.h"

/* Writes count scores; each has its head above its column. */
void score_table_write(const struct score *scores, const char *const *heads, size_t count,
                       struct text *text);

void score_table_summary(const struct score_summary *summary, struct text *text,
                         struct arena *arena);
void score_table_track_summary(const struct score_track_summary *summary, struct text *text);

/* Energy distances of all scenes, a row each, and of all together. */
void score_table_ensemble(const struct ensemble_score *score, struct text *text);

#endif
