/* What frames carry by choice: the words of --sections.
 *
 * The choice stands in the header of every frame, so that all later stages follow it without being
 * told again. Sensors, targets and counts are always carried. */
#pragma once

#include "text/field.h"

struct frame;

enum carried {
    CARRY_OBJECTS = 1 << 0,    /* beside the targets; stages before them always have objects */
    CARRY_REFLECTORS = 1 << 1, /* beyond the stage that reads them, as the two below */
    CARRY_ECHOES = 1 << 2,
    CARRY_CELLS = 1 << 3,
    CARRY_ACCOUNT = 1 << 4,    /* lost: with counts and labels, what became of every echo */
    CARRY_MARGINS = 1 << 5,    /* of every entry; without them no stage computes any */
    CARRY_QUALITY = 1 << 6,    /* of every target */
    CARRY_VISIBILITY = 1 << 7, /* sightings of every object (sightings.h) */
};

enum { CARRY_BY_DEFAULT = CARRY_OBJECTS };

extern const char *const sections_names[]; /* NULL-terminated; bit i of enum carried is the i-th */

/* What a command line changes in the choice of the frames that it is given. */
struct sections_change {
    uint64_t added, removed; /* sets of enum carried */
    int64_t account_every;   /* the account is added to frames whose number is a multiple of it */
};

/* Reads the text of --sections: all, none, or words, each with - in front to leave it out, on top
 * of what the frames say; account:every=10 for every tenth frame of a scene. An unknown word is
 * refused with what is known. */
int sections_read(const char *text, struct sections_change *change, struct diag *diag);

/* Changes the choice of a frame. Fails with DIAG_CONFIG where a word comes too late, as a stage
 * before has gone on without. Margins and quality that are left out go at once. */
int sections_apply(const struct sections_change *change, struct frame *frame, struct diag *diag);

/* The sections, a set of enum section, that frames have only by choice and this one does not. */
unsigned sections_left_out(const struct frame *frame);

/* Drops the sections that the frame does not carry and that no later stage reads. */
void sections_drop(struct frame *frame);
