#include "documents/datasheet.h"

#include "base/elementary.h"
#include "base/units.h"
#include "radar/detection.h"

#define LEAST_GAIN 1e-6 /* less is rounding where a pattern ends in a zero */

static double with_rounding(double sigma, double step)
{
    return sqrt(sigma * sigma + step * step / 12);
}

static struct datasheet_accuracy accuracy_at(const struct sensor *sensor, double amplitude,
                                             const double *azimuth_rad)
{
    double ratio = amplitude / sensor->pointer_sigma;
    struct datasheet_accuracy accuracy = {
        .snr_db = units_amplitude_db(ratio),
        .range_sigma_m = with_rounding(measurement_sigma_at(&sensor->range_error, amplitude),
                                       sensor->range_step_m),
        .range_rate_sigma_mps =
            with_rounding(measurement_sigma_at(&sensor->range_rate_error, amplitude),
                          sensor->range_rate_step_mps),
    };
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++) {
        double sigma_rad = monopulse_sigma_rad(&sensor->antenna, sensor->angle_estimator,
                                               azimuth_rad[i], ratio * ratio);
        bool seen = antenna_gain(&sensor->antenna, azimuth_rad[i]) > LEAST_GAIN;
        sigma_rad = elementary_hypot(sigma_rad, sensor->azimuth_floor_rad);
        accuracy.azimuth_sigma_rad[i] =
            seen ? with_rounding(sigma_rad, sensor->azimuth_step_rad) : (double)INFINITY;
    }
    return accuracy;
}

/* Where an echo is `excess` times as strong as the threshold, within the limits of the sensor. */
static double reach_m(const struct sensor *sensor, double azimuth_rad, double ercs, double excess)
{
    double gain = antenna_gain(&sensor->antenna, azimuth_rad);
    if (gain <= 0)
        return 0;
    double range_m = radar_detection_range_m(&sensor->amplitude_law, gain, ercs / excess);
    double least_m = elementary_max(sensor->range_min_m, sensor->range_floor_m);
    return range_m < least_m ? 0 : elementary_min(range_m, sensor->range_max_m);
}

static void add_ranges(const struct sensor *sensor, struct datasheet *sheet)
{
    struct detection_law detection = {
        .fluctuation = sensor->fluctuation,
        .fluctuation_sigma_db = sensor->fluctuation_sigma_db,
        .threshold = sensor->threshold,
        .final_threshold = sensor->final_threshold ? sensor->threshold : 0,
        .noise = sensor->pointer_sigma,
    };
    sheet->chance[0] = detection_probability(&detection, sensor->threshold);
    sheet->chance[1] = 0.9;
    double excess = detection_amplitude(&detection, sheet->chance[1]) / sensor->threshold;
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++)
        for (int k = 0; k < DATASHEET_ECHOES; k++) {
            double ercs = radar_ercs(radar_cross_section_from_dbsm_m2(sheet->echo_dbsm[k]));
            sheet->range_m[i][k][0] = reach_m(sensor, sheet->azimuth_rad[i], ercs, 1);
            sheet->range_m[i][k][1] = reach_m(sensor, sheet->azimuth_rad[i], ercs, excess);
        }
}

void datasheet_of(const struct sensor *sensor, struct datasheet *sheet)
{
    *sheet = (struct datasheet){.echo_dbsm = {0, 10, 20}};
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++)
        sheet->azimuth_rad[i] =
            antenna_border_rad(sensor->field_of_view_rad) * i / (DATASHEET_AZIMUTHS - 1);
    for (int i = 0; i < DATASHEET_LEVELS; i++)
        sheet->accuracy[i] = accuracy_at(
            sensor, sensor->threshold * units_amplitude_from_db(10 * i), sheet->azimuth_rad);
    add_ranges(sensor, sheet);
    double ercs = sensor->threshold / radar_amplitude(&sensor->amplitude_law, &sensor->antenna,
                                                      sensor->range_max_m, 0, 1);
    sheet->weakest_dbsm = 10 * elementary_log10(radar_cross_section_m2(ercs));
}
