#include "geometry/silhouette.h"

#include "base/elementary.h"

/* 1 beyond the positive end, -1 beyond the negative end, 0 between both. */
static double beyond(double place, double half)
{
    return (place > half) - (place < -half);
}

struct silhouette silhouette_of(struct vec2 half_m, struct vec2 heading, struct vec2 viewer_m)
{
    double length_m = half_m.x + SILHOUETTE_SLACK_M, width_m = half_m.y + SILHOUETTE_SLACK_M;
    double ahead = beyond(viewer_m.x, length_m), aside = beyond(viewer_m.y, width_m);
    struct vec2 gap = {elementary_max(fabs(viewer_m.x) - length_m, 0),
                       elementary_max(fabs(viewer_m.y) - width_m, 0)};
    struct vec2 most = {fabs(viewer_m.x) + length_m, fabs(viewer_m.y) + width_m};
    struct silhouette seen = {.nearest_m = vec2_length(gap), .farthest_m = vec2_length(most)};
    /* If one side is in view, its ends; if two are, their far ends. */
    struct vec2 right = {length_m * (aside != 0 ? -aside : ahead),
                         width_m * (ahead != 0 ? ahead : aside)};
    struct vec2 left = {length_m * (aside != 0 ? aside : ahead),
                        width_m * (ahead != 0 ? -ahead : aside)};
    right = vec2_sub(right, viewer_m);
    left = vec2_sub(left, viewer_m);
    if ((ahead == 0 && aside == 0) || !(vec2_dot(right, left) > 0))
        return seen;
    seen.right_m = vec2_turn(right, heading);
    seen.left_m = vec2_turn(left, heading);
    return seen;
}
