#include "base/suggestion.h"

#include <ctype.h>
#include <stdio.h>

#include "base/text.h"

/* The fewest letters of a word that count as the beginning of a longer one. */
enum { BEGINNING = 3 };

struct suggestion suggestion_begin(const char *word, size_t length)
{
    return (struct suggestion){.word = word, .length = length};
}

static bool same(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The distance of two words of fewer than SUGGESTION_SIZE letters, row by row: entry j of the row
 * of i is that of the first i letters of a and the first j of b (optimal string alignment). */
static size_t distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][SUGGESTION_SIZE];
    for (size_t i = 0; i <= a_length; i++) {
        size_t *row = rows[i % 3];
        size_t *above = rows[(i + 2) % 3];
        size_t *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            if (i == 0) {
                row[j] = j;
                continue;
            }
            size_t replaced = above[j - 1] + !same(a[i - 1], b[j - 1]);
            row[j] = least(least(row[j - 1], above[j]) + 1, replaced);
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
                row[j] = least(row[j], two_above[j - 2] + 1);
        }
    }
    return rows[a_length % 3][b_length];
}

void suggestion_offer(struct suggestion *suggestion, const char *known)
{
    size_t length = strlen(known), most = suggestion->length / 4;
    if (suggestion->length >= SUGGESTION_SIZE || length >= SUGGESTION_SIZE)
        return;
    bool beginning = suggestion->length >= BEGINNING && suggestion->length < length &&
                     strncmp(known, suggestion->word, suggestion->length) == 0;
    size_t changes = beginning ? 1 : distance(suggestion->word, suggestion->length, known, length);
    bool near = beginning || changes <= most;
    bool nearer = suggestion->nearest[0] == '\0' || changes < suggestion->changes ||
                  (changes == suggestion->changes && strcmp(known, suggestion->nearest) < 0);
    if (!near || !nearer)
        return;
    suggestion->changes = changes;
    memcpy(suggestion->nearest, known, length + 1);
}

int suggestion_find(const char *const *known, const char *word, size_t length,
                    struct suggestion *meant)
{
    for (int i = 0; known[i] != NULL; i++)
        if (text_is(word, length, known[i]))
            return i;
    if (meant == NULL)
        return -1;
    *meant = suggestion_begin(word, length);
    for (int i = 0; known[i] != NULL; i++)
        suggestion_offer(meant, known[i]);
    return -1;
}

const char *suggestion_question(struct suggestion *suggestion, const char *before)
{
    if (suggestion->nearest[0] == '\0')
        return "";
    snprintf(suggestion->question, sizeof suggestion->question, " (did you mean %s%s?)", before,
             suggestion->nearest);
    return suggestion->question;
}
