/* A library that packs bytes, as packing.h uses it. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Bytes that are given, and room for those that are made; a step moves both on. */
struct packing_step {
    const unsigned char *from;
    size_t given;
    unsigned char *to;
    size_t room;
};

/* The begins give NULL where there is no memory. */
struct packing_library {
    void *(*unpack_begin)(void);
    /* Returns what is damaged, or NULL; *inside is false at the end of a member or frame. */
    const char *(*unpack)(void *with, struct packing_step *step, bool *inside);
    void (*unpack_end)(void *with);
    void *(*pack_begin)(void);
    /* Packs all that is given, unless the room ends; true if nothing is left in the library that
     * must come out now. */
    bool (*pack)(void *with, struct packing_step *step, bool end);
    void (*pack_end)(void *with);
};

extern const struct packing_library packing_gzip;
extern const struct packing_library *const packing_zstd; /* NULL if it was not there at build */
