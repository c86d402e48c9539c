/* What frames carry by choice: the words of --sections.
 *
 * Every frame has the choice in its header, which all later stages follow. Frames always carry
 * sensors, targets and counts. */
#pragma once

#include "text/field.h"

struct frame;

enum carried {
    CARRY_OBJECTS = 1 << 0,    /* after the targets are made; before, frames always have objects */
    CARRY_REFLECTORS = 1 << 1, /* after the last stage that reads them, as echoes and cells */
    CARRY_ECHOES = 1 << 2,
    CARRY_CELLS = 1 << 3,
    CARRY_ACCOUNT = 1 << 4, /* the lost echoes: with targets and counts, the fate of every echo */
    CARRY_MARGINS = 1 << 5,
    CARRY_QUALITY = 1 << 6,
    CARRY_VISIBILITY = 1 << 7, /* sightings (sightings.h) */
};

enum { CARRY_BY_DEFAULT = CARRY_OBJECTS };

extern const char *const sections_names[]; /* NULL-terminated; bit i of enum carried is the i-th */
extern const char *const sections_meanings[]; /* of each, for people */

/* The change that a command line makes to the choice of its frames. */
struct sections_change {
    uint64_t added, removed; /* sets of enum carried */
    int64_t account_every;   /* only frames whose number is a multiple of this keep the account */
};

/* Reads the text of --sections: all or none, then words that are added, or removed with - in front;
 * account:every=10 adds the account to every tenth frame of a scene. Refuses an unknown word
 * (DIAG_USAGE). */
int sections_read(const char *text, struct sections_change *change, struct diag *diag);

/* Changes the choice of a frame, and removes margins and quality that it no longer carries. Fails
 * with DIAG_CONFIG if the frame lacks an added section and the stage that writes it has run. */
int sections_apply(const struct sections_change *change, struct frame *frame, struct diag *diag);

/* The parts of the frame that stages need not write, as this frame does not carry them. */
unsigned sections_left_out(const struct frame *frame);

/* Drops the parts that the frame does not carry and that no later stage reads. */
void sections_drop(struct frame *frame);
