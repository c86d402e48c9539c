/* The known word that an unknown one probably means.
 *
 * The distance of two words is the number of letters to insert, take out, replace, or swap with
 * their neighbour, without regard to case. A word is suggested if at most a quarter of the unknown
 * word's letters must change, or if the unknown word is its beginning, of three letters or more. */
#pragma once

#include <stddef.h>

enum { SUGGESTION_SIZE = 64 }; /* longer words are neither corrected nor suggested */

struct suggestion {
    const char *word; /* the unknown one */
    size_t length, changes;
    char nearest[SUGGESTION_SIZE]; /* "" so far: none is near */
    char question[SUGGESTION_SIZE + 32];
};

/* The unknown word is the first length bytes of word, which must last as long as the suggestion. */
struct suggestion suggestion_begin(const char *word, size_t length);

/* Offers a known word. Of equally near ones the first by its bytes is suggested. */
void suggestion_offer(struct suggestion *suggestion, const char *known);

/* The index of the word in a list of known words that ends with NULL. For an unknown word -1, and
 * the suggestion in *meant, unless meant is NULL. */
int suggestion_find(const char *const *known, const char *word, size_t length,
                    struct suggestion *meant);

/* " (did you mean --seed?)" for the nearest word with `before`, "--", in front of it; "" if none is
 * near. */
const char *suggestion_question(struct suggestion *suggestion, const char *before);
