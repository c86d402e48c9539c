#include "draws.h"

#include "elementary.h"

struct draws draws_at(struct random_address address, enum random_purpose purpose)
{
    return (struct draws){.address = address, .purpose = purpose};
}

double draws_next(struct draws *draws)
{
    uint32_t place = draws->taken % 4;
    if (place == 0)
        random_uniform(&draws->address, draws->purpose, draws->taken / 4, draws->block);
    draws->taken++;
    return draws->block[place];
}

double draws_between(struct draws *draws, double low, double high)
{
    return low + (high - low) * draws_next(draws);
}

int64_t draws_whole(struct draws *draws, int64_t least, int64_t most)
{
    double choices = (double)(most - least + 1);
    return least + (int64_t)elementary_least(choices * draws_next(draws), choices - 1);
}

bool draws_chance(struct draws *draws, double probability)
{
    return draws_next(draws) < probability;
}

double draws_sign(struct draws *draws)
{
    return draws_chance(draws, 0.5) ? 1 : -1;
}

double draws_margin(struct draws *draws, double largest)
{
    if (draws_chance(draws, 0.125))
        return 0;
    double sign = draws_sign(draws);
    return sign * largest * elementary_pow(10, -6 * draws_next(draws));
}
