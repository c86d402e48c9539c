/* The numbers that lib/radar/MODEL.md prints. */
#include "support/printed.h"

#include "base/units.h"
#include "radar/detection.h"
#include "radar/folding.h"
#include "radar/interferer.h"
#include "radar/level.h"
#include "radar/measurement_sigma.h"
#include "radar/monopulse.h"
#include "radar/point_response.h"
#include "radar/radar_equation.h"
#include "support/array_sensor.h"

static const struct antenna dipoles = {.pattern = ANTENNA_DIPOLE_PAIR};

/* The paper's radar. */
static struct radar_equation equation(void)
{
    return (struct radar_equation){.exponent = 2,
                                   .calibration_ercs = 0.8,
                                   .calibration_range_m = 30,
                                   .range_floor_m = 0.5,
                                   .threshold = units_amplitude_from_db(6)};
}

static double dbsm(double ercs)
{
    return 10 * log10(radar_cross_section_m2(ercs));
}

TEST(cross_sections)
{
#define OF_ERCS(f) f(0.2), f(0.3), f(0.4), f(0.5), f(0.6), f(0.7), f(0.8), f(1)
    PRINTED("3", "σ in m^2 # # # # # # # #", OF_ERCS(radar_cross_section_m2));
    PRINTED("3", "σ in dBsm # # # # # # # #", OF_ERCS(dbsm));
    PRINTED("3", "11.25 dBsm on average (ERCS #), people -1.37 dBsm (#)",
            radar_ercs(radar_cross_section_from_dbsm_m2(11.25)),
            radar_ercs(radar_cross_section_from_dbsm_m2(-1.37)));
}

static double detected_m(double ercs, double degrees)
{
    struct radar_equation law = equation();
    return radar_detection_range_m(&law, antenna_gain(&dipoles, degrees * DEGREE), ercs);
}

/* The farthest place aside that an ERCS is detected at. */
static double aside_m(double ercs)
{
    double most_m = 0;
    for (double degrees = 0; degrees < 90; degrees += 0.01)
        most_m = fmax(most_m, detected_m(ercs, degrees) * sin(degrees * DEGREE));
    return most_m;
}

static double aside_degrees(void)
{
    double best = 0;
    for (double degrees = 0; degrees < 90; degrees += 0.01)
        if (detected_m(1, degrees) * sin(degrees * DEGREE) >
            detected_m(1, best) * sin(best * DEGREE))
            best = degrees;
    return best;
}

static double area_m2(double ercs)
{
    double area = 0, step = 0.01;
    for (double degrees = -90 + step / 2; degrees < 90; degrees += step)
        area += pow(detected_m(ercs, degrees), 2) / 2 * step * DEGREE;
    return area;
}

TEST(calibration)
{
    struct radar_equation law = equation();
    double at_1_m = radar_reference_amplitude(&law, 1);
    PRINTED("4.1", "A_ref is # (# dB) at 1 m, # at 10 m, # at 30 m", at_1_m,
            units_amplitude_db(at_1_m), radar_reference_amplitude(&law, 10),
            radar_reference_amplitude(&law, 30));
    PRINTED("4.1", "= # sqrt(ERCS A_φ(φ))", detected_m(1, 0));
#define OF_DEGREES(ercs)                                                                           \
    ercs, detected_m(ercs, 0), detected_m(ercs, 20), detected_m(ercs, 35), detected_m(ercs, 50),   \
        detected_m(ercs, 60), aside_m(ercs), area_m2(ercs)
    PRINTED("4.1", "# # # # # # # # 0.4", OF_DEGREES(0.2));
    PRINTED("4.1", "133 # # # # # # # #", OF_DEGREES(0.4));
    PRINTED("4.1", "265 # # # # # # # #", OF_DEGREES(0.6));
    PRINTED("4.1", "398 # # # # # # # #", OF_DEGREES(0.8));
    PRINTED("4.1", "widest at # deg", aside_degrees());
}

/* The level in dB of an echo of 0 dBsm, that the page fits to 50 scans of a radar. */
static double fitted_db(double degrees)
{
    return -0.042 * degrees * degrees - 0.00013 * pow(degrees, 4);
}

/* The greatest distance from the polynomial of straight lines between rows a degree apart. */
static double straight_db(int view_degrees)
{
    double most = 0;
    for (int from = 0; from < view_degrees; from++)
        for (double part = 0; part < 1; part += 0.01) {
            double line = (1 - part) * fitted_db(from) + part * fitted_db(from + 1);
            most = fmax(most, fabs(line - fitted_db(from + part)));
        }
    return most;
}

TEST(receiver_curves)
{
    PRINTED("4.3", "within # dB of the polynomial", straight_db(17));
    double at_45_m = 68.1 - 24.4 * log10(45) + 10;
    PRINTED("4.3", "1000 m, # dB", 68.1 - 24.4 * 3);
    PRINTED("4.3", "10 dBsm has # dB at 45 m on boresight and # dB at 12 deg", at_45_m,
            at_45_m + fitted_db(12));
}

static double sum_of(double degrees)
{
    return cabs(antenna_pointers(&dipoles, degrees * DEGREE).sum);
}

static double delta_of(double degrees)
{
    return cabs(antenna_pointers(&dipoles, degrees * DEGREE).delta);
}

/* The azimuth at which the sum channel is so many dB down. */
static double down_degrees(double db)
{
    double low = 0, high = 89;
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        *(sum_of(middle) > pow(10, -db / 20) ? &low : &high) = middle;
    }
    return low;
}

TEST(pointers)
{
#define OF_AZIMUTH(f) f(0), f(5), f(10), f(20), f(30), f(35), f(40), f(50), f(60), f(70), f(80)
    PRINTED("7.1", "|H_S| # # # # # # # # # # #", OF_AZIMUTH(sum_of));
    PRINTED("7.1", "|H_D| # # # # # # # # # # #", OF_AZIMUTH(delta_of));
    PRINTED("7.1", "dB down at #, #, #, # deg", down_degrees(3), down_degrees(6), down_degrees(10),
            down_degrees(20));
}

static double asr(double degrees)
{
    double sum = sum_of(degrees), delta = delta_of(degrees);
    return (delta - sum) / (delta + sum);
}

TEST(sensing_ratios)
{
    PRINTED("7.2",
            "is # at 0, # at 5, # at 10, # at 20, # at 30, # at 40, # at 45, # at 60, # at 80",
            asr(0), asr(5), asr(10), asr(20), asr(30), asr(40), asr(45), asr(60), asr(80));
}

/* Degrees of azimuth for each unit of the sensing ratio. */
static double steepness(double degrees)
{
    const double step = 1e-4;
    double from = degrees > 0 ? degrees - step : 0;
    return (degrees + step - from) / (asr(degrees + step) - asr(from));
}

static double sigma_degrees(enum monopulse_estimator estimator, double degrees, double snr)
{
    return monopulse_sigma_rad(&dipoles, estimator, degrees * DEGREE, snr) / DEGREE;
}

TEST(conditioning)
{
    PRINTED("7.3", "deg per unit # # # # # # # # # # # #", steepness(0), steepness(5),
            steepness(10), steepness(20), steepness(30), steepness(40), steepness(50),
            steepness(60), steepness(70), steepness(80), steepness(85), steepness(89));
    PRINTED("7.3", "#, #, # deg at 0, 20, 40 deg and 30 dB", sigma_degrees(MONOPULSE_RATIO, 0, 1e3),
            sigma_degrees(MONOPULSE_RATIO, 20, 1e3), sigma_degrees(MONOPULSE_RATIO, 40, 1e3));
}

static double beam_degrees(size_t count)
{
    struct array array = array_row(count, 0.5, TAPER_RECTANGULAR);
    return 2 * asin(array_beam(&array) / 2) / DEGREE;
}

/* Values of eight elements are times N d. */
TEST(arrays)
{
    struct array plain = array_row(8, 0.5, TAPER_RECTANGULAR), hann = array_row(8, 0.5, TAPER_HANN);
    struct phasor pair[8];
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
    PRINTED("7.5", "#/(N d sqrt SNR) without a taper", 4 * array_sigma(&plain, 1));
    PRINTED("7.5", "#/(N d) without a taper, #/(N d) with Hann's", 4 * array_beam(&plain),
            4 * array_beam(&hann));
    PRINTED("7.5", "at d = 1/2 are #, #, # deg wide", beam_degrees(4), beam_degrees(8),
            beam_degrees(16));
    for (int i = 0; i < 8; i++)
        pair[i] = (struct phasor){2 * cos(PI * i * sin(5 * DEGREE)), 0};
    assert_true(array_maxima(&plain, pair, maxima) >= 2);
    PRINTED("7.5", "has its maxima at ±# deg, of #", fabs(asin(maxima[0].sine)) / DEGREE,
            maxima[0].amplitude);
}

static double by_snr(double cell, double db)
{
    struct measurement_sigma law = {.cell = cell, .factor = sqrt(6) / (2 * PI)};
    return measurement_sigma_at_snr(&law, pow(10, db / 10));
}

static double with_floor(double cell)
{
    struct measurement_sigma law = {.cell = cell, .factor = 0.68, .sigma = 0.1 * cell};
    return measurement_sigma_at_snr(&law, 100);
}

TEST(accuracy)
{
    double bandwidth_500_mhz = SPEED_OF_LIGHT_MPS / 2 / 500e6;
    PRINTED("14.7", "# = sqrt(6)/(2π)", sqrt(6) / (2 * PI));
    PRINTED("14.7", "Grandke, # times the bound", 0.68 / (sqrt(6) / (2 * PI)));
    PRINTED("14.7", "X = # m, 500 MHz # # # m", bandwidth_500_mhz, by_snr(bandwidth_500_mhz, 6),
            by_snr(bandwidth_500_mhz, 13), by_snr(bandwidth_500_mhz, 20));
    PRINTED("14.7", "X = 0.5 m/s # # m/s", by_snr(0.5, 13), by_snr(0.5, 20));
    PRINTED("14.7", "these at 20 dB: # m, # m/s", with_floor(0.15), with_floor(0.033));
}

TEST(misalignment)
{
    struct boresight_error error = {.yaw_error_rad = DEGREE};
    double aside = sin(antenna_reported_rad(&error, 0));
    double at_30_rad = antenna_reported_rad(&error, 30 * DEGREE);
    PRINTED("14.8", "reported #, #, # m aside", 10 * aside, 30 * aside, 100 * aside);
    PRINTED("14.8", "it is # m/s off for 1 deg, on boresight # m/s",
            30 * (cos(30 * DEGREE) - cos(at_30_rad)),
            30 * (1 - cos(antenna_reported_rad(&error, 0))));
}

/* Mean and deviation in dB of a fluctuation, over its draws at the middles of equal steps. */
static double fluctuation_db(enum fluctuation_law law, double db, bool deviation)
{
    enum { STEPS = 1500 };
    double mean = 0, square = 0, all = 0;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            double uniform[4] = {(i + 0.5) / STEPS, (k + 0.5) / STEPS, 0.5, 0.5};
            double drawn = units_amplitude_db(detection_fluctuation(law, db, uniform));
            mean += drawn;
            square += drawn * drawn;
            all++;
        }
    mean /= all;
    return deviation ? sqrt(square / all - mean * mean) : mean;
}

#define FINAL 9.2103403719761836 /* -ln 1e-4 */

static double detected(enum fluctuation_law law, double db)
{
    struct detection_law detection = {
        .fluctuation = law, .final_threshold = sqrt(FINAL), .noise = 1};
    return detection_probability(&detection, pow(10, db / 20));
}

TEST(fluctuations)
{
    PRINTED("14.14", "(T^2 = # σ_H^2)", -log(1e-4));
    PRINTED("14.14", "swerling_1 -ln u # #", -10 / log(10) * 0.57721566490153286,
            10 / log(10) * PI / sqrt(6));
    PRINTED("14.14", "swerling_3 -(ln u1 + ln u2)/2 # #",
            10 / log(10) * (1 - 0.57721566490153286 - log(2)),
            10 / log(10) * sqrt(PI * PI / 6 - 1));
    assert_close(fluctuation_db(FLUCTUATION_SWERLING_3, 0, false), -1.174171, 2e-2);
    assert_close(fluctuation_db(FLUCTUATION_SWERLING_3, 0, true), 3.487723, 2e-2);
    PRINTED("14.14", "N(-(ln 10/20) s^2, s) # 3.41", level_mean_db(3.41));
    PRINTED("14.14", "steady # # #", detected(FLUCTUATION_NONE, 6), detected(FLUCTUATION_NONE, 10),
            detected(FLUCTUATION_NONE, 15));
    PRINTED("14.14", "swerling_1 # # #", detected(FLUCTUATION_SWERLING_1, 6),
            detected(FLUCTUATION_SWERLING_1, 10), detected(FLUCTUATION_SWERLING_1, 15));
    PRINTED("14.14", "swerling_3 # # #", detected(FLUCTUATION_SWERLING_3, 6),
            detected(FLUCTUATION_SWERLING_3, 10), detected(FLUCTUATION_SWERLING_3, 15));
    PRINTED("14.14", "6 dB above the noise is detected with #",
            detection_in_noise(2, 2, 2 / units_amplitude_from_db(6)));
}

TEST(ambiguities)
{
    PRINTED("14.16", "45 m/s at v_u = 24.5 m/s becomes #, and -60 becomes #",
            folding_range_rate_mps(45, 0, 24.5), folding_range_rate_mps(-60, 0, 24.5));
    PRINTED("14.16", "2.5 MHz has R_u = # m", SPEED_OF_LIGHT_MPS / 2 / 2.5e6);
    PRINTED("14.16", "`lrr77-full`: # m/s, a chirp of 150 MHz every 20 us [A], and # m",
            units_wavelength_m(76.5e9) / (4 * 20e-6),
            20e6 * SPEED_OF_LIGHT_MPS / (2 * 150e6 / 20e-6));
}

/* The rise of the noise in dB. */
static double rise_db(double band_hz, double hit_share)
{
    double power_dbm = interferer_power_dbm(33, 20, units_wavelength_m(76.5e9), 50);
    double overlap = interferer_overlap(band_hz, 15e12, 20e-6);
    double ratio = interferer_ratio(power_dbm, interferer_noise_dbm(10e6, 12), overlap, hit_share);
    return units_amplitude_db(interferer_noise_factor(ratio));
}

TEST(interference)
{
    double power_dbm = interferer_power_dbm(33, 20, units_wavelength_m(76.5e9), 50);
    PRINTED("14.17", "76.5 GHz, 50 m # dB in band", power_dbm - interferer_noise_dbm(10e6, 12));
    PRINTED("14.17", "# dB rise, # dB with b = 1, # dB with 5 % of the chirps hit",
            rise_db(20e6, 1), rise_db(10e6, 1), rise_db(20e6, 0.05));
}

TEST(range_migration)
{
    double lrr77_s = units_wavelength_m(76.5e9) / (2 * 0.103);
    double corner77_s = units_wavelength_m(77e9) / (2 * 0.033);
    PRINTED("14.20", "at 30 m/s # for `lrr77`, # for `corner77`", 30 * lrr77_s / 1.79,
            30 * corner77_s / 0.15);
}

/* The mean correlation of a level at places d knots apart, over where the knots stand. */
static double correlation(double d)
{
    return d < 2 ? (1 - d / 2) * cos(PI * d / 2) + sin(PI * d / 2) / PI : 0;
}

/* Half the mean squared change of levels over so many scans, for cars at 1 to 4 m/s beside 30. */
static double semivariance_db2(int scans)
{
    double sum = 0, lag_s = 0.06 * scans;
    for (int mps = 1; mps <= 4; mps++)
        sum += 16 * (1 - correlation(lag_s * (60 + mps) / 56)) +
               3.6 * 3.6 * (1 - correlation(lag_s * mps / 0.23));
    return sum / 4;
}

TEST(levels)
{
    PRINTED("14.22", "ρ # # # # # #", correlation(0.05), correlation(0.25), correlation(0.5),
            correlation(1), correlation(1.5), correlation(2));
    PRINTED("14.22", "differ by # dB at 8 dB",
            level_centre_db(LEVEL_KEEPS_MEDIAN, 8) - level_centre_db(LEVEL_KEEPS_MEAN, 8));
    PRINTED("14.22", "s_f = 3.6 dB # # # #", semivariance_db2(1), semivariance_db2(5),
            semivariance_db2(12), semivariance_db2(25));
}
