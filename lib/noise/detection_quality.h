/* Quality of a detection, as its sensor knows it (MODEL 14.21). */
#pragma once

#include "effects/effect.h"

/* Parameters of the probability of existence. Powers of weak echoes are spread evenly over
 * decibels; an echo below first_threshold is lost before noise is added to it, one below least_echo
 * after it. Powers of false alarms exceed least_false_alarm by an exponentially distributed power
 * with the mean search_noise. All powers are in units of the noise power of a channel. */
struct existence {
    double false_alarms;                  /* mean number in a scan */
    double search_noise;                  /* power of the noise of the search; > 0 */
    double first_threshold;               /* least power without noise; 0: all pass */
    double least_false_alarm, least_echo; /* least powers that pass the thresholds; 0: all pass */
    double weakest; /* echoes from here to ten times this power tell how many weak ones there are */
    double rise;    /* power of the noise with other radars, >= 1 */
};

/* What a scan tells of one of its detections. */
struct detection_evidence {
    double power;     /* >= 0 */
    double odds;      /* of an echo and not noise, if one weak echo is expected */
    double existence; /* the probability of an echo */
};

/* Sets the probability, in [0, 1], that each detection of a scan is an echo and not noise, by
 * Bayes' rule; 1 for a power that neither of the two can have. The others of the scan tell how many
 * weak echoes are expected. */
void detection_quality_weigh(const struct existence *existence, struct detection_evidence *scan,
                             size_t count);

/* Properties of a scan that the quality of its detections depends on. */
struct detection_source {
    const struct sensor *sensor;
    const struct effect_scan *scan; /* NULL: nothing is rounded */
    double noise;                   /* RMS of a channel's own noise; 0: none */
    struct existence existence;
    bool channels; /* do measurements have noisy pointers, or noisy elements of an array? */
    double range_rate_interval_mps; /* range rates this far apart are ambiguous; 0: none are */
};

/* The power of a measurement in units of the noise power of a channel, which is > 0. */
double detection_quality_power(const struct detection_source *source,
                               const struct effect_measurement *measurement);

/* The source of cells, without false alarms. The interference that is noted in a cell counts for
 * the whole scan. */
struct detection_source detection_quality_source(const struct sensor *sensor,
                                                 struct cell_span cells,
                                                 const struct effect_scan *scan);

/* Sets looks_merged if the pointers, or the elements of an array at a beam, differ from those of a
 * single echo by more than 3 standard deviations of noise with this RMS > 0 on each channel or in
 * the beam. Returns the factor by which the standard deviation of the azimuth grows: > 1 if
 * looks_merged is set, and 1 otherwise. */
double detection_quality_widening(const struct sensor *sensor,
                                  struct effect_measurement *measurement, double noise);

/* For glint-noise: sets false alarms and thresholds of the source, and the standard deviations of
 * the measurements as the sensor estimates them: from the measured amplitude, not the exact one.
 * first_threshold: did the sensor test its cells before the noise? */
void detection_quality_estimate(struct detection_source *source, bool first_threshold,
                                struct effect_measurement *measurements, size_t count);

/* The quality of a target that the measurement became, without its existence. Its standard
 * deviations combine those of the measurement and of rounding. */
struct quality detection_quality_of(const struct detection_source *source,
                                    const struct effect_measurement *measurement,
                                    const struct target *target, const struct frame *frame);
