/* The numbers that stages/sensor_signal/MODEL.md prints. */
#include "support/printed.h"

#include "base/units.h"
#include "radar/cfar.h"
#include "radar/point_response.h"
#include "sensor_signal/element_row.h"

#define DEGREE (PI / 180)

/* The greatest error of a place between cells, two to a bin, or of the amplitude there, where it is
 * off on both axes. */
static double worst(enum point_response response, bool decibels)
{
    double most = 0;
    for (double off = -0.25; off <= 0.25; off += 1e-4) {
        double cell[3];
        for (int i = 0; i < 3; i++)
            cell[i] = fabs(point_response_value(response, off + (1 - i) * 0.5));
        double bins = point_response_vertex(cell[0], cell[1], cell[2]) / 2;
        double db = 20 * log10(cell[1] / point_response_value(response, bins));
        most = fmax(most, decibels ? fabs(2 * db) : fabs(bins - off));
    }
    return most;
}

static void the_signal(void **state)
{
    (void)state;
    PRINTED("11.3", "up to # bins and # dB off with Hann, # and # without",
            worst(POINT_RESPONSE_HANN, false), worst(POINT_RESPONSE_HANN, true),
            worst(POINT_RESPONSE_RECTANGULAR, false), worst(POINT_RESPONSE_RECTANGULAR, true));
    PRINTED("11.3", "M Y/2: #, #, # m/s for 64, 128, 256 chirps", 32 * 0.103, 64 * 0.103,
            128 * 0.103);
    PRINTED("11.3", "Cramér-Rao bound # X/sqrt χ", sqrt(6) / (2 * PI));
}

static double mean_factor(double false_alarm)
{
    return cfar_factor(CFAR_MEAN, 16, 0, false_alarm);
}

static double ordered_factor(double false_alarm)
{
    return cfar_factor(CFAR_ORDERED, 16, 12, false_alarm);
}

static void thresholds(void **state)
{
    (void)state;
    PRINTED("11.4", "CA, N = 16 # # # OS, 12th of 16 # # #", mean_factor(1e-3), mean_factor(1e-4),
            mean_factor(1e-6), ordered_factor(1e-3), ordered_factor(1e-4), ordered_factor(1e-6));
}

/* The 3 dB width of a beam on boresight. */
static double beam_degrees(size_t elements)
{
    const struct element_row row = {elements, 0.5};
    double low = 0, high = 1 / (0.5 * (double)elements);
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        *(element_row_factor(&row, middle) > sqrt(0.5) ? &low : &high) = middle;
    }
    return 2 * asin(low) / DEGREE;
}

static void beams(void **state)
{
    (void)state;
    const struct element_row row = {8, 0.5};
    double sine = sin(5 * DEGREE);
    struct phasor samples[8];
    struct element_row_peak peaks[ELEMENT_ROW_MOST_PEAKS];
    PRINTED("11.5", "at d = 1/2 are #, #, # deg wide", beam_degrees(4), beam_degrees(8),
            beam_degrees(16));
    for (int i = 0; i < 8; i++)
        samples[i] = (struct phasor){2 * cos(PI * i * sine), 0};
    assert_int_equal(element_row_peaks(&row, samples, 1, 1, 0, peaks), 2);
    PRINTED("11.5", "has its peaks at ±# deg, of #", fabs(asin(peaks[0].sine)) / DEGREE,
            peaks[0].amplitude);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_signal),
        cmocka_unit_test(thresholds),
        cmocka_unit_test(beams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
