#include "base/diag.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

int diag_fail(struct diag *diag, enum diag_code code, const char *format, ...)
{
    if (diag->code != DIAG_OK)
        return -1;
    diag->code = code;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(diag->text, sizeof diag->text, format, arguments);
    va_end(arguments);
    return -1;
}

void diag_note(struct diag *diag, const char *format, ...)
{
    if (diag->text[0] != '\0')
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(diag->text, sizeof diag->text, format, arguments);
    va_end(arguments);
}

enum diag_code diag_code_by_errno(enum diag_code otherwise)
{
    return errno == ENOMEM || errno == EMFILE || errno == ENFILE ? DIAG_MEMORY : otherwise;
}

void diag_print(const char *program, const struct diag *diag)
{
    char line[4 * sizeof diag->text + 2];
    size_t length = 0;
    const unsigned char *at = (const unsigned char *)diag->text;
    for (; *at != '\0'; at++) {
        bool wide = at[0] == 0xc2 && at[1] >= 0x80 && at[1] < 0xa0; /* U+0080 to U+009F */
        at += wide;
        if (wide || *at < 0x20 || *at == 0x7f)
            length +=
                (size_t)snprintf(line + length, sizeof line - length, "\\x%02x", (unsigned)*at);
        else
            line[length++] = (char)*at;
    }
    fprintf(stderr, "%s: %.*s\n", program, (int)length, line);
}

int diag_prefix(struct diag *diag, const char *format, ...)
{
    char whole[sizeof diag->text];
    va_list arguments;
    va_start(arguments, format);
    int used = vsnprintf(whole, sizeof whole, format, arguments);
    va_end(arguments);
    if (used < 0 || (size_t)used >= sizeof whole)
        return -1;
    snprintf(whole + used, sizeof whole - (size_t)used, "%s", diag->text);
    memcpy(diag->text, whole, sizeof whole);
    return -1;
}
