#include "base/random.h"

#include <Random123/philox.h>
#include <assert.h>

#include "base/elementary.h"

/* Part of the probability at the mean below which counts are left out. */
#define NEGLIGIBLE 0x1p-75

void random_uniform(const struct random_address *address, enum random_purpose purpose,
                    uint32_t index, double uniform[4])
{
    philox4x64_ctr_t counter = {
        {address->frame, address->sensor, address->item, (uint64_t)purpose << 32 | index}};
    philox4x64_key_t key = {{address->seed, address->scene}};
    philox4x64_ctr_t bits = philox4x64(counter, key);
    for (int i = 0; i < 4; i++)
        uniform[i] = ((double)(bits.v[i] >> 12) + 0.5) * 0x1p-52;
}

/* Two Gaussian draws from two uniform ones (Box and Muller). */
static void make_gaussian(const double uniform[2], double gaussian[2])
{
    double radius = sqrt(-2 * elementary_log(uniform[0]));
    struct elementary_sincos angle = elementary_sincos_turns(uniform[1]);
    gaussian[0] = radius * angle.cos;
    gaussian[1] = radius * angle.sin;
}

void random_gaussian(const struct random_address *address, enum random_purpose purpose,
                     uint32_t index, double gaussian[4])
{
    double uniform[4];
    random_uniform(address, purpose, index, uniform);
    make_gaussian(uniform, gaussian);
    make_gaussian(uniform + 2, gaussian + 2);
}

void random_gaussian_pair(const struct random_address *address, enum random_purpose purpose,
                          uint32_t index, double gaussian[2])
{
    double uniform[4];
    random_uniform(address, purpose, index, uniform);
    make_gaussian(uniform, gaussian);
}

double random_gaussian_exceeded(double probability)
{
    assert(probability > 0 && probability < 1);
    double offset = 0.5 - probability;
    if (fabs(offset) <= 0.425) {
        double r = 0.180625 - offset * offset;
        return offset * (((59.10937472 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
               (((67.1875636 * r + 78.757757664) * r + 17.895169469) * r + 1);
    }
    double r = sqrt(-elementary_log(offset > 0 ? probability : 1 - probability)), value;
    if (r <= 5) {
        r -= 1.6;
        value = (((0.17023821103 * r + 1.3067284816) * r + 2.75681539) * r + 1.4234372777) /
                ((0.12021132975 * r + 0.7370016425) * r + 1);
    } else {
        r -= 5;
        value = (((0.017337203997 * r + 0.42868294337) * r + 3.081226386) * r + 6.657905115) /
                ((0.012258202635 * r + 0.24197894225) * r + 1);
    }
    return offset > 0 ? value : -value;
}

struct random_sequence random_sequence_at(struct random_address address,
                                          enum random_purpose purpose)
{
    return (struct random_sequence){.address = address, .purpose = purpose};
}

double random_sequence_next(struct random_sequence *sequence)
{
    uint32_t place = sequence->taken % 4;
    if (place == 0)
        random_uniform(&sequence->address, sequence->purpose, sequence->taken / 4, sequence->block);
    sequence->taken++;
    return sequence->block[place];
}

double random_sequence_between(struct random_sequence *sequence, double low, double high)
{
    return low + (high - low) * random_sequence_next(sequence);
}

int64_t random_sequence_whole(struct random_sequence *sequence, int64_t least, int64_t most)
{
    assert(least <= most);
    double choices = (double)(most - least + 1);
    return least + (int64_t)elementary_min(choices * random_sequence_next(sequence), choices - 1);
}

bool random_sequence_chance(struct random_sequence *sequence, double probability)
{
    return random_sequence_next(sequence) < probability;
}

double random_sequence_sign(struct random_sequence *sequence)
{
    return random_sequence_chance(sequence, 0.5) ? 1 : -1;
}

double random_gamma(struct random_sequence *sequence, double shape)
{
    assert(shape > 0);
    double most = (shape < 1 ? shape + 1 : shape) - 1.0 / 3;
    for (;;) {
        double deviation = random_gaussian_exceeded(random_sequence_next(sequence));
        double root = 1 + deviation / sqrt(9 * most), ratio = root * root * root;
        double uniform = random_sequence_next(sequence);
        if (!(ratio > 0) ||
            elementary_log(uniform) >
                deviation * deviation / 2 + most * (1 - ratio + elementary_log(ratio)))
            continue;
        double smaller = shape < 1 ? elementary_pow(random_sequence_next(sequence), 1 / shape) : 1;
        return most * ratio * smaller;
    }
}

/* The count at which the summation begins. Weights are probabilities times total. */
struct beginning {
    double first, weight, total;
};

/* Begins where the weights are negligible, going down from the mean, whose weight is 1; then adds
 * up the total. */
static struct beginning begin_below_the_mean(double mean)
{
    struct beginning begin = {.first = floor(mean), .weight = 1};
    while (begin.first > 0 && begin.weight > NEGLIGIBLE) {
        begin.first--;
        begin.weight /= mean / (begin.first + 1);
    }
    double weight = begin.weight;
    for (double k = begin.first; k < mean || weight > NEGLIGIBLE; k++) {
        begin.total += weight;
        weight *= mean / (k + 1);
    }
    return begin;
}

int64_t random_poisson(double mean, double uniform)
{
    assert(uniform > 0 && uniform < 1);
    if (!(mean > 0))
        return 0;
    mean = elementary_min(mean, 1e9);
    struct beginning begin = {0, elementary_exp(-mean), 1};
    if (mean >= 16) /* the probability of 0 is too small to begin with */
        begin = begin_below_the_mean(mean);
    double target = uniform * begin.total;
    double k = begin.first, weight = begin.weight;
    double sum = weight;
    while (sum < target && (weight > NEGLIGIBLE * begin.total || k < mean)) {
        weight *= mean / (k + 1);
        sum += weight;
        k++;
    }
    return (int64_t)k;
}
