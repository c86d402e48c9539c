/* Finds the pipeline within a bound of error or time.
 *
 * Effects are left out in the order of the squared error that they add for the time that they save;
 * those that do not save time in every round stay. For an error, effects go in halves: all that
 * hold the bound together. For a time, one after the other goes until the chain is fast enough. */
#pragma once

struct cost;
enum cost_search_bound { COST_SEARCH_ERROR, COST_SEARCH_US };

/* The fastest chain with an interval of the error that ends at most at this bound, or the chain of
 * the least error that takes at most this time, measured beside the whole chain. NULL after a
 * message: no chain holds the bound (DIAG_DATA). */
const struct tried_chain *cost_search(struct cost *cost, enum cost_search_bound bound, double most);
