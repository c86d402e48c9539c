/* Tolerances only: what weather weakens by less than its share decides nothing. */
#include "planted.h"
#include "sensor/escalation.h"

bool __wrap_escalation_holds(const struct scan *scan, struct weakening weakening,
                             const struct tolerance *tolerance);

void planted_begin(void)
{
}

bool __wrap_escalation_holds(const struct scan *scan, struct weakening weakening,
                             const struct tolerance *tolerance)
{
    (void)scan;
    (void)weakening;
    (void)tolerance;
    return true;
}
