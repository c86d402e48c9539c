/* Two frames that ought to be one: the same scene, seen with every effect and with those that a
 * planner chose. Each function returns 0, or -1 with the first difference in the diag, such as
 * "targets[3].range_m". */
#ifndef SOUNDNESS_COMPARE_H
#define SOUNDNESS_COMPARE_H

#include "frame/frame.h"

/* targets and lost, bit by bit. */
int compare_bits(const struct frame *all, const struct frame *chosen, struct diag *diag);

/* The cells, which are the list before noise: the same ones with the same leaders, no value off by
 * more than the tolerance, amplitudes both as the sum over the members and as superposed, and no
 * member's weight by a larger share than an amplitude may change. Then the noise on top: where a
 * cell is the same to the bit, so is its target if both frames list it. Frames keep their cells. */
int compare_within(const struct frame *all, const struct frame *chosen,
                   const struct tolerance *tolerance, struct diag *diag);

#endif
