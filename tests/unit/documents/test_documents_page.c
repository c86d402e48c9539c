/* The numbers that lib/documents/MODEL.md, MODEL.md and the pages on sensors print. */
#include "support/printed.h"

#include "base/units.h"
#include "documents/reflector_models.h"
#include "radar/interferer.h"
#include "radar/monopulse.h"
#include "radar/radar_equation.h"
#include "support/array_sensor.h"

/* The cross section of 3GPP's vehicle in dBsm, seen level: the powers of its points add up. */
static double vehicle_dbsm(double degrees)
{
    struct reflector_set set = {.model = "car"};
    double power = 0;
    reflector_models_of_3gpp(SENSING_TARGET_3GPP_VEHICLE, &set, check_arena());
    for (size_t i = 0; i < set.points.count; i++) {
        const struct point_reflector *point = &set.points.items[i];
        double off_rad = fabs(units_wrap_rad(degrees * DEGREE - point->facing_rad));
        double factor = directivity_lobe_factor(&point->lobe, off_rad, PI / 2);
        power += radar_cross_section_m2(factor * point->ercs);
    }
    return 10 * log10(power);
}

TEST(sensing_targets)
{
    PRINTED("2.8", "σ, dBsm # # # # # #", vehicle_dbsm(0), vehicle_dbsm(45), vehicle_dbsm(75),
            vehicle_dbsm(90), vehicle_dbsm(165), vehicle_dbsm(180));
}

/* The power of a smooth side of 4.6 m, seen at 45 degrees from 50 m, over its incoherent sum. */
static double smooth_side_db(double spacing_m)
{
    int count = (int)lround(4.6 / spacing_m);
    double _Complex sum = 0;
    for (int i = 0; i < count; i++) {
        double along_m = (i + 0.5 - count / 2.0) * spacing_m;
        double range_m = hypot(50 * sin(PI / 4), 50 * cos(PI / 4) + along_m);
        double phase_rad = -4 * PI * range_m / units_wavelength_m(77e9);
        sum += cos(phase_rad) + sin(phase_rad) * (double _Complex)I;
    }
    return 10 * log10(pow(cabs(sum), 2) / count);
}

TEST(contours)
{
    PRINTED("2.7", "is at # dB of its incoherent sum at s = 0.1 m and at # dB at 0.01 m",
            smooth_side_db(0.1), smooth_side_db(0.01));
}

TEST(dwells)
{
    PRINTED("10.1", "λ/(2 Y), # ms for RadarScenes'", 500 * units_wavelength_m(77e9) / 0.028);
}

/* The spacing, in wavelengths, of so many receivers whose beam is so wide. */
static double spacing_of(size_t receivers, double beam_degrees)
{
    struct array array = array_row(receivers, 1, TAPER_RECTANGULAR);
    return array_beam(&array) / sin(beam_degrees * DEGREE);
}

/* Two equal echoes at 10 degrees to either side, with phases counted from one dipole. */
static double of_two_cars_degrees(void)
{
    struct antenna antenna = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_ELEMENT};
    struct antenna_pointers left = antenna_pointers(&antenna, 10 * DEGREE);
    struct antenna_pointers right = antenna_pointers(&antenna, -10 * DEGREE);
    struct antenna_pointers both = {left.sum + right.sum, left.delta + right.delta};
    return monopulse_angle(&antenna, MONOPULSE_MAGNITUDE, both).azimuth_rad / DEGREE;
}

TEST(pages_on_sensors)
{
    static const char page[] = "data/sensors/README.md", mine[] = "data/sensors/MY_RADAR.md";
    double wavelength_m = units_wavelength_m(77e9);
    PRINTED(page, "0.1 km/h takes # ms", 500 * wavelength_m / (0.1 / 3.6));
    PRINTED(page, "0.033 m/s (# km/h, # ms)", 0.033 * 3.6, 500 * wavelength_m / 0.033);
    PRINTED(page, "appear as one at #° instead", of_two_cars_degrees());
    PRINTED(mine, "1.6 degrees: 10 receivers # wavelengths apart", spacing_of(10, 1.6));
    PRINTED(mine, "3.2 degrees: 28 receivers # wavelengths apart", spacing_of(28, 3.2));
}

TEST(constants)
{
    PRINTED("1", "10^(6/20) = # for the paper's 6 dB", units_amplitude_from_db(6));
    PRINTED("1", "k T0 is # dBm per Hz", interferer_noise_dbm(1, 0));
    PRINTED("1", "λ is # mm at 24.125 GHz, # mm at 76.5 GHz, # mm at 77 GHz",
            1e3 * units_wavelength_m(24.125e9), 1e3 * units_wavelength_m(76.5e9),
            1e3 * units_wavelength_m(77e9));
}
