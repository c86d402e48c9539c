#include "check.h"

#include "point_response.h"

#define PI 3.14159265358979323846
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const enum point_response all[] = {POINT_RESPONSE_HANN, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_PULSE};

static void the_window_has_the_kernel_of_effects_4b(void **state)
{
    (void)state;
    assert_close(point_response_value(POINT_RESPONSE_HANN, 0), 1, 0);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 0.5), 0.848826, 5e-7);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 1), 0.5, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_HANN, -1.5), 0.169765, 5e-7);
    assert_close(fabs(point_response_value(POINT_RESPONSE_HANN, 2.5)), 0.024252, 1e-6);
    assert_close(point_response_value(POINT_RESPONSE_HANN, 2), 0, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_RECTANGULAR, 0.5), 2 / PI, 1e-15);
    assert_close(point_response_value(POINT_RESPONSE_PULSE, 2), 0.5, 1e-15);
    /* widths at -3 dB */
    assert_close(point_response_value(POINT_RESPONSE_HANN, 1.440583 / 2), sqrt(0.5), 1e-4);
    assert_close(point_response_value(POINT_RESPONSE_RECTANGULAR, 0.885899 / 2), sqrt(0.5), 1e-4);
}

static void a_kernel_is_a_half_at_its_half_width(void **state)
{
    (void)state;
    static const double half_widths[] = {
        [POINT_RESPONSE_HANN] = 1, [POINT_RESPONSE_RECTANGULAR] = 0.603354, [POINT_RESPONSE_PULSE] = 2};
    for (size_t i = 0; i < COUNT(all); i++)
        assert_close(point_response_value(all[i], half_widths[all[i]]), 0.5, 1e-6);
}

static void weights_sum_to_one_and_noise_is_their_rms(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        double sum = 0, power = 0;
        for (size_t n = 0; n < 64; n++) {
            double weight = point_response_weight(all[i], n, 64);
            sum += weight;
            power += weight * weight;
        }
        assert_close(sum, 1, 1e-15);
        assert_near(point_response_noise(all[i], 64), sqrt(power), 1e-14);
    }
    assert_near(point_response_noise(POINT_RESPONSE_PULSE, 64), 1. / 8, 1e-15);
}

static void the_envelope_bounds_the_kernel_and_falls(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(all); i++)
        for (double d = 0; d < 40; d += 0.01) {
            assert_true(fabs(point_response_value(all[i], d)) <= point_response_envelope(all[i], d) * (1 + 1e-12));
            assert_true(point_response_envelope(all[i], d + 0.01) <= point_response_envelope(all[i], -d));
        }
}

/* What bin `bin` shows of an echo at `place`: windowed kernels change sign from bin to bin. */
static struct phasor shown(enum point_response kernel, double place, int bin, double phase)
{
    double sign = kernel != POINT_RESPONSE_PULSE && bin % 2 != 0 ? -1 : 1;
    double size = 7 * sign * point_response_value(kernel, bin - place);
    return (struct phasor){size * cos(phase), size * sin(phase)};
}

static void the_place_between_bins_is_exact_for_one_echo(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(all); i++)
        for (double place = -0.5; place <= 0.5; place += 0.0625) {
            struct phasor bins[3][2];
            for (int bin = -1; bin <= 1; bin++)
                for (int channel = 0; channel < 2; channel++)
                    bins[bin + 1][channel] = shown(all[i], place, bin, 1 + 2 * channel);
            for (size_t channels = 1; channels <= 2; channels++)
                assert_close(point_response_offset(all[i], bins[0], bins[1], bins[2], channels, 1), place,
                             1e-14);
        }
}

static void nothing_received_stands_in_the_middle_of_its_bin(void **state)
{
    (void)state;
    const struct phasor silence = {0, 0}, one = {1, 0};
    for (size_t i = 0; i < COUNT(all); i++)
        assert_close(point_response_offset(all[i], &silence, &silence, &silence, 1, 1), 0, 0);
    assert_true(fabs(point_response_offset(POINT_RESPONSE_HANN, &one, &one, &silence, 1, 1)) <= 0.75);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_window_has_the_kernel_of_effects_4b),
        cmocka_unit_test(a_kernel_is_a_half_at_its_half_width),
        cmocka_unit_test(weights_sum_to_one_and_noise_is_their_rms),
        cmocka_unit_test(the_envelope_bounds_the_kernel_and_falls),
        cmocka_unit_test(the_place_between_bins_is_exact_for_one_echo),
        cmocka_unit_test(nothing_received_stands_in_the_middle_of_its_bin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
