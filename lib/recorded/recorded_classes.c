#include "recorded/recorded_classes.h"

#include "text/file_format.h"
#include "text/input.h"

static const char *after_pair(const char *pair)
{
    size_t length = strcspn(pair, ",");
    return pair[length] == ',' ? pair + length + 1 : NULL;
}

static void add(struct recorded_classes *classes, const struct recorded_word *word)
{
    uint32_t number = intern_word(&classes->known, word->word, classes->arena);
    if (number == classes->words.count)
        list_add(&classes->words, classes->arena);
    classes->words.items[number] = *word;
}

int recorded_classes_begin(struct recorded_classes *classes, const struct recorded_format *format,
                           const char *map, const char *otherwise, struct arena *arena,
                           struct diag *diag)
{
    *classes = (struct recorded_classes){.map = map,
                                         .otherwise = otherwise,
                                         .own = format->words,
                                         .typed = format->jumps,
                                         .arena = arena};
    if (document_list("vehicles", ".json", &classes->vehicles, arena, diag) != 0)
        return -1;
    for (const struct recorded_word *word = format->words; word->word != NULL; word++)
        add(classes, word);
    classes->own_count = classes->words.count;
    for (const char *pair = map; pair != NULL; pair = after_pair(pair)) {
        size_t word = strcspn(pair, "=,"), length = strcspn(pair, ",");
        if (word == 0 || word + 1 >= length)
            return diag_fail(diag, DIAG_USAGE, "--class-map: \"%.*s\"; expected WORD=CLASS",
                             (int)length, pair);
    }
    return 0;
}

/* NULL if there is none of that name. */
static const struct recorded_word *known(const struct recorded_classes *classes, const char *word,
                                         size_t length)
{
    uint32_t number;
    return intern_find(&classes->known, word, length, &number) ? &classes->words.items[number]
                                                               : NULL;
}

static const char *class_of(const struct recorded_classes *classes,
                            const struct recorded_word *found, const char *word, size_t length)
{
    for (const char *pair = classes->map; pair != NULL; pair = after_pair(pair))
        if (strncmp(pair, word, length) == 0 && pair[length] == '=')
            return arena_text(classes->arena, pair + length + 1, strcspn(pair + length + 1, ","));
    if (found != NULL)
        return found->class;
    for (size_t i = 0; i < classes->vehicles.names.count; i++)
        if (strncmp(classes->vehicles.names.items[i], word, length) == 0 &&
            classes->vehicles.names.items[i][length] == '\0')
            return classes->vehicles.names.items[i];
    return NULL;
}

static struct recorded_word answer_to(const struct recorded_classes *classes, const char *word,
                                      const struct recorded_word *found)
{
    size_t length = strlen(word);
    const char *class = class_of(classes, found, word, length);
    if (class == NULL && word[strcspn(word, "@")] == '@') {
        length = strcspn(word, "@");
        found = known(classes, word, length);
        class = class_of(classes, found, word, length);
    }
    struct recorded_word answer = {.class = class != NULL ? class : classes->otherwise};
    const struct recorded_word *own = found == NULL && answer.class != NULL ? classes->own : NULL;
    for (; own != NULL && own->word != NULL && found == NULL; own++)
        if (strcmp(own->class, answer.class) == 0)
            found = own;
    if (found != NULL) {
        answer.length_m = found->length_m;
        answer.width_m = found->width_m;
        answer.height_m = found->height_m;
    }
    return answer;
}

const struct recorded_word *recorded_classes_find(struct recorded_classes *classes,
                                                  const char *word)
{
    uint32_t number = intern_word(&classes->asked, word, classes->arena);
    if (number == classes->answers.count)
        *list_add(&classes->answers, classes->arena) =
            answer_to(classes, word, known(classes, word, strlen(word)));
    const struct recorded_word *answer = &classes->answers.items[number];
    return answer->class != NULL ? answer : NULL;
}

void recorded_classes_add(struct recorded_classes *classes, const char *word, const char *like,
                          double length_m, double width_m, double height_m)
{
    const struct recorded_word *own = classes->own;
    while (own->word != NULL && strcmp(own->word, like) != 0)
        own++;
    struct recorded_word added = answer_to(classes, like, own->word != NULL ? own : NULL);
    if (added.class == NULL)
        return;
    added.word = word;
    added.length_m = length_m != 0 ? length_m : added.length_m;
    added.width_m = width_m != 0 ? width_m : added.width_m;
    added.height_m = height_m != 0 ? height_m : added.height_m;
    add(classes, &added);
}

int recorded_classes_refuse(const struct recorded_classes *classes, const char *word,
                            struct diag *diag)
{
    struct text list = {0};
    for (size_t i = 0; i < classes->words.count; i++)
        text_format(&list, "%s, ", classes->words.items[i].word);
    text_format(&list, "or a class:");
    for (size_t i = 0; i < classes->vehicles.names.count; i++)
        text_format(&list, "%s %s", i > 0 ? "," : "", classes->vehicles.names.items[i]);
    diag_fail(diag, DIAG_DATA,
              "unknown class \"%.80s\"; expected one of %.*s; --class-map %.80s=CLASS or "
              "--class-default CLASS names one%s",
              word, (int)(list.length < 1200 ? list.length : 1200), list.bytes, word,
              classes->typed ? ", but not its size, which is that of its vType: --types FILE" : "");
    text_free(&list);
    return -1;
}

/* ---- types of SUMO ---- */

#define BLANKS " \t\r\n"

enum { ID, CLASS, LENGTH, WIDTH, HEIGHT, ATTRIBUTES, MOST_BYTES = 1 << 30 };

static const char *const attributes[] = {"id", "vClass", "length", "width", "height"};

static bool is(const char *name, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(name, word, length) == 0;
}

/* The end of a comment and the like that begins here, NULL if it has none; at itself where a tag
 * begins. */
static const char *skip(const char *at)
{
    static const char *const marks[][2] = {
        {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"</", ">"}};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (strncmp(at, marks[i][0], strlen(marks[i][0])) == 0) {
            const char *end = strstr(at + strlen(marks[i][0]), marks[i][1]);
            return end != NULL ? end + strlen(marks[i][1]) : NULL;
        }
    return at;
}

/* The end of a tag whose attributes begin here, NULL if it is not well-formed; values may be NULL.
 */
static const char *read_tag(const char *at, const char **values, struct arena *arena)
{
    while (*(at += strspn(at, BLANKS "/")) != '>') {
        size_t length = strcspn(at, BLANKS "=");
        const char *open = at + length + strspn(at + length, BLANKS);
        open += *open == '=' ? 1 + strspn(open + 1, BLANKS) : 0;
        const char *close = *open == '"' || *open == '\'' ? strchr(open + 1, *open) : NULL;
        if (close == NULL)
            return NULL;
        for (size_t i = 0; values != NULL && i < ATTRIBUTES; i++)
            if (is(at, length, attributes[i]))
                values[i] = arena_text(arena, open + 1, (size_t)(close - open - 1));
        at = close + 1;
    }
    return at + 1;
}

/* Is the id that of a type above, with another class or size? */
static bool contradicts(const struct recorded_classes *classes, const struct recorded_word *before,
                        const char *id)
{
    const struct recorded_word *now = known(classes, id, strlen(id));
    return before->word != NULL &&
           (strcmp(before->class, now->class) != 0 || before->length_m != now->length_m ||
            before->width_m != now->width_m || before->height_m != now->height_m);
}

static int add_type(struct recorded_classes *classes, const char *const *values, struct diag *diag)
{
    struct recorded_word before = {0};
    double sizes_m[ATTRIBUTES] = {0};
    if (values[ID] == NULL || !recorded_row_name_fits(values[ID]))
        return diag_fail(diag, DIAG_DATA, "id is \"%.80s\"; expected 1 to 1024 ASCII characters",
                         values[ID] != NULL ? values[ID] : "");
    for (size_t i = LENGTH; i <= HEIGHT; i++)
        if (values[i] != NULL &&
            (field_read_number(values[i], strlen(values[i]), &sizes_m[i]) != 0 ||
             !(sizes_m[i] >= 0 && sizes_m[i] <= 1e6)))
            return diag_fail(diag, DIAG_DATA, "%s is \"%.80s\"; expected a number in [0, 1e+06]",
                             attributes[i], values[i]);
    const struct recorded_word *same = known(classes, values[ID], strlen(values[ID]));
    if (same != NULL && same >= classes->words.items + classes->own_count)
        before = *same;
    recorded_classes_add(classes, values[ID], values[CLASS] != NULL ? values[CLASS] : "passenger",
                         sizes_m[LENGTH], sizes_m[WIDTH], sizes_m[HEIGHT]);
    return contradicts(classes, &before, values[ID])
               ? diag_fail(diag, DIAG_DATA,
                           "id is \"%.80s\", as that of a type above with another class or size; "
                           "expected one type of an id",
                           values[ID])
               : 0;
}

/* Reads the tag, comment or the like that begins here: its end, or NULL after a message. */
static const char *take(struct recorded_classes *classes, const char *at, size_t *depth,
                        struct diag *diag)
{
    const char *values[ATTRIBUTES] = {NULL}, *name = at + 1, *end = skip(at);
    size_t length = strcspn(name, BLANKS "/>");
    bool type = is(name, length, "vType");
    if (*name == '/' && *depth > 0)
        --*depth;
    if (end == at && *depth == 0 && !is(name, length, "routes") && !is(name, length, "additional"))
        diag_fail(diag, DIAG_DATA,
                  "<routes> is missing; expected routes, or additional elements, of SUMO");
    else if (end == at &&
             (end = read_tag(name + length, type ? values : NULL, classes->arena)) != NULL) {
        *depth += end[-2] != '/';
        if (type)
            add_type(classes, values, diag);
    }
    if (end == NULL)
        diag_fail(diag, DIAG_DATA, "a tag or comment is not well-formed or has no end");
    return diag->code == DIAG_OK ? end : NULL;
}

static int read_tags(struct recorded_classes *classes, const char *text, struct diag *diag)
{
    size_t depth = 0, line = 1;
    const char *at = text, *tag;
    while ((tag = strchr(at, '<')) != NULL) {
        at = take(classes, tag, &depth, diag);
        for (const char *mark = text; at == NULL && mark < tag; mark++)
            line += *mark == '\n';
        if (at == NULL)
            return diag_prefix(diag, "line %zu: ", line);
    }
    return at != text && depth == 0
               ? 0
               : diag_fail(diag, DIAG_DATA, "the file ends before </routes> or </additional>");
}

int recorded_classes_read_types(struct recorded_classes *classes, const char *path,
                                struct diag *diag)
{
    struct text text = {0};
    struct input *input = input_open(path, diag);
    if (input != NULL && input_all(input, MOST_BYTES, &text, diag) == 0) {
        *text_room(&text, 1) = '\0';
        if (read_tags(classes, text.bytes, diag) != 0)
            file_format_explain("routes", text.bytes, text.length, diag);
    }
    input_close(input);
    text_free(&text);
    return diag->code == DIAG_OK ? 0 : diag_prefix(diag, "--types: %s: ", path);
}
