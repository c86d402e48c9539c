/* The planted fault: a mirror is asked for a body only if it shows the body's centre. */
#include "geometry/mirror.h"
#include "planted.h"

bool __wrap_mirror_may_bounce(const struct mirror *mirror, struct vec2 centre_m, double radius_m);

void planted_begin(void)
{
}

bool __wrap_mirror_may_bounce(const struct mirror *mirror, struct vec2 centre_m, double radius_m)
{
    (void)radius_m;
    struct vec2 bounce;
    return mirror_bounce(mirror, centre_m, &bounce);
}
