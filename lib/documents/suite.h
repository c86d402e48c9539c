/* Sensor suites: mount, beam, resolution, noise and list of radars. The record of the documents in
 * data/sensors/ (MODEL 4, 6 to 10).
 *
 * Plain members are the document's; those from `amplitude_law` on are derived when it is loaded
 * (suite_derive). */
#pragma once

#include "documents/waveform.h"
#include "propagation/carrier.h"
#include "radar/antenna.h"
#include "radar/array.h"
#include "radar/detection.h"
#include "radar/level.h"
#include "radar/measurement_sigma.h"
#include "radar/monopulse.h"
#include "radar/radar_equation.h"
#include "radar/resolution.h"
#include "text/field.h"

enum cell_phase { CELL_IN_PHASE, CELL_RANDOM_PHASE, CELL_PHASE_BY_PATH };
enum if_sampling { IF_REAL, IF_COMPLEX };
enum range_migration {
    MIGRATION_NONE,
    MIGRATION_RECTANGULAR,
    MIGRATION_HANN,
    MIGRATION_COMPENSATED
};
/* The threshold on cells before noise: lower than the final one that follows, or the same. */
enum first_threshold { FIRST_LOWERED, FIRST_FULL };
enum list_order { LIST_STRONGEST, LIST_NEAREST };

/* The farthest range that is measured at an azimuth, to either side. */
struct range_limit {
    double azimuth_rad, range_max_m;
};

struct sensor {
    const char *name;
    double mount_x_m, mount_y_m, mount_z_m, mount_yaw_rad;
    double carrier_hz;
    double range_min_m, range_max_m;
    LIST_OF(struct range_limit) range_limits; /* by azimuth, ascending */
    double field_of_view_rad;
    double elevation_half_width_rad;
    double elevation_view_rad; /* 0: elevation is not measured */
    bool diffraction, curved_sides, micro_motion;
    double cycle_s, latency_s;
    int64_t bounces; /* bounces of the longest path, off objects and mirrors; below 2 only direct
                      * paths */

    enum polarization polarization;
    enum fluctuation_law fluctuation;
    double fluctuation_sigma_db;
    double level_constant_db, level_slow_db, level_slow_m, level_fast_db;
    enum level_keeps level_keeps;
    double unambiguous_range_m, unambiguous_rate_mps; /* 0: unlimited */
    double unambiguous_middle_mps;                    /* of the interval of range rates */
    double receiver_bandwidth_hz, noise_figure_db, antenna_gain_dbi;
    enum if_sampling if_sampling;
    double chirp_slope_hzps, chirp_s;

    double threshold_db;
    double calibration_ercs, calibration_range_m;
    double exponent;
    double range_floor_m;
    const char *range_curve, *azimuth_curve, *elevation_curve, *azimuth_floor_curve;

    double cell_range_m, cell_range_rate_mps;
    double azimuth_cell_rad; /* 0: not given */
    enum cell_extent cell_extent;
    enum cell_phase cell_phase;
    enum range_migration range_migration;

    enum antenna_pattern antenna_pattern;
    const char *antenna_table;
    struct array_layout array;
    enum antenna_phase phase_reference;
    enum monopulse_estimator angle_estimator;

    double pointer_sigma;
    double range_sigma_m, range_sigma_share; /* the larger of the two holds */
    double range_rate_sigma_mps, azimuth_sigma_rad, azimuth_floor_rad;
    double elevation_sigma_rad, elevation_floor_rad;
    enum sigma_law sigma_law;
    double window_factor;
    double misalignment_rad, radome_bias_rad, radome_period_rad, radome_phase_rad;
    bool final_threshold;
    enum first_threshold first_threshold;
    double false_alarms, false_alarm_range_rate_mps;
    double range_step_m, range_rate_step_mps, azimuth_step_rad, elevation_step_rad;
    enum list_order list_order;
    int64_t list_limit;
    struct waveform waveform;

    struct radar_equation amplitude_law;
    struct antenna antenna;
    struct array beams; /* of the array; count 0: none */
    struct receiver_curve elevation_levels, floor_levels;
    struct measurement_sigma range_error, range_rate_error;
    double threshold;                         /* linear, on the amplitude */
    double lowered_threshold;                 /* of a cell before noise; at most the threshold */
    double bin_range_m, bin_range_rate_mps;   /* full width of the stated cell */
    double half_range_m, half_range_rate_mps; /* half the width of a resolution cell */
    double dwell_s;                           /* of a scan's signal */
    double search_sigma; /* RMS of the noise of the search for echoes; > 0 with false alarms */
};

struct suite {
    const char *origin;
    const char *effects;  /* a selection of effects (effects.h); NULL: auto */
    const char *vehicles; /* a set of vehicle documents (vehicle_set.h); NULL: the paper's */
    LIST_OF(struct sensor) sensors; /* in the document's order */
    LIST_OF(const char *) assumed;  /* sentences for people */
    const char *given;              /* the name or path that the user gave */
    const char *name;               /* the last part of it, up to .json */
    char digest[17];
};

extern const struct record sensor_record, suite_record;

/* The sensor of that name, or NULL. */
const struct sensor *suite_sensor(const struct suite *suite, const char *name);

/* Sets derived members but rows of tables. Noise or false alarms below 1e-100 become none. */
void suite_derive(struct sensor *sensor);

/* The farthest range that the sensor measures at an azimuth: straight between its range_limits and
 * constant beyond them, at most range_max_m. */
double suite_range_max_m(const struct sensor *sensor, double azimuth_rad);

/* The standard deviation of a range whose other noise has sigma_m: at least range_sigma_share of
 * the range. */
double suite_range_sigma_m(const struct sensor *sensor, double range_m, double sigma_m);

/* The standard deviation of the azimuth of a single echo, at the linear ratio of powers snr,
 * without the floor: by the elements of an array, or by the sum and delta channels. */
double suite_azimuth_sigma_rad(const struct sensor *sensor, double azimuth_rad, double snr);

/* The floor, which no signal lessens, of the standard deviation of an azimuth. */
double suite_azimuth_floor_rad(const struct sensor *sensor, double azimuth_rad);

/* The standard deviation of the elevation of a target of this amplitude, over the noise that other
 * radars do not raise: elevation_sigma_rad at the threshold, in proportion to 1/amplitude, with the
 * floor in quadrature; at most that of an elevation anywhere in the view (MODEL 7.6). */
double suite_elevation_sigma_rad(const struct sensor *sensor, double amplitude);
