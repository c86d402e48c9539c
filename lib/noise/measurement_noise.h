/* What the effects at home in noise do to what one sensor reads off its cells (MODEL 7 to 9, 14).
 */
#ifndef MEASUREMENT_NOISE_H
#define MEASUREMENT_NOISE_H

#include "base/random.h"
#include "noise/target_list.h"

/* Which of them there are: described by the sensor's document, and selected. */
struct measurement_noise {
    const struct sensor *sensor;
    bool pointers, range, accuracy, misalignment, final_threshold, steps;
    double false_alarms; /* mean number per scan */
    int64_t list_limit;  /* 0: all */
};

/* Also notes every one of them in the selection's log. */
struct measurement_noise measurement_noise_of(const struct sensor *sensor,
                                              const struct selection *selection);

/* The cell's pointers by equation (8): both channels get independent complex noise of the same RMS,
 * which other radars raise. */
struct antenna_pointers measurement_noise_pointers(const struct measurement_noise *by,
                                                   const struct random_address *address,
                                                   const struct cell *cell);

/* Standard deviations of range and range rate. */
struct deviation {
    double range_m, range_rate_mps;
};

/* Of a cell, whose noise-free amplitude counts over its noise, by the sensor's sigma_law:
 *     fixed          as the document says;
 *     by_amplitude   that times threshold / amplitude, at most 1;
 *     by_snr         snr_sigma.h's, for the cell's size and (amplitude / pointer_sigma)^2, with the
 *                    document's as floor. */
struct deviation measurement_noise_deviation(const struct measurement_noise *by,
                                             const struct cell *cell);

/* Noise on range and range rate; no range is below 0. */
void measurement_noise_range(const struct measurement_noise *by,
                             const struct random_address *address, struct measurement *measurement);

/* Misalignment and radome (boresight_error.h). */
void measurement_noise_azimuth(const struct measurement_noise *by, struct measurement *measurement);

#endif
