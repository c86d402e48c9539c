/* Numbers that a page prints, compared with values that the test computes.
 *
 *     PRINTED("14.17", "76.5 GHz, 50 m # dB in band", inr_db);
 *
 * finds this text in section 14.17 of the model's pages, with any white space between words. Each #
 * stands for a number as the page prints it, and the values follow in their order: each must round
 * to the printed digits. The text must be there once. In place of the section a page may be named,
 * "pipelines/README.md". Tests run where make runs, at the top of the tree. */
#pragma once

#include <ctype.h>
#include <glob.h>

#include "check.h"

enum { PRINTED_MOST = 16, PRINTED_PAGE = 1 << 17 };

/* Reads a file into the text, as far as there is room. */
static inline void printed_read(const char *path, char *text)
{
    FILE *file = fopen(path, "r");
    if (file == NULL)
        fail_msg("%s cannot be read", path);
    size_t length = 0;
    for (int byte; (byte = fgetc(file)) != EOF && length + 2 < PRINTED_PAGE;)
        text[length++] = (char)byte;
    text[length] = '\0';
    fclose(file);
}

/* The rest of the text from the section's heading on, cut off at the next heading; NULL: none. */
static inline char *printed_section(char *text, const char *section)
{
    size_t length = strlen(section);
    for (char *line = text; line != NULL; line = strchr(line, '\n')) {
        line += *line == '\n';
        const char *name = line + strspn(line, "#"), *after = name + 1 + length;
        if (name == line || *name != ' ' || strncmp(name + 1, section, length) != 0)
            continue;
        if (*after != ' ' && (*after != '.' || isdigit((unsigned char)after[1])))
            continue;
        char *end = strstr(line + 1, "\n#");
        if (end != NULL)
            *end = '\0';
        return line;
    }
    return NULL;
}

/* The text of a section of the model, or of a page. */
static inline const char *printed_text(const char *where, char *text)
{
    if (strstr(where, ".md") != NULL) {
        printed_read(where, text);
        return text;
    }
    glob_t pages;
    assert_int_equal(glob("lib/*/MODEL.md", 0, NULL, &pages), 0);
    assert_int_equal(glob("stages/*/MODEL.md", GLOB_APPEND, NULL, &pages), 0);
    assert_int_equal(glob("MODEL.md", GLOB_APPEND, NULL, &pages), 0);
    char *found = NULL;
    for (size_t i = 0; i < pages.gl_pathc && found == NULL; i++) {
        printed_read(pages.gl_pathv[i], text);
        found = printed_section(text, where);
    }
    globfree(&pages);
    if (found == NULL)
        fail_msg("no page of the model has a section %s", where);
    return found;
}

/* A number as it is printed, and the value of one in its last digit. */
struct printed_number {
    double value, unit;
};

/* Reads a number at the text's begin; returns its end, or NULL. */
static inline const char *printed_number(const char *text, struct printed_number *number)
{
    const char *digits = text + (*text == '-' || *text == '+'), *end = digits;
    end += strspn(end, "0123456789");
    number->unit = 1;
    if (*end == '.' && isdigit((unsigned char)end[1]))
        for (end++; isdigit((unsigned char)*end); end++)
            number->unit /= 10;
    if (end == digits)
        return NULL;
    number->value = strtod(text, NULL);
    return end;
}

/* Reads the pattern at the text's begin; returns the number of numbers, or -1 where it differs. */
static inline int printed_match(const char *text, const char *pattern,
                                struct printed_number numbers[])
{
    int count = 0;
    for (; *pattern != '\0'; pattern++) {
        if (*pattern == '#') {
            text = count < PRINTED_MOST ? printed_number(text, &numbers[count++]) : NULL;
            if (text == NULL)
                return -1;
        } else if (*pattern == ' ') {
            size_t blanks = strspn(text, " \n|");
            if (blanks == 0)
                return -1;
            text += blanks;
        } else if (*text++ != *pattern) {
            return -1;
        }
    }
    bool inside = *text == '.' && isdigit((unsigned char)text[1]);
    return isdigit((unsigned char)*text) || inside ? -1 : count;
}

static inline void printed_check(const char *where, const char *pattern, size_t count,
                                 const double *values)
{
    char *page = malloc(PRINTED_PAGE);
    assert_non_null(page);
    struct printed_number numbers[PRINTED_MOST], kept[PRINTED_MOST] = {{0, 0}};
    int places = 0;
    const char *text = printed_text(where, page);
    for (const char *at = text; *at != '\0'; at++) {
        bool begins = at == text || strchr(" \n(|", at[-1]) != NULL;
        if (!begins || printed_match(at, pattern, numbers) != (int)count)
            continue;
        memcpy(kept, numbers, sizeof kept);
        places++;
    }
    free(page);
    if (places != 1)
        fail_msg("%s: \"%s\" with %zu numbers is there %d times, not once", where, pattern, count,
                 places);
    for (size_t i = 0; i < count; i++) {
        double off = fabs(values[i] - kept[i].value) / kept[i].unit;
        if (!(off <= 0.5 * (1 + 1e-9)))
            fail_msg("%s: \"%s\", number %zu: %.12g is printed, %.12g is computed", where, pattern,
                     i + 1, kept[i].value, values[i]);
    }
}

#define PRINTED(where, pattern, ...)                                                               \
    printed_check((where), (pattern), sizeof((double[]){__VA_ARGS__}) / sizeof(double),            \
                  (const double[]){__VA_ARGS__})
