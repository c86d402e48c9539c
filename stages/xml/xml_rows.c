#include "xml_rows.h"

#include <stdio.h>

#include "base/number.h"
#include "text/field.h"
#include "text/file_format.h"

/* Bytes of a piece, and the most bytes of a tag or comment. expat parses an unfinished tag anew
 * with every piece. So a piece is as long as the unfinished tag before it, which keeps the cost
 * linear. */
enum { PIECE = 64 * 1024, TOKEN = 4 * 1024 * 1024 };

/* Memory that expat asked for; ends the program if there is none. */
static void *granted(void *memory)
{
    return memory != NULL ? memory : memory_get((size_t)-1);
}

void xml_rows_begin(struct xml_rows *xml, const char *kind, struct input *input, void *context)
{
    xml->kind = kind;
    xml->input = input;
    xml->parser = granted(XML_ParserCreate(NULL));
    XML_SetUserData(xml->parser, context);
#ifdef XML_HAS_REPARSE_DEFERRAL
    XML_SetReparseDeferralEnabled(xml->parser, XML_FALSE);
#endif
}

void xml_rows_close(void *state)
{
    struct xml_rows *xml = state;
    if (xml->parser != NULL)
        XML_ParserFree(xml->parser);
    input_close(xml->input);
    arena_free(&xml->arena);
}

size_t xml_rows_line(const struct xml_rows *xml)
{
    return (size_t)XML_GetCurrentLineNumber(xml->parser);
}

/* ---- values ---- */

void xml_rows_fail(struct xml_rows *xml, const char *what, const char *value,
                   const char *expectation)
{
    const char *quote = value != NULL ? "\"" : "";
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: %s is %s%.80s%s; expected %s", xml_rows_line(xml),
              what, quote, value != NULL ? value : "missing", quote, expectation);
    XML_StopParser(xml->parser, XML_FALSE);
}

const char *xml_rows_attribute(const char **attributes, const char *name)
{
    for (; *attributes != NULL; attributes += 2)
        if (*attributes[0] == *name && strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

bool xml_rows_number(struct xml_rows *xml, const char *what, const char *text, double low,
                     double high, double *value)
{
    char expectation[80];
    size_t length = text != NULL ? strlen(text) : 0;
    bool good = text != NULL && (number_take(text, text + length, value) == text + length ||
                                 field_read_number(text, length, value) == 0);
    if (good && *value >= low && *value <= high)
        return true;
    snprintf(expectation, sizeof expectation, "a number in [%g, %g]", low, high);
    xml_rows_fail(xml, what, text, expectation);
    return false;
}

const char *xml_rows_name(struct xml_rows *xml, const char *what, const char *text,
                          struct arena *arena)
{
    size_t length = 0;
    while (text != NULL && (unsigned char)text[length] >= ' ' && text[length] != '\x7f')
        length++;
    if (text != NULL && text[length] == '\0' && length > 0 && length <= FIELD_NAME_SIZE)
        return arena_text(arena, text, length);
    xml_rows_fail(xml, what, text, "a name of 1 to 1024 bytes");
    return NULL;
}

/* ---- parsing ---- */

/* Parses one more piece; false at the end and after a fault. */
static bool parse(struct xml_rows *xml)
{
    int64_t left = TOKEN + 1 - xml->open;
    int piece = xml->open > PIECE ? (int)xml->open : PIECE;
    piece = piece < left ? piece : (int)left;
    void *buffer = granted(XML_GetBuffer(xml->parser, piece));
    struct diag damage = {0};
    long got = input_read(xml->input, buffer, (size_t)piece, &damage);
    bool done = XML_ParseBuffer(xml->parser, got > 0 ? (int)got : 0, got <= 0) == XML_STATUS_OK;
    enum XML_Error error = XML_GetErrorCode(xml->parser);
    if (error == XML_ERROR_NO_MEMORY)
        granted(NULL);
    if (!done && got <= 0 && xml->in_root)
        xml->fail_at_end(xml);
    else if (!done)
        diag_fail(&xml->fault, DIAG_DATA, "line %zu: %s%s", xml_rows_line(xml),
                  XML_ErrorString(error), xml->advice != NULL ? xml->advice : "");
    if (got < 0)
        xml->fault = damage;
    xml->bytes += got;
    xml->open = xml->bytes - XML_GetCurrentByteIndex(xml->parser);
    if (done && got > 0 && xml->open > TOKEN)
        diag_fail(&xml->fault, DIAG_DATA,
                  "line %zu: a tag or comment of more than %d MB; expected its end before",
                  xml_rows_line(xml), TOKEN >> 20);
    return xml->fault.code == DIAG_OK && got > 0;
}

/* Reports the fault, or the format of a file of another format; returns -1. */
static int report(const struct xml_rows *xml, struct diag *diag)
{
    size_t length;
    const char *head = input_head(xml->input, &length);
    *diag = xml->fault;
    file_format_explain(xml->kind, head, length, diag);
    return -1;
}

int xml_rows_next(void *state, struct recorded_row *row, struct diag *diag)
{
    struct xml_rows *xml = state;
    while (xml->taken == xml->events.count && !xml->ended) {
        arena_clear(&xml->arena);
        memset(&xml->events, 0, sizeof xml->events);
        xml->taken = 0;
        xml->ended = !parse(xml);
    }
    if (xml->taken < xml->events.count) {
        const struct xml_event *event = &xml->events.items[xml->taken++];
        *row = event->row;
        return (int)event->kind;
    }
    return xml->fault.code == DIAG_OK ? RECORDED_END : report(xml, diag);
}
