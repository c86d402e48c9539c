#include "run/datasheet.h"

#include <stdio.h>

#include "base/elementary.h"
#include "base/units.h"
#include "documents/consistency.h"
#include "documents/usual_figures.h"
#include "effects/effect.h"
#include "radar/detection.h"
#include "text/text_table.h"

#define LONG_RANGE_M 150 /* radars that look farther are of another class than those of corners */
#define LEAST_GAIN 1e-6  /* less is rounding where a pattern ends in a zero */

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
        double sigma_rad = suite_azimuth_sigma_rad(sensor, azimuth_rad[i], ratio * ratio);
        bool seen = antenna_gain(&sensor->antenna, azimuth_rad[i]) > LEAST_GAIN;
        sigma_rad = elementary_hypot(sigma_rad, suite_azimuth_floor_rad(sensor, azimuth_rad[i]));
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
    double end_m = elementary_min(range_m, suite_range_max_m(sensor, azimuth_rad));
    return end_m < least_m ? 0 : end_m;
}

static void add_ranges(const struct sensor *sensor, struct datasheet *sheet)
{
    double level_db = elementary_hypot(
        elementary_hypot(sensor->level_constant_db, sensor->level_slow_db), sensor->level_fast_db);
    struct detection_law detection = {
        .fluctuation = sensor->fluctuation,
        .fluctuation_sigma_db = sensor->fluctuation_sigma_db,
        .threshold = sensor->lowered_threshold,
        .final_threshold = sensor->final_threshold ? sensor->threshold : 0,
        .noise = sensor->pointer_sigma,
        .level_mean_db = level_centre_db(sensor->level_keeps, level_db),
        .level_sigma_db = level_db,
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
    double border_rad = elementary_max(antenna_border_rad(sensor->field_of_view_rad), 0);
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++)
        sheet->azimuth_rad[i] = border_rad * i / (DATASHEET_AZIMUTHS - 1);
    for (int i = 0; i < DATASHEET_LEVELS; i++)
        sheet->accuracy[i] = accuracy_at(
            sensor, sensor->threshold * units_amplitude_from_db(10 * i), sheet->azimuth_rad);
    add_ranges(sensor, sheet);
    double ercs = sensor->threshold / radar_amplitude(&sensor->amplitude_law, &sensor->antenna,
                                                      sensor->range_max_m, 0, 1);
    sheet->weakest_dbsm = 10 * elementary_log10(radar_cross_section_m2(ercs));
}

#define DEGREES (180 / PI)

static void add_update(const struct sensor *sensor, struct text *text)
{
    text_add_word(text, "  update             ");
    if (sensor->cycle_s > 0)
        text_format(text, "every %.4g ms", 1e3 * sensor->cycle_s);
    else
        text_add_word(text, "in every frame");
    text_format(text, ", from a dwell of %.3g ms; latency %.4g ms\n", 1e3 * sensor->dwell_s,
                1e3 * sensor->latency_s);
}

static void add_ambiguity(const struct sensor *sensor, struct text *text)
{
    text_add_word(text, "  unambiguous        ");
    if (sensor->unambiguous_range_m > 0)
        text_format(text, "to %.4g m, ", sensor->unambiguous_range_m);
    else
        text_add_word(text, "at every range, ");
    double middle_mps = sensor->unambiguous_middle_mps, rate_mps = sensor->unambiguous_rate_mps;
    if (middle_mps != 0)
        text_format(text, "from %.4g to %.4g m/s", middle_mps - rate_mps, middle_mps + rate_mps);
    else if (rate_mps > 0)
        text_format(text, "within +-%.4g m/s", rate_mps);
    else
        text_add_word(text, "at every rate");
    if (sensor->waveform.samples > 0)
        text_format(text, "; the signal within +-%.4g m/s", consistency_fold_mps(sensor));
    text_add_word(text, "\n");
}

static void add_array(const struct sensor *sensor, struct text *text)
{
    const struct array *array = &sensor->beams;
    size_t transmitters = sensor->array.transmit.count;
    text_format(text,
                "azimuths %.3g degrees apart\n"
                "  array              %zu transmitter%s, %zu receivers: %zu elements, %.4g "
                "wavelengths apart\n",
                DEGREES * array_beam(array), transmitters, transmitters > 1 ? "s in turn" : "",
                sensor->array.receive.count, array->count, array->spacing);
}

static void add_resolution(const struct sensor *sensor, struct text *text)
{
    double beam = DEGREES * antenna_beam_rad(&sensor->antenna);
    text_format(text, "  cell               %.3g m, %.3g m/s; ", sensor->bin_range_m,
                sensor->bin_range_rate_mps);
    if (sensor->beams.count > 0)
        add_array(sensor, text);
    else
        text_add_word(text, "no separation in angle\n");
    text_format(text, "  resolution         %.3g m or %.3g m/s from a stronger echo\n",
                sensor->half_range_m, sensor->half_range_rate_mps);
    text_format(text, "  %s%.3g degrees wide, ",
                sensor->beams.count > 0 ? "element's beam     " : "beam               ", beam);
    if (sensor->elevation_half_width_rad > 0)
        text_format(text, "%.3g degrees high\n", 2 * DEGREES * sensor->elevation_half_width_rad);
    else if (sensor->elevation_curve != NULL)
        text_format(text, "in elevation by %s\n", sensor->elevation_curve);
    else
        text_add_word(text, "without a limit in elevation\n");
}

static void add_elevation(const struct sensor *sensor, struct text *text)
{
    if (sensor->elevation_view_rad > 0)
        text_format(text,
                    "  elevation          within +-%.3g degrees; 1 sigma: %.2g degrees at the "
                    "threshold, at best %.2g\n",
                    DEGREES * sensor->elevation_view_rad / 2,
                    DEGREES * suite_elevation_sigma_rad(sensor, sensor->threshold),
                    DEGREES * sensor->elevation_floor_rad);
}

/* How bodies of one class differ; nothing where they do not. */
static void add_levels(const struct sensor *sensor, struct text *text)
{
    if (sensor->level_constant_db == 0 && sensor->level_slow_db == 0 && sensor->level_fast_db == 0)
        return;
    text_format(
        text,
        "  levels of bodies   1 sigma: %.3g dB, %.3g dB over %.4g m driven, %.3g dB over aspect "
        "and range; %s kept\n",
        sensor->level_constant_db, sensor->level_slow_db, sensor->level_slow_m,
        sensor->level_fast_db, sensor->level_keeps == LEVEL_KEEPS_MEAN ? "mean" : "median");
}

static void add_limits(const struct sensor *sensor, struct text *text)
{
    for (size_t i = 0; i < sensor->range_limits.count; i++) {
        const struct range_limit *limit = &sensor->range_limits.items[i];
        text_format(text, "%s %.4g m at %.4g degrees", i == 0 ? "  range limits      " : ",",
                    limit->range_max_m, DEGREES * limit->azimuth_rad);
    }
    if (sensor->range_limits.count > 0)
        text_add_word(text, "\n");
}

static void add_effects(const char *label, uint64_t set, struct text *text)
{
    text_add_word(text, label);
    for (int i = 0, count = 0; i < EFFECT_COUNT; i++)
        if ((set & EFFECT_BIT(i)) != 0)
            text_format(text, "%s%s", count++ > 0 ? ", " : "", effects_names[i]);
}

uint64_t datasheet_missing(const struct sensor *sensor)
{
    uint64_t missing = effect_missing(sensor);
    bool levels = (missing & EFFECT_BIT(EFFECT_LEVEL)) == 0;
    if (levels)
        missing &= ~EFFECT_BIT(EFFECT_FLUCTUATION);
    if (sensor->elevation_view_rad == 0)
        missing &= ~EFFECT_BIT(EFFECT_ELEVATION_NOISE);
    return missing;
}

struct datasheet_example datasheet_example(const struct sensor *sensor)
{
    if (sensor->range_max_m > LONG_RANGE_M)
        return (struct datasheet_example){"lrr77-full", EFFECT_BIT(EFFECT_COHERENCE)};
    return (struct datasheet_example){"radarscenes77-full", EFFECT_BIT(EFFECT_QUANTISATION)};
}

/* The effects that the document lacks, and a suite to extend that has them. */
static void add_missing(const struct sensor *sensor, struct text *text)
{
    uint64_t missing = datasheet_missing(sensor);
    struct datasheet_example example = datasheet_example(sensor);
    uint64_t neither = missing & example.missing;
    add_effects("  not described:     ", missing, text);
    text_add_word(text, missing == 0 ? "no effect" : "");
    if (neither != missing)
        text_format(text, "; \"extends\": \"%s\" has them", example.name);
    if (neither != missing && neither != 0)
        add_effects(" without ", neither, text);
    add_effects("\n  of the scene:      ", effect_of_scenes(), text);
    text_add_word(text, "\n");
}

static void add_figures(const struct sensor *sensor, const struct datasheet *sheet,
                        struct text *text)
{
    text_format(text, "  carrier            %.5g GHz\n", 1e-9 * sensor->carrier_hz);
    text_format(text, "  field of view      +-%.4g degrees\n",
                DEGREES * sensor->field_of_view_rad / 2);
    text_format(text,
                "  range              %.4g (blind before) to %.4g m, where %.1f dBsm are seen\n",
                sensor->range_min_m, sensor->range_max_m, sheet->weakest_dbsm);
    add_limits(sensor, text);
    add_resolution(sensor, text);
    add_elevation(sensor, text);
    add_ambiguity(sensor, text);
    add_update(sensor, text);
    add_levels(sensor, text);
    text_format(text, "  false alarms       %.3g a scan\n", sensor->false_alarms);
    if (sensor->list_limit > 0)
        text_format(text, "  list               the %s %lld\n",
                    sensor->list_order == LIST_STRONGEST ? "strongest" : "nearest",
                    (long long)sensor->list_limit);
    add_missing(sensor, text);
}

static void add_accuracy(const struct sensor *sensor, const struct datasheet *sheet,
                         struct text *text)
{
    struct text rows = {0};
    text_add_word(&rows, "accuracy, 1 sigma\trange, m\trate, m/s\tazimuth, degrees, at");
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++)
        text_format(&rows, "\t%.3g", DEGREES * sheet->azimuth_rad[i]);
    for (int i = 0; i < DATASHEET_LEVELS; i++) {
        const struct datasheet_accuracy *accuracy = &sheet->accuracy[i];
        if (isfinite(accuracy->snr_db))
            text_format(&rows, "\nSNR %5.1f dB", accuracy->snr_db);
        else
            text_format(&rows, "\nthreshold + %2d dB", 10 * i);
        text_format(&rows, "\t%.2g\t%.2g\t", accuracy->range_sigma_m,
                    accuracy->range_rate_sigma_mps);
        for (int k = 0; k < DATASHEET_AZIMUTHS; k++)
            if (isfinite(accuracy->azimuth_sigma_rad[k]))
                text_format(&rows, "\t%.2g", DEGREES * accuracy->azimuth_sigma_rad[k]);
            else
                text_add_word(&rows, "\t-");
    }
    text_add_word(&rows, "\n");
    text_add_word(text, "\n");
    text_table_write(&rows, (int[]){-17, 12, 11, 21, 5, 0}, "  ", text);
    if (sensor->range_sigma_share > 0)
        text_format(text, "  range: at least %.3g %% of the range, %.3g m at %.4g m\n",
                    100 * sensor->range_sigma_share,
                    sensor->range_sigma_share * sensor->range_max_m, sensor->range_max_m);
}

static void add_range(double range_m, double range_max_m, struct text *rows)
{
    if (range_m > 0)
        text_format(rows, "\t%s%.4g", range_m < range_max_m ? "" : ">", range_m);
    else
        text_add_word(rows, "\t-");
}

static void add_detection(const struct sensor *sensor, const struct datasheet *sheet,
                          struct text *text)
{
    struct text rows = {0};
    text_format(text, "\n  detected up to, m, with a probability of %.2f and of %.2f\n",
                sheet->chance[0], sheet->chance[1]);
    text_add_word(&rows, "at");
    for (int k = 0; k < DATASHEET_ECHOES; k++)
        text_format(&rows, "\t\t%.0f dBsm", sheet->echo_dbsm[k]);
    for (int i = 0; i < DATASHEET_AZIMUTHS; i++) {
        text_format(&rows, "\n%5.3g degrees", DEGREES * sheet->azimuth_rad[i]);
        for (int k = 0; k < DATASHEET_ECHOES; k++)
            for (int chance = 0; chance < DATASHEET_CHANCES; chance++)
                add_range(sheet->range_m[i][k][chance],
                          suite_range_max_m(sensor, sheet->azimuth_rad[i]), &rows);
    }
    text_add_word(&rows, "\n");
    text_table_write(&rows, (int[]){-13, 7, 0}, "  ", text);
}

static void add_checks(const struct sensor *sensor, struct text *text)
{
    static const struct {
        const char *name;
        double per_unit;
    } units[] = {
        [CONSISTENCY_S] = {" ms", 1e3}, [CONSISTENCY_HZ] = {" MHz", 1e-6},
        [CONSISTENCY_M] = {" m", 1},    [CONSISTENCY_MPS] = {" m/s", 1},
        [CONSISTENCY_ONE] = {"", 1},    [CONSISTENCY_RAD] = {" degrees", DEGREES},
    };
    struct consistency checks[CONSISTENCY_MOST];
    size_t count = consistency_list(sensor, checks);
    text_add_word(text, "\n");
    for (size_t i = 0; i < count; i++) {
        const struct consistency *check = &checks[i];
        double per_unit = units[check->unit].per_unit;
        const char *unit = units[check->unit].name;
        bool holds = consistency_holds(check);
        int digits = holds ? 4 : CONSISTENCY_DIGITS;
        text_format(text, "  %s %s, %.*g%s, %s %s, %.*g%s%s\n",
                    holds ? "holds:" : "doubt:", check->left, digits, per_unit * check->left_value,
                    unit, check->kind == CONSISTENCY_EQUAL ? "about" : "at most", check->right,
                    digits, per_unit * check->right_value, unit, holds ? "" : DOUBT_ADVICE);
    }
}

static void add_unusual(const struct sensor *sensor, struct text *text)
{
    struct usual_figure unusual[USUAL_FIGURES_MOST];
    size_t count = usual_figures_list(sensor, unusual);
    for (size_t i = 0; i < count; i++)
        text_format(text,
                    "  doubt: %s, %.*g%s, automotive radars have %.4g to %.4g%s" DOUBT_ADVICE "\n",
                    unusual[i].member, CONSISTENCY_DIGITS, unusual[i].value, unusual[i].unit,
                    unusual[i].least, unusual[i].most, unusual[i].unit);
}

static struct text sheet_of(const struct sensor *sensor)
{
    struct text text = {0};
    struct datasheet sheet;
    datasheet_of(sensor, &sheet);
    add_figures(sensor, &sheet, &text);
    add_accuracy(sensor, &sheet, &text);
    add_detection(sensor, &sheet, &text);
    add_checks(sensor, &text);
    add_unusual(sensor, &text);
    return text;
}

static void add_mount(const struct sensor *sensor, struct text *text)
{
    text_format(text, "%s: at x %.4g m, y %.4g m, ", sensor->name, sensor->mount_x_m,
                sensor->mount_y_m);
    if (sensor->mount_z_m > 0)
        text_format(text, "z %.4g m, ", sensor->mount_z_m);
    text_format(text, "looking to %.4g degrees\n", DEGREES * sensor->mount_yaw_rad);
}

void datasheet_add(const struct suite *suite, struct text *text)
{
    struct text before = {0};
    for (size_t i = 0; i < suite->sensors.count; i++) {
        struct text sheet = sheet_of(&suite->sensors.items[i]);
        bool same = before.bytes != NULL && before.length == sheet.length &&
                    memcmp(before.bytes, sheet.bytes, sheet.length) == 0;
        if (i > 0 && !same) {
            text_add(text, before.bytes, before.length);
            text_add_word(text, "\n");
        }
        add_mount(&suite->sensors.items[i], text);
        text_free(&before);
        before = sheet;
    }
    text_add(text, before.bytes, before.length);
    text_free(&before);
    if (suite->vehicles != NULL)
        text_format(text, "\nrealistic with   glint-extract --vehicles %s\n", suite->vehicles);
    for (size_t i = 0; i < suite->assumed.count; i++)
        text_format(text, "%s  %s\n", i == 0 ? "\nassumed\n" : "", suite->assumed.items[i]);
}
