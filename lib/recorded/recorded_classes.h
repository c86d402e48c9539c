/* Classes of vehicle documents by a recording's own words. */
#pragma once

#include "base/intern.h"
#include "recorded/recorded_row.h"
#include "text/document.h"

struct recorded_classes {
    const struct recorded_format *format;
    const char *map, *otherwise;           /* --class-map, --class-default, or NULL */
    struct intern known;                   /* words of the format, then types that are added */
    LIST_OF(struct recorded_word) words;   /* by the number of the word */
    size_t own_count;                      /* how many of them are the format's */
    struct document_names vehicles;        /* the classes that there are */
    struct intern asked;                   /* words */
    LIST_OF(struct recorded_word) answers; /* by the number of the word; class NULL: none */
    struct arena *arena;
};

/* map is "word=class,word=class" or NULL, otherwise a class or NULL. Refuses a pair without "=" and
 * what cannot be a class (DIAG_USAGE). All of it lies in the arena. */
int recorded_classes_begin(struct recorded_classes *classes, const struct recorded_format *format,
                           const char *map, const char *otherwise, struct arena *arena,
                           struct diag *diag);

/* Adds a type, whose class is another word of the format: it means the same, with sizes of its own
 * where they are not 0. It takes the place of a word of that name; false if that is a type with
 * another class or size. */
bool recorded_classes_add(struct recorded_classes *classes, struct recorded_word type);

/* The class of a word: by the map, else the words, else the class of this name in data/vehicles/,
 * else otherwise; NULL if none knows it. Of a word that is not known, the part before an "@" is
 * looked for. The sizes are those of the word, or of the format's first word with this class. */
const struct recorded_word *recorded_classes_find(struct recorded_classes *classes,
                                                  const char *word);

/* Refuses the word, with the nearest one that is known; returns -1. */
int recorded_classes_refuse(const struct recorded_classes *classes, const char *word,
                            struct diag *diag);
