/* What comes through between two places of a look, past everything that blocks (MODEL 2.5, 14.3,
 * 14.4).
 *
 * Two sides in line, where one begins as the other ends, are one wall: the object of neither hides
 * a foot on the other, though it may touch the sight line there, and where they share that vertex
 * as doubles, the second mirrors what is exactly before it. */
#ifndef LINE_OF_SIGHT_H
#define LINE_OF_SIGHT_H

#include "geometry/obstruction.h"
#include "ideal/look.h"

/* Two sides in line are one wall if no more than this is between them: places of objects that meet
 * are not the same to the last bit, and no edge stands there to hide or bend anything. */
#define LINE_OF_SIGHT_JOINT_M 1e-6

/* What comes through to a place and back, there along a straight line. */
struct line_of_sight {
    double factor;              /* on amplitude; 0 if it is blocked */
    const struct look_body *by; /* by the first of these by id; NULL if it is not */
    uint64_t effects;           /* that changed the factor */
};

/* A plane in the world. */
struct side {
    struct vec2 from, to, along;
};

struct side line_of_sight_side(const struct look_body *body, const struct plane_reflector *plane);

/* A foot exactly at the joint of two sides in line is the second one's (NUMERICS 33). */
bool line_of_sight_next_side_has_foot(const struct look *look, const struct side *side);

/* Which objects to ask for when own's reflectors, all within an extent, are looked at: all that
 * block, or those of them that overlap it. They stay in the look until the next call. */
void line_of_sight_find_blockers(struct look *look, const struct look_body *own,
                                 const struct look_extent *wanted);

/* True only if one of the blockers that were found hides every reflector of that set within the
 * extent. */
bool line_of_sight_all_hidden(const struct look *look, const struct look_set *set,
                              const struct look_extent *wanted);

/* What comes through to a place on the body whose blockers were found, on a side of it or not
 * (NULL); only those objects count that no radar can look under if solid. */
struct line_of_sight line_of_sight_past_blockers(const struct look *look, const struct side *side,
                                                 const struct obstruction_line *line, bool solid);

/* What comes along a line past all bodies that block; of the count bodies of but, any of which may
 * be NULL, none does. All of it where occlusion is not selected. */
struct line_of_sight line_of_sight_along(const struct look *look,
                                         const struct obstruction_line *line,
                                         const struct look_body *const *but, size_t count);

/* Of all objects that can be in the way: how near the sight line comes to the nearest that lets it
 * pass, beside it or over it, or how deep it is in those in the way. Of a soft shadow nothing is
 * known but how deep the line lies in what is always dark. */
double line_of_sight_margin_m(const struct look *look, const struct look_body *const *but,
                              size_t count, const struct obstruction_line *line, bool solid,
                              bool blocked);

/* How near the line comes to what it passes; infinite where there is nothing, or occlusion is not
 * selected. */
double line_of_sight_clearance_m(const struct look *look, const struct obstruction_line *line,
                                 const struct look_body *const *but, size_t count);

#endif
