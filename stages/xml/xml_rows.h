/* What readers of rows in XML share (by expat).
 *
 * A file is parsed piece by piece. The reader's handlers add events, which are given out before the
 * next piece is parsed. A fault ends the file after the events before it. */
#pragma once

#include <expat.h>

#include "recorded/recorded_row.h"
#include "text/input.h"

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
    const char *advice;                        /* added to messages of expat; NULL: none */
    void (*fail_at_end)(struct xml_rows *xml); /* refuses a file that ends within its root */
    LIST_OF(struct xml_event) events;          /* of the last piece */
    size_t taken;                              /* number of events given out */
    int64_t bytes, open; /* bytes parsed so far; bytes of the unfinished tag or comment */
    struct arena arena;  /* of events and their names */
    bool in_root, ended;
};

/* Takes over the input. The handlers, which the caller sets, get the context. */
void xml_rows_begin(struct xml_rows *xml, const char *kind, struct input *input, void *context);

/* next and close of a format; the state is or begins with a struct xml_rows. */
int xml_rows_next(void *state, struct recorded_row *row, struct diag *diag);
void xml_rows_close(void *state);

/* The line that is being parsed. */
size_t xml_rows_line(const struct xml_rows *xml);

/* Refuses the value of an element or attribute; NULL means that it is missing. */
void xml_rows_fail(struct xml_rows *xml, const char *what, const char *value,
                   const char *expectation);

/* The value of an attribute, or NULL. */
const char *xml_rows_attribute(const char **attributes, const char *name);

/* Reads a number in [low, high]; false after a message. */
bool xml_rows_number(struct xml_rows *xml, const char *what, const char *text, double low,
                     double high, double *value);

/* A copy of a name in the arena, or NULL after a message. */
const char *xml_rows_name(struct xml_rows *xml, const char *what, const char *text,
                          struct arena *arena);
