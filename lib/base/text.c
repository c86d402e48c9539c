#include "base/text.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arena.h"

void text_grow(struct text *text, size_t size)
{
    text->room = 2 * text->room + size + 4096;
    text->bytes = memory_resize(text->bytes, text->room);
}

void text_add(struct text *text, const char *bytes, size_t length)
{
    memcpy(text_room(text, length + 1), bytes, length);
    text->length += length;
}

void text_add_word(struct text *text, const char *word)
{
    text_add(text, word, strlen(word));
}

void text_format(struct text *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0)
        return;
    va_start(arguments, format);
    vsnprintf(text_room(text, (size_t)length + 1), (size_t)length + 1, format, arguments);
    va_end(arguments);
    text->length += (size_t)length;
}

/* The length of a character of UTF-8 that begins with this byte; 0: none does. */
static size_t utf8_length(unsigned char first)
{
    if (first < 0x80)
        return 1;
    if (first < 0xc2 || first >= 0xf5)
        return 0;
    if (first < 0xe0)
        return 2;
    return first < 0xf0 ? 3 : 4;
}

size_t text_utf8(const char *bytes, size_t room)
{
    const unsigned char *text = (const unsigned char *)bytes;
    if (room == 0)
        return 0;
    size_t length = utf8_length(text[0]);
    if (length == 0 || length > room)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    bool surrogate = text[0] == 0xed && text[1] >= 0xa0;
    bool beyond = text[0] == 0xf4 && text[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

size_t text_json_size(size_t length)
{
    return 6 * length + 2 + sizeof(uint64_t);
}

static char *put_escaped(char *at, unsigned char byte)
{
    static const char digits[] = "0123456789abcdef";
    if (byte == '"' || byte == '\\')
        *at++ = '\\';
    if (byte >= 0x20) {
        *at++ = (char)byte;
        return at;
    }
    at[0] = '\\';
    at[1] = 'u';
    at[2] = at[3] = '0';
    at[4] = digits[byte >> 4];
    at[5] = digits[byte & 15];
    return at + 6;
}

/* Copies eight bytes at a time and counts the plain ones; the next bytes overwrite the others. */
char *text_put_json(char *at, const char *bytes, size_t length)
{
    *at++ = '"';
    for (size_t i = 0; i < length;) {
        size_t rest = length - i, taken = rest < 8 ? rest : 8;
        uint64_t word = text_short_word(bytes + i, taken), stops = text_not_plain(word);
        size_t plain = stops != 0 ? (size_t)__builtin_ctzll(stops) / 8 : 8;
        text_put_word(at, word);
        at += plain;
        i += plain;
        if (plain < taken)
            at = put_escaped(at, (unsigned char)bytes[i++]);
    }
    *at++ = '"';
    return at;
}

void text_add_json(struct text *text, const char *bytes, size_t length)
{
    const char *end = text_put_json(text_room(text, text_json_size(length)), bytes, length);
    text->length = (size_t)(end - text->bytes);
}

void text_add_base64(struct text *text, const unsigned char *bytes, size_t size)
{
    assert(size % 3 == 0);
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *out = text_room(text, size / 3 * 4);
    for (size_t i = 0; i < size; i += 3) {
        unsigned group = (unsigned)bytes[i] << 16 | (unsigned)bytes[i + 1] << 8 | bytes[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6)
            *out++ = digits[group >> shift & 63];
    }
    text->length += size / 3 * 4;
}

void text_free(struct text *text)
{
    free(text->bytes);
    *text = (struct text){0};
}
