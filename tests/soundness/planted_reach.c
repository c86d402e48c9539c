/* The planted fault: mirrors and objects in the last fifth of the range have no ghosts. */
#include "ideal/look.h"
#include "planted.h"

bool __wrap_look_out_of_range(const struct look *look, const struct silhouette *silhouette);

void planted_begin(void)
{
}

bool __wrap_look_out_of_range(const struct look *look, const struct silhouette *silhouette)
{
    return silhouette->nearest_m > 0.8 * look->sensor->range_max_m;
}
