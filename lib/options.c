#include "options.h"

#include <stdio.h>
#include <string.h>

static const struct field no_choice_fields[] = {{0}};

const struct record no_choice_record = {
    .name = "stage", .size = sizeof(struct no_choice), .fields = no_choice_fields};

static const struct field suite_choice_fields[] = {
    {FIELD_NAME_OF(struct suite_choice,                sensors, "take the suite from here, not from the frame"),
     FIELD_OPTIONAL},
    {0},
};

const struct record suite_choice_record = {
    .name = "stage", .size = sizeof(struct suite_choice), .fields = suite_choice_fields};

static const struct field common_fields[] = {
    {FIELD_NAME_OF(struct common_options,                               output,
     "write to this file instead of standard output (.gz compresses)"),
     FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct common_options, keep, "keep the sections that this stage uses up"),
     FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct common_options,                                                                 seed_text, "seed of every draw from here on"),
     FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct common_options,                                                             complete, "fail unless every scene is there to its end"),
     FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct common_options,                                                    help, "print this help"), FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct common_options,                               version, "print the version"), FIELD_OPTIONAL},
    {0                              },
};

static const struct record common_record = {
    .name = "stage",
    .size = sizeof(struct common_options),
    .fields = common_fields,
};

/* The option as people type it: "seed_text" is --seed, "radius_m" is --radius-m. */
static void spell(const struct field *field, char *text, size_t size)
{
    snprintf(text, size, "%s", strcmp(field->name, "seed_text") == 0 ? "seed" : field->name);
    for (char *at = text; *at != '\0'; at++)
        if (*at == '_')
            *at = '-';
}

/* A message about a member becomes one about the option. */
static void spell_message(struct diag *diag)
{
    for (char *letter = diag->text; *letter != '\0' && *letter != ':'; letter++)
        if (*letter == '_')
            *letter = '-';
}

static bool is_source(const struct stage *stage)
{
    return stage->next != NULL;
}

static bool applies(const struct stage *stage, const struct field *field)
{
    bool filter = !is_source(stage);
    if (strcmp(field->name, "keep") == 0)
        return filter && (stage->reads & SECTIONS_CONSUMED) != 0;
    if (strcmp(field->name, "complete") == 0)
        return filter;
    return true;
}

static const struct field *find(const struct record *record, const char *word, size_t length)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        char spelling[80];
        spell(field, spelling, sizeof spelling);
        if (strlen(spelling) == length && memcmp(spelling, word, length) == 0)
            return field;
    }
    return NULL;
}

static int set(const struct field *field, void *base, const char *value, struct arena *arena,
               struct diag *diag)
{
    if (field->kind == FIELD_REAL || field->kind == FIELD_INTEGER) {
        double number;
        if (field_read_number(value, strlen(value), &number) != 0)
            return field_wrong_kind(field, value, diag);
        return field_set_number(field, base, number, diag);
    }
    return field_set_text(field, base, value, strlen(value), arena, diag);
}

/* One option at words[*at]; moves *at past its value if that is a word of its own. */
static int read_option(const struct stage *stage, size_t count, const char *const *words,
                       size_t *at, void *state, struct common_options *common, struct arena *arena,
                       struct diag *diag)
{
    const char *word = words[*at], *name = word + 2;
    size_t length = strcspn(name, "=");
    if (strcmp(word, "-o") == 0) {
        name = "output";
        length = strlen(name);
    } else if (word[1] != '-') {
        return diag_fail(diag, DIAG_USAGE, "unknown option %s; see --help", word);
    }
    void *base = state;
    const struct field *field = find(stage->options, name, length);
    if (field != NULL && stage->operand != NULL && field == stage->options->fields)
        field = NULL;
    if (field == NULL) {
        base = common;
        field = find(&common_record, name, length);
    }
    if (field == NULL || (base == common && !applies(stage, field)))
        return diag_fail(diag, DIAG_USAGE, "unknown option %s; see --help", word);
    const char *value = name[length] == '=' ? name + length + 1 : NULL;
    if (field->kind == FIELD_FLAG) {
        if (value != NULL)
            return diag_fail(diag, DIAG_USAGE, "--%.*s takes no value", (int)length, name);
        memcpy((char *)base + field->offset, &(bool){true}, sizeof(bool));
        return 0;
    }
    if (value == NULL && *at + 1 < count)
        value = words[++*at];
    if (value == NULL)
        return diag_fail(diag, DIAG_USAGE, "%s needs a value", word);
    if (set(field, base, value, arena, diag) != 0) {
        diag->code = DIAG_USAGE;
        spell_message(diag);
        return diag_prefix(diag, "--");
    }
    return 0;
}

static const char *name_in(const struct field *field, const void *state)
{
    const char *name;
    memcpy(&name, (const char *)state + field->offset, sizeof name);
    return name;
}

static int read_operand(const struct stage *stage, const char *word, void *state,
                        struct common_options *common, struct arena *arena, struct diag *diag)
{
    if (!is_source(stage)) {
        *list_add(&common->files, arena) = arena_text(arena, word, strlen(word));
        return 0;
    }
    const struct field *operand = stage->options->fields;
    if (stage->operand == NULL || name_in(operand, state) != NULL)
        return diag_fail(diag, DIAG_USAGE, "one argument too many: %s", word);
    return field_set_text(operand, state, word, strlen(word), arena, diag);
}

static int check_required(const struct stage *stage, const void *state, struct diag *diag)
{
    for (const struct field *field = stage->options->fields; field->name != NULL; field++) {
        bool operand = stage->operand != NULL && field == stage->options->fields;
        if ((field->optional && !operand) || field->kind != FIELD_NAME)
            continue;
        char spelling[80];
        spell(field, spelling, sizeof spelling);
        if (name_in(field, state) == NULL)
            return diag_fail(diag, DIAG_USAGE, "missing %s%s: %s; see --help", operand ? "" : "--",
                             operand ? stage->operand : spelling, field->help);
    }
    return 0;
}

int options_read(const struct stage *stage, size_t count, const char *const *words, void *state,
                 struct common_options *common, struct arena *arena, struct diag *diag)
{
    field_clear(stage->options, state);
    *common = (struct common_options){.seed = OPTIONS_DEFAULT_SEED};
    bool only_operands = false;
    for (size_t at = 0; at < count; at++) {
        const char *word = words[at];
        bool option = !only_operands && word[0] == '-' && word[1] != '\0';
        int result = 0;
        if (option && strcmp(word, "--") == 0)
            only_operands = true;
        else if (option)
            result = read_option(stage, count, words, &at, state, common, arena, diag);
        else
            result = read_operand(stage, word, state, common, arena, diag);
        if (result != 0) {
            diag->code = DIAG_USAGE;
            return -1;
        }
    }
    if (common->seed_text != NULL) {
        const struct field seed = {FIELD_SEED_OF(struct common_options, seed, "")};
        if (field_set_text(&seed, common, common->seed_text, strlen(common->seed_text), arena,
                           diag) != 0) {
            diag->code = DIAG_USAGE;
            return diag_prefix(diag, "--");
        }
    }
    return common->help || common->version ? 0 : check_required(stage, state, diag);
}

static void help_option(const struct field *field, struct text *text)
{
    static const char *const values[] = {
        [FIELD_REAL] = "NUMBER", [FIELD_INTEGER] = "NUMBER", [FIELD_NAME] = "NAME",
        [FIELD_CHOICE] = "WORD", [FIELD_SEED] = "SEED",
    };
    char left[160], spelling[80];
    spell(field, spelling, sizeof spelling);
    bool output = strcmp(spelling, "output") == 0, seed = strcmp(spelling, "seed") == 0;
    const char *value = output ? "=FILE" : seed ? "=SEED" : field->kind != FIELD_FLAG ? "=" : "";
    snprintf(left, sizeof left, "%s--%s%s%s", output ? "-o, " : "    ", spelling, value,
             strcmp(value, "=") == 0 ? values[field->kind] : "");
    text_format(text, "  %-26s  %s", left, field->help);
    if (seed)
        text_format(text, "; sources take %d", OPTIONS_DEFAULT_SEED);
    if (field->kind == FIELD_REAL || field->kind == FIELD_INTEGER) {
        const char *unit = field_unit(field->name);
        text_format(text, " (%g to %g%s%s)", field->low, field->high, *unit ? " " : "", unit);
    }
    if (field->kind == FIELD_CHOICE) {
        text_add_word(text, " (");
        for (int i = 0; field->choices[i] != NULL; i++)
            text_format(text, "%s%s", i > 0 ? ", " : "", field->choices[i]);
        text_add_word(text, ")");
    }
    text_add_word(text, "\n");
}

static void help_sections(const char *verb, unsigned sections, struct text *text)
{
    text_format(text, "%s", verb);
    const char *separator = " ";
    for (unsigned bit = 1; bit <= SECTION_COUNTS; bit <<= 1)
        if ((sections & bit) != 0) {
            text_format(text, "%s%s", separator, frame_section_name(bit));
            separator = ", ";
        }
    text_add_word(text, ".\n");
}

void options_help(const struct stage *stage, struct text *text)
{
    text_format(text, "Usage: glint-%s [OPTION]... %s\n%s\n", stage->name,
                !is_source(stage)        ? "[FILE]..."
                : stage->operand != NULL ? stage->operand
                                         : "",
                stage->summary);
    if (stage->operand != NULL)
        text_format(text, "\n%s: %s.\n", stage->operand, stage->options->fields->help);
    if (stage->details != NULL)
        text_format(text, "\n%s\n", stage->details);
    text_add_word(text, "\n");
    if (stage->reads != 0)
        help_sections("Frames come as JSON lines from the files or standard input; reads",
                      stage->reads, text);
    if (stage->writes != 0)
        help_sections("Frames go as JSON lines to standard output; writes", stage->writes, text);
    text_add_word(text, "\nOptions:\n");
    for (const struct field *field = stage->options->fields; field->name != NULL; field++)
        if (stage->operand == NULL || field != stage->options->fields)
            help_option(field, text);
    for (const struct field *field = common_fields; field->name != NULL; field++)
        if (applies(stage, field))
            help_option(field, text);
    text_add_word(text, "\nExit status: 0, or as in sysexits: 64 usage, 65 bad data, 66 no input, "
                        "70 internal,\n71 memory, 73 cannot create, 74 input/output, 78 "
                        "configuration.\n");
}
