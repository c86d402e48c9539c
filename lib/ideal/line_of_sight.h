/* Part of an echo that all bodies together let through.
 *
 * Each body in the way blocks the line or lets it pass (MODEL 2.5), over its top (14.3) or around
 * its edges (14.4); obstruction.h answers for one body.
 *
 * Two sides in line, of which one begins where the other ends, are one wall: neither body blocks a
 * line to a foot on the other's side, though its outline may touch that line. If both sides share
 * the vertex as doubles and the foot is exactly there, only the second side has it. */
#pragma once

#include "geometry/obstruction.h"
#include "ideal/look.h"

/* The widest gap between two sides in line that are one wall. Ends of two objects that meet differ
 * in their last bits, and there is no edge between them that hides or bends anything. */
#define LINE_OF_SIGHT_JOINT_M 1e-6

/* What passes along a straight line, there and back. */
struct line_of_sight {
    double factor;              /* on amplitude, in [0, 1]; 0 if the line is blocked */
    const struct look_body *by; /* the first by id that blocks it; NULL if none does */
    uint64_t effects;           /* the effects that changed the factor */
};

/* A flat side in the world. */
struct side {
    struct vec2 from, to, along; /* along: unit vector */
};

/* The side of a body that a plane reflector describes. */
struct side line_of_sight_side(const struct look_body *body, const struct plane_reflector *plane);

/* True if the sensor's foot is exactly at the end of the side, and another side in line begins
 * there: the foot is then that side's (hard case 33). */
bool line_of_sight_next_side_has_foot(const struct look *look, const struct side *side);

/* Finds the bodies that may hide reflectors of own within an extent; they stay in look->blockers
 * until the next call. Under auto they are those whose shadows overlap the extent, else all that
 * block but own, and none if occlusion is not selected. */
void line_of_sight_find_blockers(struct look *look, const struct look_body *own,
                                 const struct look_extent *wanted);

/* True only if one of look->blockers hides every reflector of the set within the extent. */
bool line_of_sight_all_hidden(const struct look *look, const struct look_set *set,
                              const struct look_extent *wanted);

/* What passes all of look->blockers on a line from the sensor to a place on own. The place is on
 * that side of own, or on none (NULL). With under, the line leads under raised bodies, and they do
 * not block it. */
struct line_of_sight line_of_sight_past_blockers(const struct look *look, const struct side *side,
                                                 const struct obstruction_line *line, bool under);

/* What passes all bodies that block, except these; entries of except may be NULL. All passes if
 * occlusion is not selected. */
struct line_of_sight line_of_sight_along(const struct look *look,
                                         const struct obstruction_line *line,
                                         const struct look_body *const *except, size_t count);

/* The sight margin of a line past all bodies that block, except these and, with under, raised ones.
 * If it is not blocked, the margin is its least distance from a body, beside it or over its top:
 * infinite without any, 0 in a soft shadow (MODEL 14.4). If it is blocked, the margin is its
 * greatest depth in a body; with diffraction, depth counts from two of the line's widest Fresnel
 * radii on. */
double line_of_sight_margin_m(const struct look *look, const struct look_body *const *except,
                              size_t count, const struct obstruction_line *line, bool under,
                              bool blocked);

/* The sight margin of a line that is not blocked. Infinite if occlusion is not selected. */
double line_of_sight_clearance_m(const struct look *look, const struct obstruction_line *line,
                                 const struct look_body *const *except, size_t count);

/* Margins of single decisions, in metres and positive on both sides of a border, 0 on it: how far a
 * reflector is from being lost, or from not being lost (MODEL 2.5, 11.1). */

/* From the border of a point's visibility: the angle to zero_rad, times the range. Infinite for a
 * point that is seen from everywhere. */
double line_of_sight_facing_margin_m(const struct box *box, enum visibility_shape shape,
                                     double facing_rad, double zero_rad, struct vec2 place,
                                     struct vec2 sensor);

/* From losing or gaining the specular point on the side a to b, with unit vector along
 * (mirror_specular_point). If there is one: the lesser of the foot's distance from the nearer
 * shortened end and the sensor's distance from the side's line. If there is none: the greatest of
 * the distances by which foot and sensor are beyond those borders. NaN for a side of length zero,
 * which never has a foot. */
double line_of_sight_foot_margin_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                                   struct vec2 sensor);

/* Distance of a sight line from an outline that it does not touch. */
double line_of_sight_outline_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                      struct vec2 to);

/* Depth of a sight line in an outline that it touches. To clear an edge that it touches, an end of
 * the edge must cross the line or an end of the line the edge; the depth is the distance of the
 * nearest such end, from the edge where that is farthest. */
double line_of_sight_depth_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                    struct vec2 to);
