/* Messages of OSI 3.8: detections of radars, and the truth.
 *
 * A trace holds one scene; its times ascend from 0 on. Objects and sensors are numbers in it: an id
 * of at most 15 digits is the number itself, other objects are numbered from OSI_TRACE_NAMED on,
 * and sensors from 1 on, in the order of the frame's list. */
#pragma once

#include "base/intern.h"
#include "base/text.h"
#include "frame/frame.h"

#define OSI_TRACE_NAMED UINT64_C(1000000000000000)

/* Zeroed before the first frame, but for the option and the arena. */
struct osi_trace {
    double shift_s; /* added to all times; infinite until the first frame: choose it there */
    struct arena *arena;
    const char *scene;
    uint64_t seed, time_ns;    /* of the latest frame */
    struct intern objects;     /* ids in the order in which they first appear */
    const struct frame *frame; /* of which a message is built */
};

/* The option of stages whose state begins with a struct osi_trace. */
#define OSI_TRACE_OPTION                                                                           \
    {                                                                                              \
        OPTIONAL_REAL(struct osi_trace, shift_s, -1e10, 1e10,                                      \
                      "added to all times; absent: the largest age of a scan in the first frame, " \
                      "if one would be below 0, or else 0"),                                       \
            .absent = (double)INFINITY                                                             \
    }

/* Takes the next frame of a stream and sorts its objects. Refuses a second scene, a time that is
 * not later than the frame before or that a trace cannot hold, and objects without a size. */
int osi_trace_take(struct osi_trace *trace, struct frame *frame, struct diag *diag);

/* A time of a frame that was taken, shifted, in whole nanoseconds. */
uint64_t osi_trace_ns(const struct osi_trace *trace, double time_s);

/* Appends the SensorData of a frame that was taken. Fails if its targets have no quality. */
int osi_trace_add(struct osi_trace *trace, const struct frame *frame, struct text *text,
                  struct diag *diag);
