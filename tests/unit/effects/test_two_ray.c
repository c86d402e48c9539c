#include "support/effect_bench.h"
#include "support/printed.h"

#include <complex.h>

static const double _Complex i = (double _Complex)I;
static const double sensor_m = 0.5, reflector_m = 0.6, concrete_loss = 0.318;

/* The field by way of the road over the direct one, g R1/R2, for concrete by Fresnel's vertical
 * coefficient. Sets the length of the direct path and by how much the other is longer, one way. */
static double _Complex road_echo(double wave_m, double along_m, double *direct_m, double *longer_m)
{
    const double ghz = 76.5, roughness_m = 3e-4;
    double bounced_m = hypot(along_m, sensor_m + reflector_m);
    double _Complex eps = 5.24 - i * (17.98 * 0.0462 * pow(ghz, 0.7822) / ghz);
    double sine = (sensor_m + reflector_m) / bounced_m;
    double _Complex bent = csqrt(eps - (1 - sine * sine));
    double _Complex g = (eps * sine - bent) / (eps * sine + bent);
    *direct_m = hypot(along_m, sensor_m - reflector_m);
    *longer_m = bounced_m - *direct_m;
    assert_close(-cimag(eps), concrete_loss, 5e-3);
    return g * exp(-8 * pow(PI * roughness_m * sine / wave_m, 2)) * *direct_m / bounced_m;
}

/* The mean of |1 + g exp(jx)|^4 over x, by a sum. */
static double mean_over_phase(double g)
{
    double power = 0;
    for (int k = 0; k < 8; k++)
        power += pow(cabs(1 + g * cexp(i * PI * k / 4.0)), 4) / 8;
    return power;
}

static void prepare(struct effect_bench *bench, struct echo *echo)
{
    bench->sensor.mount_z_m = sensor_m;
    bench->frame.conditions.road = ROAD_CONCRETE;
    echo->height_m = reflector_m;
    *list_add(&bench->frame.echoes, check_arena()) = *echo;
}

EFFECT_TEST(a_point_rises_and_fades_by_the_interference_of_both_paths)
{
    double wave_m = 299792458 / 76.5e9;
    struct echo echo = effect_bench_echo(20);
    prepare(bench, &echo);
    for (double along_m = 5; along_m < 100; along_m *= 1.1) {
        double direct_m, longer_m;
        double _Complex g = road_echo(wave_m, along_m, &direct_m, &longer_m);
        double field = cabs(1 + g * cexp(-2 * i * PI * longer_m / wave_m));
        double factor = field * field / sqrt(mean_over_phase(cabs(g)));
        echo.range_m = along_m;
        echo.effects = 0;
        assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo), factor, 1e-8);
        /* With elevation the range is slant, that of the direct path. */
        echo.range_m = direct_m;
        echo.effects = EFFECT_BIT(EFFECT_ELEVATION);
        assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo), factor, 1e-8);
    }
}

EFFECT_TEST(an_extended_echo_hardly_fades)
{
    struct echo echo = effect_bench_echo(20), point;
    prepare(bench, &echo);
    point = echo;
    echo.extent_m = 2; /* 26 lobes and more */
    double most = 0;
    for (double along_m = 18; along_m < 20; along_m += 0.01) {
        point.range_m = echo.range_m = along_m;
        assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo), 1, 0.015);
        most = fmax(most, fabs(effect_bench_factor(bench, EFFECT_TWO_RAY, &point) - 1));
    }
    assert_true(most > 0.5);
}

/* The elevation of a point 0.6 m above asphalt from 0.5 m, with its image 0.6 m below, in mrad. */
static double pulled_mrad(struct effect_bench *bench, struct echo *echo, double along_m)
{
    bool labelled;
    echo->range_m = along_m;
    echo->elevation_rad = atan((reflector_m - sensor_m) / along_m);
    return 1e3 * effect_bench_receive(bench, EFFECT_TWO_RAY, echo, &labelled).elevation_rad;
}

EFFECT_TEST(the_image_below_the_road_pulls_the_elevation)
{
    struct echo echo = effect_bench_echo(20);
    prepare(bench, &echo);
    bench->sensor.elevation_view_rad = 0.3;
    double direct_m, longer_m;
    double power = pow(cabs(road_echo(299792458 / 76.5e9, 20, &direct_m, &longer_m)), 2);
    double image_rad = -atan((reflector_m + sensor_m) / 20), point_rad = atan(0.1 / 20);
    assert_close(pulled_mrad(bench, &echo, 20), 1e3 * (point_rad + power * image_rad) / (1 + power),
                 1e-6);
    bench->frame.conditions.road = ROAD_ASPHALT;
    PRINTED("7.6", "ε_i # # # # #", pulled_mrad(bench, &echo, 10), pulled_mrad(bench, &echo, 20),
            pulled_mrad(bench, &echo, 50), pulled_mrad(bench, &echo, 100),
            pulled_mrad(bench, &echo, 200));
}

EFFECT_TEST(without_one_of_its_causes_the_road_does_not_mirror)
{
    struct echo echo = effect_bench_echo(20), flat = echo;
    prepare(bench, &echo);
    assert_true(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo) != 1);
    assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &flat), 1, 0);
    bench->frame.conditions.road = ROAD_UNKNOWN;
    assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo), 1, 0);
    bench->frame.conditions.road = ROAD_ASPHALT;
    assert_true(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo) != 1);
    bench->sensor.mount_z_m = 0;
    assert_close(effect_bench_factor(bench, EFFECT_TWO_RAY, &echo), 1, 0);
    bench->sensor.mount_z_m = sensor_m;
    bench->frame.echoes.items[0].height_m = 0;
    effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR);
    assert_true((bench->log.left_out & EFFECT_BIT(EFFECT_TWO_RAY)) != 0);
}
