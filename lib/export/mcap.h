/* MCAP files: channels of messages in chunks, with checksums and an index.
 *
 * Bytes of the file gather in out, which the caller writes and then passes by (mcap_sent). Chunks
 * are not compressed. mcap.c needs zlib for checksums; it is linked with glint-mcap alone. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"
#include "base/text.h"

/* Records that the summary repeats, or that index the file. */
struct mcap_group {
    struct text records;
    uint32_t count;
};

struct mcap_channel {
    struct text index; /* of its messages in the open chunk */
    uint64_t messages;
};

/* Zeroed before the first call, but for the arena. */
struct mcap {
    struct arena *arena;
    struct text out;
    uint64_t sent; /* bytes of the file before out */
    uint32_t crc;  /* of those bytes */
    struct mcap_group schemas, channels, chunks, metadata;
    LIST_OF(struct mcap_channel) list; /* of channels, by id */
    struct text chunk;                 /* records of the open chunk */
    uint64_t first_ns, last_ns;        /* of its messages */
    bool begun;                        /* are there any? */
    uint64_t begin_ns, messages;       /* of the file */
};

/* Begins a file with metadata; keys and values take turns up to NULL. */
void mcap_begin(struct mcap *mcap, const char *name, const char *const *pairs);

/* Both return the id, which must fit into 16 bits. */
uint16_t mcap_add_schema(struct mcap *mcap, const char *name, const char *encoding,
                         const char *data, size_t length);
uint16_t mcap_add_channel(struct mcap *mcap, uint16_t schema, const char *topic,
                          const char *encoding, const char *const *pairs);

/* Times must not descend. */
void mcap_add_message(struct mcap *mcap, uint16_t channel, uint64_t time_ns, const char *data,
                      size_t length);

void mcap_end(struct mcap *mcap);

void mcap_sent(struct mcap *mcap);

void mcap_free(struct mcap *mcap);
