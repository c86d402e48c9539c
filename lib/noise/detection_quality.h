/* Quality of a detection, as its sensor knows it (MODEL 14.21). */
#pragma once

#include "effects/effect.h"
#include "noise/existence.h"

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
