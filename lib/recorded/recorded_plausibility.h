/* Compares ways with stated speeds, and yaws with motion.
 *
 * A way leads a road user from one step to the next, length_s later. It is denied, and a new visit
 * begins, if it leads farther than the speeds that the source states at its two ends, or in a
 * direction that the two velocities do not have, by more than
 *
 *     2 m + 1 m/s^2 length_s^2 + 0.25 length_s max(speeds) + 3 scatter
 *
 * Between two steps a body that speeds up and brakes again by 4 m/s^2 gains the second term. The
 * scatter is the deviation within which nine of ten ways of the recording stay; where ways are
 * judged while they are read, it is at least 0.7 m in the first 30. A way that is shorter than the
 * speeds say is not denied, since a body may stop.
 *
 * Units are judged by stretches: the ways of one road user until it has moved by 3 m, or should
 * have by its velocities, within 3 s or a single way. In a noisy recording a stretch is longer by
 * eight times what the scatter is above the median of the deviations, at most by 12 m, and may last
 * as much longer. It contradicts if its velocities lead more than 1.5 times as far as it moves, or
 * if it moves more than 1.5 times as far as its speeds add up to. A recording is refused if its
 * denied ways and contradicting stretches are of more ways than the other stretches, or if its yaws
 * contradict the directions of the stretches. Nothing is compared where no speed, or no yaw, is
 * stated. */
#pragma once

#include "base/vec2.h"
#include "recorded/recorded_row.h"

/* What the source states of a road user in a step, and the stretch that ends there. */
struct recorded_stretch {
    struct vec2 at_m;
    struct vec2 velocity_mps; /* speed along the yaw if only that is stated; NAN: not stated */
    double speed_mps;         /* at least 0; NAN: not stated */
    bool reversible;          /* the velocity may as well be the opposite one */
    double yaw_rad;           /* not wrapped; NAN: not stated */
    size_t place;             /* in the file */
    struct vec2 from_m;       /* where the stretch began, and with which yaw */
    double from_yaw_rad;
    double lasts_s, said_m; /* its time, and its length by the speeds */
    struct vec2 led_m;      /* where the velocities lead in that time; NAN: not stated */
    unsigned ways;          /* in it */
    bool slanted;           /* a yaw of the road user has contradicted a direction */
};

/* Ways that contradict the speeds in the same sense. */
struct recorded_contradiction {
    uint64_t ways;
    double moved_m, said_m;
};

/* What the number of a yaw may mean. */
enum recorded_yaw {
    RECORDED_YAW_STATED,
    RECORDED_YAW_DEGREES,  /* taken for radians */
    RECORDED_YAW_RADIANS,  /* taken for degrees */
    RECORDED_YAW_COMPASS,  /* clockwise from north */
    RECORDED_YAW_MIRRORED, /* clockwise from x */
    RECORDED_YAWS,
};

/* Angles between the yaws and the directions of stretches; modulo pi, unless bodies only drive
 * forward. */
struct recorded_slants {
    uint64_t stretches, contradicting;
    double off_rad[RECORDED_YAWS]; /* sums */
    double most_rad, yaw_rad;      /* the largest angle as stated, and the yaw that has it */
    size_t place;                  /* of that yaw */
};

enum { RECORDED_FASTEST_MPS = 200, RECORDED_SCATTER_BINS = 200 };

/* Begins as {0} but for forward. */
struct recorded_plausibility {
    bool forward; /* bodies never reverse, as those of SUMO */
    bool whole;   /* the recording is judged at its end alone */
    bool learned; /* the whole recording has been judged; only denied ways are counted again */
    bool counted; /* nothing is counted any more */
    uint64_t ways, scatter[RECORDED_SCATTER_BINS]; /* ways by their deviations */
    size_t most;                                   /* the last bin that has ways */
    uint64_t agreeing;                             /* ways */
    struct recorded_contradiction rests, leaps;    /* too short ways; too long and denied ways */
    double stretches_m;                            /* length of the stretches among these */
    struct recorded_slants all, far;               /* far: yaws beyond 2 pi */
    uint64_t slanted;                              /* road users */
    size_t place;                                  /* of the first contradiction */
    struct recorded_contradiction rest; /* a way of a long time on which a fast body rests, or 0 */
    double rest_s;
    size_t rest_place;
    /* Denied ways: of bodies that stand by their speeds, of bodies that drive; and ways faster than
     * RECORDED_FASTEST_MPS where no speed is stated. */
    size_t standing, driving, fast;
    size_t first; /* place of the first of these */
};

/* The stretch of a road user that comes. */
struct recorded_stretch recorded_plausibility_begin(const struct recorded_row *row);

/* What the source tells of a way beside the speeds. */
enum recorded_way {
    RECORDED_WAY_PLAIN,     /* nothing */
    RECORDED_WAY_EXPLAINED, /* it is a change of lanes, which is never denied */
    RECORDED_WAY_LEFT,      /* it is none of the body's own, and always denied */
};

/* Compares the way to a state from the state before, and continues its stretch. False if the way is
 * denied. */
bool recorded_plausibility_follow(struct recorded_plausibility *plausibility,
                                  struct recorded_stretch *now,
                                  const struct recorded_stretch *before, double length_s,
                                  enum recorded_way way);

/* Refuses a recording that contradicts itself. At its end, stretches of 10 m or 8 denied ways are
 * enough for that; before, it takes contradictions of 200 ways. A single way is enough if a body
 * that is fast at both of its ends should have moved by 50 m and has moved by a 200th of that. */
int recorded_plausibility_check(const struct recorded_plausibility *plausibility,
                                const struct recorded_format *format, bool ended,
                                struct diag *diag);

/* Refuses a recording that has been followed as a whole, or else has learned its scatter: it is to
 * be followed again, for its denied ways. */
int recorded_plausibility_learn(struct recorded_plausibility *plausibility,
                                const struct recorded_format *format, struct diag *diag);
