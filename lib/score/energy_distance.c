#include "score/energy_distance.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/sort.h"

/* A Gaussian of a larger exponent is below 1e-17, which no sum shows beside a target's own 3; and
 * so are all Gaussians of targets whose ranges lie so many cells apart. */
#define MOST_EXPONENT 40
#define REACH 90

/* The sum of exp(-d^2 / 2w^2) over the widths w = 1, 3 and 10; the narrowest is the ninth power of
 * the middle one. */
static double kernel(const struct embedded_target *a, const struct embedded_target *b)
{
    const double middle = 2 * 3 * 3, widest = 2 * 10 * 10;
    double square = 0;
    for (int i = 0; i < EMBEDDED_AXES; i++)
        square += (a->axis[i] - b->axis[i]) * (a->axis[i] - b->axis[i]);
    if (square > MOST_EXPONENT * widest)
        return 0;
    double sum = elementary_exp(-square / widest);
    if (square > MOST_EXPONENT * middle)
        return sum;
    double gaussian = elementary_exp(-square / middle);
    double cube = gaussian * gaussian * gaussian;
    return sum + gaussian + cube * cube * cube;
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

/* <m(X), m(X)>: every target overlaps itself by 3, and each pair counts twice. */
static double square_of(const struct embedded_list *list)
{
    const struct embedded_target *targets = list->targets.items;
    double sum = 0;
    for (size_t i = 0; i < list->targets.count; i++) {
        sum += 3;
        for (size_t j = i + 1; j < list->targets.count; j++) {
            if (targets[j].axis[0] > targets[i].axis[0] + REACH)
                break;
            sum += 2 * kernel(&targets[i], &targets[j]);
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
    list->square = square_of(list);
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
