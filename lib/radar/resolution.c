#include "radar/resolution.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/elementary.h"
#include "base/sort.h"

#define NO_CELL SIZE_MAX

static bool shares_cell(const struct resolution_echo *leader, const struct resolution_echo *echo,
                        double half_range_m, double half_range_rate_mps)
{
    double size = 1 + elementary_max(leader->widening, echo->widening);
    return fabs(echo->range_m - leader->range_m) <= size * half_range_m &&
           fabs(echo->range_rate_mps - leader->range_rate_mps) <= size * half_range_rate_mps;
}

/* The size of the largest echo's cell, where the sensor's is 1. */
static double largest_size(const struct resolution_echo *echoes, size_t count)
{
    double widening = 0;
    for (size_t i = 0; i < count; i++)
        widening = elementary_max(widening, echoes[i].widening);
    return 1 + widening;
}

static int compare_ranges(const void *left, const void *right)
{
    const struct resolution_echo *a = left, *b = right;
    return (a->range_m > b->range_m) - (a->range_m < b->range_m);
}

bool resolution_close(const struct resolution_echo *echoes, size_t count, double half_range_m,
                      double half_range_rate_mps, struct resolution_echo *by_range,
                      struct arena *arena)
{
    if (count == 0)
        return false;
    /* Echoes of one object are often neighbours in the list: most answers are found without the
     * sort, which takes most of the time. */
    for (size_t i = 1; i < count; i++)
        if (shares_cell(&echoes[i - 1], &echoes[i], half_range_m, half_range_rate_mps))
            return true;
    memcpy(by_range, echoes, count * sizeof *echoes);
    sort_items(by_range, count, sizeof *by_range, compare_ranges, arena);
    double reach_m = half_range_m * largest_size(echoes, count);
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count && by_range[j].range_m - by_range[i].range_m <= reach_m;
             j++)
            if (shares_cell(&by_range[i], &by_range[j], half_range_m, half_range_rate_mps))
                return true;
    return false;
}

struct ranged {
    double range_m;
    size_t echo;
};

static int compare_ranged(const void *left, const void *right)
{
    const struct ranged *a = left, *b = right;
    return (a->range_m > b->range_m) - (a->range_m < b->range_m);
}

/* The echoes in order of range; place[i] is the position of echo i in that order. */
struct ranks {
    struct ranged *items;
    size_t *place;
};

static struct ranks rank(const struct resolution_echo *echoes, size_t count, struct arena *arena)
{
    struct ranks ranks = {arena_get(arena, count * sizeof(struct ranged)),
                          arena_get(arena, count * sizeof(size_t))};
    for (size_t i = 0; i < count; i++)
        ranks.items[i] = (struct ranged){echoes[i].range_m, i};
    sort_items(ranks.items, count, sizeof *ranks.items, compare_ranged, arena);
    for (size_t i = 0; i < count; i++)
        ranks.place[ranks.items[i].echo] = i;
    return ranks;
}

size_t resolution_cluster(const struct resolution_echo *echoes, size_t count, double half_range_m,
                          double half_range_rate_mps, size_t *cell, struct arena *arena)
{
    size_t cells = 0;
    double reach_m = half_range_m * largest_size(echoes, count);
    struct ranks ranks = rank(echoes, count, arena);
    for (size_t i = 0; i < count; i++)
        cell[i] = NO_CELL;
    for (size_t leader = 0; leader < count; leader++) {
        if (cell[leader] != NO_CELL)
            continue;
        const struct resolution_echo *first = &echoes[leader];
        size_t low = ranks.place[leader], high = low;
        while (low > 0 && first->range_m - ranks.items[low - 1].range_m <= reach_m)
            low--;
        while (high < count && ranks.items[high].range_m - first->range_m <= reach_m)
            high++;
        for (size_t i = low; i < high; i++) {
            size_t echo = ranks.items[i].echo;
            if (cell[echo] == NO_CELL &&
                shares_cell(first, &echoes[echo], half_range_m, half_range_rate_mps))
                cell[echo] = cells;
        }
        cells++;
    }
    return cells;
}

double resolution_mean(const double *values, const double *weights, size_t count)
{
    double least = values[0];
    double most = values[0];
    double shift = 0;
    double total = 0;
    for (size_t i = 0; i < count; i++) {
        double weight = weights[i] / weights[0];
        shift += weight * (values[i] - values[0]);
        total += weight;
        least = elementary_min(least, values[i]);
        most = elementary_max(most, values[i]);
    }
    /* Rounding may carry the mean by an ulp beyond the least or the largest value. */
    return elementary_min(elementary_max(values[0] + shift / total, least), most);
}
