/* Costs of accuracy, as a table and as a pipeline. */
#pragma once

#include "run/cost.h"

/* A line for each chain, under lines that say what was measured. */
void cost_text_table(const struct cost *cost, struct text *text);

/* A script: as comments the chain's time and error, and for every effect that it leaves out what
 * that saves and adds; then its pipeline. */
void cost_text_pipeline(const struct cost *cost, const struct ladder_chain *chain,
                        struct text *text);
