#include "text/file_format.h"

#include <string.h>

static const struct file_format formats[] = {
#define FORMAT(kind, begins, one, other, name, use) {kind, name, use, begins, {one, other}},
#include "text/file_format.def"
};

/* Skips the length before a message of OSI, and blanks and a byte order mark before a text. */
static size_t begin_of(const char *bytes, size_t length)
{
    enum { LENGTH = 4 };
    size_t begin = 0;
    if (length > LENGTH && bytes[LENGTH - 1] == '\0')
        return LENGTH;
    while (begin < length && bytes[begin] != '\0' && strchr(" \t\r\n\xef\xbb\xbf", bytes[begin]))
        begin++;
    return begin;
}

static bool has(const char *bytes, size_t length, const char *word)
{
    size_t room = word != NULL ? strlen(word) : 0;
    for (size_t at = 0; at + room <= length; at++)
        if (room == 0 || memcmp(bytes + at, word, room) == 0)
            return true;
    return false;
}

const struct file_format *file_format_of(const char *bytes, size_t length)
{
    size_t begin = begin_of(bytes, length);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const struct file_format *format = &formats[i];
        size_t sign = strlen(format->begins);
        size_t at = (unsigned char)format->begins[0] < 0x80 ? begin : 0;
        if (length - at >= sign && memcmp(bytes + at, format->begins, sign) == 0 &&
            has(bytes, length, format->has[0]) && has(bytes, length, format->has[1]))
            return format;
    }
    return NULL;
}

bool file_format_explain(const char *kind, const char *bytes, size_t length, struct diag *diag)
{
    enum { ENOUGH = 4096 };
    const struct file_format *format = file_format_of(bytes, length < ENOUGH ? length : ENOUGH);
    bool own = format != NULL && format->kind != NULL && strcmp(format->kind, kind) == 0;
    enum diag_code code = diag->code;
    bool refused = code == DIAG_USAGE || code == DIAG_DATA || code == DIAG_CONFIG;
    if (format == NULL || own || !refused)
        return false;
    *diag = (struct diag){0};
    diag_fail(diag, code, "%s; %s", format->name, format->use);
    return true;
}
