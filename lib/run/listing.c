#include "run/listing.h"

#include "base/suggestion.h"
#include "documents/vehicle.h"
#include "effects/effect.h"
#include "run/fused.h"
#include "text/document.h"

static void add_stages(struct text *text)
{
    for (size_t i = 0; stages[i] != NULL; i++)
        text_format(text, "glint-%-18s %s\n", stages[i]->name, stages[i]->summary);
}

static void add_tools(struct text *text)
{
    for (size_t i = 0; tools[i] != NULL; i++)
        text_format(text, "glint-%-18s %s\n", tools[i]->name, tools[i]->summary);
}

static void add_effects(struct text *text)
{
    for (int i = 0; i < EFFECT_COUNT; i++)
        text_format(text, "%-17s %-7s %s\n", effects_names[i], effect_homes[effect_table[i]->home],
                    effect_table[i]->summary);
}

static void add_effect(const struct effect *effect, struct text *text)
{
    bool leaves = effect->left_out_when != NULL;
    text_format(text, "%s\nsimulated by glint-%s\ndescribed by %s\nauto %s%s\ncosts %s\n",
                effect->summary, effect_homes[effect->home], effect->cause,
                leaves ? "leaves it out when " : "never leaves it out",
                leaves ? effect->left_out_when : "", effect->cost);
}

/* What a suite or a scenario says of its origin, without "Made for glint ...: " at its begin. */
static void add_origin(const char *name, const char *path, struct text *text, struct arena *arena)
{
    (void)name;
    static const char ours[] = "Made for glint";
    const char *origin = document_origin(path, arena);
    if (origin == NULL)
        origin = "a document without an origin";
    const char *colon = strstr(origin, ": ");
    if (strncmp(origin, ours, sizeof ours - 1) == 0 && colon != NULL)
        origin = colon + 2;
    text_add_word(text, origin);
}

static void add_size(const char *name, const char *path, struct text *text, struct arena *arena)
{
    (void)path;
    struct diag diag = {0};
    const struct vehicle *vehicle = vehicle_load(name, NULL, arena, &diag);
    if (vehicle == NULL)
        text_add_word(text, diag.text);
    else
        text_format(text, "%g m long, %g m wide, %g m high", vehicle->length_m, vehicle->width_m,
                    vehicle->height_m);
}

/* The words of the comment at the head of a script, behind its first line, #!. */
static void read_comment(const char *path, struct text *comment)
{
    struct diag diag = {0};
    struct text script = {0};
    document_bytes(path, &script, &diag);
    text_add(&script, "", 1);
    const char *line = strchr(script.bytes, '\n');
    while (line != NULL && line[1] == '#') {
        size_t length = strcspn(line + 2, "\n");
        text_add(comment, line + 2, length);
        line = strchr(line + 2, '\n');
    }
    text_add(comment, "", 1);
    text_free(&script);
}

/* The comment's first sentence, or its first two if the first is a mere title. */
static void add_comment(const char *name, const char *path, struct text *text, struct arena *arena)
{
    enum { TITLE = 24 };
    (void)name;
    (void)arena;
    struct text comment = {0};
    read_comment(path, &comment);
    const char *words = comment.bytes + (comment.bytes[0] == ' ');
    const char *stop = strstr(words, ". ");
    if (stop != NULL && stop < words + TITLE)
        stop = strstr(stop + 1, ". ");
    text_add(text, words, stop != NULL ? (size_t)(stop + 1 - words) : strlen(words));
    text_free(&comment);
}

/* Kinds of things that are files with names, and what a line says of one. */
static const struct file_kind {
    const char *name, *ending;
    void (*describe)(const char *name, const char *path, struct text *text, struct arena *arena);
} file_kinds[] = {
    {"sensors", ".json", add_origin},
    {"scenarios", ".json", add_origin},
    {"vehicles", ".json", add_size},
    {"pipelines", ".sh", add_comment},
};

/* Kinds of things that are built in. */
static const struct built_kind {
    const char *name;
    void (*add)(struct text *text);
} built_kinds[] = {{"stages", add_stages}, {"tools", add_tools}, {"effects", add_effects}};

enum {
    FILE_KINDS = sizeof file_kinds / sizeof file_kinds[0],
    BUILT_KINDS = sizeof built_kinds / sizeof built_kinds[0],
};

static int add_files(const struct file_kind *kind, struct text *text, struct arena *arena,
                     struct diag *diag)
{
    struct document_names list;
    if (document_list(kind->name, kind->ending, &list, arena, diag) != 0)
        return -1;
    for (size_t i = 0; i < list.names.count; i++) {
        const char *name = list.names.items[i];
        const char *path = document_find(kind->name, name, kind->ending, arena, diag);
        text_format(text, "%-22s ", name);
        if (path != NULL)
            kind->describe(name, path, text, arena);
        text_add_word(text, "\n");
    }
    return 0;
}

int listing_add(const char *kind, struct text *text, struct arena *arena, struct diag *diag)
{
    struct suggestion meant = suggestion_begin(kind, strlen(kind));
    for (size_t i = 0; i < BUILT_KINDS; i++) {
        suggestion_offer(&meant, built_kinds[i].name);
        if (strcmp(kind, built_kinds[i].name) == 0) {
            built_kinds[i].add(text);
            return 0;
        }
    }
    for (size_t i = 0; i < FILE_KINDS; i++) {
        suggestion_offer(&meant, file_kinds[i].name);
        if (strcmp(kind, file_kinds[i].name) == 0)
            return add_files(&file_kinds[i], text, arena, diag);
    }
    for (int i = 0; i < EFFECT_COUNT; i++) {
        suggestion_offer(&meant, effects_names[i]);
        if (strcmp(kind, effects_names[i]) == 0) {
            add_effect(effect_table[i], text);
            return 0;
        }
    }
    return diag_fail(diag, DIAG_USAGE,
                     "--list %s is unknown%s; expected sensors, scenarios, vehicles, pipelines, "
                     "stages, tools, effects or the name of an effect",
                     kind, suggestion_question(&meant, ""));
}
