#include "run/cost_search.h"

#include "base/elementary.h"
#include "base/sort.h"
#include "run/cost.h"

/* An effect that may be left out, and the squared error added for the time saved if it is. */
struct saving {
    uint64_t effect;
    double price;
};

struct savings {
    struct saving items[EFFECT_COUNT];
    size_t count;
};

static int cheaper(const void *left, const void *right)
{
    double a = ((const struct saving *)left)->price, b = ((const struct saving *)right)->price;
    return (a > b) - (a < b);
}

/* False if the chain leaves out effects and is not faster than the whole chain in every round. By
 * chance 1 of 64 effects that save nothing passes this sign test. */
static bool saves_time(const struct tried_chain *chain)
{
    return !chain->automatic || chain->left_out == 0 || chain->saved.least_us > 0;
}

/* The figure that must be at most the bound, and the figure that must be least among such chains.
 * Energies of other chains may be negative, so the reference's counts as minus infinity. */
static double bounded(const struct tried_chain *chain, enum cost_search_bound bound)
{
    return bound == COST_SEARCH_US ? chain->row.us_per_frame : chain->row.relative_distance.high;
}

static double rival(const struct cost *cost, const struct tried_chain *chain,
                    enum cost_search_bound bound)
{
    const struct tried_chain *reference =
        cost->no_signal == NULL ? &cost->reference : cost->chains.list.items[COST_WHOLE];
    if (bound == COST_SEARCH_ERROR)
        return chain->row.us_per_frame;
    if (chain == reference && strcmp(chain->row.effects, cost->reference.row.effects) == 0)
        return -(double)INFINITY;
    return chain->row.energy.value;
}

/* The effects that save time in every round, in the order of their prices, but for those that alone
 * break a bound of the error. */
static struct savings savings_of(const struct cost *cost, enum cost_search_bound bound, double most)
{
    struct savings savings = {0};
    for (size_t i = 0; i < cost->chains.list.count; i++) {
        const struct tried_chain *chain = cost->chains.list.items[i];
        if (chain->trial->effect == EFFECT_NONE || !saves_time(chain) ||
            (bound == COST_SEARCH_ERROR && bounded(chain, bound) > most))
            continue;
        savings.items[savings.count++] = (struct saving){
            chain->left_out, elementary_max(cost_added(cost, chain).value, 0) / chain->saved.us};
    }
    sort_items(savings.items, savings.count, sizeof savings.items[0], cheaper,
               runner_arena(cost->runner));
    return savings;
}

/* Leaves out all of these effects as well if the error holds, or else as many of each half. */
static int leave_out(struct cost *cost, const struct saving *savings, size_t count, double most,
                     uint64_t *left_out)
{
    uint64_t all = *left_out;
    if (count == 0)
        return 0;
    for (size_t i = 0; i < count; i++)
        all |= savings[i].effect;
    const struct tried_chain *chain = cost_try_without(cost, all, false);
    if (chain == NULL)
        return -1;
    if (bounded(chain, COST_SEARCH_ERROR) <= most) {
        *left_out = all;
        return 0;
    }
    if (count == 1)
        return 0;
    if (leave_out(cost, savings, count / 2, most, left_out) != 0)
        return -1;
    return leave_out(cost, savings + count / 2, count - count / 2, most, left_out);
}

/* Measures chains without several effects; for a time, until one is fast enough. */
static int try_fewer_effects(struct cost *cost, enum cost_search_bound bound, double most)
{
    struct savings savings = savings_of(cost, bound, most);
    uint64_t left_out = 0;
    if (bound == COST_SEARCH_ERROR) {
        if (leave_out(cost, savings.items, savings.count, most, &left_out) != 0)
            return -1;
        return left_out == 0 || cost_try_without(cost, left_out, true) != NULL ? 0 : -1;
    }
    for (size_t i = 0; i < savings.count; i++) {
        left_out |= savings.items[i].effect;
        const struct tried_chain *chain = cost_try_without(cost, left_out, true);
        if (chain == NULL || bounded(chain, bound) <= most)
            return chain == NULL ? -1 : 0;
    }
    return 0;
}

const struct tried_chain *cost_search(struct cost *cost, enum cost_search_bound bound, double most)
{
    const struct relative_error *energy = &cost->chains.list.items[COST_IDEAL]->row.energy;
    if (!cost_has_errors(cost)) {
        diag_fail(runner_diag(cost->runner), DIAG_DATA,
                  "ideal echoes cannot be told from the reference in these frames (D %.3g, 95 %% "
                  "interval %.3g to %.3g), so chains have no errors",
                  energy->value, energy->low, energy->high);
        return NULL;
    }
    if (bounded(cost->chains.list.items[COST_WHOLE], bound) > most || bound == COST_SEARCH_ERROR)
        if (try_fewer_effects(cost, bound, most) != 0)
            return NULL;
    const struct tried_chain *best = NULL, *nearest = cost->chains.list.items[COST_IDEAL];
    for (size_t i = 0; i < cost->chains.list.count; i++) {
        const struct tried_chain *chain = cost->chains.list.items[i];
        if (saves_time(chain) && bounded(chain, bound) < bounded(nearest, bound))
            nearest = chain;
        if (saves_time(chain) && bounded(chain, bound) <= most &&
            (best == NULL || rival(cost, chain, bound) < rival(cost, best, bound)))
            best = chain;
    }
    if (best == NULL) {
        diag_fail(runner_diag(cost->runner), DIAG_DATA,
                  "no chain holds the bound; the nearest, %s, takes %.1f us a frame and has an "
                  "error of up to %.1f %%",
                  nearest->row.chain, nearest->row.us_per_frame,
                  100 * nearest->row.relative_distance.high);
        return NULL;
    }
    cost->table.chosen = best->row.chain;
    if (best->automatic && best->left_out != 0)
        *list_add(&cost->table.chains, runner_arena(cost->runner)) = best->row;
    return best;
}
