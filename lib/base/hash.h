/* A 64-bit hash of bytes (FNV-1a with a final mix), for random addresses and document digests. Not
 * for adversaries. Chain calls to hash several pieces: a piece's end counts, so ("a", "bc") and
 * ("ab", "c") differ. */
#ifndef HASH_H
#define HASH_H

#include <stddef.h>
#include <stdint.h>

#define HASH_START UINT64_C(0xcbf29ce484222325)

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t length);
uint64_t hash_text(uint64_t hash, const char *text);

/* A quick one for tables in memory, which nothing that is written depends on. */
uint64_t hash_for_table(uint64_t hash, const char *text);

#endif
