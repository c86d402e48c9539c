#include "text.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

char *text_room(struct text *text, size_t size)
{
    if (text->room - text->length < size) {
        text->room = 2 * text->room + size + 4096;
        text->bytes = memory_resize(text->bytes, text->room);
    }
    return text->bytes + text->length;
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

size_t text_utf8(const char *bytes, size_t room)
{
    const unsigned char *text = (const unsigned char *)bytes;
    if (room == 0)
        return 0;
    size_t length = text[0] < 0x80   ? 1
                    : text[0] < 0xc2 ? 0
                    : text[0] < 0xe0 ? 2
                    : text[0] < 0xf0 ? 3
                    : text[0] < 0xf5 ? 4
                                     : 0;
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

void text_add_json(struct text *text, const char *bytes, size_t length)
{
    text_add(text, "\"", 1);
    for (size_t i = 0, plain = 0; i <= length; i++) {
        bool special =
            i == length || (unsigned char)bytes[i] < 0x20 || bytes[i] == '"' || bytes[i] == '\\';
        if (!special)
            continue;
        text_add(text, bytes + plain, i - plain);
        plain = i + 1;
        if (i < length && (unsigned char)bytes[i] >= 0x20)
            text_format(text, "\\%c", bytes[i]);
        else if (i < length)
            text_format(text, "\\u%04x", (unsigned)bytes[i]);
    }
    text_add(text, "\"", 1);
}

void text_free(struct text *text)
{
    free(text->bytes);
    *text = (struct text){0};
}
