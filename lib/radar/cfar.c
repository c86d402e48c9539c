#include "radar/cfar.h"

#include "base/elementary.h"
#include "base/root.h"

/* The probability with which noise passes under CFAR_ORDERED. */
static double ordered_false_alarm(size_t cells, size_t rank, double factor)
{
    double probability = 1;
    for (size_t i = 0; i < rank; i++) {
        double rest = (double)(cells - i);
        probability *= rest / (rest + factor);
    }
    return probability;
}

struct ordered_search {
    size_t cells, rank;
    double false_alarm;
};

static bool is_too_low(const void *of, double factor)
{
    const struct ordered_search *search = of;
    return ordered_false_alarm(search->cells, search->rank, factor) > search->false_alarm;
}

static double ordered_factor(size_t cells, size_t rank, double false_alarm)
{
    const struct ordered_search search = {cells, rank, false_alarm};
    double high = 1;
    while (is_too_low(&search, high))
        high *= 2;
    return root_between(0, high, 0, is_too_low, &search).high;
}

double cfar_factor(enum cfar_kind kind, size_t cells, size_t rank, double false_alarm)
{
    if (kind == CFAR_ORDERED)
        return ordered_factor(cells, rank, false_alarm);
    return (double)cells * (elementary_pow(false_alarm, -1 / (double)cells) - 1);
}

/* The rank-th smallest value, by insertion sort, as there are few. */
static double of_rank(double *values, size_t count, size_t rank)
{
    for (size_t i = 1; i < count; i++) {
        double value = values[i];
        size_t place = i;
        for (; place > 0 && values[place - 1] > value; place--)
            values[place] = values[place - 1];
        values[place] = value;
    }
    return values[rank - 1];
}

static double mean(const double *values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    return sum / (double)count;
}

size_t cfar_extent(const struct cfar *cfar)
{
    return 2 * (cfar->nearest + (cfar->cells / 2 - 1) * cfar->spacing) + 1;
}

double cfar_threshold(const struct cfar *cfar, const double *power, size_t count, size_t stride,
                      size_t at)
{
    double window[CFAR_MOST_CELLS] = {0};
    for (size_t i = 0; i < cfar->cells / 2; i++) {
        size_t away = cfar->nearest + i * cfar->spacing;
        window[2 * i] = power[(at + count - away) % count * stride];
        window[2 * i + 1] = power[(at + away) % count * stride];
    }
    double noise = cfar->kind == CFAR_ORDERED ? of_rank(window, cfar->cells, cfar->rank)
                                              : mean(window, cfar->cells);
    return cfar->factor * noise;
}
