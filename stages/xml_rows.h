/* Rows of a recording that lies in XML: what the sources share that parse it by expat.
 *
 * A file is parsed piece by piece. The source's handlers add events, which are given out before the
 * next piece is parsed. A fault ends the file, after the events before it. The functions are inline
 * because libglint.a has no expat. */
#pragma once

#include <expat.h>
#include <stdio.h>

#include "base/number.h"
#include "recorded/recorded_row.h"
#include "run/stage.h"
#include "text/file_format.h"
#include "text/input.h"

/* Bytes of a piece, and the most bytes of a tag or comment. expat parses an unfinished tag anew
 * with every piece. So the next piece is as long as the unfinished tag, which keeps the cost
 * linear. */
enum { XML_ROWS_PIECE = 64 * 1024, XML_ROWS_TOKEN = 4 * 1024 * 1024 };

/* A row, or the end of a step. */
struct xml_event {
    enum recorded_event kind;
    struct recorded_row row;
};

struct xml_rows {
    XML_Parser parser;
    struct input *input;
    const char *kind;                          /* in file_format.def */
    struct diag fault;                         /* that ends the file */
    const char *advice;                        /* after what is no XML; NULL: none */
    void (*fail_at_end)(struct xml_rows *xml); /* refuses a file that ends within its root */
    LIST_OF(struct xml_event) events;          /* of the piece that was parsed last */
    size_t taken;
    int64_t bytes, open; /* bytes parsed so far; bytes of the tag or comment that has not ended */
    struct arena arena;  /* of events and their names */
    bool in_root, ended;
};

/* Memory that expat got, or did not get. */
static inline void *xml_rows_granted(void *memory)
{
    return memory != NULL ? memory : memory_get((size_t)-1);
}

/* Takes over the input. The handlers, which the caller sets, get the context. */
static inline void xml_rows_begin(struct xml_rows *xml, const char *kind, struct input *input,
                                  void *context)
{
    xml->kind = kind;
    xml->input = input;
    xml->parser = xml_rows_granted(XML_ParserCreate(NULL));
    XML_SetUserData(xml->parser, context);
#ifdef XML_HAS_REPARSE_DEFERRAL
    XML_SetReparseDeferralEnabled(xml->parser, XML_FALSE);
#endif
}

static inline void xml_rows_close(void *state)
{
    struct xml_rows *xml = state;
    if (xml->parser != NULL)
        XML_ParserFree(xml->parser);
    input_close(xml->input);
    arena_free(&xml->arena);
}

static inline size_t xml_rows_line(const struct xml_rows *xml)
{
    return (size_t)XML_GetCurrentLineNumber(xml->parser);
}

/* ---- values ---- */

/* Refuses the value of what an element or attribute of this name says; NULL: it is missing. */
static inline void xml_rows_fail(struct xml_rows *xml, const char *what, const char *value,
                                 const char *expectation)
{
    const char *quote = value != NULL ? "\"" : "";
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: %s is %s%.80s%s; expected %s", xml_rows_line(xml),
              what, quote, value != NULL ? value : "missing", quote, expectation);
    XML_StopParser(xml->parser, XML_FALSE);
}

/* The value of an attribute, or NULL. */
static inline const char *xml_rows_attribute(const char **attributes, const char *name)
{
    for (; *attributes != NULL; attributes += 2)
        if (*attributes[0] == *name && strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

/* Reads a number in [low, high]; false after a message. */
static inline bool xml_rows_number(struct xml_rows *xml, const char *what, const char *text,
                                   double low, double high, double *value)
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

/* A copy of a name in the arena, or NULL after a message. */
static inline const char *xml_rows_name(struct xml_rows *xml, const char *what, const char *text,
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

/* Parses a piece more; false at the end and after a fault. */
static inline bool xml_rows_parse(struct xml_rows *xml)
{
    int64_t left = XML_ROWS_TOKEN + 1 - xml->open;
    int piece = xml->open > XML_ROWS_PIECE ? (int)xml->open : XML_ROWS_PIECE;
    piece = piece < left ? piece : (int)left;
    void *buffer = xml_rows_granted(XML_GetBuffer(xml->parser, piece));
    struct diag damage = {0};
    long got = input_read(xml->input, buffer, (size_t)piece, &damage);
    bool done = XML_ParseBuffer(xml->parser, got > 0 ? (int)got : 0, got <= 0) == XML_STATUS_OK;
    enum XML_Error error = XML_GetErrorCode(xml->parser);
    if (error == XML_ERROR_NO_MEMORY)
        xml_rows_granted(NULL);
    if (!done && got <= 0 && xml->in_root)
        xml->fail_at_end(xml);
    else if (!done)
        diag_fail(&xml->fault, DIAG_DATA, "line %zu: %s%s", xml_rows_line(xml),
                  XML_ErrorString(error), xml->advice != NULL ? xml->advice : "");
    if (got < 0) {
        xml->fault.code = damage.code;
        diag_prefix(&xml->fault, "%s: ", damage.text);
    }
    xml->bytes += got;
    xml->open = xml->bytes - XML_GetCurrentByteIndex(xml->parser);
    if (done && got > 0 && xml->open > XML_ROWS_TOKEN)
        diag_fail(&xml->fault, DIAG_DATA,
                  "line %zu: a tag or comment of more than %d MB; expected its end before",
                  xml_rows_line(xml), XML_ROWS_TOKEN >> 20);
    return xml->fault.code == DIAG_OK && got > 0;
}

/* Tells the fault, or the format of a file that is of another one; returns -1. */
static inline int xml_rows_report(const struct xml_rows *xml, struct diag *diag)
{
    size_t length;
    const char *head = input_head(xml->input, &length);
    *diag = xml->fault;
    file_format_explain(xml->kind, head, length, diag);
    return -1;
}

/* The next event: the format's function next. Its state, as that of close, is or begins with a
 * struct xml_rows. */
static inline int xml_rows_next(void *state, struct recorded_row *row, struct diag *diag)
{
    struct xml_rows *xml = state;
    while (xml->taken == xml->events.count && !xml->ended) {
        arena_clear(&xml->arena);
        xml->events.items = NULL;
        xml->events.count = xml->events.room = xml->taken = 0;
        xml->ended = !xml_rows_parse(xml);
    }
    if (xml->taken < xml->events.count) {
        const struct xml_event *event = &xml->events.items[xml->taken++];
        *row = event->row;
        return (int)event->kind;
    }
    return xml->fault.code == DIAG_OK ? RECORDED_END : xml_rows_report(xml, diag);
}
