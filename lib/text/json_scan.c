#include "text/json_scan.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/text.h"

int json_scan_unexpected(struct json_scan *scan, const char *what)
{
    if (json_scan_peek(scan) == '\0' && scan->at == scan->end)
        return diag_fail(scan->diag, DIAG_DATA, "the line ends where %s is expected", what);
    unsigned char byte = (unsigned char)*scan->at;
    if (byte < 0x20 || byte >= 0x7f)
        return diag_fail(scan->diag, DIAG_DATA, "byte 0x%02x where %s is expected", byte, what);
    return diag_fail(scan->diag, DIAG_DATA, "'%c' where %s is expected", byte, what);
}

static size_t utf8_write(uint32_t code, char *out)
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t length = 4;
    if (code < 0x800)
        length = 2;
    else if (code < 0x10000)
        length = 3;
    static const unsigned char lead[] = {0, 0, 0xc0, 0xe0, 0xf0};
    for (size_t i = length - 1; i > 0; i--, code >>= 6)
        out[i] = (char)(0x80 | (code & 0x3f));
    out[0] = (char)(lead[length] | code);
    return length;
}

/* The number of four hexadecimal digits; -1 if they are not there. */
static int32_t hex4(const char *at, const char *end)
{
    char digits[] = "....";
    if (end - at >= 4)
        memcpy(digits, at, 4);
    bool good = strspn(digits, "0123456789abcdefABCDEF") == 4;
    return good ? (int32_t)strtol(digits, NULL, 16) : -1;
}

/* Decodes the escape after the backslash at *at and moves *at past it; returns the number of bytes,
 * 0 if it is not an escape. */
static size_t unescape(const char **at, const char *end, char *out)
{
    static const char names[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    if (*at == end)
        return 0;
    char escape = *(*at)++;
    const char *simple = escape != '\0' ? strchr(names, escape) : NULL;
    if (simple != NULL) {
        *out = meanings[simple - names];
        return 1;
    }
    int32_t code = escape == 'u' ? hex4(*at, end) : -1;
    if (code <= 0 || (code >= 0xdc00 && code < 0xe000))
        return 0;
    *at += 4;
    if (code < 0xd800 || code >= 0xe000)
        return utf8_write((uint32_t)code, out);
    int32_t low = end - *at >= 6 && (*at)[0] == '\\' && (*at)[1] == 'u' ? hex4(*at + 2, end) : -1;
    if (low < 0xdc00 || low >= 0xe000)
        return 0;
    *at += 6;
    return utf8_write(0x10000 + ((uint32_t)(code - 0xd800) << 10) + (uint32_t)(low - 0xdc00), out);
}

/* Moves past the closing quote and counts the escapes. */
static int skip_string(struct json_scan *scan, size_t *escapes)
{
    *escapes = 0;
    for (;;) {
        scan->at += text_plain(scan->at, (size_t)(scan->end - scan->at));
        if (scan->at == scan->end || *scan->at == '"')
            break;
        unsigned char byte = (unsigned char)*scan->at;
        if (byte < 0x20)
            return diag_fail(scan->diag, DIAG_DATA, "control character 0x%02x in a string", byte);
        if (byte == '\\') {
            char decoded[4];
            scan->at++;
            ++*escapes;
            if (unescape(&scan->at, scan->end, decoded) == 0)
                return diag_fail(scan->diag, DIAG_DATA, "a bad escape in a string");
            continue;
        }
        size_t length = text_utf8(scan->at, (size_t)(scan->end - scan->at));
        if (length == 0)
            return diag_fail(scan->diag, DIAG_DATA, "byte 0x%02x in a string is not UTF-8", byte);
        scan->at += length;
    }
    if (scan->at == scan->end)
        return diag_fail(scan->diag, DIAG_DATA, "the line ends inside a string");
    scan->at++;
    return 0;
}

/* Decodes in a copy of the same size: no escape is shorter than its meaning. */
static void decode(struct json_scan *scan, struct json_string *string)
{
    char *decoded = arena_get(scan->arena, string->length);
    size_t length = 0;
    for (const char *at = string->text, *end = at + string->length; at < end;) {
        if (*at == '\\') {
            at++;
            length += unescape(&at, end, decoded + length);
        } else {
            decoded[length++] = *at++;
        }
    }
    string->text = decoded;
    string->length = length;
}

int json_scan_string(struct json_scan *scan, struct json_string *string)
{
    if (!json_scan_take(scan, '"'))
        return json_scan_unexpected(scan, "a string");
    const char *begin = scan->at;
    size_t plain = text_plain(begin, (size_t)(scan->end - begin));
    if (begin + plain < scan->end && begin[plain] == '"') {
        *string = (struct json_string){begin, plain};
        scan->at += plain + 1;
        return 0;
    }
    size_t escapes;
    if (skip_string(scan, &escapes) != 0)
        return -1;
    *string = (struct json_string){begin, (size_t)(scan->at - 1 - begin)};
    if (escapes > 0)
        decode(scan, string);
    return 0;
}

/* Moves *at past digits; returns how many there were. */
static long skip_digits(const char **at, const char *end)
{
    const char *begin = *at;
    while (*at < end && **at >= '0' && **at <= '9')
        ++*at;
    return *at - begin;
}

/* The end of the JSON number that begins at the cursor, or NULL. */
static const char *number_end(const struct json_scan *scan)
{
    const char *at = scan->at, *end = scan->end;
    at += at < end && *at == '-';
    bool zero = at < end && *at == '0';
    long digits = skip_digits(&at, end);
    bool good = digits == 1 || (digits > 1 && !zero);
    if (at < end && *at == '.') {
        at++;
        good = skip_digits(&at, end) > 0 && good;
    }
    if (at < end && (*at == 'e' || *at == 'E')) {
        at++;
        at += at < end && (*at == '+' || *at == '-');
        good = skip_digits(&at, end) > 0 && good;
    }
    return good ? at : NULL;
}

static int scan_long_number(struct json_scan *scan, double *value)
{
    const char *end = number_end(scan);
    if (end == NULL)
        return json_scan_unexpected(scan, "a number");
    if (!number_read(scan->at, end, value)) {
        int length = (int)(end - scan->at < 40 ? end - scan->at : 40);
        return diag_fail(scan->diag, DIAG_DATA, "%.*s is too large for a double", length, scan->at);
    }
    scan->at = end;
    return 0;
}

int json_scan_number(struct json_scan *scan, double *value)
{
    json_scan_peek(scan);
    const char *end = number_take(scan->at, scan->end, value);
    if (end == NULL)
        return scan_long_number(scan, value);
    scan->at = end;
    return 0;
}

static bool take_word(struct json_scan *scan, const char *word)
{
    size_t length = strlen(word);
    json_scan_peek(scan);
    if ((size_t)(scan->end - scan->at) < length || memcmp(scan->at, word, length) != 0)
        return false;
    scan->at += length;
    return true;
}

int json_scan_flag(struct json_scan *scan, bool *value)
{
    *value = take_word(scan, "true");
    return *value || take_word(scan, "false") ? 0 : json_scan_unexpected(scan, "true or false");
}

static bool ends_member(const char *at, const char *end)
{
    if (end - at >= 3 && at[0] == ',' && at[1] == '"')
        return at[2] >= 'a' && at[2] <= 'z';
    return end - at == 1 && at[0] == '}';
}

bool json_scan_skip_flat(struct json_scan *scan)
{
    const char *begin = scan->at + 1;
    if (json_scan_peek(scan) != '[')
        return false;
    const char *close = memchr(begin, ']', (size_t)(scan->end - begin));
    if (close == NULL || memchr(begin, '[', (size_t)(close - begin)) != NULL ||
        !ends_member(close + 1, scan->end))
        return false;
    scan->at = close + 1;
    return true;
}

const char *json_scan_kind(struct json_scan *scan)
{
    switch (json_scan_peek(scan)) {
    case '"':
        return "a string";
    case '{':
        return "an object";
    case '[':
        return "an array";
    case 't':
    case 'f':
        return "true or false";
    case 'n':
        return "null";
    case '\0':
        return scan->at == scan->end ? "nothing" : "a NUL byte";
    default:
        return "a number";
    }
}

static int scan_scalar(struct json_scan *scan)
{
    double number;
    size_t escapes;
    char first = json_scan_peek(scan);
    if (first == '"') {
        scan->at++;
        return skip_string(scan, &escapes);
    }
    if (first == '-' || (first >= '0' && first <= '9'))
        return json_scan_number(scan, &number);
    if (take_word(scan, "true") || take_word(scan, "false") || take_word(scan, "null"))
        return 0;
    return json_scan_unexpected(scan, "a value");
}

static int scan_key(struct json_scan *scan)
{
    struct json_string key;
    if (json_scan_string(scan, &key) != 0)
        return -1;
    return json_scan_take(scan, ':') ? 0 : json_scan_unexpected(scan, "':'");
}

int json_scan_value(struct json_scan *scan, struct json_string *bytes)
{
    char closing[JSON_SCAN_DEPTH];
    size_t depth = 0;
    json_scan_peek(scan);
    const char *begin = scan->at;
    for (;;) {
        char first = json_scan_peek(scan);
        if (first == '{' || first == '[') {
            if (depth == JSON_SCAN_DEPTH)
                return diag_fail(scan->diag, DIAG_DATA, "nested deeper than %d", JSON_SCAN_DEPTH);
            closing[depth++] = first == '{' ? '}' : ']';
            scan->at++;
            if (!json_scan_take(scan, closing[depth - 1])) {
                if (first == '{' && scan_key(scan) != 0)
                    return -1;
                continue;
            }
            depth--;
        } else if (scan_scalar(scan) != 0) {
            return -1;
        }
        while (depth > 0 && json_scan_take(scan, closing[depth - 1]))
            depth--;
        if (depth == 0)
            break;
        if (!json_scan_take(scan, ','))
            return json_scan_unexpected(scan,
                                        closing[depth - 1] == '}' ? "',' or '}'" : "',' or ']'");
        if (closing[depth - 1] == '}' && scan_key(scan) != 0)
            return -1;
    }
    *bytes = (struct json_string){begin, (size_t)(scan->at - begin)};
    return 0;
}
