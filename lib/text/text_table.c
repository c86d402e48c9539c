#include "text/text_table.h"

#include <stdlib.h>

/* Widens the columns for the cells of this line; gives the next line. */
static const char *widen(int *width, const char *at)
{
    for (;; width += width[1] != 0) {
        int length = (int)strcspn(at, "\t\n");
        if (length > abs(*width))
            *width = *width < 0 ? -length : length;
        at += length + 1;
        if (at[-1] == '\n')
            return at;
    }
}

/* Writes this line; gives the next one. */
static const char *write_line(const int *width, const char *at, struct text *text)
{
    for (;; width += width[1] != 0) {
        int length = (int)strcspn(at, "\t\n");
        text_format(text, "%*.*s", *width, length, at);
        at += length + 1;
        if (at[-1] == '\n')
            break;
        text_add_word(text, "  ");
    }
    while (text->length > 0 && text->bytes[text->length - 1] == ' ')
        text->length--;
    text_add_word(text, "\n");
    return at;
}

void text_table_write(struct text *rows, int *widths, const char *mark, struct text *text)
{
    text_add(rows, "", 1);
    for (const char *at = rows->bytes; *at != '\0';)
        at = widen(widths, at);
    for (const char *at = rows->bytes; *at != '\0';) {
        text_add_word(text, mark);
        at = write_line(widths, at, text);
    }
    text_free(rows);
}
