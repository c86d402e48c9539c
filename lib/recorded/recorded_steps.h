/* The road users of a recording, step by step.
 *
 * A step is an instant at which the recording has states. Velocities and yaw rates that the source
 * lacks are the slopes of the parabola through three steps, at unequal distances too; in the first
 * and the last step of a road user they are differences of two. So a step waits for the next one.
 * Live, they are differences to the step before, and nothing waits.
 *
 * A road user that is missing from a step has left, and if its id comes again, a new visit begins.
 * A new visit begins, too, where a road user moves faster than RECORDED_STEPS_FASTEST_MPS from one
 * step to the next, as those do that SUMO teleports. Memory is that of three steps. */
#pragma once

#include "base/vec2.h"
#include "frame/frame.h"
#include "recorded/recorded_classes.h"

enum { RECORDED_STEPS_RING = 3, RECORDED_STEPS_FASTEST_MPS = 200, RECORDED_JUMP_S = 3 };

/* What a vehicle carries on of the jumps to another lane or angle before (recorded_jumps.c). */
struct recorded_jumps {
    struct vec2 along;            /* the direction in which it moved last, of length 1 */
    double angle_rad;             /* in the file */
    struct vec2 rest_m, rest_mps; /* how far its place in the file is ahead, and how that changes */
    double left_s;                /* until it is 0 */
    bool turns;                   /* has its yaw not reached the angle yet? */
};

struct recorded_jump_counts {
    size_t lanes, angles;
};

struct recorded_state {
    struct object object;         /* in the source's coordinates */
    int64_t since_ns;             /* when its visit began */
    bool passenger;               /* recorded_row.passenger */
    bool leaves;                  /* is it missing from the next step, or is this the last? */
    size_t place;                 /* row, line or byte in the file */
    struct vec2 recorded_m;       /* as the file has it */
    struct recorded_jumps *jumps; /* NULL where there are none */
    struct vec2 at_m;             /* velocities are differences of this place */
    double direction_rad;         /* recorded_row.direction_rad */
    double ahead_m;               /* of at_m before the centre, while the yaw is not known */
    double speed_mps;             /* recorded_row.speed_mps */
    double way_m, way_rest_m;     /* since the visit began, and what rounding took off */
    size_t before, after;         /* its places in the steps beside, or SIZE_MAX */
};

struct recorded_step {
    int64_t time_ns;
    int64_t interval_ns; /* since the step before; of the first until the next; 0: only one */
    LIST_OF(struct recorded_state) states; /* ids ascending as text */
    struct arena arena;
};

struct recorded_steps {
    struct recorded_reader reader;
    struct recorded_classes classes;
    bool live;
    int64_t to_ns; /* no step is after this */
    struct recorded_step ring[RECORDED_STEPS_RING];
    size_t read, given; /* how many steps */
    struct recorded_jump_counts jumps;
    double moved_m, said_m; /* ways of all, by their places and by their speeds */
    struct recorded_row row;
    bool row_waits;    /* for the next step */
    bool ended;        /* there is no more to read */
    struct diag fault; /* that ended it */
};

/* The next step: 1; 0 at the end; -1 after a message. It and the step before it stay valid until
 * the next call. Where the source is damaged, all steps before come first. */
int recorded_steps_next(struct recorded_steps *steps, const struct recorded_step **step,
                        struct diag *diag);

/* The state of an id, or NULL. */
const struct recorded_state *recorded_steps_find(const struct recorded_step *step, const char *id);

/* Spreads a jump of the place over RECORDED_JUMP_S and one of the angle over the way that the body
 * needs to turn. The state has the place and angle of its row; before is that of the same visit,
 * length_s earlier, or NULL. */
void recorded_jumps_spread(struct recorded_state *state, const struct recorded_state *before,
                           double length_s, struct recorded_jump_counts *counts);

void recorded_steps_close(struct recorded_steps *steps);
