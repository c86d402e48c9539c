#include "recorded/sumo_types.h"

#include "base/text.h"
#include "text/field.h"
#include "text/file_format.h"
#include "text/input.h"

const struct recorded_word sumo_types_words[] = {
#define SUMO(word, class, length_m, width_m, height_m) {word, class, length_m, width_m, height_m},
#include "recorded/recorded_classes.def"
    {0},
};

#define BLANKS " \t\r\n"

enum { ID, CLASS, LENGTH, WIDTH, HEIGHT, ATTRIBUTES, MOST_BYTES = 1 << 30 };

static const char *const attributes[] = {"id", "vClass", "length", "width", "height"};

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
            if (text_is(at, length, attributes[i]))
                values[i] = arena_text(arena, open + 1, (size_t)(close - open - 1));
        at = close + 1;
    }
    return at + 1;
}

static int add_type(struct recorded_classes *classes, const char *const *values, struct diag *diag)
{
    double sizes_m[ATTRIBUTES] = {0};
    const char *id = values[ID], *class = values[CLASS] != NULL ? values[CLASS] : "passenger";
    if (id == NULL || !recorded_row_name_fits(id))
        return diag_fail(diag, DIAG_DATA, "id is \"%.80s\"; expected 1 to 1024 ASCII characters",
                         id != NULL ? id : "");
    for (size_t i = LENGTH; i <= HEIGHT; i++)
        if (values[i] != NULL &&
            (field_read_number(values[i], strlen(values[i]), &sizes_m[i]) != 0 ||
             !(sizes_m[i] >= 0 && sizes_m[i] <= 1e6)))
            return diag_fail(diag, DIAG_DATA, "%s is \"%.80s\"; expected a number in [0, 1e+06]",
                             attributes[i], values[i]);
    const struct recorded_word type = {id, class, sizes_m[LENGTH], sizes_m[WIDTH], sizes_m[HEIGHT]};
    return recorded_classes_add(classes, type)
               ? 0
               : diag_fail(diag, DIAG_DATA,
                           "id is \"%.80s\", as that of a type above with another class or size; "
                           "expected one type of an id",
                           id);
}

/* Reads the tag, comment or the like that begins here: its end, or NULL after a message. */
static const char *take(struct recorded_classes *classes, const char *at, size_t *depth,
                        struct diag *diag)
{
    const char *values[ATTRIBUTES] = {NULL}, *name = at + 1, *end = skip(at);
    size_t length = strcspn(name, BLANKS "/>");
    bool type = text_is(name, length, "vType");
    if (*name == '/' && *depth > 0)
        --*depth;
    if (end == at && *depth == 0 && !text_is(name, length, "routes") &&
        !text_is(name, length, "additional"))
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

int sumo_types_read(struct recorded_classes *classes, const char *path, struct diag *diag)
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
