#include "documents/suite.h"

#include "base/elementary.h"
#include "base/search.h"
#include "base/units.h"
#include "documents/antenna_array.h"
#include "radar/scan_timing.h"

#define LEAST 1e-100 /* what is divided by less noise or fewer false alarms may be no double */

static const char *const extents[] = {
    [CELL_WIDTH] = "width", [CELL_HALF_WIDTH] = "half_width", NULL};
static const char *const phases[] = {[CELL_IN_PHASE] = "in_phase",
                                     [CELL_RANDOM_PHASE] = "random",
                                     [CELL_PHASE_BY_PATH] = "by_path",
                                     NULL};
static const char *const migrations[] = {[MIGRATION_NONE] = "none",
                                         [MIGRATION_RECTANGULAR] = "rectangular",
                                         [MIGRATION_HANN] = "hann",
                                         [MIGRATION_COMPENSATED] = "compensated",
                                         NULL};
static const char *const laws[] = {[SIGMA_FIXED] = "fixed",
                                   [SIGMA_BY_AMPLITUDE] = "by_amplitude",
                                   [SIGMA_BY_SNR] = "by_snr",
                                   NULL};
static const char *const samplings[] = {[IF_REAL] = "real", [IF_COMPLEX] = "complex", NULL};
static const char *const firsts[] = {[FIRST_LOWERED] = "lowered", [FIRST_FULL] = "full", NULL};
static const char *const orders[] = {
    [LIST_STRONGEST] = "strongest", [LIST_NEAREST] = "nearest", NULL};
static const char *const patterns[] = {[ANTENNA_DIPOLE_PAIR] = "dipole_pair",
                                       [ANTENNA_TABLE] = "table",
                                       [ANTENNA_ARRAY] = "array",
                                       NULL};
static const char *const references[] = {
    [PHASE_CENTRE] = "centre", [PHASE_ELEMENT] = "element", NULL};
static const char *const estimators[] = {[MONOPULSE_MAGNITUDE] = "magnitude",
                                         [MONOPULSE_RATIO] = "ratio",
                                         [MONOPULSE_BEAMS] = "beams",
                                         NULL};

static const char *const polarizations[] = {
    [POLARIZATION_HORIZONTAL] = "horizontal", [POLARIZATION_VERTICAL] = "vertical", NULL};
static const char *const fluctuations[] = {
    [FLUCTUATION_NONE] = "none",
    [FLUCTUATION_SWERLING_1] = "swerling_1",
    [FLUCTUATION_SWERLING_3] = "swerling_3",
    [FLUCTUATION_LOG_NORMAL] = "log_normal",
    NULL,
};

static const char *const keeps[] = {
    [LEVEL_KEEPS_MEAN] = "mean", [LEVEL_KEEPS_MEDIAN] = "median", NULL};

/* Real numbers and choices of struct sensor. */
#define NEEDS(member, low, high, help) FIELD_REAL_IN(struct sensor, member, low, high, help)
#define MAY_HAVE(member, low, high, help) OPTIONAL_REAL(struct sensor, member, low, high, help)
#define CHOOSES(member, words, help) FIELD_CHOICE_OF(struct sensor, member, words, help)
#define MAY_CHOOSE(member, words, help) OPTIONAL_CHOICE(struct sensor, member, words, help)

static const struct field limit_fields[] = {
    {FIELD_REAL_IN(struct range_limit, azimuth_rad, 0, PI, "from boresight, to either side")},
    {FIELD_REAL_IN(struct range_limit, range_max_m, 0, 1e6, "nothing farther is measured there")},
    {0},
};

static const struct record limit_record = {
    FIELD_TABLE(struct range_limit, limit_fields, "range_limit",
                "Greatest range at an azimuth; straight between two azimuths.")};

static const struct field sensor_fields[] = {
    {FIELD_NAME_OF(struct sensor, name, "unique in the suite")},
    {NEEDS(mount_x_m, -100, 100, "from the centre of the ego's box")},
    {NEEDS(mount_y_m, -100, 100, "from the centre of the ego's box")},
    {MAY_HAVE(mount_z_m, 0.01, 100, "height above the road; absent: a flat world without heights")},
    {NEEDS(mount_yaw_rad, -PI, PI, "boresight, from the ego's heading")},
    {NEEDS(carrier_hz, 1e9, 1e12, "carrier frequency")},
    {NEEDS(range_min_m, 0, 1e6, "nothing nearer is measured")},
    {NEEDS(range_max_m, 0, 1e6, "nothing farther is measured")},
    {OPTIONAL_LIST(
        struct sensor, range_limits, &limit_record,
        "ranges below range_max_m by azimuth, which ascends from 0 on; straight between")},
    {NEEDS(field_of_view_rad, 0, PI, "full width; the border itself is outside")},
    {MAY_HAVE(elevation_half_width_rad, 1e-3, PI / 2,
              "one way, the beam is down by 3 dB this far above and below; absent: no loss")},
    {MAY_HAVE(elevation_view_rad, 1e-3, PI,
              "full width, around the horizontal; absent: elevation is not measured")},
    {OPTIONAL_FLAG(struct sensor, diffraction,
                   "do waves bend around the edges of bodies that block?")},
    {OPTIONAL_FLAG(struct sensor, curved_sides,
                   "do planes with a profile_radius_m reflect as curved surfaces?")},
    {OPTIONAL_FLAG(struct sensor, micro_motion,
                   "do wheels and limbs echo with range rates of their own?")},
    {MAY_HAVE(cycle_s, 1e-4, 1e3, "time from scan to scan; absent: a scan in every frame")},
    {MAY_HAVE(latency_s, 0, 10, "the scan shows the world this much earlier")},
    {OPTIONAL_INTEGER(struct sensor, bounces, 0, 3,
                      "2: ghosts by a mirror on the way out or back; 3: also on both ways")},
    {MAY_CHOOSE(polarization, polarizations, "of both antennas; absent: vertical"),
     .absent = POLARIZATION_VERTICAL},
    {MAY_CHOOSE(fluctuation, fluctuations, "how echoes vary from scan to scan")},
    {MAY_HAVE(fluctuation_sigma_db, 0, 30,
              "standard deviation of the log-normal law; absent: 3.41"),
     .absent = 3.41},
    {MAY_HAVE(level_constant_db, 0, 30,
              "standard deviation of levels from body to body; a body keeps it; absent: 0")},
    {MAY_HAVE(level_slow_db, 0, 30,
              "standard deviation of a body's level as it and the ego drive; absent: 0")},
    {MAY_HAVE(level_slow_m, 0.1, 1e6,
              "driven by both together, from knot to knot of the slow level; absent: 56"),
     .absent = 56},
    {MAY_HAVE(level_fast_db, 0, 30,
              "standard deviation of a body's level over its aspect and range; absent: 0")},
    {MAY_CHOOSE(level_keeps, keeps,
                "is a reflector's ERCS that of the mean power over all levels, or of the median?")},
    {MAY_HAVE(unambiguous_range_m, 0.1, 1e6, "farther echoes fold below it; absent: none do")},
    {MAY_HAVE(unambiguous_rate_mps, 0.1, 1e5,
              "faster echoes fold to within +- this of unambiguous_middle_mps; absent: none do")},
    {MAY_HAVE(unambiguous_middle_mps, -1e5, 1e5,
              "middle of the range rates that do not fold; absent: 0")},
    {MAY_HAVE(receiver_bandwidth_hz, 1, 1e12,
              "highest beat that the receiver passes; absent: other radars are not heard")},
    {MAY_CHOOSE(if_sampling, samplings,
                "are beats sampled as real values, so that the image band folds onto them, or as "
                "complex?")},
    {MAY_HAVE(noise_figure_db, 0, 100,
              "of the receiver; if_sampling real: with the image band's noise")},
    {MAY_HAVE(antenna_gain_dbi, -100, 100, "one way, on boresight")},
    {MAY_HAVE(chirp_slope_hzps, -1e15, 1e15, "frequency slope of a chirp, negative if it falls")},
    {MAY_HAVE(chirp_s, 1e-9, 1, "duration of a chirp")},
    {NEEDS(threshold_db, -300, 300, "detection threshold, 20 log10 of the amplitude")},
    {MAY_HAVE(calibration_ercs, 1e-6, 1e6,
              "on boresight an echo of this ERCS meets the threshold at calibration_range_m")},
    {MAY_HAVE(calibration_range_m, 1e-3, 1e6,
              "range at which calibration_ercs meets the threshold")},
    {MAY_HAVE(exponent, 0.1, 10, "amplitude falls with range to this power"), .absent = 2},
    {MAY_HAVE(range_floor_m, 1e-3, 1e3,
              "echoes from nearer than this have the amplitude of this range"),
     .absent = 0.5},
    {OPTIONAL_NAME(
        struct sensor, range_curve,
        "CSV file with range_m, level_db: 20 log10 of the amplitude of an echo of 0 dBsm "
        "on boresight, instead of the calibration")},
    {OPTIONAL_NAME(
        struct sensor, azimuth_curve,
        "CSV file with azimuth_rad, level_db: both ways, from the level at 0, instead of "
        "the antenna's sum amplitude")},
    {OPTIONAL_NAME(
        struct sensor, elevation_curve,
        "CSV file with elevation_rad, level_db: both ways, from the level at 0, positive "
        "upwards, instead of elevation_half_width_rad")},
    {NEEDS(cell_range_m, 1e-6, 1e6,
           "size of the resolution cell in range; with a waveform that of a bin")},
    {NEEDS(cell_range_rate_mps, 1e-6, 1e5,
           "size of the resolution cell in range rate; with a waveform that of a bin")},
    {MAY_HAVE(
        azimuth_cell_rad, 1e-6, 2 * PI,
        "azimuths this far apart count as one cell in scores; absent: a twentieth of the view")},
    {MAY_CHOOSE(cell_extent, extents,
                "whether the size of a cell is its width or half of it; with a waveform it is the "
                "width of a bin")},
    {MAY_CHOOSE(cell_phase, phases,
                "do echoes of a cell add in phase, at random or by their paths?")},
    {MAY_CHOOSE(range_migration, migrations,
                "window under which echoes that walk through range cells fade and widen, or "
                "compensated: they do not")},
    {CHOOSES(antenna_pattern, patterns,
             "the paper's two dipoles, a table, or an array, by default alike in all directions")},
    {OPTIONAL_NAME(struct sensor, antenna_table, "CSV file with azimuth_rad, sum, delta")},
    {OPTIONAL_RECORD(struct sensor, array, &antenna_array_record, "of antenna_pattern array")},
    {CHOOSES(phase_reference, references, "where phases count from; equation (6) has the element")},
    {CHOOSES(angle_estimator, estimators,
             "the paper's magnitude and sign, the real ratio, or the beams of an array")},
    {NEEDS(pointer_sigma, 0, 1e300, "RMS of the complex noise on each channel")},
    {NEEDS(range_sigma_m, 0, 1e3, "noise on range")},
    {MAY_HAVE(range_sigma_share, 0, 1, "noise on range is at least this share of the range")},
    {NEEDS(range_rate_sigma_mps, 0, 1e3, "noise on range rate")},
    {NEEDS(azimuth_sigma_rad, 0, PI, "noise on azimuth, for glint-noise-gauss")},
    {MAY_HAVE(azimuth_floor_rad, 0, PI,
              "adds to the angle's noise in quadrature, for glint-noise")},
    {OPTIONAL_NAME(struct sensor, azimuth_floor_curve,
                   "CSV file with azimuth_rad, level_db: 20 log10 of the floor, from that at 0, "
                   "which is azimuth_floor_rad")},
    {MAY_HAVE(elevation_sigma_rad, 0, PI / 2,
              "noise on elevation at the threshold, in proportion to 1/amplitude")},
    {MAY_HAVE(elevation_floor_rad, 0, PI / 2, "adds to that noise in quadrature")},
    {MAY_CHOOSE(
        sigma_law, laws,
        "noise on range and range rate: constant, proportional to threshold/amplitude, or by "
        "window_factor and amplitude/pointer_sigma, with the sigmas as floors")},
    {MAY_HAVE(window_factor, 1e-3, 1e3,
              "by_snr: sigma in cells at a signal as strong as the noise"),
     .absent = 0.68},
    {MAY_HAVE(misalignment_rad, -PI / 4, PI / 4, "every azimuth is reported larger by this")},
    {MAY_HAVE(radome_bias_rad, 0, PI / 4,
              "amplitude of the radome's error of azimuth, a sine of the azimuth")},
    {MAY_HAVE(radome_period_rad, 1e-3, 2 * PI,
              "period of the radome's error, in azimuth; needed with radome_bias_rad")},
    {MAY_HAVE(radome_phase_rad, -PI, PI, "phase of the radome's error at boresight")},
    {FIELD_FLAG_OF(struct sensor, final_threshold, "test the noisy amplitude once more")},
    {MAY_CHOOSE(first_threshold, firsts,
                "of cells before noise: lowered by 1.75 pointer_sigma where final_threshold is "
                "true, so that noise decides, or full, as in the paper; absent: lowered")},
    {MAY_HAVE(false_alarms, 0, 1e4, "mean number of targets per scan that are nothing but noise")},
    {MAY_HAVE(false_alarm_range_rate_mps, 0, 1e5,
              "false alarms have range rates up to this far from unambiguous_middle_mps"),
     .absent = 70},
    {MAY_HAVE(range_step_m, 0, 1e3, "reported in multiples of this; 0: exactly")},
    {MAY_HAVE(range_rate_step_mps, 0, 1e3, "reported in multiples of this; 0: exactly")},
    {MAY_HAVE(azimuth_step_rad, 0, PI, "reported in multiples of this; 0: exactly")},
    {MAY_HAVE(elevation_step_rad, 0, PI / 2, "reported in multiples of this; 0: exactly")},
    {CHOOSES(list_order, orders, "which targets come first, and stay if there are too many")},
    {FIELD_INTEGER_IN(struct sensor, list_limit, 0, 1e6, "most targets in a list; 0: all")},
    {OPTIONAL_RECORD(struct sensor, waveform, &waveform_record,
                     "its signal, for glint-sensor-signal")},
    {.name = "sources",
     .kind = FIELD_NOTES,
     .optional = true,
     .help = "where each figure comes from"},
    {0},
};

const struct record sensor_record = {
    FIELD_TABLE(struct sensor, sensor_fields, "sensor",
                "A radar: mount, beam, amplitude, resolution, angle, noise and list.")};

static const struct field suite_fields[] = {
    {FIELD_NAME_OF(struct suite, origin, "who made this, and from what")},
    {OPTIONAL_NAME(struct suite, effects, "which effects to simulate, as for --effects")},
    {OPTIONAL_NAME(struct suite, vehicles,
                   "the set of vehicle documents that its lists are realistic with, as for "
                   "--vehicles of glint-extract; glint-plan, glint-cost and sets take it")},
    {FIELD_LIST_OF(struct suite, sensors, &sensor_record, "the radars of one ego")},
    {FIELD_NAMES_OF(struct suite, assumed, "what no source states, for people: one sentence each"),
     FIELD_OPTIONAL},
    {0},
};

static const struct field_gone gone_fields[] = {
    {"prior", "existence follows the echoes of each scan; leave prior out"}, {0}};

const struct record suite_record = {
    FIELD_TABLE(struct suite, suite_fields, "sensor suite", "The radars that one ego carries."),
    .gone = gone_fields,
};

const struct sensor *suite_sensor(const struct suite *suite, const char *name)
{
    for (size_t i = 0; i < suite->sensors.count; i++)
        if (strcmp(suite->sensors.items[i].name, name) == 0)
            return &suite->sensors.items[i];
    return NULL;
}

double suite_range_max_m(const struct sensor *sensor, double azimuth_rad)
{
    const struct range_limit *limits = sensor->range_limits.items;
    size_t count = sensor->range_limits.count;
    double aside_rad = fabs(azimuth_rad);
    if (count == 0)
        return sensor->range_max_m;
    if (count == 1 || aside_rad <= limits[0].azimuth_rad)
        return limits[0].range_max_m;
    const struct range_limit *from =
        limits + search_row(&limits[0].azimuth_rad, sizeof *limits, count - 1, aside_rad);
    const struct range_limit *to = from + 1;
    double part = (aside_rad - from->azimuth_rad) / (to->azimuth_rad - from->azimuth_rad);
    return from->range_max_m + elementary_min(part, 1) * (to->range_max_m - from->range_max_m);
}

double suite_range_sigma_m(const struct sensor *sensor, double range_m, double sigma_m)
{
    return elementary_max(sigma_m, sensor->range_sigma_share * range_m);
}

double suite_azimuth_sigma_rad(const struct sensor *sensor, double azimuth_rad, double snr)
{
    if (sensor->beams.count > 0)
        return array_sigma(&sensor->beams, snr) / elementary_cos(azimuth_rad);
    return monopulse_sigma_rad(&sensor->antenna, sensor->angle_estimator, azimuth_rad, snr);
}

double suite_azimuth_floor_rad(const struct sensor *sensor, double azimuth_rad)
{
    const struct receiver_curve *levels = &sensor->floor_levels;
    double times = levels->rows == NULL ? 1 : receiver_curve_gain(levels, azimuth_rad);
    return times * sensor->azimuth_floor_rad;
}

double suite_elevation_sigma_rad(const struct sensor *sensor, double amplitude)
{
    double noise_rad = sensor->elevation_sigma_rad * (sensor->threshold / amplitude);
    return elementary_min(elementary_hypot(noise_rad, sensor->elevation_floor_rad),
                          sensor->elevation_view_rad / sqrt(12));
}

/* With a waveform the stated cells are bins, and half a cell is the resolution (MODEL 6). */
static void derive_cells(struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    double half = sensor->cell_extent == CELL_WIDTH ? 0.5 : 1;
    sensor->half_range_m = half * sensor->cell_range_m;
    sensor->half_range_rate_mps = half * sensor->cell_range_rate_mps;
    sensor->bin_range_m = 2 * sensor->half_range_m;
    sensor->bin_range_rate_mps = 2 * sensor->half_range_rate_mps;
    sensor->dwell_s = scan_timing_dwell_s(sensor->carrier_hz, sensor->bin_range_rate_mps);
    if (waveform->samples == 0)
        return;
    sensor->half_range_m = waveform_range_step_m(waveform, sensor->cell_range_m) *
                           point_response_resolution(waveform_range_response(waveform));
    sensor->half_range_rate_mps =
        sensor->cell_range_rate_mps * point_response_resolution(waveform->window);
}

/* RMS of noise that exceeds the threshold in as many cells of a scan as there are false alarms; its
 * power is exponential in each cell (MODEL 14.9). With a waveform, that of the pointers' noise. */
static double search_sigma(const struct sensor *sensor)
{
    double ranges = (sensor->range_max_m - sensor->range_min_m) / sensor->bin_range_m;
    double rates = 2 * sensor->false_alarm_range_rate_mps / sensor->bin_range_rate_mps;
    double azimuths =
        sensor->azimuth_cell_rad > 0 ? sensor->field_of_view_rad / sensor->azimuth_cell_rad : 1;
    double cells =
        elementary_max(ranges, 1) * elementary_max(rates, 1) * elementary_max(azimuths, 1);
    if (sensor->waveform.samples > 0 || sensor->false_alarms == 0)
        return sensor->pointer_sigma;
    return sensor->threshold /
           sqrt(elementary_max(elementary_log(cells / sensor->false_alarms), 1));
}

void suite_derive(struct sensor *sensor)
{
    if (sensor->pointer_sigma < LEAST)
        sensor->pointer_sigma = 0;
    if (sensor->false_alarms < LEAST)
        sensor->false_alarms = 0;
    derive_cells(sensor);
    sensor->threshold = units_amplitude_from_db(sensor->threshold_db);
    sensor->lowered_threshold =
        sensor->final_threshold && sensor->first_threshold == FIRST_LOWERED
            ? detection_lowered_threshold(sensor->threshold, sensor->pointer_sigma)
            : sensor->threshold;
    sensor->search_sigma = search_sigma(sensor);
    sensor->antenna.pattern = sensor->antenna_pattern;
    if (sensor->array.transmit.count > 0)
        sensor->beams = array_of(&sensor->array);
    sensor->antenna.phase = sensor->phase_reference;
    sensor->amplitude_law.exponent = sensor->exponent;
    sensor->amplitude_law.calibration_ercs = sensor->calibration_ercs;
    sensor->amplitude_law.calibration_range_m = sensor->calibration_range_m;
    sensor->amplitude_law.range_floor_m = sensor->range_floor_m;
    sensor->amplitude_law.threshold = sensor->threshold;
    sensor->range_error = (struct measurement_sigma){
        .law = sensor->sigma_law,
        .sigma = sensor->range_sigma_m,
        .cell = sensor->cell_range_m,
        .factor = sensor->window_factor,
        .threshold = sensor->threshold,
        .noise = sensor->pointer_sigma,
    };
    sensor->range_rate_error = sensor->range_error;
    sensor->range_rate_error.sigma = sensor->range_rate_sigma_mps;
    sensor->range_rate_error.cell = sensor->cell_range_rate_mps;
}
