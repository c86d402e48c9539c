#include "base/random.h"

#include <Random123/philox.h>

#include "base/elementary.h"

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
