/* Can one box stand in the way to another, and does it hide all of it? Told from the outermost
 * corners that the sensor sees of both: the reason for which auto may leave out occlusion (NUMERICS
 * C3), and for which few sight lines need the exact test. */
#ifndef SILHOUETTE_H
#define SILHOUETTE_H

#include <stdbool.h>

#include "base/vec2.h"

/* Boxes are taken this much larger to every side: far more than the rounding of a place. */
#define SILHOUETTE_SLACK_M 1e-6

/* What a box covers of the view from the sensor: all directions from the right to the left, less
 * than a quarter turn. Both are zero if the sensor is in the box or too near for that: such a box
 * is before and behind everything, and hides nothing. */
struct silhouette {
    struct vec2 right_m, left_m;  /* the outermost corners, from the sensor */
    double nearest_m, farthest_m; /* from the sensor, of the whole box */
};

/* Of a box around the origin of its own frame, half_m from there to its front and to its side, seen
 * from a place in that frame; directions are those of the frame that the heading is given in. */
struct silhouette silhouette_of(struct vec2 half_m, struct vec2 heading, struct vec2 viewer_m);

/* Of a single place. */
static inline struct silhouette silhouette_of_place(struct vec2 place_m)
{
    double distance_m = vec2_length(place_m);
    return (struct silhouette){place_m, place_m, distance_m, distance_m};
}

/* False only if no sight line to what is in the box behind touches what is in the box in front,
 * which begins behind the other's end or lies aside of it. */
static inline bool silhouette_overlaps(const struct silhouette *front,
                                       const struct silhouette *behind)
{
    bool before = front->nearest_m <= behind->farthest_m;
    bool leftwards = vec2_cross(front->right_m, behind->left_m) >= 0;
    bool rightwards = vec2_cross(behind->right_m, front->left_m) >= 0;
    return before & leftwards & rightwards;
}

/* Of two that overlap: true only if every sight line to what is in the box behind runs through the
 * one in front, which ends before the other begins. Lines that run nearer to an edge of it than
 * four times the slack are not told from those that miss it. */
static inline bool silhouette_covers(const struct silhouette *front,
                                     const struct silhouette *behind)
{
    double slack = 4 * SILHOUETTE_SLACK_M * behind->farthest_m;
    return front->farthest_m < behind->nearest_m &&
           vec2_cross(front->right_m, behind->right_m) > slack &&
           vec2_cross(behind->left_m, front->left_m) > slack;
}

/* True only if none of its directions lies between these two, the left one less than half a turn
 * from the right one. Of two zeros nothing is outside. */
static inline bool silhouette_outside(const struct silhouette *silhouette, struct vec2 right,
                                      struct vec2 left)
{
    return (vec2_cross(right, silhouette->right_m) < 0 &&
            vec2_cross(right, silhouette->left_m) < 0) ||
           (vec2_cross(silhouette->right_m, left) < 0 && vec2_cross(silhouette->left_m, left) < 0);
}

#endif
