#include "mcap_file.h"
#include <zlib.h>

enum { HEADER = 1, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX };
enum { STATISTICS = 11, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END };
enum { CHUNK_SIZE = 1 << 20 };

static const char magic[] = "\x89MCAP0\r\n";

/* A number of so many bytes, lowest first; the length of the bytes behind it, if not NULL. */
struct part {
    uint64_t number;
    size_t size;
    const char *bytes;
};

#define U8(number) ((struct part){(uint8_t)(number), 1, NULL})
#define U16(number) ((struct part){(number), 2, NULL})
#define U32(number) ((struct part){(number), 4, NULL})
#define U64(number) ((struct part){(number), 8, NULL})
#define WORD(word) ((struct part){strlen(word), 4, (word)})
#define TEXT(size, text) ((struct part){(text).length, (size), (text).bytes})
#define ADD(text, ...)                                                                             \
    add_parts(text, (const struct part[]){__VA_ARGS__},                                            \
              sizeof((struct part[]){__VA_ARGS__}) / sizeof(struct part))
/* A record is its opcode, the length of its content, and the content. */
#define RECORD(text, opcode, ...)                                                                  \
    do {                                                                                           \
        ADD(text, U8(opcode), U64(0));                                                             \
        size_t begin_ = (text)->length;                                                            \
        ADD(text, __VA_ARGS__);                                                                    \
        text_put_word((text)->bytes + begin_ - 8, (text)->length - begin_);                        \
    } while (0)

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

static struct text map_of(const char *const *pairs)
{
    struct text map = {0};
    for (; *pairs != NULL; pairs++)
        ADD(&map, WORD(*pairs));
    return map;
}

static uint64_t place(const struct mcap_file *mcap)
{
    return mcap->sent + mcap->out.length;
}

static uint32_t crc_of(uint32_t crc, const char *bytes, size_t length)
{
    return (uint32_t)crc32_z(crc, (const unsigned char *)bytes, length);
}

void mcap_file_begin(struct mcap_file *mcap, const char *profile)
{
    text_add(&mcap->out, magic, sizeof magic - 1);
    RECORD(&mcap->out, HEADER, WORD(profile), WORD("glint"));
}

void mcap_file_add_metadata(struct mcap_file *mcap, const char *name, const char *const *pairs)
{
    struct text map = map_of(pairs);
    uint64_t begin = place(mcap);
    RECORD(&mcap->out, METADATA, WORD(name), TEXT(4, map));
    RECORD(&mcap->groups[MCAP_METADATA], METADATA_INDEX, U64(begin), U64(place(mcap) - begin),
           WORD(name));
    mcap->metadata++;
    text_free(&map);
}

/* Each channel has a schema of its own, of the same id. Both records stand in the data and in the
 * summary. */
uint16_t mcap_file_add_channel(struct mcap_file *mcap, const char *topic,
                               const struct mcap_schema *schema)
{
    struct text *groups = mcap->groups, map = map_of(schema->pairs);
    size_t from[] = {groups[MCAP_SCHEMAS].length, groups[MCAP_CHANNELS].length};
    *list_add(&mcap->channels, mcap->arena) = (struct mcap_channel){0};
    uint16_t id = (uint16_t)mcap->channels.count;
    RECORD(&groups[MCAP_SCHEMAS], SCHEMA, U16(id), WORD(schema->name), WORD(schema->encoding),
           {schema->size, 4, schema->data});
    RECORD(&groups[MCAP_CHANNELS], CHANNEL, U16(id), U16(id), WORD(topic),
           WORD(schema->message_encoding), TEXT(4, map));
    for (int i = MCAP_SCHEMAS; i <= MCAP_CHANNELS; i++)
        text_add(&mcap->out, groups[i].bytes + from[i], groups[i].length - from[i]);
    text_free(&map);
    return id;
}

/* Writes the chunk, the places of each channel's messages in it, and its own for the summary. */
static void end_chunk(struct mcap_file *mcap)
{
    struct text *out = &mcap->out, *chunk = &mcap->chunk;
    struct text indexes = {0};
    uint64_t begin = place(mcap);
    if (chunk->length == 0)
        return;
    RECORD(out, CHUNK, U64(mcap->first_ns), U64(mcap->last_ns), U64(chunk->length),
           U32(crc_of(0, chunk->bytes, chunk->length)), WORD(""), TEXT(8, *chunk));
    uint64_t end = place(mcap);
    for (size_t i = 0; i < mcap->channels.count; i++) {
        struct text *index = &mcap->channels.items[i].index;
        if (index->length == 0)
            continue;
        ADD(&indexes, U16(i + 1), U64(place(mcap)));
        RECORD(out, MESSAGE_INDEX, U16(i + 1), TEXT(4, *index));
        index->length = 0;
    }
    RECORD(&mcap->groups[MCAP_CHUNKS], CHUNK_INDEX, U64(mcap->first_ns), U64(mcap->last_ns),
           U64(begin), U64(end - begin), TEXT(4, indexes), U64(place(mcap) - end), WORD(""),
           U64(chunk->length), U64(chunk->length));
    mcap->chunks++;
    chunk->length = 0;
    text_free(&indexes);
}

void mcap_file_add_message(struct mcap_file *mcap, uint16_t channel, uint64_t time_ns,
                           const struct text *message)
{
    struct mcap_channel *own = &mcap->channels.items[channel - 1];
    if (mcap->messages++ == 0)
        mcap->begin_ns = time_ns;
    if (mcap->chunk.length == 0)
        mcap->first_ns = time_ns;
    mcap->last_ns = time_ns;
    own->messages++;
    ADD(&own->index, U64(time_ns), U64(mcap->chunk.length));
    RECORD(&mcap->chunk, MESSAGE, U16(channel), U32(0), U64(time_ns), U64(time_ns),
           TEXT(0, *message));
    if (mcap->chunk.length >= CHUNK_SIZE)
        end_chunk(mcap);
}

void mcap_file_sent(struct mcap_file *mcap)
{
    mcap->crc = crc_of(mcap->crc, mcap->out.bytes, mcap->out.length);
    mcap->sent += mcap->out.length;
    mcap->out.length = 0;
}

static void add_statistics(struct mcap_file *mcap)
{
    size_t channels = mcap->channels.count;
    struct text counts = {0};
    for (size_t i = 0; i < channels; i++)
        ADD(&counts, U16(i + 1), U64(mcap->channels.items[i].messages));
    RECORD(&mcap->groups[MCAP_STATISTICS], STATISTICS, U64(mcap->messages), U16(channels),
           U32(channels), U32(0), U32(mcap->metadata), U32(mcap->chunks), U64(mcap->begin_ns),
           U64(mcap->last_ns), TEXT(4, counts));
    text_free(&counts);
}

void mcap_file_end(struct mcap_file *mcap)
{
    struct text *out = &mcap->out, offsets = {0};
    end_chunk(mcap);
    uint32_t crc = crc_of(mcap->crc, out->bytes, out->length);
    RECORD(out, DATA_END, U32(crc));
    size_t begin = out->length;
    uint64_t summary = place(mcap);
    add_statistics(mcap);
    for (int i = 0; i < MCAP_GROUPS; i++) {
        const struct text *group = &mcap->groups[i];
        if (group->length == 0)
            continue;
        RECORD(&offsets, SUMMARY_OFFSET, U8(*group->bytes), U64(place(mcap)), U64(group->length));
        text_add(out, group->bytes, group->length);
    }
    uint64_t places = place(mcap);
    text_add(out, offsets.bytes, offsets.length);
    RECORD(out, FOOTER, U64(summary), U64(places), U32(0));
    out->length -= 4; /* for the checksum of what stands before it */
    ADD(out, U32(crc_of(0, out->bytes + begin, out->length - begin)));
    text_add(out, magic, sizeof magic - 1);
    text_free(&offsets);
}

void mcap_file_free(struct mcap_file *mcap)
{
    for (int i = 0; i < MCAP_GROUPS; i++)
        text_free(&mcap->groups[i]);
    for (size_t i = 0; i < mcap->channels.count; i++)
        text_free(&mcap->channels.items[i].index);
    text_free(&mcap->chunk);
    text_free(&mcap->out);
}
