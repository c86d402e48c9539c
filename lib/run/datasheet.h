/* Data sheet of a suite: its figures, and their text.
 *
 * The figures hold for one echo in the plane, without rain and interference. */
#pragma once

#include "base/text.h"
#include "documents/suite.h"

enum { DATASHEET_AZIMUTHS = 4, DATASHEET_LEVELS = 3, DATASHEET_ECHOES = 3, DATASHEET_CHANCES = 2 };

/* Standard deviations of reported values at one amplitude, rounding to steps included. */
struct datasheet_accuracy {
    double snr_db; /* infinity without noise */
    double range_sigma_m, range_rate_sigma_mps;
    double azimuth_sigma_rad[DATASHEET_AZIMUTHS]; /* infinity where the antenna receives nothing */
};

struct datasheet {
    double azimuth_rad[DATASHEET_AZIMUTHS]; /* from boresight to the border of the view */
    struct datasheet_accuracy accuracy[DATASHEET_LEVELS]; /* at the threshold, 10 and 20 dB above */
    double chance[DATASHEET_CHANCES]; /* of detection: that of a mean echo at the threshold; 0.9 */
    double echo_dbsm[DATASHEET_ECHOES]; /* 0, 10, 20 */
    /* The range up to which an echo is detected with that chance, at most range_max_m; 0: nowhere
     * from range_min_m on. */
    double range_m[DATASHEET_AZIMUTHS][DATASHEET_ECHOES][DATASHEET_CHANCES];
    double weakest_dbsm; /* the echo that meets the threshold on boresight at range_max_m */
};

/* The figures of a sensor with its derived members. */
void datasheet_of(const struct sensor *sensor, struct datasheet *sheet);

/* The set of effects that the sensor's document does not describe, of those that a sensor may lack.
 * Levels of bodies stand for fluctuation: a sensor with levels does not lack it. */
uint64_t datasheet_missing(const struct sensor *sensor);

/* A shipped suite that describes all effects but a few. */
struct datasheet_example {
    const char *name;
    uint64_t missing; /* the set of effects that its sensors lack, too */
};

/* The example whose sensors reach about as far as this one. */
struct datasheet_example datasheet_example(const struct sensor *sensor);

/* Adds a sheet for every sensor, in degrees, dBsm, m and m/s. Neighbouring sensors that differ only
 * in name and mount share one. A check that does not hold, and a figure that is not usual, is a
 * line that begins with "doubt:". The suite's assumptions follow. */
void datasheet_add(const struct suite *suite, struct text *text);
