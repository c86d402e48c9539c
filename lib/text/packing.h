/* Packed bytes: gzip, and zstd where libzstd was there.
 *
 * gzip is unpacked by an inflate loop that insists on the end mark of every member, because zlib's
 * gzread has been measured to accept truncated files silently. Anything after the last member or
 * frame is refused. Both are packed at level 1, at which gzip keeps up with the chain at 116 MB/s;
 * the bytes depend only on the content and on the version of the library. */
#pragma once

#include "base/diag.h"
#include "base/text.h"

enum packing { PACKING_NONE, PACKING_GZIP, PACKING_ZSTD };

/* "gzip" or "zstd". */
const char *packing_name(enum packing packing);

/* ".gz" or ".zst". */
const char *packing_ending(enum packing packing);

/* What the first bytes of a file, or the ending of its name (.gz, .zst), say. */
enum packing packing_of_bytes(const unsigned char *bytes, size_t length);
enum packing packing_of_name(const char *name);

/* True if these bytes are the beginning of what tells a packing, but not all of it. */
bool packing_may_begin(const unsigned char *bytes, size_t length);

/* The length of a name without the ending of its packing. */
size_t packing_plain_length(const char *name);

/* Refuses a packing without its library (DIAG_USAGE). The functions below expect one with it. */
int packing_check(enum packing packing, struct diag *diag);

struct unpacker;

struct unpacker *packing_unpack_begin(enum packing packing);
void packing_unpack_end(struct unpacker *unpacker); /* NULL: nothing */

/* Unpacks bytes from *from on, of which there are *given, and moves both on; returns how many bytes
 * it made, at most size. Bytes before damage are made first. */
size_t packing_unpack_take(struct unpacker *unpacker, const unsigned char **from, size_t *given,
                           char *bytes, size_t size);

/* What is damaged; NULL if nothing is. */
const char *packing_unpack_damage(const struct unpacker *unpacker);

/* True within a member or frame, whose end is still to come. */
bool packing_unpack_is_inside(const struct unpacker *unpacker);

struct packer;

struct packer *packing_pack_begin(enum packing packing);

/* Appends the packed bytes that are ready to a text, or, at the end, all of them. */
void packing_pack_add(struct packer *packer, const char *bytes, size_t length, bool end,
                      struct text *packed);
void packing_pack_end(struct packer *packer); /* NULL: nothing */
