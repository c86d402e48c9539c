/* The numbers that lib/propagation/MODEL.md prints. */
#include "support/printed.h"

#include "base/units.h"
#include "propagation/attenuation.h"
#include "propagation/reflection.h"

/* What the road adds to a point at 0.6 m before a sensor at 0.5 m, for a constant g. */
static double two_ray_db(double g, double distance_m)
{
    const struct two_ray_ends ends = {
        .sensor_height_m = 0.5, .reflector_height_m = 0.6, .distance_m = distance_m};
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    return units_amplitude_db(reflection_two_ray_factor(&paths, g, units_wavelength_m(76.5e9)));
}

TEST(the_road_as_a_mirror)
{
    double null_m = 2 * 0.5 * 0.6 / units_wavelength_m(76.5e9);
    PRINTED("14.10", "about 2 h_s h_r/(m λ): #, #, # m", null_m, null_m / 2, null_m / 3);
    PRINTED("14.10", "g = -1 # # # #", two_ray_db(-1, 20), two_ray_db(-1, 50), two_ray_db(-1, 100),
            two_ray_db(-1, 200));
    PRINTED("14.10", "g = -0.7 # # # #", two_ray_db(-0.7, 20), two_ray_db(-0.7, 50),
            two_ray_db(-0.7, 100), two_ray_db(-0.7, 200));
}

/* What an attenuation takes there and back. */
static double taken_db(double attenuation_dbpkm, double range_m)
{
    return -units_amplitude_db(attenuation_amplitude_factor(attenuation_dbpkm, range_m));
}

static double rain_dbpkm(double carrier_hz, double rate_mmph)
{
    return attenuation_rain_dbpkm(attenuation_rain_law(carrier_hz, POLARIZATION_VERTICAL),
                                  rate_mmph);
}

TEST(rain_and_fog)
{
    PRINTED("14.15", "25 mm/h, 100 m 24.125 GHz # dB 76.5 GHz # dB",
            taken_db(rain_dbpkm(24.125e9, 25), 100), taken_db(rain_dbpkm(76.5e9, 25), 100));
    PRINTED("14.15", "50 mm/h, 250 m 76.5 GHz # dB", taken_db(rain_dbpkm(76.5e9, 50), 250));
    PRINTED("14.15", "0.5 g/m^3, 100 m 76.5 GHz # dB",
            taken_db(attenuation_fog_dbpkm(76.5e9, 10, 0.5), 100));
}

TEST(snow)
{
    PRINTED("14.19", "10 mm/h γ is # dB/km, that of as much rain #",
            attenuation_snow_dbpkm(77e9, 10), rain_dbpkm(77e9, 10));
    PRINTED("14.19", "0.75 mm/h, 1 km, one way 77 GHz # dB", attenuation_snow_dbpkm(77e9, 0.75));
    PRINTED("14.19", "10 mm/h, 100 m, there and back 24.125 GHz # dB 76.5 GHz # dB",
            taken_db(attenuation_snow_dbpkm(24.125e9, 10), 100),
            taken_db(attenuation_snow_dbpkm(76.5e9, 10), 100));
}
