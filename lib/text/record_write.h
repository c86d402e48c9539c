/* Structs checked and written as JSON lines by field tables.
 *
 * The writer makes no tree and no white space; keys come in table order. */
#pragma once

#include "base/text.h"
#include "text/list_cache.h"

/* Refuses a struct out of the bounds of its fields with "echoes[3].range_m: -1 is outside [0,
 * 1e+06] m", "name: missing" and the like. Covers embedded structs and lists, and accepts whatever
 * the reader of a line would. Of the record's own groups it checks only these; ~0U: all. A list
 * is checked member by member: one member of all items, then the next member. Of several faults,
 * the message names the first in this order. */
int record_write_check(const struct record *record, const void *base, unsigned groups,
                       struct diag *diag);

/* Appends the line with its newline to text. The struct must have passed record_write_check. The
 * cache of steady lists may be NULL. */
void record_write(const struct record *record, const void *base, struct list_cache *cache,
                  struct text *text);
