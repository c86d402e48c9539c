#include "frame/sections.h"

#include "base/suggestion.h"
#include "frame/frame.h"

const char *const sections_names[] = {"objects", "reflectors", "echoes",     "cells", "account",
                                      "margins", "quality",    "visibility", NULL};

enum { CARRY_ALL = (CARRY_VISIBILITY << 1) - 1 };

const char *const sections_meanings[] = {
    "what traffic has: every object, its place and its motion",
    "the reflection centres of the objects",
    "what each sensor could see of each reflector",
    "the resolution cells of each sensor, before noise",
    "what became of every reflector that gave no target",
    "how close every decision was to another outcome",
    "how far a tracker may trust each target",
    "how much of each object each sensor has in view",
};

/* For each section, in the order of enum carried: the part of the frame with that name, the last
 * stage that takes the word, and parts that are present once this stage has run. */
static const struct {
    unsigned own, after;
    const char *stage;
} places[] = {
    {PART_OBJECTS, PART_TARGETS, "glint-noise"},
    {PART_REFLECTORS, PART_SENSORS, "glint-ideal"},
    {PART_ECHOES, PART_CELLS | PART_TARGETS, "glint-sensor"},
    {PART_CELLS, PART_TARGETS, "glint-noise"},
    {PART_LOST, PART_SENSORS, "glint-ideal"},
    {0, PART_SENSORS, "glint-ideal"},
    {0, PART_TARGETS, "glint-noise"},
    {PART_VISIBILITY, PART_SENSORS, "glint-ideal"},
};

_Static_assert(CARRY_ALL + 1 == 1 << sizeof places / sizeof *places &&
                   sizeof sections_names == (1 + sizeof places / sizeof *places) * sizeof(char *) &&
                   sizeof sections_meanings + sizeof(char *) == sizeof sections_names,
               "each bit of enum carried has its word, its meaning and its place");

/* Reads the N of account:every=N. */
static int read_every(const char *text, size_t length, struct sections_change *change,
                      struct diag *diag)
{
    double every;
    if (field_read_number(text, length, &every) != 0 || every != floor(every) || every < 1 ||
        every > 1e9)
        return diag_fail(diag, DIAG_USAGE,
                         "account:every=%.*s; expected a whole number in [1, 1e9]",
                         (int)(length < 80 ? length : 80), text);
    change->account_every = (int64_t)every;
    return 0;
}

static int read_word(const char *text, size_t length, struct sections_change *change,
                     struct diag *diag)
{
    static const char every[] = "account:every=";
    size_t start = strlen(every);
    if (length >= start && memcmp(text, every, start) == 0) {
        if (read_every(text + start, length - start, change, diag) != 0)
            return -1;
        length = strlen("account");
    }
    struct suggestion meant;
    bool remove = text[0] == '-';
    int section = suggestion_find(sections_names, text + remove, length - remove, &meant);
    if (section < 0)
        return diag_fail(
            diag, DIAG_USAGE, "\"%.*s\" is no section%s; glint-ideal --help lists the sections",
            (int)(length < 80 ? length : 80), text, suggestion_question(&meant, remove ? "-" : ""));
    uint64_t bit = UINT64_C(1) << section;
    *(remove ? &change->added : &change->removed) &= ~bit;
    *(remove ? &change->removed : &change->added) |= bit;
    return 0;
}

int sections_read(const char *text, struct sections_change *change, struct diag *diag)
{
    static const char *const first_words[] = {"all", "none", NULL};
    int word = suggestion_find(first_words, text, strcspn(text, ","), NULL);
    *change = (struct sections_change){.added = word == 0 ? CARRY_ALL : 0,
                                       .removed = word == 1 ? CARRY_ALL : 0,
                                       .account_every = 1};
    for (;; word = -1) {
        size_t length = strcspn(text, ",");
        if (word < 0 && read_word(text, length, change, diag) != 0)
            return -1;
        if (text[length] == '\0')
            return 0;
        text += length + 1;
    }
}

static void clear_margins(struct frame *frame)
{
    frame_alter(frame, PART_ECHOES | PART_CELLS | PART_TARGETS | PART_LOST);
    const struct margins none = {0};
    for (size_t i = 0; i < frame->echoes.count; i++)
        frame->echoes.items[i].margins = none;
    for (size_t i = 0; i < frame->cells.count; i++)
        frame->cells.items[i].margins = none;
    for (size_t i = 0; i < frame->targets.count; i++)
        frame->targets.items[i].margins = none;
    for (size_t i = 0; i < frame->lost.count; i++)
        for (size_t j = 0; j < frame->lost.items[i].echoes.count; j++)
            frame->lost.items[i].echoes.items[j].margins = none;
}

static void clear_quality(struct frame *frame)
{
    frame_alter(frame, PART_TARGETS);
    for (size_t i = 0; i < frame->targets.count; i++)
        frame->targets.items[i].quality = (struct quality){0};
}

int sections_apply(const struct sections_change *change, struct frame *frame, struct diag *diag)
{
    uint64_t before = frame->sections, wanted = (before & ~change->removed) | change->added;
    if (frame->frame % change->account_every != 0)
        wanted &= ~(uint64_t)CARRY_ACCOUNT;
    for (int i = 0; sections_names[i] != NULL; i++)
        if ((wanted & ~before & UINT64_C(1) << i) != 0 && (frame->present & places[i].after) != 0 &&
            (frame->present & places[i].own) == 0)
            return diag_fail(diag, DIAG_CONFIG,
                             "--sections: \"%s\" comes too late for this frame; give it to %s or a "
                             "stage before it",
                             sections_names[i], places[i].stage);
    if ((before & ~wanted & CARRY_MARGINS) != 0)
        clear_margins(frame);
    if ((before & ~wanted & CARRY_QUALITY) != 0)
        clear_quality(frame);
    frame->sections = wanted;
    if (wanted != before)
        frame_alter(frame, PART_HEADER);
    return 0;
}

unsigned sections_left_out(const struct frame *frame)
{
    return (frame_carries(frame, CARRY_ACCOUNT) ? 0U : PART_LOST) |
           (frame_carries(frame, CARRY_VISIBILITY) ? 0U : PART_VISIBILITY);
}

void sections_drop(struct frame *frame)
{
    unsigned dropped = 0;
    for (int i = 0; sections_names[i] != NULL; i++)
        if ((frame->sections & UINT64_C(1) << i) == 0 && (frame->present & places[i].after) != 0)
            dropped |= places[i].own;
    if (dropped != 0)
        frame_drop(frame, dropped);
}
