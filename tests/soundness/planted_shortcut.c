/* The planted fault: without account and log, what is in the last fifth of the range is lost. An
 * account and a log switch the shortcut off in which such a fault would stand. */
#include "ideal/look.h"
#include "planted.h"

bool __real_look_out_of_reach(const struct look *look, double rise_m,
                              const struct silhouette *silhouette);
bool __wrap_look_out_of_reach(const struct look *look, double rise_m,
                              const struct silhouette *silhouette);

void planted_begin(void)
{
}

bool __wrap_look_out_of_reach(const struct look *look, double rise_m,
                              const struct silhouette *silhouette)
{
    bool far = silhouette->nearest_m > 0.8 * look->sensor->range_max_m;
    bool shortcut = look->selection->log == NULL && !frame_carries(look->frame, CARRY_ACCOUNT);
    return (shortcut && far) || __real_look_out_of_reach(look, rise_m, silhouette);
}
