#include "base/poisson.h"

#include "base/elementary.h"

#define NEGLIGIBLE 0x1p-75

/* The distribution of counts for a mean and an overdispersion. */
struct law {
    double mean, overdispersion;
};

static double probability_ratio(const struct law *law, double k)
{
    return (law->mean + k * (law->overdispersion - 1)) / (law->overdispersion * (k + 1));
}

/* The count at which the summation begins. Weights are probabilities times total. */
struct beginning {
    double first, weight, total;
};

/* Begins where the weights are negligible, going down from the mean, whose weight is 1; then adds
 * up the total. */
static struct beginning begin_below_the_mean(const struct law *law)
{
    struct beginning begin = {.first = floor(law->mean), .weight = 1};
    while (begin.first > 0 && begin.weight > NEGLIGIBLE) {
        begin.first--;
        begin.weight /= probability_ratio(law, begin.first);
    }
    double weight = begin.weight;
    for (double k = begin.first; k < law->mean || weight > NEGLIGIBLE; k++) {
        begin.total += weight;
        weight *= probability_ratio(law, k);
    }
    return begin;
}

/* Begins at a count of 0, whose probability has a closed form; only for means at which it is not
 * too small. */
static struct beginning begin_at_zero(const struct law *law)
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
    struct beginning begin = law.mean < 16 ? begin_at_zero(&law) : begin_below_the_mean(&law);
    double target = uniform * begin.total;
    double k = begin.first, weight = begin.weight, sum = weight;
    while (sum < target && (weight > NEGLIGIBLE * begin.total || k < law.mean)) {
        weight *= probability_ratio(&law, k);
        sum += weight;
        k++;
    }
    return (int64_t)k;
}

int64_t poisson_count(double mean, double uniform)
{
    return poisson_overdispersed_count(mean, 1, uniform);
}
