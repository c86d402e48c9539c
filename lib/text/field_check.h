/* Check of a struct against the bounds of its fields.
 *
 * It covers embedded structs and lists, and accepts whatever the reader of a line would. A list is
 * checked member by member: one member of all items, then the next member. Of several faults, the
 * message names the first in this order. */
#pragma once

#include "text/field.h"

/* Refuses a struct with "echoes[3].range_m: -1 is outside [0, 1e+06] m", "name: missing" and the
 * like. */
int field_check(const struct record *record, const void *base, struct diag *diag);

/* Like field_check, but of the record's own sections checks only these. */
int field_check_sections(const struct record *record, const void *base, unsigned sections,
                         struct diag *diag);
