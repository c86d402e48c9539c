/* Quality of a detection, as its sensor knows it (MODEL 14.21). */
#pragma once

#include "effects/effect.h"

/* What the probability of existence follows from: echoes are expected to have exponential powers
 * from least_echo on, and noise alone from least_false_alarm on, in units of the noise's. */
struct existence {
    double echoes;                        /* mean number in a scan, detected or not; > 0 */
    double snr;                           /* mean ratio of their powers to that of the noise; > 0 */
    double false_alarms;                  /* mean number in a scan */
    double least_false_alarm, least_echo; /* powers that the thresholds let pass; 0: all */
    double rise;                          /* of the noise's power by other radars, >= 1 */
};

/* The probability, in [0, 1], that a detection of a power >= 0 is an echo and not noise, by Bayes'
 * rule. What can be neither counts as an echo. */
double detection_quality_existence(const struct existence *existence, double power);

/* A scan's detections, as far as the quality of each depends on them. */
struct detection_source {
    const struct sensor *sensor;
    const struct effect_scan *scan; /* NULL: nothing is rounded */
    double noise;                   /* RMS of a channel's own noise; 0: none */
    struct existence existence;     /* but for echoes and snr; powers are over that noise's */
    double range_rate_interval_mps; /* rates this far apart read alike; 0: none do */
};

/* The source of cells, without false alarms. Other radars, which the cells tell, are heard in the
 * whole scan. */
struct detection_source detection_quality_source(const struct sensor *sensor,
                                                 struct cell_span cells,
                                                 const struct effect_scan *scan);

/* For glint-noise: sets the false alarms and the thresholds, and gives the measurements the
 * standard deviations of its noise as far as the sensor knows, by the amplitude that it measured in
 * place of the exact one. */
void detection_quality_estimate(struct detection_source *source,
                                struct effect_measurement *measurements, size_t count);

/* The quality of a target that the measurement became. Its standard deviations are those of the
 * measurement, and of rounding. */
struct quality detection_quality_of(const struct detection_source *source,
                                    const struct effect_measurement *measurement,
                                    const struct target *target, const struct frame *frame);
