/* Times and numbers of the scene in a trace.
 *
 * A trace holds one scene, whose times ascend. Programs that write it choose its limits of time. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"

enum { TRACE_SECOND_NS = 1000000000 };

/* Zeroed before the first frame, but for the option, the arena and the limits of times. */
struct trace {
    double shift_s; /* added to all times; infinite until the first frame: choose it there */
    double begin_s; /* the shift that is chosen leaves no scan of the first frame before this */
    double end_s;   /* times are from 0 to this */
    struct arena *arena;
    struct intern objects; /* ids in the order in which they first appear */
    const char *scene;
    uint64_t seed;
    const struct frame *frame; /* the latest one */
    uint64_t time_ns;          /* its time */
};

/* The option of stages whose state begins with a struct trace. */
#define TRACE_OPTION                                                                               \
    {                                                                                              \
        OPTIONAL_REAL(struct trace, shift_s, -1e10, 1e10,                                          \
                      "added to all times; absent: the largest age of a scan in the first frame, " \
                      "if one would be below 0, or else 0"),                                       \
            .absent = (double)INFINITY                                                             \
    }

/* Takes the next frame of a stream and sorts its objects. Refuses a second scene, a time that is
 * not later than the frame before or out of the limits, targets without quality or without a scan,
 * and objects without a size. */
int trace_take(struct trace *trace, struct frame *frame, struct diag *diag);

/* A time of a frame that was taken, shifted, in whole nanoseconds. */
uint64_t trace_ns(const struct trace *trace, double time_s);

/* The number of an object: 1 for the first of the trace. */
uint32_t trace_object(struct trace *trace, const char *id);
