/* JSON tokens of one line, strictly by RFC 8259.
 *
 * It is strict also where libraries are lenient: UTF-8 must be valid, surrogates paired, and \u0000
 * is refused, since names are C strings. Every function moves the cursor past the token that it
 * read, or leaves a message without a path. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"
#include "base/diag.h"

struct json_scan {
    const char *at, *end;
    struct arena *arena;
    struct diag *diag;
};

enum { JSON_SCAN_DEPTH = 1000 };

/* A decoded string: in the line itself, or in the arena if it had escapes. Not NUL-terminated. */
struct json_string {
    const char *text;
    size_t length;
};

/* The next character that is not white space, or '\0' at the end of the line. */
static inline char json_scan_peek(struct json_scan *scan)
{
    const char *at = scan->at, *end = scan->end;
    if (at<end && * at> ' ')
        return *at;
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r'))
        at++;
    scan->at = at;
    return at < end ? *at : '\0';
}

/* Moves past the next character and returns true if it is this one, which is not '\0'. */
static inline bool json_scan_take(struct json_scan *scan, char character)
{
    bool is_here = scan->at < scan->end && *scan->at == character;
    if (!is_here && json_scan_peek(scan) != character)
        return false;
    scan->at++;
    return true;
}

/* Refuses the character at the cursor with "... where WHAT is expected". */
int json_scan_unexpected(struct json_scan *scan, const char *what);

int json_scan_string(struct json_scan *scan, struct json_string *string);
int json_scan_number(struct json_scan *scan, double *value);
int json_scan_flag(struct json_scan *scan, bool *value);

/* Reads any value, checked but not decoded: bytes from its first to its last character. */
int json_scan_value(struct json_scan *scan, struct json_string *bytes);

/* Moves past an array without reading it; false, and nowhere, if its end cannot be told. It can
 * where no array lies within, and `]` stands before the next key or before the end of the line. A
 * `]` in a string is not taken for it: no letter follows the quote that ends a string, as one
 * follows the quote that begins a key. What lies in the array is not checked. */
bool json_scan_skip_flat(struct json_scan *scan);

/* The kind of the next value, for messages: "a string", "null", ... */
const char *json_scan_kind(struct json_scan *scan);
