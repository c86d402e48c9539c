/* The numbers that lib/noise/MODEL.md prints. */
#include "support/printed.h"

#include "base/units.h"
#include "documents/suite_file.h"
#include "radar/detection.h"

TEST(rounding)
{
    PRINTED("9", "step/sqrt(12) [T]: # m, # m/s, # deg", 0.2 / sqrt(12), 0.25 / sqrt(12),
            0.1 / sqrt(12));
}

/* How far the threshold of a suite's first sensor stands above the noise of its search. */
static double above_db(const char *name)
{
    struct diag diag = {0};
    const struct suite *suite = suite_file_load(name, check_arena(), &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    const struct sensor *sensor = &suite->sensors.items[0];
    double above = units_amplitude_db(sensor->threshold / sensor->search_sigma);
    return above;
}

TEST(false_alarms)
{
    PRINTED("14.9", "one look at noise, # for a threshold 6 dB above it",
            detection_in_noise(0, units_amplitude_from_db(6), 1));
    PRINTED("14.9", "6400 cells at 1e-4 make #, the shipped mean [A], and # % of the scans",
            6400 * 1e-4, 100 * exp(-0.64));
    PRINTED("14.9", "T stands # dB above σ_d in `lrr77-full`, # dB in `radarscenes77-full`",
            above_db("lrr77-full"), above_db("radarscenes77-full"));
}

TEST(quality)
{
    PRINTED("14.21", "# % of single echoes look merged", 100 * erfc(3 / sqrt(2)));
}
