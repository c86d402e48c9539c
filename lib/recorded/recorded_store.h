/* Puts rows that do not ascend in time into steps.
 *
 * The usual step of a road user is the lower quartile of the times between its rows, as it may be
 * absent for longer; that of the recording is the median over its road users. Rows form a step if
 * their stamps lie within RECORDED_STORE_STEP_SHARE of the recording's, from the first to the last:
 * of a chain of stamps, each near the next, that much is one step. The time of the step is the
 * stamp of most of its rows, the first one of equals. A row with another stamp is moved to that
 * time by its velocity and yaw rate. A step has no two stamps of one road user.
 *
 * Road users have times of their own if more than RECORDED_STORE_APART_SHARE of their successive
 * rows have a step of others in between, absences aside; if there is a rate, if any have. Then they
 * are interpolated, each between its own rows, at the instants of the rate. Rows farther apart than
 * 1.5 times the usual step of their road user, or with a denied way in between, are those of two
 * visits. */
#pragma once

#include "recorded/recorded_plausibility.h"
#include "recorded/recorded_row.h"

#define RECORDED_STORE_STEP_SHARE 0.1
#define RECORDED_STORE_APART_SHARE 0.1

/* Reads all rows of a reader and closes it. The new reader gives them in the order of time and
 * marks steps; its format is NULL after a message. Road users with times of their own are refused
 * if there is no rate (rate_hz <= 0); with one, they are judged here, as their rows are not given.
 * Memory is that of recorded_memory.h. */
struct recorded_reader recorded_store_open(struct recorded_reader reader, double rate_hz,
                                           struct recorded_plausibility *plausibility,
                                           struct arena *arena, struct diag *diag);

/* Such a reader gives all rows again. */
void recorded_store_rewind(struct recorded_reader reader);
