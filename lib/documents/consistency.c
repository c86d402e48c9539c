#include "documents/consistency.h"

#include "base/elementary.h"
#include "base/units.h"

double consistency_fold_mps(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    double turns = elementary_max(1, (double)sensor->array.transmit.count);
    double folds = elementary_max(turns, (double)waveform->stagger);
    return folds * (double)waveform->repetitions * sensor->cell_range_rate_mps / 2;
}

/* The mean number of bins in which noise alone passes the waveform's CFAR in a scan (MODEL 11.4).
 */
static double signal_alarms(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    double step_m = waveform_range_step_m(waveform, sensor->cell_range_m);
    return (sensor->range_max_m - sensor->range_min_m) / step_m * (double)waveform->repetitions *
           waveform->cfar_false_alarm;
}

static double beat_hz(const struct sensor *sensor, double range_m)
{
    return 2 * range_m * fabs(sensor->chirp_slope_hzps) / SPEED_OF_LIGHT_MPS;
}

/* Adds a check if the document has both sides. */
static size_t add(struct consistency *checks, size_t count, const struct consistency *check)
{
    if (check->left_value > 0 && check->right_value > 0)
        checks[count++] = *check;
    return count;
}

#define ADD(kind, unit, left, left_value, right, right_value, member)                              \
    count = add(checks, count,                                                                     \
                &(struct consistency){CONSISTENCY_##kind, CONSISTENCY_##unit, left, right,         \
                                      left_value, right_value, member})
#define LIMIT(...) ADD(LIMIT, __VA_ARGS__, NULL)

static size_t add_strict(const struct sensor *sensor, struct consistency *checks)
{
    size_t count = 0;
    double alarm_rate_mps = sensor->false_alarms > 0 ? sensor->false_alarm_range_rate_mps : 0;
    double dwell_s = sensor->dwell_s, stagger = (double)sensor->waveform.stagger;
    double trains = stagger > 0 ? 2 + 1 / stagger : 0;
    ADD(STRICT, S, "dwell, wavelength/(2 cell_range_rate_mps)", dwell_s, "cycle_s", sensor->cycle_s,
        "cell_range_rate_mps");
    ADD(STRICT, S, "dwell of both trains, (2 + 1/stagger) wavelength/(2 cell_range_rate_mps)",
        trains * dwell_s, "cycle_s", sensor->cycle_s, "waveform.stagger");
    ADD(STRICT, HZ, "beat, 2 range_max_m chirp_slope_hzps/c", beat_hz(sensor, sensor->range_max_m),
        "receiver_bandwidth_hz", sensor->receiver_bandwidth_hz, "range_max_m");
    ADD(STRICT, MPS, "false alarms to false_alarm_range_rate_mps", alarm_rate_mps,
        "unambiguous_rate_mps", sensor->unambiguous_rate_mps, "false_alarm_range_rate_mps");
    return count;
}

static size_t add_signal(const struct sensor *sensor, struct consistency *checks, size_t count)
{
    double sweep_hz = fabs(sensor->chirp_slope_hzps) * sensor->chirp_s;
    bool chirps = sensor->waveform.kind == WAVEFORM_CHIRP && sweep_hz > 0;
    double sweep_m = chirps ? SPEED_OF_LIGHT_MPS / (2 * sweep_hz) : 0;
    double rate_mps = sensor->unambiguous_rate_mps, dwell_s = sensor->dwell_s;
    double repetition_s =
        rate_mps > 0 ? units_wavelength_m(sensor->carrier_hz) / (4 * rate_mps) : 0;
    double cell_m = sensor->bin_range_m;
    double fastest_mps = rate_mps > 0 ? rate_mps + fabs(sensor->unambiguous_middle_mps) : 0;
    double walk_m = sensor->range_migration == MIGRATION_COMPENSATED ? 0 : fastest_mps * dwell_s;
    LIMIT(MPS, "unambiguous_rate_mps", rate_mps, "signal, by repetitions and stagger",
          consistency_fold_mps(sensor));
    ADD(STRICT, M, "sweep, c/(2 chirp_slope_hzps chirp_s)", sweep_m, "cell_range_m", cell_m,
        "chirp_slope_hzps");
    ADD(STRICT, S, "chirp_s", sensor->chirp_s, "repetition, wavelength/(4 unambiguous_rate_mps)",
        repetition_s, "chirp_s");
    LIMIT(M, "range_max_m", sensor->range_max_m, "unambiguous_range_m",
          sensor->unambiguous_range_m);
    LIMIT(HZ, "receiver_bandwidth_hz", sensor->receiver_bandwidth_hz,
          "beat, 2 unambiguous_range_m chirp_slope_hzps/c",
          beat_hz(sensor, sensor->unambiguous_range_m));
    LIMIT(M, "walk in a dwell at the fastest unambiguous rate", walk_m, "cell_range_m", cell_m);
    LIMIT(S, "half a dwell", dwell_s / 2, "latency_s", sensor->latency_s);
    return count;
}

static size_t add_accuracy(const struct sensor *sensor, struct consistency *checks, size_t count)
{
    double cell_m = sensor->bin_range_m;
    double cell_mps = sensor->bin_range_rate_mps, even = 1 / sqrt(12);
    double factor = sensor->sigma_law == SIGMA_BY_SNR ? sensor->window_factor : 0;
    LIMIT(M, "range_sigma_m", sensor->range_sigma_m, "cell_range_m/sqrt(12)", cell_m * even);
    LIMIT(MPS, "range_rate_sigma_mps", sensor->range_rate_sigma_mps, "cell_range_rate_mps/sqrt(12)",
          cell_mps * even);
    LIMIT(RAD, "azimuth_floor_rad", sensor->azimuth_floor_rad, "azimuth_cell_rad/sqrt(12)",
          sensor->azimuth_cell_rad * even);
    LIMIT(RAD, "elevation_sigma_rad", sensor->elevation_sigma_rad, "elevation_view_rad/sqrt(12)",
          sensor->elevation_view_rad * even);
    ADD(STRICT, ONE, "Cramer-Rao bound, sqrt(6)/(2 pi)", sqrt(6) / (2 * PI), "window_factor",
        factor, "window_factor");
    LIMIT(RAD, "beam of the antenna",
          sensor->beams.count > 0 ? array_beam(&sensor->beams) : antenna_beam_rad(&sensor->antenna),
          "azimuth_cell_rad", sensor->azimuth_cell_rad);
    if (sensor->waveform.samples > 0 && sensor->pointer_sigma > 0)
        ADD(EQUAL, ONE, "false_alarms", sensor->false_alarms,
            "noise alone, range bins times repetitions times cfar_false_alarm",
            signal_alarms(sensor), "false_alarms");
    else if (sensor->false_alarms > 0)
        ADD(STRICT, ONE, "pointer_sigma", sensor->pointer_sigma,
            "noise of the search, threshold/sqrt(ln(cells/false_alarms))", sensor->search_sigma,
            "pointer_sigma");
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
    if (check->kind == CONSISTENCY_EQUAL)
        return ratio <= 2 && ratio >= 0.5;
    return ratio <= 1 + CONSISTENCY_SLACK;
}

int consistency_check(const struct sensor *sensor, size_t index, struct diag *diag)
{
    static const char *const units[] = {" s", " Hz", " m", " m/s", " rad", ""};
    struct consistency checks[CONSISTENCY_MOST];
    size_t count = consistency_list(sensor, checks);
    for (size_t i = 0; i < count; i++) {
        const struct consistency *check = &checks[i];
        const char *unit = units[check->unit];
        if (check->kind != CONSISTENCY_LIMIT && !consistency_holds(check))
            return diag_fail(diag, DIAG_CONFIG, "sensors[%zu].%s: %s, %g%s; expected %s %s, %g%s",
                             index, check->member, check->left, check->left_value, unit,
                             check->kind == CONSISTENCY_STRICT ? "at most" : "about", check->right,
                             check->right_value, unit);
    }
    return 0;
}
