/* Growing text, JSON strings, and eight bytes as a number.
 *
 * A zeroed text is empty; text_free gives its memory back. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

struct text {
    char *bytes;
    size_t length, room;
};

/* Moves the text to where there is room for size more bytes. */
void text_grow(struct text *text, size_t size);

/* Room for the next size bytes; the caller writes there and adds to length. */
static inline char *text_room(struct text *text, size_t size)
{
    if (text->room - text->length < size)
        text_grow(text, size);
    return text->bytes + text->length;
}

void text_add(struct text *text, const char *bytes, size_t length);
void text_add_word(struct text *text, const char *word);
void text_format(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* True if the length bytes at text are this word. */
static inline bool text_is(const char *text, size_t length, const char *word)
{
    return length > 0 && *text == *word && strlen(word) == length &&
           memcmp(text, word, length) == 0;
}

/* The length of the UTF-8 sequence that begins at bytes, at most room bytes; 0 if there is none
 * (cut short, overlong, a surrogate, beyond U+10FFFF). */
size_t text_utf8(const char *bytes, size_t room);

/* A JSON string with its quotes and escapes; length bytes of valid UTF-8. */
void text_add_json(struct text *text, const char *bytes, size_t length);

/* Writes the same string at a place with room for text_json_size(length) bytes; returns its end. */
char *text_put_json(char *at, const char *bytes, size_t length);
size_t text_json_size(size_t length);

/* Bytes in base64; size is a multiple of 3. */
void text_add_base64(struct text *text, const unsigned char *bytes, size_t size);

/* Four or eight bytes as a number, the first one lowest, on every machine. */
static inline uint64_t text_half_word(const char *bytes)
{
    const unsigned char *byte = (const unsigned char *)bytes;
    return (uint64_t)byte[0] | (uint64_t)byte[1] << 8 | (uint64_t)byte[2] << 16 |
           (uint64_t)byte[3] << 24;
}

static inline uint64_t text_word(const char *bytes)
{
    const unsigned char *byte = (const unsigned char *)bytes;
    return (uint64_t)byte[0] | (uint64_t)byte[1] << 8 | (uint64_t)byte[2] << 16 |
           (uint64_t)byte[3] << 24 | (uint64_t)byte[4] << 32 | (uint64_t)byte[5] << 40 |
           (uint64_t)byte[6] << 48 | (uint64_t)byte[7] << 56;
}

/* Writes eight bytes, the lowest of the number first. */
static inline void text_put_word(char *bytes, uint64_t word)
{
    bytes[0] = (char)word;
    bytes[1] = (char)(word >> 8);
    bytes[2] = (char)(word >> 16);
    bytes[3] = (char)(word >> 24);
    bytes[4] = (char)(word >> 32);
    bytes[5] = (char)(word >> 40);
    bytes[6] = (char)(word >> 48);
    bytes[7] = (char)(word >> 56);
}

/* Up to eight bytes as a number, the first one lowest; zeros above them. */
static inline uint64_t text_short_word(const char *bytes, size_t length)
{
    if (length == 8)
        return text_word(bytes);
    if (length >= 4)
        return text_half_word(bytes) | text_half_word(bytes + length - 4) << 8 * (length - 4);
    if (length == 0)
        return 0;
    const unsigned char *byte = (const unsigned char *)bytes;
    return (uint64_t)byte[0] | (uint64_t)byte[length / 2] << 8 * (length / 2) |
           (uint64_t)byte[length - 1] << 8 * (length - 1);
}

/* The lowest bit set is the high bit of the first byte that is not plain (text_plain); higher bits
 * mean nothing. 0 if all eight bytes are plain. */
static inline uint64_t text_not_plain(uint64_t word)
{
    const uint64_t ones = UINT64_C(0x0101010101010101);
    uint64_t beyond = word | (word + ones), control = word - 0x20 * ones;
    uint64_t quote = (word ^ '"' * ones) - ones, backslash = (word ^ '\\' * ones) - ones;
    return (beyond | control | quote | backslash) & 0x80 * ones;
}

/* The number of plain bytes before the first other one, at most length. Plain is printable ASCII
 * but '"' and '\\': bytes that stand for themselves in names and in JSON strings. */
static inline size_t text_plain(const char *bytes, size_t length)
{
    for (size_t i = 0;; i += 8) {
        size_t rest = length - i;
        uint64_t word = rest >= 8 ? text_word(bytes + i) : text_short_word(bytes + i, rest);
        uint64_t stops = text_not_plain(word);
        if (stops != 0)
            return i + (size_t)__builtin_ctzll(stops) / 8;
        if (rest == 8)
            return length;
    }
}

void text_free(struct text *text);
