/* Antenna array of a radar, in its document (MODEL 7.5). */
#pragma once

#include "radar/array.h"
#include "text/field.h"

extern const struct record antenna_array_record; /* of struct array_layout */

/* Refuses an array without beams (DIAG_CONFIG): of too few or too many virtual elements, uneven
 * ones, or ones so far apart that two directions in the field of view look alike. */
int antenna_array_check(const struct array_layout *layout, double field_of_view_rad,
                        struct diag *diag);
