/* What a sensor tells of a detection's quality (MODEL 14.21).
 *
 * It is what the sensor itself knows, from its report and its document, but for exact labels. */
#pragma once

#include "text/field.h"

/* Members that are known together. */
enum quality_group {
    QUALITY_NOISE = 1 << 0, /* snr_db, existence */
    QUALITY_RCS = 1 << 1,
    QUALITY_ERRORS = 1 << 2, /* standard deviations */
    QUALITY_FOLDS = 1 << 3,  /* interval and ambiguity_number */
    QUALITY_MERGED = 1 << 4,
    QUALITY_MOUNT = 1 << 5, /* places from the sensor and the centre */
    QUALITY_EGO = 1 << 6,   /* places and rate that need to know the ego */
};

struct quality {
    double snr_db, rcs_dbsm;
    double range_sd_m, range_rate_sd_mps, azimuth_sd_rad; /* standard deviations */
    double existence;                                     /* probability of an echo */
    double range_rate_interval_mps;                       /* rates this far apart read alike */
    int64_t ambiguity_number; /* label: true rate less reported one, in such intervals */
    bool merged_objects, merged_reflectors; /* labels: are contributors of several? */
    double range_rate_over_ground_mps;      /* without the sensor's own motion */
    double x_sensor_m, y_sensor_m, x_centre_m, y_centre_m;
    double x_rear_axle_m, y_rear_axle_m, x_world_m, y_world_m;
    unsigned present; /* enum quality_group */
};

extern const struct record quality_record;
