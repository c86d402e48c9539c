#include "score/relative_error.h"

#include "base/elementary.h"
#include "base/random.h"
#include "base/sort.h"
#include "score/energy_distance.h"

enum { RESAMPLES = 2000 };

static const double NORMAL = 1.96; /* the 97.5 % quantile of the normal distribution */

/* The 97.5 % quantile of Student's distribution over NORMAL, by its expansion in 1/freedom
 * (Abramowitz and Stegun 26.7.5); off by 7 % with 2 degrees of freedom, by less than 1 % from 4. */
static double student(double freedom)
{
    double z = NORMAL, square = z * z;
    double first = (square + 1) / 4;
    double second = ((5 * square + 16) * square + 3) / 96;
    double third = (((3 * square + 19) * square + 17) * square - 15) / 384;
    return 1 + ((third / freedom + second) / freedom + first) / freedom;
}

static struct energy_sample sample_at(const struct energy_blocks *lists, size_t block)
{
    size_t all = lists->references + lists->seeds;
    return (struct energy_sample){lists->distance + block * all * all, lists->references,
                                  lists->seeds};
}

/* The mean over all blocks. */
static struct energy_sample whole(const struct energy_blocks *lists, struct arena *arena)
{
    size_t all = lists->references + lists->seeds;
    double *mean = arena_get(arena, all * all * sizeof *mean);
    for (size_t block = 0; block < lists->blocks; block++)
        for (size_t i = 0; i < all * all; i++)
            mean[i] += lists->weight[block] * lists->distance[block * all * all + i];
    return (struct energy_sample){mean, lists->references, lists->seeds};
}

/* The variance of a ratio by the jackknife over the lists of one law; without an ideal, that of the
 * numerator. */
static double jackknife(const struct energy_sample *chain, const struct energy_sample *ideal,
                        size_t first, size_t count)
{
    double sum = 0, squares = 0;
    for (size_t i = first; i < first + count; i++) {
        double below = ideal != NULL ? energy_distance_without(ideal, i) : 1;
        double ratio = energy_distance_without(chain, i) / below;
        sum += ratio;
        squares += ratio * ratio;
    }
    double n = (double)count;
    return (n - 1) / n * elementary_max(squares - sum * sum / n, 0);
}

/* Writes the ratios of sums over resampled blocks in ascending order and returns their number.
 * There is none of blocks that are all empty, whose sum below is 0. */
static size_t resample(const double *above, const double *below, size_t blocks, double *ratios,
                       struct arena *arena)
{
    size_t count = 0;
    struct random_sequence draws =
        random_sequence_at((struct random_address){.seed = 1}, RANDOM_BOOTSTRAP);
    for (size_t i = 0; i < RESAMPLES; i++) {
        double one = 0, other = 0;
        for (size_t k = 0; k < blocks; k++) {
            int64_t drawn = random_sequence_whole(&draws, 0, (int64_t)blocks - 1);
            one += above[drawn];
            other += below[drawn];
        }
        if (other > 0)
            ratios[count++] = one / other;
    }
    sort_numbers(ratios, count, arena);
    return count;
}

/* One end of the interval: what the blocks and the seeds make it go apart, as squares. */
static double apart(double by_blocks, double by_seeds)
{
    by_blocks = elementary_max(by_blocks, 0);
    return sqrt(by_blocks * by_blocks + by_seeds * by_seeds);
}

struct relative_error relative_error_of(const struct energy_blocks *chain,
                                        const struct energy_blocks *ideal, struct arena *arena)
{
    size_t blocks = chain->blocks;
    double *above = arena_get(arena, blocks * sizeof *above);
    double *below = arena_get(arena, blocks * sizeof *below);
    for (size_t i = 0; i < blocks; i++) {
        struct energy_sample one = sample_at(chain, i), other = sample_at(ideal ? ideal : chain, i);
        above[i] = chain->weight[i] * energy_distance_of(&one);
        below[i] = chain->weight[i] * (ideal != NULL ? energy_distance_of(&other) : 1);
    }
    struct energy_sample one = whole(chain, arena), other = whole(ideal ? ideal : chain, arena);
    const struct energy_sample *under = ideal != NULL ? &other : NULL;
    double value = energy_distance_of(&one) / (under != NULL ? energy_distance_of(under) : 1);
    double variance = jackknife(&one, under, 0, chain->references) +
                      jackknife(&one, under, chain->references, chain->seeds);
    double by_seeds = NORMAL * sqrt(variance);
    double *ratios = arena_get(arena, RESAMPLES * sizeof *ratios);
    size_t count = resample(above, below, blocks, ratios, arena), tail = count / 40;
    double n = (double)blocks, wider = blocks > 1 ? student(n - 1) * sqrt(n / (n - 1)) : 1;
    return (struct relative_error){
        value,
        value - apart(wider * (value - ratios[tail]), by_seeds),
        value + apart(wider * (ratios[count - 1 - tail] - value), by_seeds),
    };
}

/* The energy distance is linear in the distances, so the difference of two is that of their
 * matrices. */
struct relative_error relative_error_added(const struct energy_blocks *chain,
                                           const struct energy_blocks *other,
                                           const struct energy_blocks *ideal, struct arena *arena)
{
    size_t all = chain->references + chain->seeds, count = chain->blocks * all * all;
    double *difference = arena_get(arena, count * sizeof *difference);
    for (size_t i = 0; i < count; i++)
        difference[i] = chain->distance[i] - other->distance[i];
    struct energy_blocks added = *chain;
    added.distance = difference;
    return relative_error_of(&added, ideal, arena);
}
