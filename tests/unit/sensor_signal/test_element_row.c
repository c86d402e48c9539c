#include "check.h"

#include "sensor_signal/element_row.h"

#define PI 3.14159265358979323846
#define DEGREE (PI / 180)

static void receive(const struct element_row *array, double azimuth_rad, double amplitude,
                    double phase, struct phasor *elements)
{
    for (size_t a = 0; a < array->elements; a++) {
        struct phasor one = element_row_response(array, sin(azimuth_rad), a);
        elements[a].re += amplitude * (one.re * cos(phase) - one.im * sin(phase));
        elements[a].im += amplitude * (one.re * sin(phase) + one.im * cos(phase));
    }
}

static void one_echo_has_one_peak_of_its_amplitude_at_its_azimuth(void **state)
{
    (void)state;
    static const struct element_row arrays[] = {{4, 1.1}, {8, 0.55}, {2, 0.5}, {16, 0.5}};
    for (size_t i = 0; i < 4; i++)
        for (double azimuth = -8.5; azimuth <= 8.5; azimuth += 1.7) {
            struct phasor elements[16] = {{0, 0}};
            struct element_row_peak peaks[ELEMENT_ROW_MOST_PEAKS];
            receive(&arrays[i], azimuth * DEGREE, 3, 2, elements);
            assert_int_equal(element_row_peaks(&arrays[i], elements, 1, sin(9 * DEGREE), 0, peaks),
                             1);
            assert_close(asin(peaks[0].sine), azimuth * DEGREE, 1e-12);
            assert_close(peaks[0].amplitude, 3, 1e-13);
        }
}

/* A pair at 5 degrees to both sides, in phase at the first element and so not in the middle; in
 * phase there, it would be one peak, at 0. */
static void a_pair_in_phase_at_the_first_element_has_two_peaks(void **state)
{
    (void)state;
    const struct element_row array = {8, 0.5};
    struct phasor elements[8] = {{0, 0}}, middle[8] = {{0, 0}};
    struct element_row_peak peaks[ELEMENT_ROW_MOST_PEAKS];
    for (int side = -1; side <= 1; side += 2) {
        receive(&array, 5 * side * DEGREE, 1, PI * 3.5 * sin(5 * side * DEGREE), elements);
        receive(&array, 5 * side * DEGREE, 1, 0, middle);
    }
    assert_int_equal(element_row_peaks(&array, elements, 1, 1, 0, peaks), 2);
    for (size_t i = 0; i < 2; i++) {
        assert_close(fabs(asin(peaks[i].sine)) / DEGREE, 4.05, 0.005);
        assert_close(peaks[i].amplitude, 0.9432, 5e-5);
    }
    assert_close(peaks[0].sine + peaks[1].sine, 0, 1e-12);
    assert_int_equal(element_row_peaks(&array, middle, 1, sin(10 * DEGREE), 0, peaks), 1);
    assert_close(peaks[0].sine, 0, 1e-12);
}

/* Full widths at -3 dB on boresight of 4, 8, 16 elements half a wavelength apart. */
static void beams_have_the_published_widths(void **state)
{
    (void)state;
    static const double degrees[] = {26.322952, 12.802526, 6.358726};
    for (size_t i = 0; i < 3; i++) {
        const struct element_row array = {(size_t)4 << i, 0.5};
        assert_close(element_row_factor(&array, sin(degrees[i] / 2 * DEGREE)), sqrt(0.5), 1e-7);
    }
}

static void a_beam_repeats_at_its_grating_lobes(void **state)
{
    (void)state;
    const struct element_row array = {4, 1.1};
    assert_close(element_row_factor(&array, 0), 1, 0);
    assert_close(element_row_factor(&array, 1 / 1.1), 1, 1e-9);
    assert_close(element_row_factor(&array, 1 / 4.4), 0, 1e-15);
}

static void side_lobes_and_weak_echoes_are_no_peaks(void **state)
{
    (void)state;
    const struct element_row array = {8, 0.5};
    struct phasor elements[2 * 8] = {{0, 0}};
    struct element_row_peak peaks[ELEMENT_ROW_MOST_PEAKS];
    for (size_t a = 0; a < 8; a++)
        elements[2 * a] = element_row_response(&array, 0.1, a);
    assert_int_equal(element_row_peaks(&array, elements, 2, 1, 0, peaks), 1);
    assert_int_equal(element_row_peaks(&array, elements, 2, 1, 0.999, peaks), 1);
    assert_int_equal(element_row_peaks(&array, elements, 2, 1, 1.001, peaks), 0);
    assert_int_equal(element_row_peaks(&array, elements, 2, 0.05, 0, peaks), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_echo_has_one_peak_of_its_amplitude_at_its_azimuth),
        cmocka_unit_test(a_pair_in_phase_at_the_first_element_has_two_peaks),
        cmocka_unit_test(beams_have_the_published_widths),
        cmocka_unit_test(a_beam_repeats_at_its_grating_lobes),
        cmocka_unit_test(side_lobes_and_weak_echoes_are_no_peaks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
