/* What a sensor tells of a detection's quality (MODEL 14.21).
 *
 * A target has a quality if the frame asks for it. All of it is what the sensor itself knows, from
 * what it reports and from its document, but for the labels ambiguity_number and merged_*, which
 * are exact. A member is absent where `present` does not have its bit. */
#ifndef QUALITY_H
#define QUALITY_H

#include <stdbool.h>

#include "text/field.h"

enum quality_member {
    QUALITY_SNR = 1 << 0,
    QUALITY_RCS = 1 << 1,
    QUALITY_RANGE = 1 << 2,
    QUALITY_RANGE_RATE = 1 << 3,
    QUALITY_AZIMUTH = 1 << 4,
    QUALITY_EXISTENCE = 1 << 5,
    QUALITY_INTERVAL = 1 << 6,
    QUALITY_AMBIGUITY = 1 << 7,
    QUALITY_OBJECTS = 1 << 8,
    QUALITY_REFLECTORS = 1 << 9,
    QUALITY_OVER_GROUND = 1 << 10,
    QUALITY_X_SENSOR = 1 << 11,
    QUALITY_Y_SENSOR = 1 << 12,
    QUALITY_X_CENTRE = 1 << 13,
    QUALITY_Y_CENTRE = 1 << 14,
    QUALITY_X_REAR_AXLE = 1 << 15,
    QUALITY_Y_REAR_AXLE = 1 << 16,
    QUALITY_X_WORLD = 1 << 17,
    QUALITY_Y_WORLD = 1 << 18,
};

struct quality {
    double snr_db;
    double rcs_dbsm;
    double range_sd_m, range_rate_sd_mps, azimuth_sd_rad;
    double existence;                  /* probability that an echo is the cause */
    double range_rate_interval_mps;    /* rates this far apart read alike */
    int64_t ambiguity_number;          /* true rate = reported rate + this many intervals */
    bool merged_objects;               /* are there contributors of several objects? */
    bool merged_reflectors;            /* of several reflectors? */
    double range_rate_over_ground_mps; /* less the sensor's own motion: 0 for what stands */
    double x_sensor_m, y_sensor_m;
    double x_centre_m, y_centre_m;
    double x_rear_axle_m, y_rear_axle_m;
    double x_world_m, y_world_m;
    unsigned present; /* enum quality_member */
};

extern const struct record quality_record;

#endif
