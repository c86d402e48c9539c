#include "base/random_sequence.h"

#include "base/elementary.h"

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
