/* The planted fault: the outer half of a vehicle hides nothing, and is no part of what is
 * hidden. */
#include "geometry/silhouette.h"
#include "planted.h"

struct silhouette __real_silhouette_of(struct vec2 half_m, struct vec2 heading,
                                       struct vec2 viewer_m);
struct silhouette __wrap_silhouette_of(struct vec2 half_m, struct vec2 heading,
                                       struct vec2 viewer_m);

void planted_begin(void)
{
}

struct silhouette __wrap_silhouette_of(struct vec2 half_m, struct vec2 heading,
                                       struct vec2 viewer_m)
{
    return __real_silhouette_of(vec2_scale(0.5, half_m), heading, viewer_m);
}
