#include "export/mcap.h"
/* needs: zlib */
#include <zlib.h>

enum opcode {
    HEADER = 1,
    FOOTER,
    SCHEMA,
    CHANNEL,
    MESSAGE,
    CHUNK,
    MESSAGE_INDEX,
    CHUNK_INDEX,
    STATISTICS = 0x0B,
    METADATA,
    METADATA_INDEX,
    SUMMARY_OFFSET,
    DATA_END,
};

enum { CHUNK_SIZE = 1 << 20 };

static const char magic[] = "\x89MCAP0\r\n";

/* ---- records ---- */

/* A number of so many bytes; it is the length of bytes that follow it, unless they are NULL. */
struct part {
    uint64_t number;
    size_t size;
    const char *bytes;
};

#define U16(number)                                                                                \
    {                                                                                              \
        (number), 2, NULL                                                                          \
    }
#define U32(number)                                                                                \
    {                                                                                              \
        (number), 4, NULL                                                                          \
    }
#define U64(number)                                                                                \
    {                                                                                              \
        (number), 8, NULL                                                                          \
    }
#define WORD(word)                                                                                 \
    {                                                                                              \
        strlen(word), 4, (word)                                                                    \
    }
#define ARRAY(text)                                                                                \
    {                                                                                              \
        (text).length, 4, (text).bytes                                                             \
    }
#define BYTES(size, bytes, length)                                                                 \
    {                                                                                              \
        (length), (size), (bytes)                                                                  \
    }
#define RECORD(text, opcode, ...)                                                                  \
    add_record(text, opcode, (const struct part[]){__VA_ARGS__},                                   \
               sizeof((const struct part[]){__VA_ARGS__}) / sizeof(struct part))

/* Numbers have their lowest byte first. */
static void add_parts(struct text *text, const struct part *parts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char bytes[8];
        text_put_word(bytes, parts[i].number);
        text_add(text, bytes, parts[i].size);
        if (parts[i].bytes != NULL)
            text_add(text, parts[i].bytes, parts[i].number);
    }
}

static void add_record(struct text *text, enum opcode opcode, const struct part *parts,
                       size_t count)
{
    add_parts(text, (const struct part[]){{opcode, 1, NULL}, U64(0)}, 2);
    size_t begin = text->length;
    add_parts(text, parts, count);
    text_put_word(text->bytes + begin - 8, text->length - begin);
}

static uint64_t place(const struct mcap *mcap)
{
    return mcap->sent + mcap->out.length;
}

static uint32_t crc_of(uint32_t crc, const char *bytes, size_t length)
{
    return (uint32_t)crc32_z(crc, (const unsigned char *)bytes, length);
}

/* ---- the data ---- */

static struct text map_of(const char *const *pairs)
{
    struct text map = {0};
    for (; *pairs != NULL; pairs++)
        add_parts(&map, (const struct part[]){WORD(*pairs)}, 1);
    return map;
}

void mcap_begin(struct mcap *mcap, const char *name, const char *const *pairs)
{
    struct text map = map_of(pairs);
    text_add(&mcap->out, magic, sizeof magic - 1);
    RECORD(&mcap->out, HEADER, WORD(""), WORD("glint"));
    uint64_t from = place(mcap);
    RECORD(&mcap->out, METADATA, WORD(name), ARRAY(map));
    RECORD(&mcap->metadata.records, METADATA_INDEX, U64(from), U64(place(mcap) - from), WORD(name));
    mcap->metadata.count++;
    text_free(&map);
}

/* Copies the record that was added to the group at this place. */
static uint16_t share(struct mcap *mcap, struct mcap_group *group, size_t from)
{
    text_add(&mcap->out, group->records.bytes + from, group->records.length - from);
    return (uint16_t)++group->count;
}

uint16_t mcap_add_schema(struct mcap *mcap, const char *name, const char *encoding,
                         const char *data, size_t length)
{
    struct mcap_group *schemas = &mcap->schemas;
    size_t from = schemas->records.length;
    RECORD(&schemas->records, SCHEMA, U16(schemas->count + 1), WORD(name), WORD(encoding),
           BYTES(4, data, length));
    return share(mcap, schemas, from);
}

uint16_t mcap_add_channel(struct mcap *mcap, uint16_t schema, const char *topic,
                          const char *encoding, const char *const *pairs)
{
    struct mcap_group *channels = &mcap->channels;
    struct text map = map_of(pairs);
    size_t from = channels->records.length;
    RECORD(&channels->records, CHANNEL, U16(channels->count + 1), U16(schema), WORD(topic),
           WORD(encoding), ARRAY(map));
    text_free(&map);
    *list_add(&mcap->list, mcap->arena) = (struct mcap_channel){0};
    return share(mcap, channels, from);
}

/* Writes the indexes of the chunk that begins there: its messages by channel, and one for the
 * summary. */
static void index_chunk(struct mcap *mcap, uint64_t from)
{
    uint64_t end = place(mcap);
    struct text map = {0};
    for (size_t i = 0; i < mcap->list.count; i++) {
        struct text *index = &mcap->list.items[i].index;
        if (index->length == 0)
            continue;
        add_parts(&map, (const struct part[]){U16(i + 1), U64(place(mcap))}, 2);
        RECORD(&mcap->out, MESSAGE_INDEX, U16(i + 1), ARRAY(*index));
        index->length = 0;
    }
    RECORD(&mcap->chunks.records, CHUNK_INDEX, U64(mcap->first_ns), U64(mcap->last_ns), U64(from),
           U64(end - from), ARRAY(map), U64(place(mcap) - end), WORD(""), U64(mcap->chunk.length),
           U64(mcap->chunk.length));
    text_free(&map);
}

static void end_chunk(struct mcap *mcap)
{
    const struct text *chunk = &mcap->chunk;
    uint64_t from = place(mcap);
    if (chunk->length == 0)
        return;
    RECORD(&mcap->out, CHUNK, U64(mcap->first_ns), U64(mcap->last_ns), U64(chunk->length),
           U32(crc_of(0, chunk->bytes, chunk->length)), WORD(""),
           BYTES(8, chunk->bytes, chunk->length));
    index_chunk(mcap, from);
    mcap->chunks.count++;
    mcap->chunk.length = 0;
    mcap->begun = false;
}

void mcap_add_message(struct mcap *mcap, uint16_t channel, uint64_t time_ns, const char *data,
                      size_t length)
{
    struct mcap_channel *own = &mcap->list.items[channel - 1];
    if (mcap->messages++ == 0)
        mcap->begin_ns = time_ns;
    if (!mcap->begun)
        mcap->first_ns = time_ns;
    mcap->begun = true;
    mcap->last_ns = time_ns;
    own->messages++;
    add_parts(&own->index, (const struct part[]){U64(time_ns), U64(mcap->chunk.length)}, 2);
    RECORD(&mcap->chunk, MESSAGE, U16(channel), U32(0), U64(time_ns), U64(time_ns),
           BYTES(0, data, length));
    if (mcap->chunk.length >= CHUNK_SIZE)
        end_chunk(mcap);
}

void mcap_sent(struct mcap *mcap)
{
    mcap->crc = crc_of(mcap->crc, mcap->out.bytes, mcap->out.length);
    mcap->sent += mcap->out.length;
    mcap->out.length = 0;
}

/* ---- the summary ---- */

static struct text statistics(const struct mcap *mcap)
{
    struct text record = {0}, map = {0};
    for (size_t i = 0; i < mcap->list.count; i++)
        add_parts(&map, (const struct part[]){U16(i + 1), U64(mcap->list.items[i].messages)}, 2);
    RECORD(&record, STATISTICS, U64(mcap->messages), U16(mcap->schemas.count),
           U32(mcap->channels.count), U32(0), U32(mcap->metadata.count), U32(mcap->chunks.count),
           U64(mcap->begin_ns), U64(mcap->last_ns), ARRAY(map));
    text_free(&map);
    return record;
}

static void add_group(struct mcap *mcap, const struct text *records, struct text *offsets)
{
    if (records->length > 0)
        RECORD(offsets, SUMMARY_OFFSET, {(uint8_t)*records->bytes, 1, NULL}, U64(place(mcap)),
               U64(records->length));
    text_add(&mcap->out, records->bytes, records->length);
}

void mcap_end(struct mcap *mcap)
{
    struct text *out = &mcap->out, offsets = {0};
    end_chunk(mcap);
    RECORD(out, DATA_END, U32(crc_of(mcap->crc, out->bytes, out->length)));
    struct text counts = statistics(mcap);
    const struct text *groups[] = {&mcap->schemas.records, &mcap->channels.records, &counts,
                                   &mcap->chunks.records, &mcap->metadata.records};
    size_t begin = out->length;
    uint64_t summary = place(mcap);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        add_group(mcap, groups[i], &offsets);
    uint64_t places = place(mcap);
    text_add(out, offsets.bytes, offsets.length);
    RECORD(out, FOOTER, U64(summary), U64(places), U32(0));
    out->length -= 4; /* the checksum of the summary, up to itself */
    add_parts(out, (const struct part[]){U32(crc_of(0, out->bytes + begin, out->length - begin))},
              1);
    text_add(out, magic, sizeof magic - 1);
    text_free(&counts);
    text_free(&offsets);
}

void mcap_free(struct mcap *mcap)
{
    struct text *texts[] = {&mcap->schemas.records, &mcap->channels.records,
                            &mcap->chunks.records,  &mcap->metadata.records,
                            &mcap->chunk,           &mcap->out};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        text_free(texts[i]);
    for (size_t i = 0; i < mcap->list.count; i++)
        text_free(&mcap->list.items[i].index);
}
