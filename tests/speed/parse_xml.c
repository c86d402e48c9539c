/* Parses a file of XML by expat with empty handlers: the floor of what any reader of it costs. */
#include <expat.h>
#include <stdio.h>

#include "text/input.h"

enum { PIECE = 64 * 1024 };

static void on_begin(void *context, const char *name, const char **attributes)
{
    (void)context;
    (void)name;
    (void)attributes;
}

static void on_end(void *context, const char *name)
{
    (void)context;
    (void)name;
}

int main(int count, char **words)
{
    struct diag diag = {0};
    struct input *input = count == 2 ? input_open(words[1], &diag) : NULL;
    XML_Parser parser = XML_ParserCreate(NULL);
    long got = input != NULL ? 1 : -1;
    XML_SetElementHandler(parser, on_begin, on_end);
    while (got > 0) {
        got = input_read(input, XML_GetBuffer(parser, PIECE), PIECE, &diag);
        if (got >= 0 && XML_ParseBuffer(parser, (int)got, got == 0) != XML_STATUS_OK)
            got = -1;
    }
    XML_ParserFree(parser);
    input_close(input);
    if (got < 0)
        fprintf(stderr, "parse_xml: no file of XML\n");
    return got < 0;
}
