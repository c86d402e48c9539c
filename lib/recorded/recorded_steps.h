/* Decides class, place, velocity and yaw, whatever the format.
 *
 * A step is an instant at which the recording has states. Velocities and yaw rates that the source
 * lacks are the slopes of the parabola through three steps, at equal or unequal distances; in the
 * first and the last step of a road user they are differences of two. So a step waits for the next
 * one. Live, they are differences to the step before, and no step waits.
 *
 * A road user that is missing from a step has left; if its id comes again, a new visit begins. A
 * new visit also begins behind a way that its speeds deny, as after a teleport of SUMO
 * (recorded_plausibility.h). No velocity, yaw rate or distance is that of two visits. Memory is
 * that of three steps. */
#pragma once

#include "base/vec2.h"
#include "frame/frame.h"
#include "recorded/recorded_classes.h"
#include "recorded/recorded_levels.h"
#include "recorded/recorded_plausibility.h"

enum { RECORDED_STEPS_RING = 3, RECORDED_JUMP_S = 3 };

/* The state of a vehicle's jumps to another lane or angle (recorded_jumps.c). */
struct recorded_jumps {
    struct vec2 along;            /* unit vector of the last motion */
    double angle_rad;             /* in the file */
    struct vec2 rest_m, rest_mps; /* from the present place to that of the file, and its rate */
    double left_s;                /* time until the rest is 0 */
    const char *lane;             /* recorded_row.lane */
    bool turns;                   /* the yaw has not reached the angle yet */
};

struct recorded_jump_counts {
    size_t lanes, angles;
};

struct recorded_state {
    struct object object;             /* in the source's coordinates */
    int64_t since_ns;                 /* time when its visit began */
    bool passenger;                   /* recorded_row.passenger */
    bool leaves;                      /* not in the next step, or there is none */
    size_t place;                     /* row, line or byte in the file */
    struct recorded_jumps *jumps;     /* NULL: none */
    struct vec2 at_m;                 /* place whose differences are velocities */
    double direction_rad;             /* recorded_row.direction_rad */
    double ahead_m;                   /* distance of the place ahead of the centre */
    double speed_mps;                 /* recorded_row.speed_mps */
    struct recorded_stretch *stretch; /* what its rows state */
    double way_m, way_rest_m;         /* path length of the visit, and its rounding error */
    double z_m, slope;                /* recorded_row.z_m; slope by the track, or else by the row */
    struct recorded_climb climb;      /* of the track */
    bool stands;                      /* recorded_row.stands */
    size_t before, after;             /* place in the step before and after, or SIZE_MAX */
};

struct recorded_step {
    int64_t time_ns;
    int64_t interval_ns; /* since the step before; first step: until the next; 0: a single step */
    LIST_OF(struct recorded_state) states; /* ids ascending as text */
    struct arena arena;
};

struct recorded_steps {
    struct recorded_reader reader;
    struct recorded_classes classes;
    bool live;
    int64_t to_ns; /* no step is later */
    struct recorded_step ring[RECORDED_STEPS_RING];
    size_t read, given; /* numbers of steps */
    struct recorded_jump_counts jumps;
    struct recorded_plausibility plausibility;
    struct recorded_row row;
    bool row_waits; /* the row belongs to the next step */
    bool ended;     /* all is read, or there was a fault */
    struct diag fault;
};

/* Judges a recording that is stored (recorded_store.h) as a whole before its first step is given:
 * -1 after the message that refuses it. The caller then has the reader begin again. Faults of its
 * rows are left to recorded_steps_next. */
int recorded_steps_judge(struct recorded_steps *steps, struct diag *diag);

/* The next step: 1; 0 at the end; -1 after a message. It and the step before it stay valid until
 * the next call. All steps before a fault of the source come first. */
int recorded_steps_next(struct recorded_steps *steps, const struct recorded_step **step,
                        struct diag *diag);

/* The slope, at the middle of three places, of the parabola through them. before and after are the
 * rises to and from the middle; their times are 0 if there is no such place. NAN without both. */
double recorded_steps_slope(double before, double before_s, double after, double after_s);

/* The state of an id, or NULL. */
const struct recorded_state *recorded_steps_find(const struct recorded_step *step, const char *id);

/* Whether the way from the state before, length_s earlier, is a jump: to another lane, which is
 * spread, or of a standing vehicle within one, as SUMO parks vehicles. */
enum recorded_way recorded_jumps_way(const struct recorded_state *state,
                                     const struct recorded_state *before, double length_s);

/* Spreads a jump of the place over RECORDED_JUMP_S, and a jump of the angle over the distance that
 * the body needs to turn. The state has the place and angle of its row; before is the state of the
 * same visit length_s earlier, or NULL. */
void recorded_jumps_spread(struct recorded_state *state, const struct recorded_state *before,
                           double length_s, struct recorded_jump_counts *counts);

void recorded_steps_close(struct recorded_steps *steps);
