/* What a tolerance lets a scan do without, decided by what the scan shows (NUMERICS C3).
 *
 * A tolerance alone proves nothing: a change of half a decibel can carry a cell over the threshold,
 * or make another echo its leader. So effects that only weaken echoes, rain and fog, are left out
 * first, and the scan is made; then every decision that it took must have been further from going
 * the other way than they could push it. If one was not, the scan is made again with everything:
 * that is the escalation. Superposition is spared per cell, where all members look the same way.
 *
 * Shares of the tolerance are fixed: weather may take all of range and range rate and half of
 * azimuth and amplitude, superposition the other half. */
#ifndef ESCALATION_H
#define ESCALATION_H

#include "sensor/scan.h"

/* What weather may do to the amplitude of an echo, and to that of one echo against another that is
 * no farther from it than two echoes of one cell can be: factors >= 1 at most, and their inverses
 * at least. */
struct weakening {
    double alone, between;
};

struct weakening escalation_weakening(const struct reception *reception);

/* Which of the effects described for a scan the selection lets it try without: none unless it is
 * automatic and has a tolerance that their weakening alone does not exceed. */
uint64_t escalation_spared(const struct reception *reception, const struct selection *selection);

/* Of a scan made without weather: would weather have changed none of its cells, leaders and
 * thresholds, and no value by more than its share? */
bool escalation_holds(const struct scan *scan, struct weakening weakening,
                      const struct tolerance *tolerance);

/* Can the cell of these received echoes be read at their mean azimuth, with no value off by more
 * than superposition's share? Only where pointers add in phase, from the array's centre. */
bool escalation_spares_superposition(const struct sensor *sensor,
                                     const struct received_echo *members, size_t count,
                                     const struct tolerance *tolerance);

#endif
