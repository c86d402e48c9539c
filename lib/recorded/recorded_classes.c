#include "recorded/recorded_classes.h"

#include "base/suggestion.h"
#include "documents/vehicle.h"

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

static int check_class(const char *option, const char *class, struct diag *diag)
{
    if (class == NULL || vehicle_check_class(class, diag) == 0)
        return 0;
    diag->code = DIAG_USAGE;
    return diag_prefix(diag, "%s: ", option);
}

static int check_map(const struct recorded_classes *classes, struct diag *diag)
{
    for (const char *pair = classes->map; pair != NULL; pair = after_pair(pair)) {
        size_t word = strcspn(pair, "=,"), length = strcspn(pair, ",");
        if (word == 0 || word + 1 >= length)
            return diag_fail(diag, DIAG_USAGE, "--class-map: \"%.*s\"; expected WORD=CLASS",
                             (int)length, pair);
        const char *class = arena_text(classes->arena, pair + word + 1, length - word - 1);
        if (check_class("--class-map", class, diag) != 0)
            return -1;
    }
    return 0;
}

int recorded_classes_begin(struct recorded_classes *classes, const struct recorded_format *format,
                           const char *map, const char *otherwise, struct arena *arena,
                           struct diag *diag)
{
    *classes = (struct recorded_classes){
        .format = format, .map = map, .otherwise = otherwise, .arena = arena};
    if (document_list("vehicles", ".json", &classes->vehicles, arena, diag) != 0)
        return -1;
    for (const struct recorded_word *word = format->words; word->word != NULL; word++)
        add(classes, word);
    classes->own_count = classes->words.count;
    return check_map(classes, diag) == 0 && check_class("--class-default", otherwise, diag) == 0
               ? 0
               : -1;
}

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

/* The first word of this class, or NULL. */
static const struct recorded_word *first_of_class(const struct recorded_word *words,
                                                  const char *class)
{
    while (words->word != NULL && (words->class == NULL || strcmp(words->class, class) != 0))
        words++;
    return words->word != NULL ? words : NULL;
}

/* Takes the sizes that a word lacks from another one, if there is one. */
static void take_sizes(struct recorded_word *word, const struct recorded_word *from)
{
    if (from == NULL)
        return;
    word->length_m = word->length_m != 0 ? word->length_m : from->length_m;
    word->width_m = word->width_m != 0 ? word->width_m : from->width_m;
    word->height_m = word->height_m != 0 ? word->height_m : from->height_m;
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
    take_sizes(&answer, found);
    if (answer.class != NULL && (found == NULL || found->class == NULL))
        take_sizes(&answer, first_of_class(classes->format->words, answer.class));
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

/* False if there is another added type of this name. */
static bool add_type(struct recorded_classes *classes, struct recorded_word type)
{
    const struct recorded_word *own = classes->format->words;
    const struct recorded_word *before = known(classes, type.word, strlen(type.word));
    while (own->word != NULL && strcmp(own->word, type.class) != 0)
        own++;
    struct recorded_word meant = answer_to(classes, type.class, own->word != NULL ? own : NULL);
    classes->has_types = true;
    if (meant.class == NULL) {
        *list_add(&classes->strange, classes->arena) = type;
        type.class = NULL;
        add(classes, &type);
        return true;
    }
    type.class = meant.class;
    take_sizes(&type, &meant);
    if (before != NULL && before >= classes->words.items + classes->own_count)
        return before->class != NULL && strcmp(before->class, type.class) == 0 &&
               before->length_m == type.length_m && before->width_m == type.width_m &&
               before->height_m == type.height_m;
    add(classes, &type);
    return true;
}

int recorded_classes_add(struct recorded_classes *classes, const struct recorded_types *types,
                         struct diag *diag)
{
    for (size_t i = 0; i < types->list.count; i++) {
        const struct recorded_type *type = &types->list.items[i];
        if (!add_type(classes, type->word))
            return diag_fail(diag, DIAG_DATA,
                             "--types: %s: line %zu: id is \"%.80s\", as that of a type above with "
                             "another class or size; expected one type of an id",
                             type->file, type->line, type->word.word);
    }
    return 0;
}

/* The added type of this name, or of the part before "@", whose class is no word; NULL: none. */
static const struct recorded_word *strange_type(const struct recorded_classes *classes,
                                                const char *word)
{
    size_t whole = strlen(word), part = strcspn(word, "@");
    for (size_t i = 0; i < classes->strange.count; i++) {
        const struct recorded_word *type = &classes->strange.items[i];
        if (text_is(word, whole, type->word) || text_is(word, part, type->word))
            return type;
    }
    return NULL;
}

static int refuse_unknown(const struct recorded_classes *classes, const char *word,
                          struct diag *diag)
{
    struct suggestion meant = suggestion_begin(word, strlen(word));
    for (size_t i = 0; i < classes->words.count; i++)
        suggestion_offer(&meant, classes->words.items[i].word);
    for (size_t i = 0; i < classes->vehicles.names.count; i++)
        suggestion_offer(&meant, classes->vehicles.names.items[i]);
    const char *sizes = "";
    if (classes->format->of_sumo && classes->has_types)
        sizes = ", but not its size, which is that of its vType, and no file of --types has it";
    else if (classes->format->of_sumo)
        sizes = ", but not its size, which is that of its vType: glint-traffic-sumo --types FILE";
    return diag_fail(
        diag, DIAG_DATA,
        "unknown class \"%.80s\"%s; expected a word that --help lists, or a name that glint --list "
        "vehicles lists; --class-map %.80s=CLASS or --class-default CLASS names one%s",
        word, suggestion_question(&meant, ""), word, sizes);
}

int recorded_classes_refuse(const struct recorded_classes *classes, const char *word,
                            const char *untold, struct diag *diag)
{
    const struct recorded_word *type = strange_type(classes, word);
    if (untold != NULL)
        return diag_fail(diag, DIAG_DATA,
                         "%s; --class-map %s=CLASS or --class-default CLASS names one", untold,
                         word);
    if (type != NULL)
        return diag_fail(diag, DIAG_DATA,
                         "type \"%.80s\" has vClass \"%.80s\"; expected one that --help lists; "
                         "--class-map %.80s=CLASS or --class-default CLASS names one",
                         type->word, type->class, type->class);
    return refuse_unknown(classes, word, diag);
}
