/* What a radar reads off the peaks of its spectrum, and which echoes made them (MODEL 11.2).
 *
 * An echo belongs to the peak at which most of it shows, if that is at least half of its amplitude;
 * so it has one label, and a target's label are the echoes that a radar of this resolution cannot
 * tell from it. A peak that no echo belongs to has the one that makes at least half of it, which
 * then has two; if there is none, it is a false alarm. */
#ifndef SIGHTINGS_H
#define SIGHTINGS_H

#include "readings.h"
#include "signal.h"

struct sighting {
    const struct spectrum_peak *peak;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude;
    bool sign_undecided;
    struct cell cell; /* of its echoes alone, without noise */
};

struct sightings {
    const struct signal *signal;
    const struct spectrum *spectrum;
    double threshold;
    LIST_OF(struct sighting) list;
};

/* Every peak that meets the threshold, in every beam: range, azimuth, rate and amplitude. Memory
 * comes from the arena. */
struct sightings sightings_of(const struct signal *signal, const struct spectrum *spectrum,
                              double threshold, struct arena *arena);

/* Gives every sighting its cell, and a range rate as near to that of its strongest echo as its
 * ambiguity allows; writes off the rays that no sighting shows, and counts false alarms. Rays come
 * strongest first. */
void sightings_label(struct sightings *sightings, struct frame *frame, const char *stage,
                     const struct ray *rays, size_t count, double time_s);

/* As one entry of the list. */
struct reading sightings_reading(const struct sighting *sighting);

#endif
