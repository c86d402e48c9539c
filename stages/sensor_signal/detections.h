/* Detections from the peaks of a spectrum, and their labels (MODEL 11.3).
 *
 * An echo belongs to the detection that contains the largest part of its amplitude, if that is at
 * least half. A detection is labelled with the echoes that belong to it. If there are none, the
 * label is the echo that makes most of its amplitude, at least half, and that then labels two
 * detections. Without such an echo the detection is a false alarm. */
#pragma once

#include "effects/effect.h"
#include "signal_cube.h"

struct clustered_echoes;

struct detection {
    const struct range_doppler_peak *peak;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude;
    struct antenna_pointers pointers; /* of sum and delta channels; 0 for an array */
    bool sign_undecided;
    const struct array_maximum *beam; /* of an array, sigma for noise of amplitude 1; else NULL */
    struct cell cell;                 /* from the labelled echoes alone, without noise */
};

struct detections {
    const struct signal_cube *signal;
    const struct range_doppler *spectrum;
    struct cfar cfar;
    double noise;  /* RMS in a bin; 0: none */
    double least;  /* least amplitude of a detection; 0 with noise: CFAR decides */
    double time_s; /* instant of the measurement */
    LIST_OF(struct detection) list;
};

/* Range, azimuth, range rate and amplitude of a detection for every peak of the spectrum, in every
 * beam that passes the peak's threshold. noise is the RMS in a bin; without noise the sensor's
 * threshold counts. Memory comes from the frame's arena. */
struct detections detections_of(const struct signal_cube *signal,
                                const struct range_doppler *spectrum, double noise,
                                const struct effect_scan *context);

/* Sets the cell of every detection, with its range rate folded as the waveform folds it. Records
 * received echoes without a detection as lost, and counts false alarms. resolved has the strongest
 * echo first. */
void detections_label(struct detections *detections, struct frame *frame, const char *stage,
                      const struct clustered_echoes *resolved);

/* Writes the target list: with misalignment, in the sensor's order, up to its limit, rounded. */
void detections_list(const struct detections *detections, struct frame *frame, const char *stage,
                     const struct effect_scan *noise);

/* Sets the standard deviations of the measurement of a single echo (MODEL 14.21) by the Cramer-Rao
 * bound of the window and of the elements, or by the slope of sum and delta. The range error of a
 * chirp contains the error of the range rate. Each is at most that of a value that is uniform in a
 * cell, or in the field of view. With sum and delta channels it also sets looks_merged. peak is the
 * amplitude of the peak, over all beams; noise > 0 is the RMS of noise in the peak's cell of the
 * spectrum, in units of peak and of the measurement's amplitude and pointers. */
void detections_estimate(const struct signal_cube *signal, double peak, double noise,
                         struct effect_measurement *measurement);

/* Number of independent bins of noise that the sensor searches: ranges times rates times beams. */
double detections_noise_bins(const struct signal_cube *signal);
