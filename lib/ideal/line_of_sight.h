/* Part of an echo that all bodies together let through.
 *
 * Each body on the line blocks it or lets it pass (MODEL 2.5), over its top or under its bottom
 * (14.3) or around its edges (14.4); obstruction.h has the formulas for one body.
 *
 * Two sides in line are one wall if one begins where the other ends. Then neither body blocks a
 * line to a foot on the other's side, though its outline may touch that line. If both sides share
 * the vertex as doubles and the foot is exactly there, only the second side has the foot. */
#pragma once

#include "geometry/obstruction.h"
#include "ideal/look.h"

/* The widest gap between two sides in line that are one wall: the ends of two objects that meet
 * differ in their last bits. */
#define LINE_OF_SIGHT_JOINT_M 1e-6

/* The wave that passes along a straight line, there and back. */
struct line_of_sight {
    double factor;              /* on amplitude, in [0, 1]; 0 if the line is blocked */
    const struct look_body *by; /* the first body by id that blocks the line; NULL: none */
    uint64_t effects;           /* the effects that changed the factor */
};

/* A flat side in the world. */
struct side {
    struct vec2 from, to, along; /* along: unit vector */
};

/* The side of a body between two places in fractions of its box. */
struct side line_of_sight_side(const struct look_body *body, double from_x, double from_y,
                               double to_x, double to_y);

/* True if the foot of the perpendicular from the sensor is exactly at the end of the side and
 * another side in line begins there, which then has the foot (hard case 33). */
bool line_of_sight_next_side_has_foot(const struct look *look, const struct side *side);

/* Notes in the selection's log that bodies may hide something, or that none can. */
void line_of_sight_note(const struct look *look, bool some);

/* Sets look->blockers to the bodies that may hide reflectors of own within an extent. Under auto
 * their shadows overlap the extent; with forced occlusion they are all bodies that block, except
 * own; without occlusion there are none. */
void line_of_sight_find_blockers(struct look *look, const struct look_body *own,
                                 const struct look_extent *wanted);

/* True only if one of look->blockers hides every reflector of the set within the extent. */
bool line_of_sight_all_hidden(const struct look *look, const struct look_set *set,
                              const struct look_extent *wanted);

/* The wave that passes all of look->blockers on a line from the sensor to a place, which is on the
 * given side or on none (NULL). With under, the line leads under raised bodies, which do not block
 * it. */
struct line_of_sight line_of_sight_past_blockers(const struct look *look, const struct side *side,
                                                 const struct obstruction_line *line, bool under);

/* The wave that passes all bodies that block, except count bodies, which may be NULL. All of it if
 * occlusion is not selected. */
struct line_of_sight line_of_sight_along(const struct look *look,
                                         const struct obstruction_line *line,
                                         const struct look_body *const *except, size_t count);

/* Margins of single decisions, in metres, positive on both sides of a border and 0 on it: the
 * distance of a reflector from being lost, or from not being lost (MODEL 2.5, 11.1). */

/* The margin of a line past all bodies that block, except the given ones and, with under, raised
 * ones. If it is not blocked: the least distance from a body, beside, over or under it; infinite
 * without bodies or occlusion, 0 in a soft shadow (MODEL 14.4). If it is blocked: the greatest
 * depth in a body; with diffraction, that beyond twice its widest Fresnel radius. */
double line_of_sight_margin_m(const struct look *look, const struct look_body *const *except,
                              size_t count, const struct obstruction_line *line, bool under,
                              bool blocked);

/* The margin of a point's visibility: the angle to zero_rad, times the range. It is infinite for a
 * point that is visible from everywhere. */
double line_of_sight_facing_margin_m(const struct box *box, enum visibility_shape shape,
                                     double facing_rad, double zero_rad, struct vec2 place,
                                     struct vec2 sensor);

/* The margin of the specular point on the side a to b with the unit vector along
 * (mirror_specular_point). With a specular point it is the least of the foot's distances from the
 * shortened ends and the sensor's distance from the side's line. Without one it is the greatest
 * distance by which foot or sensor is beyond these borders. NaN for a side of length zero. */
double line_of_sight_foot_margin_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                                   struct vec2 sensor);

/* The distance of a sight line from an outline that it does not touch. */
double line_of_sight_outline_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                      struct vec2 to);

/* Depth of a sight line in an outline that it touches: the greatest, over the edges that it
 * touches, of the least distance by which an end of the edge or of the line must move to part the
 * two. */
double line_of_sight_depth_margin_m(const struct vec2 *corners, size_t count, struct vec2 from,
                                    struct vec2 to);
