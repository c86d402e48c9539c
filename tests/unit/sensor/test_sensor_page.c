/* The numbers that lib/sensor/MODEL.md prints. */
#include "support/printed.h"

#include "base/elementary.h"
#include "base/units.h"
#include "radar/detection.h"
#include "radar/monopulse.h"
#include "radar/point_response.h"

/* The power of two echoes in quadrature, ratio and d bins apart. */
static double power(enum point_response response, double d, double ratio, double at)
{
    return pow(point_response_value(response, at), 2) +
           pow(ratio * point_response_value(response, at - d), 2);
}

/* Has the weaker echo a peak of its own within a bin of its place? */
static bool parts(enum point_response response, double d, double ratio)
{
    const double step = 1e-4;
    for (double at = d / 2; at < d + 1; at += step)
        if (power(response, d, ratio, at + step) > power(response, d, ratio, at) * (1 + 1e-13))
            return true;
    return false;
}

/* The least distance at which the weaker one has a peak, in bins. */
static double parted(enum point_response response, double ratio)
{
    double low = 0.1, high = response == POINT_RESPONSE_PULSE ? 6 : 1.9;
    while (high - low > 1e-5) {
        double middle = (low + high) / 2;
        *(parts(response, middle, ratio) ? &high : &low) = middle;
    }
    return high;
}

TEST(resolutions)
{
    PRINTED("6", "# bins for Hann, # bins without a window, # X for pulses of width X",
            point_response_resolution(POINT_RESPONSE_HANN),
            point_response_resolution(POINT_RESPONSE_RECTANGULAR),
            point_response_resolution(POINT_RESPONSE_PULSE) / 4);
    assert_close(parted(POINT_RESPONSE_HANN, 0.5), 1.7748, 1e-3);
    PRINTED("6", "equal echoes have one from #, #, # on, and echoes 3 dB apart from # bins of Hann",
            parted(POINT_RESPONSE_HANN, 1), parted(POINT_RESPONSE_RECTANGULAR, 1),
            parted(POINT_RESPONSE_PULSE, 1) / 4, parted(POINT_RESPONSE_HANN, sqrt(0.5)));
    PRINTED("6", "δ = # ((ΔR/h_R)²", point_response_resolution(POINT_RESPONSE_PULSE) / 2);
    PRINTED("6", "only below # m, its long side and its corners below # m",
            (0.9 * 0.9 - 0.15 * 0.15) / (2 * 0.15), (2.25 * 2.25 - 0.15 * 0.15) / (2 * 0.15));
}

/* The probability of detection of a steady echo at the lowered threshold, or at the threshold. */
static double detected_at(double threshold_db, bool lowered)
{
    double threshold = units_amplitude_from_db(threshold_db);
    double amplitude = lowered ? detection_lowered_threshold(threshold, 1) : threshold;
    return detection_in_noise(amplitude, threshold, 1);
}

TEST(detection_in_noise_below_the_threshold)
{
    PRINTED("8.4", "Q1 at T_1 # # # # #", detected_at(6, true), detected_at(10, true),
            detected_at(13.2, true), detected_at(18.1, true), detected_at(26, true));
    PRINTED("8.4", "Q1 at T # # # # #", detected_at(6, false), detected_at(10, false),
            detected_at(13.2, false), detected_at(18.1, false), detected_at(26, false));
    PRINTED("8.4", "Up to # dB T_1 is 0", units_amplitude_db(1.75));
}

static double hann(double bins)
{
    return point_response_hann(bins);
}

/* Where two opposite echoes, a bin apart, have their second peak. */
static double opposite_peak(void)
{
    double best = 1;
    for (double at = 1; at < 3; at += 1e-4)
        if (fabs(hann(at) - hann(at - 1)) > fabs(hann(best) - hann(best - 1)))
            best = at;
    return best;
}

static double width(enum point_response response, double db)
{
    double low = 0, high = 1.9;
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2, amplitude = point_response_value(response, middle);
        *(amplitude > pow(10, -db / 20) ? &low : &high) = middle;
    }
    return 2 * low;
}

static double lobe_db(enum point_response response)
{
    double most = 0;
    for (double bins = point_response_main_lobe(response); bins < 4; bins += 1e-4)
        most = fmax(most, fabs(point_response_value(response, bins)));
    return 20 * log10(most);
}

static double bandwidth(enum point_response response)
{
    return 100 * pow(point_response_noise(response, 100), 2);
}

#define HALF_POWER (10 * log10(2))

TEST(smearing)
{
    PRINTED("6.1", "W: 1 at 0, # at 0.5, # at 1, # at 1.5, # at 2.5", hann(0.5), hann(1), hann(1.5),
            hann(2.5));
    PRINTED("6.1", "one peak between them, # dB (ψ = 0), # dB (90 deg)", 20 * log10(2 * hann(0.5)),
            20 * log10(sqrt(2) * hann(0.5)));
    PRINTED("6.1", "at # and # (180 deg)", 1 - opposite_peak(), opposite_peak());
#define OF_WINDOW(w)                                                                               \
    width(w, HALF_POWER), width(w, 2 * HALF_POWER), bandwidth(w),                                  \
        -20 * log10(point_response_value(w, 0.5)), lobe_db(w)
    PRINTED("6.1", "none # # # # dB # dB", OF_WINDOW(POINT_RESPONSE_RECTANGULAR));
    PRINTED("6.1", "Hann # # # # dB # dB", OF_WINDOW(POINT_RESPONSE_HANN));
}

/* The angle of a cell of two echoes of these strengths, in degrees, by the rule of the paper. */
static double merged(enum antenna_phase phase, double strength, double degrees,
                     double other_strength, double other_degrees)
{
    struct antenna antenna = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = phase};
    struct antenna_pointers a = antenna_pointers(&antenna, degrees * DEGREE);
    struct antenna_pointers b = antenna_pointers(&antenna, other_degrees * DEGREE);
    struct antenna_pointers both = {strength * a.sum + other_strength * b.sum,
                                    strength * a.delta + other_strength * b.delta};
    return fabs(monopulse_angle(&antenna, MONOPULSE_MAGNITUDE, both).azimuth_rad) / DEGREE;
}

static double mirrored(double degrees)
{
    return merged(PHASE_ELEMENT, 1, -degrees, 1, degrees);
}

static double of_8_degrees(enum antenna_phase phase, double ratio)
{
    return merged(phase, 1, -8, ratio, 8);
}

TEST(superposition)
{
    PRINTED("8.1", "element # # # # # # # # #", mirrored(4), mirrored(6), mirrored(8), mirrored(10),
            mirrored(12), mirrored(15), mirrored(20), mirrored(25), mirrored(30));
    PRINTED("8.1", "`element` #, #, #, `centre` #, #, # deg", of_8_degrees(PHASE_ELEMENT, 1),
            of_8_degrees(PHASE_ELEMENT, 2), of_8_degrees(PHASE_ELEMENT, 5),
            of_8_degrees(PHASE_CENTRE, 1), of_8_degrees(PHASE_CENTRE, 2),
            of_8_degrees(PHASE_CENTRE, 5));
    PRINTED("8.1", "-5 and +15 deg: # and # deg", merged(PHASE_ELEMENT, 1, -5, 1, 15),
            merged(PHASE_CENTRE, 1, -5, 1, 15));
}

/* The quantile of the angle of two equal echoes at 8 degrees to either side, of even phases. */
static double quantile(double part)
{
    double u = PI / 2 * sin(8 * DEGREE);
    return asin(2 / PI * atan(tan(u) * tan(PI / 2 * part))) / DEGREE;
}

TEST(phases)
{
    PRINTED("8.2", "quantiles #, #, #, #, # deg (10, 25, 50, 75, 90 %)", quantile(0.1),
            quantile(0.25), quantile(0.5), quantile(0.75), quantile(0.9));
    PRINTED("8.3", "T then stands # dB above the noise",
            20 * log10(units_amplitude_from_db(6) / 0.5));
    PRINTED("14.18", "10 dB below their mean power with #, 20 dB with #", acos(0.9) / PI,
            acos(0.99) / PI);
    PRINTED("14.18", "half a turn: # mm at 76.5 GHz", 250 * units_wavelength_m(76.5e9));
}
