#include "score/gospa.h"

#include "base/elementary.h"
#include "score/assignment.h"

/* Costs are at most c^2, so every item of the shorter list gets a partner. A partner at the cut-off
 * costs as much as two unpaired items, and does not count as one. */
size_t gospa_pair(const double *distance, size_t truths, size_t listed, double cutoff,
                  size_t *item_of, struct arena *arena)
{
    double *cost = arena_get(arena, truths * listed * sizeof *cost);
    for (size_t i = 0; i < truths * listed; i++) {
        double near = elementary_min(distance[i], cutoff);
        cost[i] = near * near;
    }
    assignment_least(cost, truths, listed, item_of, arena);
    size_t pairs = 0;
    for (size_t i = 0; i < truths; i++) {
        if (item_of[i] != ASSIGNMENT_NONE && !(distance[i * listed + item_of[i]] < cutoff))
            item_of[i] = ASSIGNMENT_NONE;
        pairs += item_of[i] != ASSIGNMENT_NONE;
    }
    return pairs;
}

struct gospa gospa_of(double squares, size_t pairs, size_t truths, size_t listed, double cutoff)
{
    double alone = cutoff * cutoff / 2;
    struct gospa gospa = {
        .localisation = squares,
        .missed_part = alone * (double)(truths - pairs),
        .false_part = alone * (double)(listed - pairs),
    };
    gospa.value = sqrt(gospa.localisation + gospa.missed_part + gospa.false_part);
    return gospa;
}

double gospa_ospa(double squares, size_t pairs, size_t truths, size_t listed, double cutoff)
{
    size_t longer = truths > listed ? truths : listed;
    if (longer == 0)
        return 0;
    return sqrt((squares + cutoff * cutoff * (double)(longer - pairs)) / (double)longer);
}
