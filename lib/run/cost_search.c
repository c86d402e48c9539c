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
        if (chain->trial->effect == EFFECT_NONE || !saves_time(chain))
            continue;
        if (bound == COST_SEARCH_ERROR && bounded(chain, bound) > most)
            continue;
        savings.items[savings.count++] = (struct saving){
            chain->left_out, elementary_max(cost_added(cost, chain).value, 0) / chain->saved.us};
    }
    sort_items(savings.items, savings.count, sizeof savings.items[0], cheaper,
               runner_arena(cost->runner));
    return savings;
}

/* Leaves out all of these effects as well if the error holds, or else as many of each half. found
 * is the chain that leaves out the most so far; NULL: there is none. */
static int leave_out(struct cost *cost, const struct saving *savings, size_t count, double most,
                     struct tried_chain **found)
{
    if (count == 0)
        return 0;
    uint64_t all = *found != NULL ? (*found)->left_out : 0;
    for (size_t i = 0; i < count; i++)
        all |= savings[i].effect;
    struct tried_chain *chain = cost_chain_without(cost, all);
    if (cost_measure_error(cost, chain) != 0)
        return -1;
    if (bounded(chain, COST_SEARCH_ERROR) <= most) {
        *found = chain;
        return 0;
    }
    if (count == 1)
        return 0;
    if (leave_out(cost, savings, count / 2, most, found) != 0)
        return -1;
    return leave_out(cost, savings + count / 2, count - count / 2, most, found);
}

/* Leaves out one effect after the other until the chain is fast enough. */
static int speed_up(struct cost *cost, const struct savings *savings, double most_us,
                    struct tried_chain **found)
{
    uint64_t left_out = 0;
    for (size_t i = 0; i < savings->count; i++) {
        left_out |= savings->items[i].effect;
        *found = cost_chain_without(cost, left_out);
        if (cost_measure_time(cost, *found) != 0)
            return -1;
        if (bounded(*found, COST_SEARCH_US) <= most_us)
            break;
    }
    return 0;
}

/* Adds the chain without several effects that was found for the bound, with its error and time. */
static int try_fewer_effects(struct cost *cost, enum cost_search_bound bound, double most)
{
    struct savings savings = savings_of(cost, bound, most);
    struct tried_chain *found = NULL;
    if (bound == COST_SEARCH_ERROR) {
        if (leave_out(cost, savings.items, savings.count, most, &found) != 0)
            return -1;
        if (found != NULL && cost_measure_time(cost, found) != 0)
            return -1;
    } else {
        if (speed_up(cost, &savings, most, &found) != 0)
            return -1;
        if (found != NULL && cost_measure_error(cost, found) != 0)
            return -1;
    }
    if (found != NULL)
        *list_add(&cost->chains.list, runner_arena(cost->runner)) = found;
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
    bool holds = bounded(cost->chains.list.items[COST_WHOLE], bound) <= most;
    if ((bound == COST_SEARCH_ERROR || !holds) && try_fewer_effects(cost, bound, most) != 0)
        return NULL;
    const struct tried_chain *best = NULL;
    const struct tried_chain *nearest = cost->chains.list.items[COST_IDEAL];
    for (size_t i = 0; i < cost->chains.list.count; i++) {
        const struct tried_chain *chain = cost->chains.list.items[i];
        if (!saves_time(chain))
            continue;
        if (bounded(chain, bound) < bounded(nearest, bound))
            nearest = chain;
        if (bounded(chain, bound) > most)
            continue;
        if (best == NULL || rival(cost, chain, bound) < rival(cost, best, bound))
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
