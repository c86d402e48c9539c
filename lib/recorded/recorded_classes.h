/* Classes of vehicle documents by the words of a recording. */
#pragma once

#include "base/intern.h"
#include "recorded/recorded_row.h"
#include "text/document.h"

struct recorded_classes {
    const struct recorded_format *format;
    const char *map, *otherwise;           /* --class-map, --class-default, or NULL */
    struct intern known;                   /* words of the format, then added types */
    LIST_OF(struct recorded_word) words;   /* by the number of the word */
    size_t own_count;                      /* number of words of the format */
    bool has_types;                        /* a type was added */
    LIST_OF(struct recorded_word) strange; /* added types whose class is no word of the format */
    struct document_names vehicles;        /* all classes */
    struct intern asked;                   /* words looked up so far */
    LIST_OF(struct recorded_word) answers; /* by the number of the word; class NULL: none */
    struct arena *arena;
};

/* map is "word=class,word=class" or NULL, otherwise a class or NULL. Refuses a pair without "=" and
 * a word that cannot be a class (DIAG_USAGE). */
int recorded_classes_begin(struct recorded_classes *classes, const struct recorded_format *format,
                           const char *map, const char *otherwise, struct arena *arena,
                           struct diag *diag);

/* Adds types. Each takes class and sizes of the word that its class is, but for its own sizes that
 * are not 0, and replaces a word of the same name. Refuses (DIAG_DATA) an added type with another
 * class or size. A type whose class is no such word has none, and is refused where it is used. */
int recorded_classes_add(struct recorded_classes *classes, const struct recorded_types *types,
                         struct diag *diag);

/* The class of a word: by the map, else by the format's words, else the class of this name in
 * data/vehicles/, else otherwise; NULL if there is none. Of an unknown word the part before "@" is
 * looked up. The sizes are those of the word, or of the format's first word with this class. */
const struct recorded_word *recorded_classes_find(struct recorded_classes *classes,
                                                  const char *word);

/* Refuses the word in a message; returns -1. The message says what the source lacks (untold), or
 * which vClass the type has, or the nearest known word. */
int recorded_classes_refuse(const struct recorded_classes *classes, const char *word,
                            const char *untold, struct diag *diag);
