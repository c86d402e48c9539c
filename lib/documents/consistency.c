#include "documents/consistency.h"

#include <math.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/snr_sigma.h"

/* The size of a cell in a document may mean half of it. */
static double width(const struct sensor *sensor, double cell)
{
    return sensor->cell_extent == CELL_HALF_WIDTH ? 2 * cell : cell;
}

double consistency_dwell_s(const struct sensor *sensor)
{
    return units_wavelength_m(sensor->carrier_hz) /
           (2 * width(sensor, sensor->cell_range_rate_mps));
}

double consistency_beam_rad(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    if (waveform->elements > 0) /* MODEL 11.5 */
        return 0.886 / ((double)waveform->elements * waveform->spacing);
    return antenna_beam_rad(&sensor->antenna);
}

double consistency_cells(const struct sensor *sensor)
{
    double ranges =
        (sensor->range_max_m - sensor->range_min_m) / width(sensor, sensor->cell_range_m);
    double rates =
        2 * sensor->false_alarm_range_rate_mps / width(sensor, sensor->cell_range_rate_mps);
    double azimuths =
        sensor->azimuth_cell_rad > 0 ? sensor->field_of_view_rad / sensor->azimuth_cell_rad : 1;
    return elementary_max(ranges, 1) * elementary_max(rates, 1) * elementary_max(azimuths, 1);
}

double consistency_noise_alarms(const struct sensor *sensor)
{
    double ratio = units_amplitude_from_db(sensor->threshold_db) / sensor->pointer_sigma;
    return consistency_cells(sensor) * elementary_exp(-ratio * ratio);
}

static double beat_hz(const struct sensor *sensor, double range_m)
{
    return 2 * range_m * fabs(sensor->chirp_slope_hzps) / SPEED_OF_LIGHT_MPS;
}

/* Adds a check whose sides the document has both. */
static size_t add(struct consistency *checks, size_t count, const struct consistency *check)
{
    if (check->left_value > 0 && check->right_value > 0)
        checks[count++] = *check;
    return count;
}

#define ADD(...) count = add(checks, count, &(struct consistency){__VA_ARGS__})

static size_t add_strict(const struct sensor *sensor, struct consistency *checks)
{
    size_t count = 0;
    ADD(CONSISTENCY_STRICT, CONSISTENCY_S, "dwell, wavelength/(2 cell_range_rate_mps)", "cycle_s",
        consistency_dwell_s(sensor), sensor->cycle_s, "cell_range_rate_mps");
    ADD(CONSISTENCY_STRICT, CONSISTENCY_HZ, "beat, 2 range_max_m chirp_slope_hzps/c",
        "receiver_bandwidth_hz", beat_hz(sensor, sensor->range_max_m),
        sensor->receiver_bandwidth_hz, "range_max_m");
    ADD(CONSISTENCY_STRICT, CONSISTENCY_MPS, "false alarms to false_alarm_range_rate_mps",
        "unambiguous_rate_mps", sensor->false_alarms > 0 ? sensor->false_alarm_range_rate_mps : 0,
        sensor->unambiguous_rate_mps, "false_alarm_range_rate_mps");
    return count;
}

static size_t add_signal(const struct sensor *sensor, struct consistency *checks, size_t count)
{
    double sweep_hz = fabs(sensor->chirp_slope_hzps) * sensor->chirp_s;
    double dwell_s = consistency_dwell_s(sensor), rate_mps = sensor->unambiguous_rate_mps;
    double cell_m = width(sensor, sensor->cell_range_m);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_M, "sweep, c/(2 chirp_slope_hzps chirp_s)", "cell_range_m",
        sweep_hz > 0 ? SPEED_OF_LIGHT_MPS / (2 * sweep_hz) : 0, cell_m, NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_S, "chirp_s",
        "repetition, wavelength/(4 unambiguous_rate_mps)", sensor->chirp_s,
        rate_mps > 0 ? units_wavelength_m(sensor->carrier_hz) / (4 * rate_mps) : 0, NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_M, "range_max_m", "unambiguous_range_m", sensor->range_max_m,
        sensor->unambiguous_range_m, NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_HZ, "receiver_bandwidth_hz",
        "beat, 2 unambiguous_range_m chirp_slope_hzps/c", sensor->receiver_bandwidth_hz,
        beat_hz(sensor, sensor->unambiguous_range_m), NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_M, "walk in a dwell at unambiguous_rate_mps", "cell_range_m",
        rate_mps * dwell_s, cell_m, NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_S, "half a dwell", "latency_s", dwell_s / 2,
        sensor->latency_s, NULL);
    ADD(CONSISTENCY_EQUAL, CONSISTENCY_ONE, "false_alarms",
        "noise alone, cells exp(-(threshold/pointer_sigma)^2)", sensor->false_alarms,
        sensor->pointer_sigma > 0 ? elementary_max(consistency_noise_alarms(sensor), 1e-300) : 0,
        NULL);
    return count;
}

static size_t add_accuracy(const struct sensor *sensor, struct consistency *checks, size_t count)
{
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_M, "range_sigma_m", "cell_range_m/sqrt(12)",
        sensor->range_sigma_m, width(sensor, sensor->cell_range_m) / sqrt(12), NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_MPS, "range_rate_sigma_mps", "cell_range_rate_mps/sqrt(12)",
        sensor->range_rate_sigma_mps, width(sensor, sensor->cell_range_rate_mps) / sqrt(12), NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_RAD, "azimuth_floor_rad", "azimuth_cell_rad/sqrt(12)",
        sensor->azimuth_floor_rad, sensor->azimuth_cell_rad / sqrt(12), NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_ONE, "Cramer-Rao bound, sqrt(6)/(2 pi)", "window_factor",
        sqrt(6) / (2 * PI), sensor->sigma_law == SIGMA_BY_SNR ? sensor->window_factor : 0, NULL);
    ADD(CONSISTENCY_LIMIT, CONSISTENCY_RAD, "beam of the antenna", "azimuth_cell_rad",
        consistency_beam_rad(sensor), sensor->azimuth_cell_rad, NULL);
    return count;
}

size_t consistency_list(const struct sensor *sensor, struct consistency *checks)
{
    size_t count = add_strict(sensor, checks);
    return add_accuracy(sensor, checks, add_signal(sensor, checks, count));
}

bool consistency_holds(const struct consistency *check)
{
    double ratio = check->left_value / check->right_value;
    /* The roundings of figures that are equal are no disagreement. */
    if (check->kind == CONSISTENCY_EQUAL)
        return ratio <= 2 && ratio >= 0.5;
    return ratio <= 1 + 1e-6;
}

int consistency_check(const struct sensor *sensor, size_t index, struct diag *diag)
{
    static const char *const units[] = {"s", "Hz", "m", "m/s", "rad", ""};
    struct consistency checks[CONSISTENCY_MOST];
    size_t count = add_strict(sensor, checks);
    for (size_t i = 0; i < count; i++) {
        const struct consistency *check = &checks[i];
        const char *unit = units[check->unit];
        if (!consistency_holds(check))
            return diag_fail(diag, DIAG_CONFIG,
                             "sensors[%zu].%s: %s, %g %s; expected at most sensors[%zu].%s, %g %s",
                             index, check->member, check->left, check->left_value, unit, index,
                             check->right, check->right_value, unit);
    }
    return 0;
}
