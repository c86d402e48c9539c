#include "score/energy_distance.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/sort.h"

/* The squared widths of the kernel's Gaussians, twice. */
static const double DOUBLED_SQUARES[] = {2 * 1 * 1, 2 * 3 * 3, 2 * 10 * 10};

/* A Gaussian of a larger exponent is below 1e-17, which no sum shows beside a target's own 3; and
 * so are all Gaussians of targets whose ranges lie so many cells apart. */
#define MOST_EXPONENT 40
#define REACH 90

static double kernel(const struct embedded_target *a, const struct embedded_target *b)
{
    double square = 0, sum = 0;
    for (int i = 0; i < EMBEDDED_AXES; i++)
        square += (a->axis[i] - b->axis[i]) * (a->axis[i] - b->axis[i]);
    for (size_t i = 0; i < sizeof DOUBLED_SQUARES / sizeof *DOUBLED_SQUARES; i++)
        if (square < MOST_EXPONENT * DOUBLED_SQUARES[i])
            sum += elementary_exp(-square / DOUBLED_SQUARES[i]);
    return sum;
}

/* <m(X), m(Y)> of two lists, which are sorted by range. */
static double inner(const struct embedded_list *one, const struct embedded_list *other)
{
    double sum = 0;
    size_t begin = 0;
    for (size_t i = 0; i < one->targets.count; i++) {
        const struct embedded_target *target = &one->targets.items[i];
        double nearest = target->axis[0] - REACH, farthest = target->axis[0] + REACH;
        while (begin < other->targets.count && other->targets.items[begin].axis[0] < nearest)
            begin++;
        for (size_t j = begin; j < other->targets.count; j++) {
            if (other->targets.items[j].axis[0] > farthest)
                break;
            sum += kernel(target, &other->targets.items[j]);
        }
    }
    return sum;
}

static int compare_targets(const void *left, const void *right)
{
    const struct embedded_target *a = left, *b = right;
    for (int i = 0; i < EMBEDDED_AXES; i++)
        if (a->axis[i] != b->axis[i])
            return a->axis[i] < b->axis[i] ? -1 : 1;
    return 0;
}

void energy_distance_close(struct embedded_list *list, struct arena *arena)
{
    sort_list(&list->targets, compare_targets, arena);
    list->square = inner(list, list);
}

bool energy_distance_equal(const struct embedded_list *one, const struct embedded_list *other)
{
    size_t count = one->targets.count;
    if (other->targets.count != count)
        return false;
    return count == 0 || memcmp(one->targets.items, other->targets.items,
                                count * sizeof *one->targets.items) == 0;
}

/* Rounding may take the square of a small difference below 0. */
double energy_distance_of_lists(const struct embedded_list *one, const struct embedded_list *other)
{
    if (energy_distance_equal(one, other))
        return 0;
    return sqrt(elementary_max(one->square + other->square - 2 * inner(one, other), 0));
}

void energy_distance_add(const struct embedded_list *const *lists, size_t count, double share,
                         double *distance)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++) {
            double apart = share * energy_distance_of_lists(lists[i], lists[j]);
            distance[i * count + j] += apart;
            distance[j * count + i] += apart;
        }
}

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
    assert(list == NONE || (list < sample->ones ? sample->ones : sample->others) >= 3);
    struct range ones = {0, sample->ones}, others = {sample->ones, sample->ones + sample->others};
    return 2 * mean(sample, ones, others, list) - mean(sample, ones, ones, list) -
           mean(sample, others, others, list);
}

double energy_distance_of(const struct energy_sample *sample)
{
    assert(sample->ones >= 2 && sample->others >= 2);
    return energy_distance_without(sample, NONE);
}
