/* Is everything in a struct within the bounds of its field table, all the way down?
 *
 * It passes what the reader of a line would take. A list is checked member by member: one member of
 * all items, then the next member. Of several faults the first found in this order is told. */
#ifndef FIELD_CHECK_H
#define FIELD_CHECK_H

#include "text/field.h"

/* Refuses "echoes[3].range_m: -1 is outside [0, 1e+06] m", "name: missing" and the like. */
int field_check(const struct record *record, const void *base, struct diag *diag);

/* The same; of the record's own members with a section only those of these sections. */
int field_check_sections(const struct record *record, const void *base, unsigned sections,
                         struct diag *diag);

#endif
