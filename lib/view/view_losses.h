/* The losses of a scan, as columns of the page.
 *
 * They are grouped by object. A fate is an object and the number of its pattern, the list of its
 * lost reflectors with their reasons; most objects have the same pattern for many frames. Details
 * are what changes from frame to frame: who blocked an echo, how many dB it lacked, and where it
 * was. A loss without a detail was at its spot: most reflectors stay where they are in their
 * object's axes, so that one place serves all frames of the scene. */
#pragma once

#include "view/view_columns.h"

/* What the scans before had; zeroed before the first. */
struct view_losses {
    struct intern patterns, spot_keys;
    LIST_OF(struct vec2) spots; /* of reflectors, in their object's axes, by number of the key */
    struct intern own_reasons;  /* of losses, numbered behind those of enum loss */
};

struct view_scan;

/* Adds the losses of a sensor in a frame: its scan, and the number of the frame's scene. */
void view_losses_add(struct view_losses *losses, struct view_columns *columns,
                     const struct frame *frame, const struct view_scan *scan, uint32_t scene,
                     const char *sensor);
