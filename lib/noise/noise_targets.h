/* False alarms: targets that are nothing but noise above the threshold (EFFECTS 9, MODEL 14.9).
 *
 * How many there are in a scan is a Poisson count; each is as likely in every resolution cell, so
 * even in range, azimuth and range rate, and as strong as noise is that has passed the threshold
 * (ground_return.h). They are cells of their own, with one contributor: number n, from 1, of the
 * reflector "cell" of the object "noise", which is no object of the frame. */
#ifndef NOISE_TARGETS_H
#define NOISE_TARGETS_H

#include "frame/frame.h"

struct effect_scan;

/* The n-th of a scan, without values. That of 0 is the subject of the scan's draws. */
struct contributor noise_targets_contributor(int64_t number);

/* The amplitude of noise that has passed the threshold, by a uniform in (0, 1). Its power is
 * threshold^2 + sigma^2 Exp(1), for an exponential distribution is without memory: without noise it
 * is the threshold itself. noise_sigma is the RMS of the complex noise on the sum channel. */
double noise_targets_amplitude(double threshold, double noise_sigma, double uniform);

/* Makes and counts those of one sensor's scan; none if the effect is not simulated, or if the
 * sensor did not measure in this frame. The frame is that of the context. */
struct cell_span noise_targets_of(struct frame *frame, const struct effect_scan *context);

#endif
