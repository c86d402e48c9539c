#include "check.h"

#include "sensor/received_echo.h"
#include "sensor_signal/unfolding.h"
#include "support/array_sensor.h"
#include "support/signal_transform.h"

enum { SAMPLES = 32, REPETITIONS = 32 };

struct bench {
    struct sensor sensor;
    struct signal_cube signal;
    struct arena *arena;
};

/* Chirps at 76.5 GHz, cells of 1 m and 0.5 m/s: rates fold 16 m/s apart, and a fold is a bin. */
static void begin(struct bench *bench, int64_t stagger, size_t elements)
{
    *bench = (struct bench){.arena = check_arena(),
                            .sensor = {.name = "front",
                                       .carrier_hz = 76.5e9,
                                       .range_min_m = 1,
                                       .range_max_m = 24,
                                       .cell_range_m = 1,
                                       .cell_range_rate_mps = 0.5,
                                       .antenna = {.pattern = ANTENNA_DIPOLE_PAIR},
                                       .waveform = {.kind = WAVEFORM_CHIRP,
                                                    .samples = SAMPLES,
                                                    .repetitions = REPETITIONS,
                                                    .stagger = stagger}}};
    if (elements > 0)
        array_sensor_add(&bench->sensor, elements, 0.5);
    bench->signal = signal_cube_of(&bench->sensor, bench->arena);
}

static struct received_echo echo_at(double range_m, double rate_mps, double azimuth_rad,
                                    double amplitude)
{
    return (struct received_echo){
        .echo = {.azimuth_rad = azimuth_rad, .range_rate_mps = rate_mps},
        .strength = amplitude,
        .amplitude = amplitude,
        .range_m = range_m,
        .phase_rad = 1,
    };
}

static void receive(struct bench *bench, const struct received_echo *echoes, size_t count)
{
    struct signal_input input = signal_cube_sources(&bench->signal, echoes, count, bench->arena);
    for (size_t m = 0; m < REPETITIONS && bench->signal.second != NULL; m++) {
        signal_cube_receive(&bench->signal, &input, 1, m);
        signal_transform_rows(&bench->signal);
        signal_cube_store(&bench->signal, 1, m);
    }
}

/* The peak that the first train shows of an echo. */
static struct range_doppler_peak peak_of(const struct bench *bench,
                                         const struct received_echo *received)
{
    struct range_doppler_peak peak = {.amplitude = received->amplitude};
    signal_cube_place(&bench->signal, received, &peak.range, &peak.rate);
    peak.rate = remainder(peak.rate, REPETITIONS);
    return peak;
}

TEST(the_second_train_tells_range_rates_apart_within_its_folds)
{
    for (size_t elements = 0; elements <= 4; elements += 4)
        for (double rate_mps = -39; rate_mps < 40; rate_mps += 6.1) {
            struct bench bench;
            struct unfolding_reading reading;
            double azimuth_rad = elements > 0 ? 0.3 : 0;
            struct received_echo echo = echo_at(12.3, rate_mps, azimuth_rad, 5);
            begin(&bench, 5, elements);
            receive(&bench, &echo, 1);
            struct range_doppler_peak peak = peak_of(&bench, &echo);
            assert_true(unfolding_choose(&bench.signal, &peak, 5, sin(azimuth_rad), &reading));
            assert_close(reading.range_rate_mps, rate_mps, 1e-9);
            assert_close(reading.range_m, 12.3, 1e-9);
        }
}

/* Beyond 40 m/s there is no hypothesis: 45 reads as -35, five bins too far. */
TEST(beyond_its_folds_a_rate_folds_and_takes_its_range_along)
{
    struct bench bench;
    struct unfolding_reading reading;
    struct received_echo echo = echo_at(12.3, 45, 0, 5);
    begin(&bench, 5, 0);
    receive(&bench, &echo, 1);
    struct range_doppler_peak peak = peak_of(&bench, &echo);
    assert_true(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
    assert_close(reading.range_rate_mps, -35, 1e-9);
    assert_close(reading.range_m, 17.3, 1e-9);
}

/* The strong echo is what the second train shows where another hypothesis looks. */
TEST(the_nearest_amplitude_wins_and_not_the_strongest)
{
    struct bench bench;
    struct unfolding_reading reading;
    struct received_echo echoes[] = {echo_at(12.3, 4, 0, 5), echo_at(12.3, 23.2, 0, 50)};
    begin(&bench, 5, 0);
    receive(&bench, echoes, 2);
    struct range_doppler_peak peak = peak_of(&bench, &echoes[0]);
    assert_true(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
    assert_close(reading.range_rate_mps, 4, 1e-9);
}

TEST(no_hypothesis_puts_a_target_where_the_sensor_does_not_measure)
{
    struct bench bench;
    struct unfolding_reading reading;
    struct range_doppler_peak peak = {.range = 24.4, .rate = 8, .amplitude = 5};
    begin(&bench, 0, 0);
    /* 4 m/s are a quarter of a fold, and a quarter of a bin. */
    assert_true(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
    assert_close(reading.range_m, 24.15, 1e-9);
    /* Half a cell beyond its ranges a sensor still measures. */
    peak.range = 24.7;
    assert_true(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
    peak.range = 24.8;
    assert_false(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
    peak.range = 0.7;
    assert_false(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
}

TEST(without_a_second_train_a_rate_is_read_in_the_middle_fold)
{
    struct bench bench;
    struct unfolding_reading reading;
    begin(&bench, 0, 0);
    assert_true(bench.signal.second == NULL);
    for (double rate_mps = -37; rate_mps < 40; rate_mps += 7) {
        struct received_echo echo = echo_at(12, rate_mps, 0, 5);
        struct range_doppler_peak peak = peak_of(&bench, &echo);
        assert_true(unfolding_choose(&bench.signal, &peak, 5, 0, &reading));
        assert_close(reading.range_rate_mps, remainder(rate_mps, 16), 1e-9);
        assert_close(reading.range_m, 12 + round((rate_mps - reading.range_rate_mps) / 16), 1e-9);
    }
}
