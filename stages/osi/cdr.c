#include "cdr.h"

/* Pads to a multiple of the size, a power of two of at most 8, and adds the value's low bytes. */
static void add_bits(struct cdr *cdr, uint64_t bits, size_t size)
{
    enum { MOST = 8 };
    size_t length = cdr->text->length - cdr->begin, padding = -length & (size - 1);
    char *room = text_room(cdr->text, MOST + MOST);
    text_put_word(room, 0);
    text_put_word(room + padding, bits);
    cdr->text->length += padding + size;
}

struct cdr cdr_begin(struct text *text)
{
    text_add(text, "\0\1\0\0", 4); /* plain CDR, the lowest byte first */
    return (struct cdr){text, text->length};
}

void cdr_add_uint8(struct cdr *cdr, uint8_t value)
{
    add_bits(cdr, value, sizeof value);
}

void cdr_add_uint32(struct cdr *cdr, uint32_t value)
{
    add_bits(cdr, value, sizeof value);
}

void cdr_add_int32(struct cdr *cdr, int32_t value)
{
    add_bits(cdr, (uint32_t)value, sizeof value);
}

void cdr_add_float32(struct cdr *cdr, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_bits(cdr, bits, sizeof bits);
}

void cdr_add_float64(struct cdr *cdr, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_bits(cdr, bits, sizeof bits);
}

void cdr_add_string(struct cdr *cdr, const char *value)
{
    size_t size = strlen(value) + 1;
    cdr_add_uint32(cdr, (uint32_t)size);
    text_add(cdr->text, value, size);
}
