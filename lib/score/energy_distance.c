#include "score/energy_distance.h"

/* The lists from first up to, not including, end. */
struct range {
    size_t first, end;
};

#define NONE ((size_t)-1)

/* The mean distance between lists of two ranges; the list `without` and equal lists do not count.
 */
static double mean(const struct energy_sample *sample, struct range rows, struct range columns,
                   size_t without)
{
    size_t all = sample->ones + sample->others, count = 0;
    double sum = 0;
    for (size_t i = rows.first; i < rows.end; i++)
        for (size_t j = columns.first; j < columns.end; j++)
            if (i != j && i != without && j != without) {
                sum += sample->distance[i * all + j];
                count++;
            }
    return sum / (double)count;
}

double energy_distance_without(const struct energy_sample *sample, size_t list)
{
    struct range ones = {0, sample->ones}, others = {sample->ones, sample->ones + sample->others};
    return 2 * mean(sample, ones, others, list) - mean(sample, ones, ones, list) -
           mean(sample, others, others, list);
}

double energy_distance_of(const struct energy_sample *sample)
{
    return energy_distance_without(sample, NONE);
}

/* The variance over the lists of one law: (n - 1)/n times the sum of squares about their mean. */
static double jackknife(const struct energy_sample *sample, struct range lists)
{
    double count = (double)(lists.end - lists.first), middle = 0, squares = 0;
    for (size_t i = lists.first; i < lists.end; i++)
        middle += energy_distance_without(sample, i) / count;
    for (size_t i = lists.first; i < lists.end; i++) {
        double apart = energy_distance_without(sample, i) - middle;
        squares += apart * apart;
    }
    return (count - 1) / count * squares;
}

double energy_distance_variance(const struct energy_sample *sample)
{
    struct range ones = {0, sample->ones}, others = {sample->ones, sample->ones + sample->others};
    return jackknife(sample, ones) + jackknife(sample, others);
}
