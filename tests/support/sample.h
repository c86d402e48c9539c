/* Repeatable samples for tests, the same on every machine, and independent of the random module,
 * which is under test itself. The caller owns the state and starts it with any number. */
#pragma once

#include <stdint.h>
#include <string.h>

/* 48 bits of a linear congruential generator modulo 2^64; the weak low bits are dropped. */
static inline uint64_t sample_bits(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 16;
}

/* From low up to but not including high. */
static inline double sample_between(uint64_t *state, double low, double high)
{
    return low + (high - low) * ((double)sample_bits(state) * 0x1p-48);
}

/* From -bound to bound, both included; bound below 2^46. */
static inline int64_t sample_integer(uint64_t *state, int64_t bound)
{
    return (int64_t)(sample_bits(state) % (uint64_t)(2 * bound + 1)) - bound;
}

/* All 64 bits. */
static inline uint64_t sample_word(uint64_t *state)
{
    uint64_t high = sample_bits(state) << 32;
    return high ^ sample_bits(state);
}

/* The double of these bits. */
static inline double sample_from_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint64_t sample_to_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}
