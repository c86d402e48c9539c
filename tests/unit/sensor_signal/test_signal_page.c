/* The numbers that stages/sensor_signal/MODEL.md prints. */
#include "support/printed.h"

#include "base/units.h"
#include "radar/cfar.h"
#include "radar/point_response.h"

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

TEST(the_signal)
{
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

TEST(thresholds)
{
    PRINTED("11.4", "CA, N = 16 # # # OS, 12th of 16 # # #", mean_factor(1e-3), mean_factor(1e-4),
            mean_factor(1e-6), ordered_factor(1e-3), ordered_factor(1e-4), ordered_factor(1e-6));
}
