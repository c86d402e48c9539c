/* Draws in their order in place of lib/random.c, one of which merging takes: where it is left out,
 * all that follow move. Traffic is drawn by address all the same: scenes stay what they are. The
 * linker sends calls of resolution_cluster here. */
#include "planted.h"
#include "random.h"
#include "resolution.h"

#include <math.h>

#include <Random123/philox.h>

#include "units.h"

static uint64_t drawn;

void planted_begin(void)
{
    drawn = 0;
}

void random_uniform(const struct random_address *address, enum random_purpose purpose,
                    uint32_t index, double uniform[4])
{
    philox4x64_ctr_t counter = {{address->frame, ++drawn, 0, 0}};
    if (purpose == RANDOM_TRAFFIC || purpose == RANDOM_HARD_CASE)
        counter = (philox4x64_ctr_t){
            {address->frame, address->sensor, address->subject, (uint64_t)purpose << 32 | index}};
    philox4x64_key_t key = {{address->seed, address->scene}};
    philox4x64_ctr_t bits = philox4x64(counter, key);
    for (int i = 0; i < 4; i++)
        uniform[i] = ((double)(bits.v[i] >> 12) + 0.5) * 0x1p-52;
}

void random_gaussian(const struct random_address *address, enum random_purpose purpose,
                     uint32_t index, double gaussian[4])
{
    double uniform[4];
    random_uniform(address, purpose, index, uniform);
    for (int i = 0; i < 4; i += 2) {
        double radius = sqrt(-2 * log(uniform[i]));
        gaussian[i] = radius * cos(2 * PI * uniform[i + 1]);
        gaussian[i + 1] = radius * sin(2 * PI * uniform[i + 1]);
    }
}

size_t __real_resolution_cluster(const struct resolution_echo *echoes, size_t count,
                                 double half_range_m, double half_range_rate_mps, size_t *cell);
size_t __wrap_resolution_cluster(const struct resolution_echo *echoes, size_t count,
                                 double half_range_m, double half_range_rate_mps, size_t *cell);

size_t __wrap_resolution_cluster(const struct resolution_echo *echoes, size_t count,
                                 double half_range_m, double half_range_rate_mps, size_t *cell)
{
    drawn++;
    return __real_resolution_cluster(echoes, count, half_range_m, half_range_rate_mps, cell);
}
