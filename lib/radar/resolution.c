#include "radar/resolution.h"

#include "base/elementary.h"
#include "base/sort.h"
#include "radar/point_response.h"

/* Coherent echoes that are so many times farther apart than half a cell share none: there the
 * stronger one has 1/7000 of its amplitude. */
#define COHERENT_REACH 2

#define NO_CELL SIZE_MAX

/* The distance of two echoes in bins of a pulse that the cell of the wider one resolves. */
static double pulse_bins(const struct resolution_echo *leader, const struct resolution_echo *echo,
                         const struct resolution *resolution)
{
    double range = (echo->range_m - leader->range_m) / resolution->half_range_m;
    double rate = (echo->range_rate_mps - leader->range_rate_mps) / resolution->half_range_rate_mps;
    double size = 1 + elementary_max(leader->widening, echo->widening);
    return point_response_resolution(POINT_RESPONSE_PULSE) * elementary_hypot(range, rate) / size;
}

double resolution_response(const struct resolution_echo *leader, const struct resolution_echo *echo,
                           const struct resolution *resolution)
{
    return point_response_value(POINT_RESPONSE_PULSE, pulse_bins(leader, echo, resolution));
}

/* Opposite echoes with more than half of their amplitudes at each other's places cancel. */
static bool has_one_peak(const struct resolution_echo *leader, const struct resolution_echo *echo,
                         double bins)
{
    double ratio = echo->amplitude / leader->amplitude, turn = echo->phase_rad - leader->phase_rad;
    return point_response_value(POINT_RESPONSE_PULSE, bins) > 0.5 ||
           (bins < COHERENT_REACH * point_response_resolution(POINT_RESPONSE_PULSE) &&
            !point_response_pulses_part(bins, ratio, turn));
}

static bool shares_cell(const struct resolution_echo *leader, const struct resolution_echo *echo,
                        const struct resolution *resolution)
{
    if (resolution->coherent)
        return has_one_peak(leader, echo, pulse_bins(leader, echo, resolution));
    double size = 1 + elementary_max(leader->widening, echo->widening);
    return fabs(echo->range_m - leader->range_m) <= size * resolution->half_range_m &&
           fabs(echo->range_rate_mps - leader->range_rate_mps) <=
               size * resolution->half_range_rate_mps;
}

/* The size of the largest echo's cell, where the sensor's is 1. */
static double largest_size(const struct resolution_echo *echoes, size_t count)
{
    double widening = 0;
    for (size_t i = 0; i < count; i++)
        widening = elementary_max(widening, echoes[i].widening);
    return 1 + widening;
}

static int compare_places(const void *left, const void *right)
{
    const struct resolution_place *a = left, *b = right;
    return (a->place > b->place) - (a->place < b->place);
}

/* The axis that has fewer echoes in a cell's width, if echoes lie evenly between the outermost. */
static bool rates_spread_wider(const struct resolution_echo *echoes, size_t count,
                               const struct resolution *resolution)
{
    struct resolution_echo low = echoes[0], high = low;
    for (size_t i = 1; i < count; i++) {
        low.range_m = elementary_min(low.range_m, echoes[i].range_m);
        high.range_m = elementary_max(high.range_m, echoes[i].range_m);
        low.range_rate_mps = elementary_min(low.range_rate_mps, echoes[i].range_rate_mps);
        high.range_rate_mps = elementary_max(high.range_rate_mps, echoes[i].range_rate_mps);
    }
    return (high.range_rate_mps - low.range_rate_mps) * resolution->half_range_m >
           (high.range_m - low.range_m) * resolution->half_range_rate_mps;
}

struct resolution_row resolution_row_of(const struct resolution_echo *echoes, size_t count,
                                        const struct resolution *resolution, struct arena *arena)
{
    struct resolution_row row = {.count = count};
    if (count == 0)
        return row;
    bool by_rate = rates_spread_wider(echoes, count, resolution);
    row.reach = (by_rate ? resolution->half_range_rate_mps : resolution->half_range_m) *
                (resolution->coherent ? COHERENT_REACH : 1) * largest_size(echoes, count);
    row.items = arena_room(arena, count * sizeof *row.items);
    row.rank = arena_room(arena, count * sizeof *row.rank);
    for (size_t i = 0; i < count; i++)
        row.items[i] =
            (struct resolution_place){by_rate ? echoes[i].range_rate_mps : echoes[i].range_m, i};
    sort_items(row.items, count, sizeof *row.items, compare_places, arena);
    for (size_t i = 0; i < count; i++)
        row.rank[row.items[i].echo] = i;
    return row;
}

bool resolution_close(const struct resolution_echo *echoes, size_t count,
                      const struct resolution *resolution, struct arena *arena)
{
    /* Echoes of one object are often neighbours in the list: most answers are found without the
     * sort, which takes most of the time. */
    for (size_t i = 1; i < count; i++)
        if (shares_cell(&echoes[i - 1], &echoes[i], resolution))
            return true;
    struct resolution_row row = resolution_row_of(echoes, count, resolution, arena);
    const struct resolution_place *items = row.items;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count && items[j].place - items[i].place <= row.reach; j++)
            if (shares_cell(&echoes[items[i].echo], &echoes[items[j].echo], resolution))
                return true;
    return false;
}

size_t resolution_cluster(const struct resolution_echo *echoes, size_t count,
                          const struct resolution *resolution, size_t *cell, struct arena *arena)
{
    size_t cells = 0;
    struct resolution_row row = resolution_row_of(echoes, count, resolution, arena);
    for (size_t i = 0; i < count; i++)
        cell[i] = NO_CELL;
    for (size_t leader = 0; leader < count; leader++) {
        if (cell[leader] != NO_CELL)
            continue;
        size_t low = row.rank[leader], high = low;
        double place = row.items[low].place;
        while (low > 0 && place - row.items[low - 1].place <= row.reach)
            low--;
        while (high < count && row.items[high].place - place <= row.reach)
            high++;
        for (size_t i = low; i < high; i++) {
            size_t echo = row.items[i].echo;
            if (cell[echo] == NO_CELL && shares_cell(&echoes[leader], &echoes[echo], resolution))
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
