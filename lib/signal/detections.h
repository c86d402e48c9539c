/* What a radar reads off the peaks of its spectrum, and which echoes made them (MODEL 11.3).
 *
 * An echo belongs to the peak at which most of it shows, if that is at least half of its amplitude;
 * so it has one label, and a target's label are the echoes that a radar of this resolution cannot
 * tell from it. A peak that no echo belongs to has the one that makes at least half of it, which
 * then has two; if there is none, it is a false alarm. */
#ifndef DETECTIONS_H
#define DETECTIONS_H

#include "noise/measurement_noise.h"
#include "signal/signal_cube.h"

struct clustered_echoes;
struct reception;

struct sighting {
    const struct range_doppler_peak *peak;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude;
    bool sign_undecided;
    struct cell cell; /* of its echoes alone, without noise */
};

struct detections {
    const struct signal_cube *signal;
    const struct range_doppler *spectrum;
    double threshold;
    double time_s; /* of the measurement */
    LIST_OF(struct sighting) list;
};

/* Every peak that meets the threshold, which rises with what other radars add to the noise, in
 * every beam: range, azimuth, rate and amplitude. Memory comes from the frame's arena. */
struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum,
                                const struct effect_scan *context);

/* Gives every sighting its cell, and a range rate as near to that of its strongest echo as its
 * ambiguity allows; writes off the received echoes that no sighting shows, and counts false alarms.
 * Rays come strongest first. */
void detections_label(struct detections *sightings, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved);

/* Writes the list: misaligned, in its order, up to its limit, rounded. */
void detections_list(const struct detections *sightings, struct frame *frame, const char *stage,
                     const struct effect_scan *noise);

#endif
