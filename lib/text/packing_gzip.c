/* Bytes packed by zlib, as gzip. */
#define ZLIB_CONST
#include <limits.h>
#include <stdlib.h>

#include <zlib.h>

#include "base/arena.h"
#include "text/packing_library.h"

enum { BITS = 16 + MAX_WBITS, MEMORY = 8, LEVEL = 1 };

/* The step as zlib has it, in numbers that zlib can have. */
static void set(z_stream *stream, const struct packing_step *step)
{
    stream->next_in = step->from;
    stream->avail_in = (unsigned)(step->given < INT_MAX ? step->given : INT_MAX);
    stream->next_out = step->to;
    stream->avail_out = (unsigned)(step->room < INT_MAX ? step->room : INT_MAX);
}

static void move_on(struct packing_step *step, const z_stream *stream)
{
    step->given -= (size_t)(stream->next_in - step->from);
    step->room -= (size_t)(stream->next_out - step->to);
    step->from = stream->next_in;
    step->to = stream->next_out;
}

static void *unpack_begin(void)
{
    z_stream *stream = memory_get(sizeof *stream);
    *stream = (z_stream){0};
    if (inflateInit2(stream, BITS) == Z_OK)
        return stream;
    free(stream);
    return NULL;
}

static const char *unpack(void *with, struct packing_step *step, bool *inside)
{
    z_stream *stream = with;
    if (!*inside)
        inflateReset(stream);
    set(stream, step);
    int done = inflate(stream, Z_NO_FLUSH); /* Z_BUF_ERROR: it needs more bytes */
    if (done == Z_MEM_ERROR)
        memory_get((size_t)-1);
    move_on(step, stream);
    *inside = done != Z_STREAM_END;
    if (done == Z_OK || done == Z_STREAM_END || done == Z_BUF_ERROR)
        return NULL;
    return stream->msg != NULL ? stream->msg : "no message";
}

static void unpack_end(void *with)
{
    inflateEnd(with);
    free(with);
}

static void *pack_begin(void)
{
    z_stream *stream = memory_get(sizeof *stream);
    *stream = (z_stream){0};
    if (deflateInit2(stream, LEVEL, Z_DEFLATED, BITS, MEMORY, Z_DEFAULT_STRATEGY) == Z_OK)
        return stream;
    free(stream);
    return NULL;
}

static bool pack(void *with, struct packing_step *step, bool end)
{
    z_stream *stream = with;
    set(stream, step);
    deflate(stream, end ? Z_FINISH : Z_NO_FLUSH);
    move_on(step, stream);
    return step->given == 0 && step->room > 0;
}

static void pack_end(void *with)
{
    deflateEnd(with);
    free(with);
}

const struct packing_library packing_gzip = {
    unpack_begin, unpack, unpack_end, pack_begin, pack, pack_end,
};
