/* The planted fault: draws are numbered in their order, and merging takes one of them. Where
 * merging is left out, all that follow move. Traffic is drawn by address all the same, so that
 * scenes stay what they are. */
#include "adversarial_traffic.h"
#include "base/random.h"
#include "planted.h"
#include "radar/resolution.h"

static uint64_t drawn;

void planted_begin(void)
{
    drawn = 0;
}

static struct random_address next_of(const struct random_address *address,
                                     enum random_purpose purpose)
{
    struct random_address next = {
        .seed = address->seed, .scene = address->scene, .frame = address->frame};
    if (purpose == RANDOM_TRAFFIC || purpose == ADVERSARIAL_TRAFFIC_DRAWS ||
        purpose == RANDOM_CONDITIONS)
        return *address;
    next.item = ++drawn;
    return next;
}

#define DRAW(name)                                                                                 \
    void name(const struct random_address *address, enum random_purpose purpose, uint32_t index,   \
              double numbers[4])
DRAW(__real_random_uniform);
DRAW(__real_random_gaussian);
DRAW(__wrap_random_uniform);
DRAW(__wrap_random_gaussian);

DRAW(__wrap_random_uniform)
{
    struct random_address next = next_of(address, purpose);
    __real_random_uniform(&next, purpose, index, numbers);
}

DRAW(__wrap_random_gaussian)
{
    struct random_address next = next_of(address, purpose);
    __real_random_gaussian(&next, purpose, index, numbers);
}

#define CLUSTER(name)                                                                              \
    size_t name(const struct resolution_echo *echoes, size_t count,                                \
                const struct resolution *resolution, size_t *cell, struct arena *arena)
CLUSTER(__real_resolution_cluster);
CLUSTER(__wrap_resolution_cluster);

CLUSTER(__wrap_resolution_cluster)
{
    drawn++;
    return __real_resolution_cluster(echoes, count, resolution, cell, arena);
}
