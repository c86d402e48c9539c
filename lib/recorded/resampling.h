/* Resamples a recording to another rate.
 *
 * Places and velocities follow the cubic Hermite curve between two steps, and distances travelled
 * the cubic that has the speeds as its slopes; yaws follow the shorter arc, yaw rates and heights
 * are linear; class and sizes stay. Where the velocities of the two steps point into the same half
 * plane, they are reduced between the steps so that nobody rolls back (motion_monotone_share).
 * Distances travelled never fall. A road user is there from its first step to its last. Instant 0
 * is the first step of the recording, whatever from_ns is, so that parts that are cut by time have
 * the instants of the whole. */
#pragma once

#include "recorded/recorded_steps.h"

struct resampling {
    struct recorded_steps *steps;
    double rate_hz;
    int64_t from_ns, to_ns;                /* no instant is before from_ns or after to_ns */
    int64_t begin_ns, first;               /* time of instant 0; number of the first one made */
    const struct recorded_step *from, *to; /* around the next instant; NULL: not read yet */
    struct recorded_step made[2];          /* instants */
    size_t made_count, given;
    bool ended;
    struct diag fault; /* that ended it */
};

/* The object at a share in [0, 1] of the time between two of its states. */
struct object resampling_between(const struct object *a, const struct object *b, double length_s,
                                 double share);

/* The next instant as a step: 1; 0 at the end; -1 after a message. It is valid until the next
 * call. */
int resampling_next(struct resampling *resampling, const struct recorded_step **step,
                    struct diag *diag);

void resampling_close(struct resampling *resampling);
