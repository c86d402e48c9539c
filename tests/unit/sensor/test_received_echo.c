#include "support/effect_bench.h"

#include "sensor/received_echo.h"

/* Rain of 25 mm/h takes 2.190804 dB there and back over 100 m. An ERCS of 100 makes the strength 1
 * at 100 m. */
EFFECT_TEST(an_echo_is_received_with_the_effects_of_its_scan)
{
    struct echo echo = effect_bench_echo(100);
    echo.ercs = 100;
    echo.azimuth_rad = 0.3;
    echo.effects = EFFECT_BIT(EFFECT_OCCLUSION);
    bench->frame.conditions.rain_mmph = 25;
    bench->sensor.unambiguous_range_m = 60;
    bench->sensor.cell_phase = CELL_RANDOM_PHASE;
    double gain = antenna_gain(&bench->sensor.antenna, 0.3), rain = pow(10, -2.190804 / 20);
    struct effect_scan dry = effect_bench_begin(bench, 0, EFFECT_HOME_SENSOR);
    struct effect_scan wet = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR);
    struct received_echo plain = received_echo_of(&dry, &echo);
    struct received_echo received = received_echo_of(&wet, &echo);
    assert_near(plain.strength, 1.0, 1e-15);
    assert_near(plain.amplitude, gain, 1e-15);
    assert_true(plain.range_m == 100 && plain.phase_rad == 0 && plain.effects == echo.effects);
    assert_near(received.strength, rain, 1e-7);
    assert_near(received.amplitude, rain * gain, 1e-7);
    assert_true(received.range_m == 40 && received.range_rate_mps == -3);
    assert_true(received.phase_rad != 0);
    assert_true(received.echo.range_m == 100);
    assert_true(received.effects ==
                (echo.effects | EFFECT_BIT(EFFECT_RAIN) | EFFECT_BIT(EFFECT_AMBIGUITY)));
}
