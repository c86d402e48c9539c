/* The two laws of the account: nothing is lost without a word.
 *
 * Every pair of a sensor that measured and a reflector has exactly one direct entry, in a target's
 * label or in lost; every other echo that was made has one too. Frames keep account if glint-ideal
 * was told --account; the stage that writes targets then has its frame audited. The audit knows how
 * many entries are due, not which: a missing one together with an invented one would pass. */
#ifndef FRAME_ACCOUNT_H
#define FRAME_ACCOUNT_H

#include "frame/frame.h"

/* Refuses with DIAG_INTERNAL and the first entry that is doubled or the first sensor whose entries
 * are not what is due. For frames with targets and account. */
int frame_account_check(const struct frame *frame, struct diag *diag);

#endif
