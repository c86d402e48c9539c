/* MCAP files: messages in chunks, checksums and an index.
 *
 * Bytes of the file gather in out; the caller writes them and tells so by mcap_file_sent. Chunks
 * are not compressed; zlib computes checksums. */
#pragma once

#include "base/arena.h"
#include "base/text.h"

/* Records of the summary, in its order. */
enum mcap_group {
    MCAP_SCHEMAS,
    MCAP_CHANNELS,
    MCAP_STATISTICS,
    MCAP_CHUNKS,
    MCAP_METADATA,
    MCAP_GROUPS
};

struct mcap_channel {
    struct text index; /* of its messages in the open chunk */
    uint64_t messages;
};

/* What the messages of a channel are. */
struct mcap_schema {
    const char *name, *encoding, *message_encoding;
    const char *data;
    size_t size;
    const char *const *pairs; /* metadata: keys and values take turns, up to NULL */
};

/* Zeroed before the first call, but for the arena. */
struct mcap_file {
    struct arena *arena;
    struct text out;
    uint64_t sent; /* bytes of the file before out */
    uint32_t crc;  /* of those bytes */
    struct text groups[MCAP_GROUPS];
    uint32_t metadata, chunks;
    LIST_OF(struct mcap_channel) channels; /* by id, from 1 on */
    struct text chunk;                     /* records of the open chunk */
    uint64_t begin_ns, first_ns, last_ns;  /* first message of file and chunk; latest message */
    uint64_t messages;
};

/* Begins a file of a profile, which may be "". */
void mcap_file_begin(struct mcap_file *mcap, const char *profile);

/* Adds metadata, pairs as in a schema. */
void mcap_file_add_metadata(struct mcap_file *mcap, const char *name, const char *const *pairs);

/* Returns the id of a new channel, which must not exceed 65,535. */
uint16_t mcap_file_add_channel(struct mcap_file *mcap, const char *topic,
                               const struct mcap_schema *schema);

/* Times must not descend. */
void mcap_file_add_message(struct mcap_file *mcap, uint16_t channel, uint64_t time_ns,
                           const struct text *message);

void mcap_file_end(struct mcap_file *mcap);

void mcap_file_sent(struct mcap_file *mcap);

void mcap_file_free(struct mcap_file *mcap);
