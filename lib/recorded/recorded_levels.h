/* Bodies on the road of an ego, by their heights.
 *
 * Between two places of one road the rise lies between those of its slopes at both, times the way
 * between them. The slopes are those along the two bodies' headings, so that a body counts by the
 * square of the cosine between its heading and the line to the other one: a vehicle that crosses
 * the line says nothing of the slope along it. Where neither slope is known the road is level.
 *
 * A body is on the ego's road if it is at most RECORDED_LEVELS_MOST_M above or below this rise from
 * the ego. On a hill that is not straight it also is if bodies lead to it that are nearer to the
 * ego and on its road: it is at most 1.5 m (3 m where slopes are not known) above or below the rise
 * from the nearest of them, and within what a road can bend from all of them. That is
 * RECORDED_LEVELS_MOST_M + d^2 / (4 R) at the distance d, R = 600 m, and 0.12 d more where slopes
 * are not known. So the vehicles on a ramp do not lead to a bridge over the ego's road. */
#pragma once

#include "base/arena.h"
#include "base/vec2.h"

enum { RECORDED_LEVELS_MOST_M = 3 };

struct recorded_level {
    struct vec2 place_m;
    struct vec2 heading; /* unit vector */
    double z_m;          /* of the road below the body; NAN: not said, which is on every road */
    double tall_m;       /* the height of a thing, of which any part may be on the road; else 0 */
    double slope;        /* rise per metre along the heading; NAN: not known */
};

/* Sets on[i] of each of count bodies; the ego, one of them, is on its road. Whether a body is does
 * not depend on bodies that are farther from the ego. */
void recorded_levels_mark(const struct recorded_level *bodies, size_t count, size_t ego, bool *on,
                          struct arena *arena);

/* Rise and run of a track; what lies back counts by the share exp(-way / 5 m). Zero: no way yet. */
struct recorded_climb {
    double rise_m, run_m;
};

/* Adds a part of a track: its run along the heading, negative backwards, and its rise. */
struct recorded_climb recorded_levels_climb(struct recorded_climb climb, double run_m,
                                            double rise_m);

/* The slope of a track; NAN after less than 0.5 m. */
double recorded_levels_slope(struct recorded_climb climb);

/* The slope of a pitch, positive upward. NAN at 0, which sources write for all bodies whose pitch
 * they do not know, and at 1.5 rad and more. */
double recorded_levels_pitched(double pitch_rad);
