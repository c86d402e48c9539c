#include "text/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

size_t terminal_columns(int fd)
{
    struct winsize size;
    return isatty(fd) && ioctl(fd, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

static size_t characters(const char *bytes, size_t length)
{
    size_t count = 0;
    for (size_t i = 0; i < length; i++)
        count += ((unsigned char)bytes[i] & 0xc0) != 0x80;
    return count;
}

static bool is_comment(const char *line, size_t length)
{
    return length > 2 && memcmp(line, "# ", 2) == 0;
}

/* How far the rest of a broken line is indented: behind the mark of a comment, and farther if two
 * blanks in the line tell that it is of a table. */
static size_t indent_of(const char *line, size_t length)
{
    enum { MARK = 2, TABLE = 4 };
    size_t mark = is_comment(line, length) ? MARK : 0;
    for (size_t i = mark + 2; i < length; i++)
        if (line[i] != ' ' && line[i - 1] == ' ' && line[i - 2] == ' ')
            return mark + TABLE;
    return mark;
}

/* The length of the piece that goes on one line: up to the last blank behind `from` up to which it
 * fits the room, or else up to the first blank. */
static size_t piece_length(const char *line, size_t length, size_t from, size_t room)
{
    size_t piece = length;
    for (size_t i = from + 1; i < length; i++) {
        bool ends = line[i] == ' ' && line[i - 1] != ' ';
        if (ends && (piece == length || characters(line, i) <= room))
            piece = i;
    }
    return piece;
}

static void add_line(const char *line, size_t length, size_t columns, struct text *text)
{
    const char *mark = is_comment(line, length) ? "# " : "";
    size_t indent = indent_of(line, length), from = indent, room = columns;
    while (characters(line, length) > room) {
        size_t piece = piece_length(line, length, from, room);
        if (piece == length)
            break;
        text_add(text, line, piece);
        text_format(text, "\n%-*s", (int)indent, mark);
        while (piece < length && line[piece] == ' ')
            piece++;
        line += piece;
        length -= piece;
        from = 0;
        room = columns - indent;
    }
    text_add(text, line, length);
    text_add_word(text, "\n");
}

void terminal_fit(struct text *text, size_t columns)
{
    if (columns == 0)
        return;
    struct text fitted = {0};
    bool goes_on = false; /* the line before ends with a backslash */
    for (size_t at = 0, length; at < text->length; at += length + 1) {
        const char *line = text->bytes + at, *end = memchr(line, '\n', text->length - at);
        length = end != NULL ? (size_t)(end - line) : text->length - at;
        bool is_command = goes_on;
        goes_on = length > 0 && line[length - 1] == '\\';
        add_line(line, length, is_command || goes_on ? length : columns, &fitted);
    }
    text_free(text);
    *text = fitted;
}
