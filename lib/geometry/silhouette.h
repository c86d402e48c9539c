/* Angular extent of a box, and which boxes hide which. A silhouette holds the outermost corners of
 * a box that the sensor sees. From two silhouettes follows whether one box can hide any of the
 * other or surely hides all of it: auto leaves out occlusion by the first answer, and only sight
 * lines between both answers need the exact test (outline_crossing.h). */
#pragma once

#include "base/vec2.h"

/* Boxes are enlarged by this to every side, far more than the rounding of a place. */
#define SILHOUETTE_SLACK_M 1e-6

/* The directions from the sensor that a box covers: all from the right corner to the left one, less
 * than a quarter turn. Both corners are zero if the sensor is in the box or too near for an extent
 * below a quarter turn: such a box counts as both before and behind every other, and hides
 * nothing. */
struct silhouette {
    struct vec2 right_m, left_m;  /* the outermost corners, from the sensor */
    double nearest_m, farthest_m; /* from the sensor, of the whole box */
};

/* The silhouette of a box, centred on the origin of its own frame, with half_m from there to its
 * front and to its side. viewer_m is the sensor's place in that frame; the corners come out turned
 * by heading, the box's unit vector forward in the frame of the result. */
struct silhouette silhouette_of(struct vec2 half_m, struct vec2 heading, struct vec2 viewer_m);

/* The silhouette of a single point. */
static inline struct silhouette silhouette_of_place(struct vec2 place_m)
{
    double distance_m = vec2_length(place_m);
    return (struct silhouette){place_m, place_m, distance_m, distance_m};
}

/* False only if no line of sight to a point in the box behind touches the box in front, because the
 * one in front begins beyond the end of the other or lies beside it. */
static inline bool silhouette_overlaps(const struct silhouette *front,
                                       const struct silhouette *behind)
{
    bool before = front->nearest_m <= behind->farthest_m;
    bool leftwards = vec2_cross(front->right_m, behind->left_m) >= 0;
    bool rightwards = vec2_cross(behind->right_m, front->left_m) >= 0;
    return before & leftwards & rightwards;
}

/* For two silhouettes that overlap. True only if every line of sight to a point in the box behind
 * runs through the box in front, and the one in front ends before the other begins. False also
 * where a line runs nearer to an edge of the box in front than four times the slack. */
static inline bool silhouette_covers(const struct silhouette *front,
                                     const struct silhouette *behind)
{
    double slack = 4 * SILHOUETTE_SLACK_M * behind->farthest_m;
    return front->farthest_m < behind->nearest_m &&
           vec2_cross(front->right_m, behind->right_m) > slack &&
           vec2_cross(behind->left_m, front->left_m) > slack;
}

/* True only if the silhouette has no direction between right and left, where left is less than half
 * a turn counter-clockwise of right. If both are zero, nothing is outside. */
static inline bool silhouette_outside(const struct silhouette *silhouette, struct vec2 right,
                                      struct vec2 left)
{
    return (vec2_cross(right, silhouette->right_m) < 0 &&
            vec2_cross(right, silhouette->left_m) < 0) ||
           (vec2_cross(silhouette->right_m, left) < 0 && vec2_cross(silhouette->left_m, left) < 0);
}
