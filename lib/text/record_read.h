/* JSON lines read into structs, by their field tables.
 *
 * The reader takes any key order and any spelling of a number. It refuses unknown, missing and
 * repeated keys and anything out of bounds, and names the path: "echoes[3].range_m: -1 is outside
 * [0, 1e6] m". */
#pragma once

#include "text/list_cache.h"

/* Reads the line (without its newline) into the struct, which must have been cleared. The texts
 * of a record that keeps its line (field.h) point into it. All else that the struct holds lies in
 * the arena, or in the cache of steady lists, which may be NULL. */
int record_read(const char *line, size_t length, const struct record *record, void *base,
                struct arena *arena, struct list_cache *cache, struct diag *diag);

/* Reads the lists of these groups that were left unread, after record_read. */
int record_read_left(const struct record *record, unsigned groups, void *base, struct arena *arena,
                     struct list_cache *cache, struct diag *diag);
