/* A growing piece of text. A zeroed one is empty; text_free gives its memory back. */
#ifndef TEXT_H
#define TEXT_H

#include <stddef.h>

struct text {
    char *bytes;
    size_t length, room;
};

/* Where the next size bytes may be written; the caller adds what it wrote to length. */
char *text_room(struct text *text, size_t size);

void text_add(struct text *text, const char *bytes, size_t length);
void text_add_word(struct text *text, const char *word);
void text_format(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The length of the UTF-8 sequence that begins at bytes, at most room bytes; 0 if there is none
 * (cut short, overlong, a surrogate, beyond U+10FFFF). */
size_t text_utf8(const char *bytes, size_t room);

/* A JSON string with its quotes and escapes; length bytes of valid UTF-8. */
void text_add_json(struct text *text, const char *bytes, size_t length);

void text_free(struct text *text);

#endif
