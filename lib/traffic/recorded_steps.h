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
#include "traffic/recorded_classes.h"

enum { RECORDED_STEPS_RING = 3, RECORDED_STEPS_FASTEST_MPS = 200 };

struct recorded_state {
    struct object object;     /* in the source's coordinates */
    int64_t since_ns;         /* when its visit began */
    bool passenger;           /* recorded_row.passenger */
    bool leaves;              /* is it missing from the next step, or is this the last? */
    size_t place;             /* row, line or byte in the file */
    struct vec2 at_m;         /* of which velocities are taken */
    double direction_rad;     /* recorded_row.direction_rad */
    double ahead_m;           /* of at_m before the centre, while the yaw is not known */
    double speed_mps;         /* recorded_row.speed_mps */
    double way_m, way_rest_m; /* since the visit began, and what rounding took off */
    size_t before, after;     /* its places in the steps beside, or SIZE_MAX */
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

void recorded_steps_close(struct recorded_steps *steps);
