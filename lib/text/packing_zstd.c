/* Bytes packed by libzstd, where it was there at build. */
#include "text/packing_library.h"

#ifdef GLINT_ZSTD
#include <zstd.h>

#include "base/arena.h"

enum { LEVEL = 1 };

static void *unpack_begin(void)
{
    return ZSTD_createDStream();
}

static const char *unpack(void *with, struct packing_step *step, bool *inside)
{
    ZSTD_inBuffer in = {step->from, step->given, 0};
    ZSTD_outBuffer out = {step->to, step->room, 0};
    size_t done = ZSTD_decompressStream(with, &out, &in);
    step->from += in.pos;
    step->given -= in.pos;
    step->to += out.pos;
    step->room -= out.pos;
    *inside = done != 0;
    return ZSTD_isError(done) != 0 ? ZSTD_getErrorName(done) : NULL;
}

static void unpack_end(void *with)
{
    ZSTD_freeDStream(with);
}

static void *pack_begin(void)
{
    ZSTD_CStream *stream = ZSTD_createCStream();
    if (stream == NULL)
        return NULL;
    ZSTD_CCtx_setParameter(stream, ZSTD_c_compressionLevel, LEVEL);
    ZSTD_CCtx_setParameter(stream, ZSTD_c_checksumFlag, 1);
    return stream;
}

static bool pack(void *with, struct packing_step *step, bool end)
{
    ZSTD_inBuffer in = {step->from, step->given, 0};
    ZSTD_outBuffer out = {step->to, step->room, 0};
    size_t left = ZSTD_compressStream2(with, &out, &in, end ? ZSTD_e_end : ZSTD_e_continue);
    if (ZSTD_isError(left) != 0)
        memory_get((size_t)-1);
    step->from += in.pos;
    step->given -= in.pos;
    step->to += out.pos;
    step->room -= out.pos;
    return step->given == 0 && (!end || left == 0);
}

static void pack_end(void *with)
{
    ZSTD_freeCStream(with);
}

static const struct packing_library library = {
    unpack_begin, unpack, unpack_end, pack_begin, pack, pack_end,
};
const struct packing_library *const packing_zstd = &library;
#else
const struct packing_library *const packing_zstd = NULL;
#endif
