#include "text/packing.h"

#include <stdlib.h>

#include "base/arena.h"
#include "text/packing_library.h"

enum { STEP = 64 * 1024 };

static const struct {
    const char *name, *ending, *mark; /* the mark is a file's first bytes */
    size_t length;                    /* of the mark */
} packings[] = {
    [PACKING_NONE] = {"plain", "", "", 0},
    [PACKING_GZIP] = {"gzip", ".gz", "\x1f\x8b", 2},
    [PACKING_ZSTD] = {"zstd", ".zst", "\x28\xb5\x2f\xfd", 4},
};

const char *packing_name(enum packing packing)
{
    return packings[packing].name;
}

const char *packing_ending(enum packing packing)
{
    return packings[packing].ending;
}

enum packing packing_of_bytes(const unsigned char *bytes, size_t length)
{
    for (enum packing each = PACKING_GZIP; each <= PACKING_ZSTD; each++)
        if (length >= packings[each].length &&
            memcmp(bytes, packings[each].mark, packings[each].length) == 0)
            return each;
    return PACKING_NONE;
}

bool packing_may_begin(const unsigned char *bytes, size_t length)
{
    for (enum packing each = PACKING_GZIP; each <= PACKING_ZSTD; each++)
        if (length < packings[each].length && memcmp(bytes, packings[each].mark, length) == 0)
            return true;
    return false;
}

enum packing packing_of_name(const char *name)
{
    size_t length = strlen(name);
    for (enum packing each = PACKING_GZIP; each <= PACKING_ZSTD; each++) {
        size_t end = strlen(packings[each].ending);
        if (length > end && strcmp(name + length - end, packings[each].ending) == 0)
            return each;
    }
    return PACKING_NONE;
}

size_t packing_plain_length(const char *name)
{
    return strlen(name) - strlen(packings[packing_of_name(name)].ending);
}

static const struct packing_library *library_of(enum packing packing)
{
    return packing == PACKING_ZSTD ? packing_zstd : &packing_gzip;
}

int packing_check(enum packing packing, struct diag *diag)
{
    if (library_of(packing) != NULL)
        return 0;
    return diag_fail(diag, DIAG_USAGE, "%s: this glint was built without lib%s",
                     packing_name(packing), packing_name(packing));
}

struct unpacker {
    const struct packing_library *library;
    void *with;
    bool inside;
    const char *damage;
};

/* What a library began; the program ends where it had no memory. */
static void *begun(void *with)
{
    return with != NULL ? with : memory_get((size_t)-1);
}

struct unpacker *packing_unpack_begin(enum packing packing)
{
    struct unpacker *unpacker = memory_get(sizeof *unpacker);
    *unpacker = (struct unpacker){.library = library_of(packing)};
    unpacker->with = begun(unpacker->library->unpack_begin());
    return unpacker;
}

void packing_unpack_end(struct unpacker *unpacker)
{
    if (unpacker == NULL)
        return;
    unpacker->library->unpack_end(unpacker->with);
    free(unpacker);
}

size_t packing_unpack_take(struct unpacker *unpacker, const unsigned char **from, size_t *given,
                           char *bytes, size_t size)
{
    struct packing_step step = {*from, *given, (unsigned char *)bytes, size};
    unpacker->damage = unpacker->library->unpack(unpacker->with, &step, &unpacker->inside);
    *from = step.from;
    *given = step.given;
    return size - step.room;
}

const char *packing_unpack_damage(const struct unpacker *unpacker)
{
    return unpacker->damage;
}

bool packing_unpack_is_inside(const struct unpacker *unpacker)
{
    return unpacker->inside;
}

struct packer {
    const struct packing_library *library;
    void *with;
};

struct packer *packing_pack_begin(enum packing packing)
{
    struct packer *packer = memory_get(sizeof *packer);
    packer->library = library_of(packing);
    packer->with = begun(packer->library->pack_begin());
    return packer;
}

void packing_pack_add(struct packer *packer, const char *bytes, size_t length, bool end,
                      struct text *packed)
{
    struct packing_step step = {.from = (const unsigned char *)bytes, .given = length};
    bool all;
    do {
        step.to = (unsigned char *)text_room(packed, STEP);
        step.room = STEP;
        all = packer->library->pack(packer->with, &step, end);
        packed->length += STEP - step.room;
    } while (!all);
}

void packing_pack_end(struct packer *packer)
{
    if (packer == NULL)
        return;
    packer->library->pack_end(packer->with);
    free(packer);
}
