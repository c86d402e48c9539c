/* Which beam owns an echo, and what a beam shows.
 *
 * An echo belongs to the beam that receives the largest part of its amplitude, if that is at least
 * half; of equal parts the first counts. A beam without an echo of its own shows the echo that
 * makes most of its amplitude. A beam may be one of an array (MODEL 7.5) or a peak of a spectrum
 * (MODEL 11.3). */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define BEAM_OWNER_NONE SIZE_MAX
#define BEAM_OWNER_LEAST_PART 0.5

struct beam_owner {
    size_t beams, echoes;
    double (*part)(const void *of, size_t echo, size_t beam); /* of the echo's amplitude, there */
    double (*amplitude)(const void *of, size_t echo);
    const void *of;
    size_t *owner; /* the beam of each echo, or BEAM_OWNER_NONE */
};

/* Sets the owner of every echo. */
void beam_owner_find(const struct beam_owner *beams);

/* Writes the numbers of the echoes that a beam shows, ascending, and returns how many. Without an
 * echo of its own that is the first of those that make most of its amplitude, if they make at least
 * `least`. If that one has an owner, *repeats becomes true; otherwise this beam becomes its owner.
 */
size_t beam_owner_shown(const struct beam_owner *beams, size_t beam, double least, size_t *shown,
                        bool *repeats);
