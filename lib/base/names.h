/* Names that a frame holds many times, kept once.
 *
 * The same few ids stand in dozens of places of a line. A table finds the copy made before by a
 * hash of the name's ends, in one of a few places; a newcomer to full ones takes the first. So
 * equal names are nearly always, but not surely, one pointer. */
#ifndef NAMES_H
#define NAMES_H

#include <stdint.h>

#include "memory.h"

struct names {
    struct arena *arena;
    struct names_slot *slots;
    size_t count; /* a power of two */
};

/* An empty table that suits about as many different names. It and they live in the arena. */
struct names names_begin(struct arena *arena, size_t expected);

/* A NUL-terminated copy of the first length bytes of text, the one made before if it is there. */
const char *names_keep(struct names *names, const char *text, size_t length);

/* The same of the plain characters with which [text, end) begins, up to a quote; NULL if there are
 * none, or they end otherwise. */
const char *names_keep_quoted(struct names *names, const char *text, const char *end,
                              size_t *length);

#endif
