#include "documents/usual_figures.h"

#include <math.h>

#include "documents/consistency.h"

struct row {
    const char *member, *unit;
    size_t offset;
    double least, most; /* of the magnitude */
};

#define ROW(member, unit, least, most)                                                             \
    {                                                                                              \
#member, unit, offsetof(struct sensor, member), least, most                                \
    }

static const struct row rows[] = {
    ROW(mount_x_m, " m", 0, 15),
    ROW(mount_y_m, " m", 0, 3),
    ROW(mount_z_m, " m", 0.05, 5),
    ROW(carrier_hz, " Hz", 10e9, 300e9),
    ROW(range_min_m, " m", 0, 20),
    ROW(range_max_m, " m", 5, 1000),
    ROW(field_of_view_rad, " rad", 0.03, 3.15),
    ROW(elevation_half_width_rad, " rad", 0.005, 1.6),
    ROW(elevation_view_rad, " rad", 0.01, 3.15),
    ROW(cycle_s, " s", 0.002, 0.5),
    ROW(latency_s, " s", 0, 0.5),
    ROW(level_slow_m, " m", 1, 1000),
    ROW(unambiguous_range_m, " m", 5, 10e3),
    ROW(unambiguous_rate_mps, " m/s", 2, 500),
    ROW(receiver_bandwidth_hz, " Hz", 10e3, 5e9),
    ROW(noise_figure_db, " dB", 1, 40),
    ROW(antenna_gain_dbi, " dBi", 0, 45),
    ROW(chirp_slope_hzps, " Hz/s", 1e9, 1e15),
    ROW(chirp_s, " s", 1e-6, 0.05),
    ROW(calibration_range_m, " m", 1, 3000),
    ROW(cell_range_m, " m", 0.01, 5),
    ROW(cell_range_rate_mps, " m/s", 0.005, 3),
    ROW(azimuth_cell_rad, " rad", 1e-3, 1.6),
    ROW(range_sigma_m, " m", 0, 3),
    ROW(range_sigma_share, " of the range", 0, 0.05),
    ROW(range_rate_sigma_mps, " m/s", 0, 1),
    ROW(azimuth_sigma_rad, " rad", 0, 0.3),
    ROW(azimuth_floor_rad, " rad", 0, 0.3),
    ROW(elevation_sigma_rad, " rad", 0, 0.3),
    ROW(elevation_floor_rad, " rad", 0, 0.1),
    ROW(misalignment_rad, " rad", 0, 0.1),
    ROW(radome_bias_rad, " rad", 0, 0.1),
    ROW(false_alarms, " a scan", 0, 500),
    ROW(range_step_m, " m", 0, 2),
    ROW(range_rate_step_mps, " m/s", 0, 2),
    ROW(azimuth_step_rad, " rad", 0, 0.1),
    ROW(elevation_step_rad, " rad", 0, 0.1),
};

_Static_assert(sizeof rows / sizeof rows[0] <= USUAL_FIGURES_MOST, "a list has room for all");

size_t usual_figures_list(const struct sensor *sensor, struct usual_figure *unusual)
{
    size_t count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct row *row = &rows[i];
        double value;
        memcpy(&value, (const char *)sensor + row->offset, sizeof value);
        double size = fabs(value), slack = CONSISTENCY_SLACK * size;
        if (size == 0 || (size + slack >= row->least && size - slack <= row->most))
            continue;
        unusual[count++] =
            (struct usual_figure){row->member, row->unit, value, row->least, row->most};
    }
    return count;
}
