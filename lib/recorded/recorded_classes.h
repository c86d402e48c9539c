/* Classes of vehicle documents by a recording's own words. */
#pragma once

#include "base/intern.h"
#include "recorded/recorded_row.h"
#include "text/document.h"

struct recorded_classes {
    const char *map, *otherwise;           /* --class-map, --class-default, or NULL */
    const struct recorded_word *own;       /* those of the format */
    struct intern known;                   /* words of the format, then those that are added */
    LIST_OF(struct recorded_word) words;   /* by the number of the word */
    size_t own_count;                      /* how many of them are the format's */
    bool typed;                            /* are sizes those of types, not of rows? */
    struct document_names vehicles;        /* the classes that there are */
    struct intern asked;                   /* words */
    LIST_OF(struct recorded_word) answers; /* by the number of the word; class NULL: none */
    struct arena *arena;
};

/* map is "word=class,word=class" or NULL, otherwise a class or NULL. Refuses a pair without "="
 * (DIAG_USAGE). All of it lies in the arena. */
int recorded_classes_begin(struct recorded_classes *classes, const struct recorded_format *format,
                           const char *map, const char *otherwise, struct arena *arena,
                           struct diag *diag);

/* Adds a word that means the same as one of the format's, with sizes of its own where they are not
 * 0. It takes the place of a word of that name. */
void recorded_classes_add(struct recorded_classes *classes, const char *word, const char *like,
                          double length_m, double width_m, double height_m);

/* Does so with the vTypes of a file of SUMO's routes or additional elements; -1 after a message.
 * Only the file's tags are read, in memory. */
int recorded_classes_read_types(struct recorded_classes *classes, const char *path,
                                struct diag *diag);

/* The class of a word: by the map, else the words, else the class of this name in data/vehicles/,
 * else otherwise; NULL if none knows it. Nor are the words known, what stands before an "@" is
 * asked for. The sizes are those of the word, or of the format's first word with this class. */
const struct recorded_word *recorded_classes_find(struct recorded_classes *classes,
                                                  const char *word);

/* Refuses the word with the words and the classes that there are; returns -1. */
int recorded_classes_refuse(const struct recorded_classes *classes, const char *word,
                            struct diag *diag);
