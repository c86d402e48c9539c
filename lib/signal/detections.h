/* Detections from the peaks of a spectrum, and their labels (MODEL 11.3).
 *
 * An echo belongs to the detection that shows the largest part of its amplitude, if that is at
 * least half. So an echo has one label, and a detection is labelled with the echoes that a radar of
 * this resolution cannot tell apart. A detection to which no echo belongs is labelled with the echo
 * that makes at least half of its amplitude, which then has two labels; if there is none, it is a
 * false alarm. */
#pragma once

#include "effects/effect.h"
#include "signal/signal_cube.h"

struct clustered_echoes;

struct detection {
    const struct range_doppler_peak *peak;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude;
    bool sign_undecided;
    struct cell cell; /* from the labelled echoes alone, without noise */
};

struct detections {
    const struct signal_cube *signal;
    const struct range_doppler *spectrum;
    struct cfar cfar;
    double noise;  /* RMS of a bin's; 0: none */
    double least;  /* amplitude of a detection where no noise makes a threshold */
    double time_s; /* instant of the measurement */
    LIST_OF(struct detection) list;
};

/* A detection for every peak of the spectrum, in every beam that passes its threshold: range,
 * azimuth, range rate and amplitude. noise is the RMS of a bin's. Without noise, detections must
 * meet the sensor's threshold. Memory comes from the frame's arena. */
struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum, double noise,
                                const struct effect_scan *context);

/* Gives every detection its cell, whose range rate is folded as the waveform folds it. Records the
 * received echoes that no detection shows as lost, and counts false alarms. resolved has the
 * strongest echo first. */
void detections_label(struct detections *detections, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved);

/* Writes the target list: misaligned, in the sensor's order, up to its limit, rounded. */
void detections_list(const struct detections *detections, struct frame *frame, const char *stage,
                     const struct effect_scan *noise);

/* Powers over that of a bin's noise, >= 0: in the cell of the spectrum where the peak was found,
 * and there in the beam of the detection. Elsewhere in its bin an echo is weaker than at its place.
 */
struct peak_snr {
    double found, in_beam;
};

struct peak_accuracy {
    double range_sigma_m, range_rate_sigma_mps, azimuth_sigma_rad;
};

/* Standard deviations of the place in the spectrum of an echo alone, at an azimuth (MODEL 14.21):
 * by the Cramer-Rao bound of the window and of the elements, or by the slope of sum and delta. A
 * chirp's range error contains the error of the range rate. Each is at most that of a value
 * anywhere in a cell, or in the field of view. */
struct peak_accuracy detections_accuracy(const struct signal_cube *signal, double azimuth_rad,
                                         struct peak_snr snr);

/* How many independent bins of noise the sensor searches: ranges times rates times beams. */
double detections_noise_bins(const struct signal_cube *signal);
