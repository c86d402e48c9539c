/* Messages of OSI 3.8: detections of radars, and the truth.
 *
 * Objects and sensors are numbers: an id of at most 15 digits is the number itself, other objects
 * are numbered from OSI_TRACE_NAMED on, and sensors from 1 on, in the order of the frame's list. */
#pragma once

#include "base/text.h"
#include "trace.h"

#define OSI_TRACE_NAMED UINT64_C(1000000000000000)

/* The latest time that OSI's traces hold. */
#define OSI_TRACE_END_S 1e10

/* Appends the SensorData of the trace's frame. */
void osi_trace_add(struct trace *trace, struct text *text);
