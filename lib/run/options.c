#include "run/options.h"

#include <stdio.h>

#include "base/suggestion.h"
#include "run/stage.h"

static const struct field common_fields[] = {
    {OPTIONAL_NAME(
         struct common_options, output,
         "write to this file instead of standard output, compressed if its name ends in .gz or "
         ".zst; the "
         "file appears when it is complete; a file that it replaces gives it its mode and owner"),
     .word = "FILE"},
    {OPTIONAL_NAME(
         struct common_options, sections,
         "sections that frames carry from this stage on: all, none, or words with commas, -WORD to "
         "leave one out; words: objects, reflectors, echoes, cells, account (account:every=10 for "
         "every tenth frame), margins, quality, visibility; absent: as the frames state; at a "
         "source: objects"),
     .word = "LIST"},
    {FIELD_SEED_OF(
         struct common_options, seed,
         "seed of the random numbers from this stage on; absent: the frames' own; at a source: 1"),
     FIELD_OPTIONAL, .absent = 1},
    {OPTIONAL_FLAG(struct common_options, complete,
                   "fail if the stream has no scene, or if a scene lacks one of its frames from 0 "
                   "to the last")},
    {OPTIONAL_FLAG(struct common_options, help, "print this help")},
    {OPTIONAL_FLAG(struct common_options, version, "print the version")},
    {0},
};

_Static_assert(sizeof common_fields / sizeof *common_fields <= 64,
               "a set of options is a uint64_t");

static const struct record common_record = {
    .name = "stage",
    .size = sizeof(struct common_options),
    .fields = common_fields,
};

/* A command line that is being read. */
struct command_line {
    const struct stage *stage;
    void *state;
    struct common_options *common;
    uint64_t seen, common_seen; /* bit i: fields[i] of the table was given */
    struct arena *arena;
    struct diag *diag;
};

/* Spells the name of a member as an option, radius_m as radius-m. In a message "radius_m: ..." only
 * the name changes. */
static void use_dashes(char *text)
{
    for (char *letter = text; *letter != '\0' && *letter != ':'; letter++)
        if (*letter == '_')
            *letter = '-';
}

struct spelling {
    char text[80];
};

static struct spelling spell(const char *name)
{
    struct spelling spelling;
    snprintf(spelling.text, sizeof spelling.text, "%s", name);
    use_dashes(spelling.text);
    return spelling;
}

/* Does the program understand this one of the options that all share? */
static bool applies(const struct stage *stage, const struct field *field)
{
    enum stage_kind kind = stage_kind(stage);
    bool writes_frames = kind == STAGE_SOURCE || kind == STAGE_FILTER;
    switch (field->offset) {
    case offsetof(struct common_options, output):
        return !stage->into_folder;
    case offsetof(struct common_options, sections):
        return writes_frames;
    case offsetof(struct common_options, seed):
        return writes_frames || stage->draws;
    case offsetof(struct common_options, complete):
        return stage_takes_files(stage);
    default:
        return true;
    }
}

/* The fields that are options: all but the operand, which is the first. */
static const struct field *named_options(const struct stage *stage)
{
    return stage->options->fields + (stage->operand != NULL ? 1 : 0);
}

/* An option that was found: a member of the table's struct, or of a record that is a member of it.
 */
struct option {
    const struct field *field; /* NULL: the table has no such option */
    size_t offset;             /* of the record in the table's struct; 0 without one */
    size_t index;              /* of the entry in the table */
};

static struct option find_option(const struct field *fields, const char *word, size_t length)
{
    for (size_t i = 0; fields[i].name != NULL; i++) {
        const struct field *field = &fields[i];
        struct spelling spelling = spell(field->name);
        if (field->kind == FIELD_RECORD) {
            struct option member = find_option(field->record->fields, word, length);
            if (member.field != NULL)
                return (struct option){member.field, field->offset + member.offset, i};
        } else if (field->kind != FIELD_LIST && strlen(spelling.text) == length &&
                   memcmp(spelling.text, word, length) == 0) {
            return (struct option){field, 0, i};
        }
    }
    return (struct option){0};
}

static int set_option(const struct field *field, void *base, const char *value, struct arena *arena,
                      struct diag *diag)
{
    int result;
    double number;
    static const struct field name = {.name = "a name in the list", .kind = FIELD_NAME};
    if (field->kind == FIELD_NAMES)
        return field_set_text(&name, field_list_add(field, base, arena), value, strlen(value),
                              arena, diag);
    if (field->kind != FIELD_REAL && field->kind != FIELD_INTEGER)
        result = field_set_text(field, base, value, strlen(value), arena, diag);
    else if (field_read_number(value, strlen(value), &number) != 0)
        result = field_refuse(field, value, diag);
    else
        result = field_set_number(field, base, number + 0, diag); /* -0 is 0 */
    if (result == 0)
        return 0;
    use_dashes(diag->text);
    return diag_prefix(diag, "--");
}

/* Finds the option of that name, the program's own or else a shared one, and notes that it was
 * given. *base becomes the struct that its field belongs to. NULL if there is none. */
static const struct field *take_option(struct command_line *line, const char *name, size_t length,
                                       void **base)
{
    const struct stage *stage = line->stage;
    struct option own = find_option(named_options(stage), name, length);
    if (own.field != NULL) {
        size_t operands = stage->operand != NULL ? 1 : 0;
        line->seen |= UINT64_C(1) << (own.index + operands);
        *base = (char *)line->state + own.offset;
        return own.field;
    }
    struct option shared = find_option(common_fields, name, length);
    if (shared.field == NULL || !applies(stage, shared.field))
        return NULL;
    line->common_seen |= UINT64_C(1) << shared.index;
    *base = (char *)line->common + shared.offset;
    return shared.field;
}

static void offer_options(const struct field *fields, const struct stage *stage,
                          struct suggestion *meant)
{
    for (const struct field *field = fields; field->name != NULL; field++) {
        if (field->kind == FIELD_RECORD)
            offer_options(field->record->fields, stage, meant);
        else if (field->kind != FIELD_LIST && (fields != common_fields || applies(stage, field)))
            suggestion_offer(meant, spell(field->name).text);
    }
}

static int unknown_option(const struct command_line *line, const char *word)
{
    const char *name = word + strspn(word, "-");
    size_t length = strcspn(name, "=");
    const struct field_gone *gone = field_find_gone(line->stage->options, name, length);
    if (gone != NULL)
        return diag_fail(line->diag, DIAG_USAGE, "%s is gone: %s", word, gone->instead);
    struct suggestion meant = suggestion_begin(name, length);
    offer_options(named_options(line->stage), line->stage, &meant);
    offer_options(common_fields, line->stage, &meant);
    return diag_fail(line->diag, DIAG_USAGE, "unknown option %s%s; see --help", word,
                     suggestion_question(&meant, "--"));
}

/* The name that an option's word begins with: "output" for -o, "help" for -h; "" if the word is
 * spelt like no option. */
static const char *option_name(const char *word)
{
    if (strcmp(word, "-o") == 0)
        return "output";
    if (strcmp(word, "-h") == 0)
        return "help";
    return word[1] == '-' ? word + 2 : "";
}

/* Reads the option at words[*at]; advances *at if its value is the word after it. */
static int read_option(struct command_line *line, size_t count, const char *const *words,
                       size_t *at)
{
    struct diag *diag = line->diag;
    const char *word = words[*at], *name = option_name(word);
    size_t length = strcspn(name, "=");
    void *base;
    const struct field *field = take_option(line, name, length, &base);
    if (field == NULL)
        return unknown_option(line, word);
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
    return set_option(field, base, value, line->arena, diag);
}

/* A word that is no option: the operand, or a file of frames. */
static int read_argument(struct command_line *line, const char *word)
{
    const struct stage *stage = line->stage;
    if (stage->operand != NULL && (line->seen & 1) == 0) {
        line->seen |= 1;
        return field_set_text(stage->options->fields, line->state, word, strlen(word), line->arena,
                              line->diag);
    }
    if (!stage_takes_files(stage))
        return diag_fail(line->diag, DIAG_USAGE, "one argument too many: %s", word);
    *list_add(&line->common->files, line->arena) = arena_text(line->arena, word, strlen(word));
    return 0;
}

static int check_required(const struct command_line *line)
{
    const struct stage *stage = line->stage;
    for (size_t i = 0; stage->options->fields[i].name != NULL; i++) {
        const struct field *field = &stage->options->fields[i];
        if (field->optional || (line->seen >> i & 1) != 0)
            continue;
        bool operand = stage->operand != NULL && i == 0;
        return diag_fail(line->diag, DIAG_USAGE, "missing %s%s: %s; see --help",
                         operand ? "" : "--", operand ? stage->operand : spell(field->name).text,
                         field->help);
    }
    return 0;
}

int options_read(const struct stage *stage, size_t count, const char *const *words, void *state,
                 struct common_options *common, struct arena *arena, struct diag *diag)
{
    struct command_line line = {
        .stage = stage, .state = state, .common = common, .arena = arena, .diag = diag};
    field_clear(stage->options, state);
    field_clear(&common_record, common);
    bool only_arguments = false;
    int result = 0;
    for (size_t at = 0; at < count && result == 0; at++) {
        const char *word = words[at];
        bool option = !only_arguments && word[0] == '-' && word[1] != '\0';
        if (option && strcmp(word, "--") == 0)
            only_arguments = true;
        else
            result = option ? read_option(&line, count, words, &at) : read_argument(&line, word);
    }
    size_t seed = find_option(common_fields, "seed", strlen("seed")).index;
    common->seed_given = (line.common_seen >> seed & 1) != 0;
    if (result == 0 && !common->help && !common->version)
        result = check_required(&line);
    if (result != 0)
        diag->code = DIAG_USAGE;
    return result;
}

static const char *value_word(const struct field *field)
{
    static const char *const words[] = {
        [FIELD_REAL] = "NUMBER", [FIELD_INTEGER] = "NUMBER", [FIELD_NAME] = "NAME",
        [FIELD_CHOICE] = "WORD", [FIELD_SEED] = "SEED",
    };
    return field->word != NULL ? field->word : words[field->kind];
}

/* The words of a paragraph, in lines that begin at this column, where the text now ends. */
static void add_words(const char *words, size_t length, size_t column, struct text *text)
{
    enum { WIDTH = 80 };
    const char *end = words + length;
    for (size_t at = column; words < end; words++) {
        size_t word = strcspn(words, " \n");
        if (at > column && at + 1 + word > WIDTH) {
            text_format(text, "\n%*s", (int)column, "");
            at = column;
        }
        text_format(text, "%s%.*s", at > column ? " " : "", (int)word, words);
        at += (at > column) + word;
        words += word;
    }
    text_add_word(text, "\n");
}

static void add_sentence(const char *words, struct text *text)
{
    add_words(words, strlen(words), 0, text);
}

/* Fills each paragraph anew. A line that begins with blanks is a paragraph of its own, with a
 * hanging indent. */
static void add_paragraphs(const char *words, struct text *text)
{
    while (*words != '\0') {
        size_t length = strcspn(words, "\n");
        size_t indent = strspn(words, " ");
        while (indent == 0 && length > 0 && words[length] == '\n' &&
               strchr(" \n", words[length + 1]) == NULL)
            length += 1 + strcspn(words + length + 1, "\n");
        text_format(text, "%*s", (int)indent, "");
        add_words(words + indent, length - indent, indent > 0 ? indent + 4 : 0, text);
        words += length + (words[length] == '\n');
    }
}

/* A name in the left column, and what it means in lines of the right one; a long name has a line of
 * its own. */
static void add_entry(const char *name, const char *words, struct text *text)
{
    enum { COLUMN = 30 };
    text_format(text, "  %-*s", COLUMN - 2, name);
    if (strlen(name) > COLUMN - 4)
        text_format(text, "\n%*s", COLUMN, "");
    add_words(words, strlen(words), COLUMN, text);
}

/* The short form of an option, and blanks if it has none. */
static const char *letter_of(const struct field *field)
{
    if (strcmp(field->name, "output") == 0)
        return "-o, ";
    if (strcmp(field->name, "help") == 0)
        return "-h, ";
    return "    ";
}

static void help_option(const struct field *field, struct text *text)
{
    if (field->kind == FIELD_RECORD)
        for (const struct field *member = field->record->fields; member->name != NULL; member++)
            help_option(member, text);
    if (field->kind == FIELD_RECORD || field->kind == FIELD_LIST)
        return;
    char left[160], expected[512] = "", words[1024];
    bool flag = field->kind == FIELD_FLAG;
    snprintf(left, sizeof left, "%s--%s%s%s", letter_of(field), spell(field->name).text,
             flag ? "" : "=", flag ? "" : value_word(field));
    if (field->kind == FIELD_REAL || field->kind == FIELD_INTEGER || field->kind == FIELD_CHOICE)
        field_expectation(field, expected, sizeof expected);
    snprintf(words, sizeof words, "%s%s%s%s", field->help, *expected != '\0' ? "; " : "", expected,
             field->optional ? "" : "; required");
    add_entry(left, words, text);
}

/* A sentence that ends with the names of parts of the frame. */
static void help_parts(const char *words, unsigned parts, struct text *text)
{
    struct text sentence = {0};
    text_add_word(&sentence, words);
    const char *separator = " ";
    for (unsigned bit = 1; bit <= PART_VISIBILITY; bit <<= 1)
        if ((parts & bit) != 0) {
            text_format(&sentence, "%s%s", separator, frame_part_name(bit));
            separator = ", ";
        }
    text_add(&sentence, ".", 2);
    add_sentence(sentence.bytes, text);
    text_free(&sentence);
}

static void help_usage(const struct stage *stage, struct text *text)
{
    const char *operand = stage->operand;
    text_format(text, "Usage: glint-%s [OPTION]...%s%s%s\n", stage->name,
                operand != NULL ? " " : "", operand != NULL ? operand : "",
                stage_takes_files(stage) ? " [FILE]..." : "");
    add_sentence(stage->summary, text);
    if (stage->operand != NULL) {
        char words[512];
        snprintf(words, sizeof words, "%s: %s.", operand, stage->options->fields->help);
        text_add_word(text, "\n");
        add_sentence(words, text);
    }
    if (stage->details != NULL) {
        text_add_word(text, "\n");
        add_paragraphs(stage->details, text);
    }
}

/* How frames come and go. */
static void help_frames(const struct stage *stage, struct text *text)
{
    if (stage_takes_files(stage) || stage->reads != 0 || stage->writes != 0)
        text_add_word(text, "\n");
    if (stage->reads != 0)
        help_parts("Reads frames (JSON lines) from the files or standard input; parts:",
                   stage->reads, text);
    else if (stage_takes_files(stage))
        add_sentence("Reads frames (JSON lines) from the files or standard input; all parts.",
                     text);
    if (stage->writes != 0)
        help_parts("Writes frames (JSON lines) to standard output; parts:", stage->writes, text);
    if (stage_kind(stage) == STAGE_FILTER)
        add_sentence("Each frame is written before the program waits for the next.", text);
    if (stage_takes_files(stage) && stage->writes == 0)
        add_sentence("Writes no frames, so it stands last in a pipeline.", text);
}

void options_help(const struct stage *stage, struct text *text)
{
    help_usage(stage, text);
    help_frames(stage, text);
    text_add_word(text, "\nOptions:\n");
    for (const struct field *field = named_options(stage); field->name != NULL; field++)
        help_option(field, text);
    for (const struct field *field = common_fields; field->name != NULL; field++)
        if (applies(stage, field))
            help_option(field, text);
    text_add_word(text, "\nEnvironment:\n");
    add_entry("GLINT_DATA", "folder of your own documents, before the shipped ones", text);
    text_add_word(text, "\n");
    add_sentence("Exit status: 0, or as in sysexits: 64 usage, 65 bad data, 66 no input, "
                 "70 internal, 71 memory or descriptors, 73 cannot create, 74 input/output, "
                 "78 configuration.",
                 text);
}
