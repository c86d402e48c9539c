#include "text/document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <jansson.h>

#include "text/input.h"

void document_guard_memory(void)
{
    json_set_alloc_funcs(memory_get, free);
}

static const char *join(struct arena *arena, const char *a, const char *b, const char *c,
                        const char *d)
{
    size_t size = strlen(a) + strlen(b) + strlen(c) + strlen(d) + 1;
    char *whole = arena_get(arena, size);
    snprintf(whole, size, "%s%s%s%s", a, b, c, d);
    return whole;
}

/* The folder of the running executable, with a slash at its end; "" if the system does not tell
 * it. */
static const char *own_folder(struct arena *arena)
{
    enum { ROOM = 4096 };
    char *path = arena_get(arena, ROOM);
    ssize_t length = readlink("/proc/self/exe", path, ROOM - 1);
    if (length <= 0)
        return "";
    path[length] = '\0';
    char *slash = strrchr(path, '/');
    slash[1] = '\0';
    return path;
}

const char *document_find(const char *kind, const char *name, const char *ending,
                          struct arena *arena, struct diag *diag)
{
    if (strpbrk(name, "/.") != NULL || strcmp(name, "-") == 0)
        return arena_text(arena, name, strlen(name));
    const char *given = getenv("GLINT_DATA");
    const char *beside = own_folder(arena);
    const char *folders[] = {
        given != NULL && *given != '\0' ? join(arena, given, "/", "", "") : NULL,
        *beside != '\0' ? join(arena, beside, "../share/glint/", "", "") : NULL,
        *beside != '\0' ? join(arena, beside, "../../data/", "", "") : NULL,
        "data/",
    };
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        if (folders[i] == NULL)
            continue;
        const char *path = join(arena, join(arena, folders[i], kind, "/", ""), name, ending, "");
        if (access(path, F_OK) == 0)
            return path;
    }
    diag_fail(diag, DIAG_CONFIG, "there is no %s/%s%s; looked in", kind, name, ending);
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        size_t used = strlen(diag->text);
        if (folders[i] != NULL)
            snprintf(diag->text + used, sizeof diag->text - used, "%s %s",
                     diag->text[used - 1] == 'n' ? "" : ",", folders[i]);
    }
    return NULL;
}

static int read_object(const json_t *tree, const struct record *record, void *base,
                       struct arena *arena, struct diag *diag);

static const char *kind_of(const json_t *value)
{
    static const char *const kinds[] = {
        [JSON_OBJECT] = "an object",    [JSON_ARRAY] = "an array", [JSON_STRING] = "a string",
        [JSON_INTEGER] = "a number",    [JSON_REAL] = "a number",  [JSON_TRUE] = "true or false",
        [JSON_FALSE] = "true or false", [JSON_NULL] = "null",
    };
    return kinds[json_typeof(value)];
}

static int read_list(const json_t *tree, const struct field *field, void *base, struct arena *arena,
                     struct diag *diag)
{
    size_t index;
    json_t *item;
    json_array_foreach(tree, index, item)
    {
        void *place = field_list_add(field, base, arena);
        if (!json_is_object(item))
            return diag_fail(diag, DIAG_DATA, "%s[%zu]: %s; expected an object", field->name, index,
                             kind_of(item));
        if (read_object(item, field->record, place, arena, diag) != 0)
            return diag_prefix(diag, "%s[%zu].", field->name, index);
    }
    return 0;
}

static int read_names(const json_t *tree, const struct field *field, void *base,
                      struct arena *arena, struct diag *diag)
{
    const struct field name = {.name = field->name, .kind = FIELD_NAME};
    size_t index;
    json_t *item;
    json_array_foreach(tree, index, item)
    {
        if (!json_is_string(item))
            return field_wrong_kind(&name, kind_of(item), diag);
        if (field_set_text(&name, field_list_add(field, base, arena), json_string_value(item),
                           json_string_length(item), arena, diag) != 0)
            return -1;
    }
    return 0;
}

static int check_notes(const json_t *tree, const struct field *field, struct diag *diag)
{
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)tree, key, value)
    {
        if (!json_is_string(value))
            return diag_fail(diag, DIAG_DATA, "%s.%s: %s; expected a string", field->name, key,
                             kind_of(value));
    }
    return 0;
}

static int read_member(const json_t *tree, const struct field *field, void *base,
                       struct arena *arena, struct diag *diag)
{
    void *member = (char *)base + field->offset;
    if (field->kind == FIELD_RECORD && json_is_object(tree))
        return read_object(tree, field->record, member, arena, diag) == 0
                   ? 0
                   : diag_prefix(diag, "%s.", field->name);
    if (field->kind == FIELD_LIST && json_is_array(tree))
        return read_list(tree, field, base, arena, diag);
    if (field->kind == FIELD_NAMES && json_is_array(tree))
        return read_names(tree, field, base, arena, diag);
    if (field->kind == FIELD_NOTES && json_is_object(tree))
        return check_notes(tree, field, diag);
    if (field->kind == FIELD_FLAG && json_is_boolean(tree)) {
        memcpy(member, &(bool){json_is_true(tree)}, sizeof(bool));
        return 0;
    }
    if (json_is_number(tree))
        return field_set_number(field, base, json_number_value(tree), diag);
    if (json_is_string(tree))
        return field_set_text(field, base, json_string_value(tree), json_string_length(tree), arena,
                              diag);
    return field_wrong_kind(field, kind_of(tree), diag);
}

static int read_object(const json_t *tree, const struct record *record, void *base,
                       struct arena *arena, struct diag *diag)
{
    uint64_t seen = 0;
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)tree, key, value)
    {
        const struct field *field = field_find(record, key, strlen(key), 0);
        if (field == NULL || field->kind == FIELD_RAW)
            return field_unknown(record, key, strlen(key), diag);
        seen |= UINT64_C(1) << (field - record->fields);
        if (read_member(value, field, base, arena, diag) != 0)
            return -1;
        field_mark_present(record, field, base);
    }
    return field_require(record, seen, diag);
}

int document_parse(const char *path, const struct text *text, const struct record *record,
                   void *base, struct arena *arena, struct diag *diag)
{
    json_error_t error;
    json_t *tree = json_loadb(text->bytes, text->length, JSON_REJECT_DUPLICATES, &error);
    if (tree == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s:%d: %s", path, error.line, error.text);
    field_clear(record, base);
    int result = json_is_object(tree)
                     ? read_object(tree, record, base, arena, diag)
                     : diag_fail(diag, DIAG_CONFIG, "%s; expected an object", kind_of(tree));
    json_decref(tree);
    if (result != 0) {
        diag->code = DIAG_CONFIG;
        return diag_prefix(diag, "%s: ", path);
    }
    return 0;
}

int document_bytes(const char *path, struct text *text, struct diag *diag)
{
    struct input *input = input_open(path, diag);
    int result = input != NULL ? input_all(input, DOCUMENT_SIZE, text, diag) : -1;
    input_close(input);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", path);
}

int document_read(const char *path, const struct record *record, void *base, struct arena *arena,
                  struct diag *diag)
{
    struct text text = {0};
    int result = document_bytes(path, &text, diag);
    if (result == 0)
        result = document_parse(path, &text, record, base, arena, diag);
    text_free(&text);
    return result;
}
