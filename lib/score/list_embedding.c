#include "score/list_embedding.h"

#include "base/elementary.h"
#include "base/sort.h"

static const double WIDTHS[] = {1, 3, 10};

static double kernel(const struct embedded_target *a, const struct embedded_target *b)
{
    double square = 0, sum = 0;
    for (int i = 0; i < LIST_EMBEDDING_AXES; i++)
        square += (a->axis[i] - b->axis[i]) * (a->axis[i] - b->axis[i]);
    for (size_t i = 0; i < sizeof WIDTHS / sizeof *WIDTHS; i++)
        sum += elementary_exp(-square / (2 * WIDTHS[i] * WIDTHS[i]));
    return sum;
}

static double inner(const struct embedded_list *one, const struct embedded_list *other)
{
    double sum = 0;
    for (size_t i = 0; i < one->targets.count; i++)
        for (size_t j = 0; j < other->targets.count; j++)
            sum += kernel(&one->targets.items[i], &other->targets.items[j]);
    return sum;
}

static int compare_targets(const void *left, const void *right)
{
    const struct embedded_target *a = left, *b = right;
    for (int i = 0; i < LIST_EMBEDDING_AXES; i++)
        if (a->axis[i] != b->axis[i])
            return a->axis[i] < b->axis[i] ? -1 : 1;
    return 0;
}

void list_embedding_close(struct embedded_list *list, struct arena *arena)
{
    sort_list(&list->targets, compare_targets, arena);
    list->square = inner(list, list);
}

/* Rounding may take the square of a small difference below 0. */
double list_embedding_distance(const struct embedded_list *one, const struct embedded_list *other)
{
    return sqrt(elementary_max(one->square + other->square - 2 * inner(one, other), 0));
}

void list_embedding_add_distances(const struct embedded_list *const *lists, size_t count,
                                  double share, double *distance)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++) {
            double apart = share * list_embedding_distance(lists[i], lists[j]);
            distance[i * count + j] += apart;
            distance[j * count + i] += apart;
        }
}
