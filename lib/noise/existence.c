#include "noise/existence.h"

#include "base/elementary.h"

double existence_probability(const struct existence *existence, double power)
{
    double mean = existence->rise + existence->snr, least = existence->least_false_alarm;
    if (existence->false_alarms == 0 || power < least)
        return 1;
    if (power < existence->least_echo)
        return 0;
    /* ln(f0/f1), as both densities may be below the least double. */
    double log_odds = elementary_log(existence->false_alarms * mean / existence->echoes) -
                      (power - least) + power / mean;
    return 1 / (1 + elementary_exp(log_odds));
}
