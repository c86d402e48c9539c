/* 64-bit hash of bytes, for random addresses and document digests. FNV-1a with the final mix of
 * splitmix64; not for adversaries. Calls can be chained to hash several pieces: the end of each
 * piece counts, so ("a", "bc") and ("ab", "c") differ. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define HASH_START UINT64_C(0xcbf29ce484222325)

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t length);
uint64_t hash_text(uint64_t hash, const char *text);
