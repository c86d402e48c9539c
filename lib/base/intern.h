/* Names that a frame holds many times, kept once.
 *
 * The same few ids stand in dozens of places of a line. A table finds the copy made before by a
 * hash of the name's ends, in one of a few places; a newcomer to full ones takes the first. So
 * equal names are nearly always, but not surely, one pointer. */
#ifndef INTERN_H
#define INTERN_H

#include <stdint.h>

#include "base/arena.h"

struct intern {
    struct arena *arena;
    struct intern_slot *slots;
    size_t count; /* a power of two */
};

/* An empty table that suits about as many different names. It and they live in the arena. */
struct intern intern_begin(struct arena *arena, size_t expected);

/* A NUL-terminated copy of the first length bytes of text, the one made before if it is there. */
const char *intern_keep(struct intern *names, const char *text, size_t length);

/* The same of the plain characters with which [text, end) begins, up to a quote; NULL if there are
 * none, or they end otherwise. */
const char *intern_keep_quoted(struct intern *names, const char *text, const char *end,
                               size_t *length);

#endif
