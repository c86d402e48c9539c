#include "signal/peak_accuracy.h"

#include "base/elementary.h"
#include "radar/measurement_sigma.h"
#include "radar/monopulse.h"

#define CRAMER_RAO 0.389848400616838 /* sqrt(6)/(2 pi) */

/* Standard deviations in cells at a signal as strong as the noise: without window the bound; with
 * Hann's 1.58 times that behind the window, whose loss is 1.5; of a pulse 1/sqrt(16 ln 2). */
static const double factors[] = {
    [POINT_RESPONSE_HANN] = 1.58 * CRAMER_RAO / 1.224744871391589,
    [POINT_RESPONSE_RECTANGULAR] = CRAMER_RAO,
    [POINT_RESPONSE_PULSE] = 0.300281,
};

static double element_sigma_rad(const struct beamforming_array *array, double azimuth_rad,
                                double snr)
{
    double count = (double)array->elements;
    struct measurement_sigma sine = {.cell = 1 / (count * array->spacing), .factor = CRAMER_RAO};
    return measurement_sigma_at_snr(&sine, snr * (1 - 1 / (count * count))) /
           elementary_cos(azimuth_rad);
}

struct peak_accuracy peak_accuracy_of(const struct signal_cube *signal, double azimuth_rad,
                                      struct peak_snr snr)
{
    const struct sensor *sensor = signal->sensor;
    struct measurement_sigma range = {.cell = sensor->cell_range_m,
                                      .factor = factors[signal->range_response]};
    struct measurement_sigma rate = {.cell = sensor->cell_range_rate_mps,
                                     .factor = factors[sensor->waveform.window]};
    double rate_mps = measurement_sigma_at_snr(&rate, snr.found);
    double coupled_m = signal->coupling * signal->range_step_m * rate_mps, azimuth;
    if (signal->array.elements > 0)
        azimuth = element_sigma_rad(&signal->array, azimuth_rad, snr.in_beam);
    else
        azimuth = monopulse_sigma_rad(&sensor->antenna, sensor->angle_estimator, azimuth_rad,
                                      snr.in_beam);
    return (struct peak_accuracy){
        .range_sigma_m = elementary_hypot(measurement_sigma_at_snr(&range, snr.found), coupled_m),
        .range_rate_sigma_mps = rate_mps,
        .azimuth_sigma_rad = elementary_min(azimuth, sensor->field_of_view_rad / sqrt(12)),
    };
}

double peak_accuracy_bins(const struct signal_cube *signal)
{
    const struct sensor *sensor = signal->sensor;
    double ranges = (sensor->range_max_m - sensor->range_min_m) / sensor->cell_range_m;
    double beams = signal->array.elements > 0 ? (double)signal->array.elements : 1;
    return ranges * (double)signal->repetitions * beams;
}
