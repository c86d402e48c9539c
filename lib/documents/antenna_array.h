/* Antenna array of a radar, in its document (MODEL 7.5). */
#pragma once

#include "radar/array.h"
#include "text/field.h"

extern const struct record antenna_array_record; /* of struct array_layout */

/* Refuses an array that has no beams (DIAG_CONFIG): too few or too many virtual elements, uneven
 * steps between them, or steps so wide that two directions in the field of view look alike. */
int antenna_array_check(const struct array_layout *layout, double field_of_view_rad,
                        struct diag *diag);
