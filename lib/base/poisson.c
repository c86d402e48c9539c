#include "base/poisson.h"

#include <math.h>

#include "base/elementary.h"

#define NEGLIGIBLE 0x1p-75

/* P(k + 1) / P(k) of the counts that a mean and an overdispersion stand for. */
struct law {
    double mean, overdispersion;
};

static double ratio(const struct law *law, double k)
{
    return (law->mean + k * (law->overdispersion - 1)) / (law->overdispersion * (k + 1));
}

/* Where to begin to count up: weights are probabilities times their total. */
struct beginning {
    double first, weight, total;
};

/* From the mean, whose weight is 1, down to where nothing is left; then the total. */
static struct beginning begin_below_the_mean(const struct law *law)
{
    struct beginning begin = {.first = floor(law->mean), .weight = 1};
    while (begin.first > 0 && begin.weight > NEGLIGIBLE) {
        begin.first--;
        begin.weight /= ratio(law, begin.first);
    }
    double weight = begin.weight;
    for (double k = begin.first; k < law->mean || weight > NEGLIGIBLE; k++) {
        begin.total += weight;
        weight *= ratio(law, k);
    }
    return begin;
}

/* With the probability of none in closed form, as long as that is not too small. */
static struct beginning begin_at_none(const struct law *law)
{
    double more = law->overdispersion - 1;
    double exponent = more > 0 ? elementary_log(law->overdispersion) / more : 1;
    return (struct beginning){0, elementary_exp(-law->mean * exponent), 1};
}

int64_t poisson_overdispersed_count(double mean, double overdispersion, double uniform)
{
    if (!(mean > 0))
        return 0;
    struct law law = {elementary_min(mean, 1e9),
                      elementary_min(elementary_max(overdispersion, 1), 1e3)};
    struct beginning begin = law.mean < 16 ? begin_at_none(&law) : begin_below_the_mean(&law);
    double target = uniform * begin.total;
    double k = begin.first, weight = begin.weight, sum = weight;
    while (sum < target && (weight > NEGLIGIBLE * begin.total || k < law.mean)) {
        weight *= ratio(&law, k);
        sum += weight;
        k++;
    }
    return (int64_t)k;
}

int64_t poisson_count(double mean, double uniform)
{
    return poisson_overdispersed_count(mean, 1, uniform);
}
