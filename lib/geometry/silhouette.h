/* Azimuths that bodies cover, and which bodies hide which. A silhouette holds the outermost corners
 * of a box that the sensor sees. Two silhouettes show whether one box can hide any part of the
 * other, and whether it surely hides all of it. The effect selection auto leaves occlusion out if
 * no box can hide another; sight lines that are neither surely free nor surely hidden need the
 * exact test (obstruction.h). */
#pragma once

#include "base/arena.h"
#include "base/vec2.h"

/* Boxes are enlarged by this to every side, far more than the rounding of a place. */
#define SILHOUETTE_SLACK_M 1e-6

/* The directions from the sensor that a box covers, from the right corner to the left one, less
 * than a quarter turn. Both corners are zero if the sensor is in the box or so near that the box
 * covers a quarter turn or more: such a box overlaps every other and hides nothing. */
struct silhouette {
    struct vec2 right_m, left_m;  /* the outermost corners, from the sensor */
    double nearest_m, farthest_m; /* from the sensor, of the whole box */
};

/* The silhouette of a box, centred on the origin of its own frame, with half its length and width
 * in half_m. viewer_m is the sensor's place in that frame; the corners are turned by heading, the
 * box's forward unit vector in the frame of the result. */
struct silhouette silhouette_of(struct vec2 half_m, struct vec2 heading, struct vec2 viewer_m);

/* The silhouette of a single point. */
static inline struct silhouette silhouette_of_place(struct vec2 place_m)
{
    double distance_m = vec2_length(place_m);
    return (struct silhouette){place_m, place_m, distance_m, distance_m};
}

/* False only if no line of sight to a point in the box behind touches the box in front, because the
 * box in front begins beyond the end of the other box or lies beside it. */
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

/* Index of bodies by azimuth, so that a search in one direction meets few of many bodies. The
 * horizon around a sensor is divided into sectors. Each sector, or group of neighbouring sectors,
 * has the set of the bodies, by number, whose silhouettes reach into it. Sets are bits, 64 to a
 * word. */
struct silhouette_index {
    unsigned shift; /* right shift from a sector's number to its set's */
    size_t words;   /* per set */
    uint64_t *sets; /* in counter-clockwise order of their sectors */
    size_t *found;  /* numbers, ascending: the result of the last search */
};

/* A run of sectors, counter-clockwise from the first. */
struct silhouette_span {
    unsigned first, count;
};

extern const struct silhouette_span silhouette_everywhere;

/* Every sector in which the silhouette has a direction; all sectors if the sensor is too near for a
 * silhouette. */
struct silhouette_span silhouette_span_of(const struct silhouette *silhouette);

/* Every sector through which a straight line between two places runs, as seen from the sensor at
 * the origin. */
struct silhouette_span silhouette_span_between(struct vec2 from_m, struct vec2 to_m);

/* An index without entries, for numbers below count. */
struct silhouette_index silhouette_index_begin(size_t count, struct arena *arena);

void silhouette_index_enter(struct silhouette_index *index, size_t number,
                            struct silhouette_span span);

/* Writes to found, in ascending order, all numbers that were entered in any sector of the span, and
 * possibly more; returns their count. */
size_t silhouette_index_find(const struct silhouette_index *index, struct silhouette_span span);
