#include "documents/consistency.h"

#include "base/elementary.h"
#include "base/units.h"
#include "documents/antenna_array.h"

/* ---- members that need or exclude each other ---- */

/* Refuses chirps that would take longer than from one repetition to the next. */
static int check_chirp(const struct sensor *sensor, struct diag *diag)
{
    const struct waveform *waveform = &sensor->waveform;
    if (waveform->samples == 0 || waveform->kind == WAVEFORM_PULSE || sensor->chirp_slope_hzps == 0)
        return 0;
    double bandwidth_hz = SPEED_OF_LIGHT_MPS / (2 * sensor->cell_range_m);
    double repetition_s = units_wavelength_m(sensor->carrier_hz) /
                          (2 * sensor->cell_range_rate_mps * (double)waveform->repetitions) /
                          elementary_max(1, (double)sensor->array.transmit.count);
    if (fabs(sensor->chirp_slope_hzps) * repetition_s >= bandwidth_hz * (1 - 1e-9))
        return 0;
    return diag_fail(diag, DIAG_CONFIG,
                     "chirp_slope_hzps: %g; expected at least %g either way, as a chirp of the "
                     "waveform sweeps %g Hz and has %g s",
                     sensor->chirp_slope_hzps, bandwidth_hz / repetition_s, bandwidth_hz,
                     repetition_s);
}

/* Refuses two statements about the level over range or over elevation, and none over range. */
static int check_levels(const struct sensor *sensor, struct diag *diag)
{
    bool ercs = sensor->calibration_ercs > 0, range = sensor->calibration_range_m > 0;
    bool curve = sensor->range_curve != NULL;
    if (curve && (ercs || range || sensor->exponent != 2))
        return diag_fail(diag, DIAG_CONFIG,
                         "range_curve: \"%s\"; expected none beside calibration_ercs %g, "
                         "calibration_range_m %g and exponent %g",
                         sensor->range_curve, sensor->calibration_ercs, sensor->calibration_range_m,
                         sensor->exponent);
    if (!curve && !(ercs && range))
        return diag_fail(diag, DIAG_CONFIG,
                         "range_curve: expected either a curve or calibration_ercs and "
                         "calibration_range_m");
    if (sensor->elevation_curve != NULL && sensor->elevation_half_width_rad > 0)
        return diag_fail(
            diag, DIAG_CONFIG,
            "elevation_curve: \"%s\"; expected none beside elevation_half_width_rad %g",
            sensor->elevation_curve, sensor->elevation_half_width_rad);
    bool elevation = sensor->elevation_half_width_rad > 0 || sensor->elevation_curve != NULL;
    if (elevation && !(sensor->mount_z_m > 0))
        return diag_fail(diag, DIAG_CONFIG, "mount_z_m: missing; %s needs it",
                         sensor->elevation_curve != NULL ? "elevation_curve"
                                                         : "elevation_half_width_rad");
    return 0;
}

/* Refuses an elevation that is measured without a height of the sensor, and figures of one that is
 * not measured. */
static int check_elevation(const struct sensor *sensor, struct diag *diag)
{
    const struct {
        const char *name;
        double value;
    } figures[] = {{"elevation_sigma_rad", sensor->elevation_sigma_rad},
                   {"elevation_floor_rad", sensor->elevation_floor_rad},
                   {"elevation_step_rad", sensor->elevation_step_rad}};
    bool measured = sensor->elevation_view_rad > 0;
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        if (figures[i].value > 0 && !measured)
            return diag_fail(diag, DIAG_CONFIG, "elevation_view_rad: missing; %s needs it",
                             figures[i].name);
    if (measured && !(sensor->mount_z_m > 0))
        return diag_fail(diag, DIAG_CONFIG, "mount_z_m: missing; elevation_view_rad needs it");
    return 0;
}

/* Refuses limits that do not ascend or exceed range_max_m, and what the signal does not have. */
static int check_limits(const struct sensor *sensor, struct diag *diag)
{
    const struct range_limit *limits = sensor->range_limits.items;
    bool signal = sensor->waveform.samples > 0;
    for (size_t i = 0; i < sensor->range_limits.count; i++) {
        if (!(limits[i].range_max_m > sensor->range_min_m &&
              limits[i].range_max_m <= sensor->range_max_m))
            return diag_fail(
                diag, DIAG_CONFIG,
                "range_limits[%zu].range_max_m: %g; expected more than range_min_m, %g "
                "m, and at most the sensor's range_max_m, %g m",
                i, limits[i].range_max_m, sensor->range_min_m, sensor->range_max_m);
        if (i > 0 && !(limits[i].azimuth_rad > limits[i - 1].azimuth_rad))
            return diag_fail(diag, DIAG_CONFIG,
                             "range_limits[%zu].azimuth_rad: %g does not ascend from %g rad", i,
                             limits[i].azimuth_rad, limits[i - 1].azimuth_rad);
    }
    if (signal && sensor->range_limits.count > 0)
        return diag_fail(diag, DIAG_CONFIG, "range_limits: expected none beside a waveform");
    if (sensor->unambiguous_middle_mps != 0 && (signal || sensor->unambiguous_rate_mps == 0))
        return diag_fail(diag, DIAG_CONFIG,
                         "unambiguous_middle_mps: %g; expected only with unambiguous_rate_mps, and "
                         "without a waveform",
                         sensor->unambiguous_middle_mps);
    return 0;
}

/* Refuses an array without its pattern and estimator, these without it, and a second train beside
 * transmitters that take turns. */
static int check_array(const struct sensor *sensor, struct diag *diag)
{
    const struct array_layout *layout = &sensor->array;
    bool stated = layout->transmit.count + layout->receive.count > 0;
    bool array = sensor->antenna_pattern == ANTENNA_ARRAY;
    if (array != stated || array != (sensor->angle_estimator == MONOPULSE_BEAMS))
        return diag_fail(diag, DIAG_CONFIG,
                         "array: expected with antenna_pattern \"array\" and angle_estimator "
                         "\"beams\", and only with both");
    if (layout->transmit.count > 1 && sensor->waveform.stagger > 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "waveform.stagger: %lld; expected none beside an array of %zu "
                         "transmitters, whose turns tell folded range rates apart",
                         (long long)sensor->waveform.stagger, layout->transmit.count);
    return array ? antenna_array_check(layout, sensor->field_of_view_rad, diag) : 0;
}

int consistency_members(const struct sensor *sensor, struct diag *diag)
{
    if (sensor->receiver_bandwidth_hz > 0 && sensor->chirp_s == 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "chirp_s: missing; receiver_bandwidth_hz needs it for interference");
    if (sensor->range_max_m <= sensor->range_min_m)
        return diag_fail(diag, DIAG_CONFIG, "range_max_m: %g is not above range_min_m, %g m",
                         sensor->range_max_m, sensor->range_min_m);
    if (check_limits(sensor, diag) != 0 || check_levels(sensor, diag) != 0 ||
        check_elevation(sensor, diag) != 0 || check_array(sensor, diag) != 0)
        return -1;
    bool pattern = sensor->antenna_pattern == ANTENNA_TABLE;
    if (pattern && sensor->antenna_table == NULL)
        return diag_fail(diag, DIAG_CONFIG,
                         "antenna_table: missing; antenna_pattern \"table\" needs it");
    if (!pattern && sensor->antenna_table != NULL)
        return diag_fail(diag, DIAG_CONFIG,
                         "antenna_table: \"%s\"; expected only with antenna_pattern \"table\"",
                         sensor->antenna_table);
    if (sensor->radome_bias_rad > 0 && sensor->radome_period_rad == 0)
        return diag_fail(diag, DIAG_CONFIG, "radome_period_rad: missing; radome_bias_rad needs it");
    bool hann = sensor->waveform.window == POINT_RESPONSE_HANN;
    enum range_migration other = hann ? MIGRATION_RECTANGULAR : MIGRATION_HANN;
    if (sensor->waveform.samples > 0 && sensor->range_migration == other)
        return diag_fail(diag, DIAG_CONFIG,
                         "range_migration: \"%s\"; expected waveform.window, or compensated",
                         hann ? "rectangular" : "hann");
    if (sensor->waveform.samples > 0 && sensor->cell_extent == CELL_HALF_WIDTH)
        return diag_fail(diag, DIAG_CONFIG,
                         "cell_extent: \"half_width\"; expected none, as the waveform's window "
                         "sets the size of cells");
    if (waveform_check(&sensor->waveform, sensor->cell_range_m, sensor->range_max_m, diag) != 0)
        return diag_prefix(diag, "waveform.");
    return check_chirp(sensor, diag);
}

/* ---- figures that physics relates ---- */

double consistency_fold_mps(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    double turns = elementary_max(1, (double)sensor->array.transmit.count);
    double folds = elementary_max(turns, (double)waveform->stagger);
    return folds * (double)waveform->repetitions * sensor->cell_range_rate_mps / 2;
}

/* Mean number of bins in which noise alone passes the waveform's CFAR in a scan (MODEL 11.4). */
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
