/* The ground truth in a message of OSI.
 *
 * A message is a GroundTruth, a SensorView with a global_ground_truth, or a SensorData with such a
 * SensorView. Nothing but its fields tells which one it is: it is a SensorData or a SensorView if
 * it unpacks as one and has a ground truth there with a timestamp or a moving object. */
#pragma once

#include "base/arena.h"
#include "recorded_osi.pb-c.h"

struct osi_message {
    const Osi3__GroundTruth *truth; /* NULL: the message has none */
    const Osi3__Identifier *host;   /* NULL: not said */
    const Osi3__Timestamp *time;    /* NULL: not said */
};

/* Unpacks a message, whose parts lie in the arena. */
struct osi_message osi_message_unpack(const void *bytes, size_t length, struct arena *arena);
