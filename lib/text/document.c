#include "text/document.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <jansson.h>

#include "base/hash.h"
#include "base/sort.h"
#include "base/suggestion.h"
#include "text/data_folder.h"
#include "text/file_format.h"
#include "text/input.h"
#include "text/path.h"
#include "text/record_read.h"

void document_guard_memory(void)
{
    json_set_alloc_funcs(memory_get, free);
}

static void list_folder(const char *folder, const char *ending, struct document_names *list,
                        struct arena *arena)
{
    DIR *entries = opendir(folder);
    if (entries == NULL)
        return;
    for (struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        size_t length = strlen(entry->d_name), tail = strlen(ending);
        if (length > tail && strcmp(entry->d_name + length - tail, ending) == 0 &&
            strcspn(entry->d_name, ".") == length - tail)
            *list_add(&list->names, arena) = arena_text(arena, entry->d_name, length - tail);
    }
    closedir(entries);
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

void document_names_order(struct document_names *list, struct arena *arena)
{
    sort_list(&list->names, compare_names, arena);
    size_t kept = 0;
    for (size_t i = 0; i < list->names.count; i++)
        if (kept == 0 || strcmp(list->names.items[kept - 1], list->names.items[i]) != 0)
            list->names.items[kept++] = list->names.items[i];
    list->names.count = kept;
}

static void list_names(const struct data_folders *folders, const char *ending,
                       struct document_names *list, struct arena *arena)
{
    *list = (struct document_names){0};
    for (size_t i = 0; i < folders->count; i++)
        list_folder(folders->paths[i], ending, list, arena);
    document_names_order(list, arena);
}

int document_list(const char *kind, const char *ending, struct document_names *list,
                  struct arena *arena, struct diag *diag)
{
    struct data_folders folders;
    if (data_folder_list(NULL, kind, &folders, arena, diag) != 0)
        return -1;
    list_names(&folders, ending, list, arena);
    return 0;
}

const char *document_origin(const char *path, struct arena *arena)
{
    json_t *tree = json_load_file(path, 0, NULL);
    const char *origin = json_string_value(json_object_get(tree, "origin"));
    if (origin != NULL)
        origin = arena_text(arena, origin, strlen(origin));
    json_decref(tree);
    return origin;
}

static void append(struct diag *diag, const char *separator, const char *text)
{
    size_t used = strlen(diag->text);
    snprintf(diag->text + used, sizeof diag->text - used, "%s%s", separator, text);
}

/* Names a similar document, the folders searched, and the command that lists all documents. */
static void refuse_name(const char *kind, const char *name, const char *ending,
                        const struct data_folders *folders, struct arena *arena, struct diag *diag)
{
    struct document_names there;
    list_names(folders, ending, &there, arena);
    struct suggestion meant = suggestion_begin(name, strlen(name));
    for (size_t i = 0; i < there.names.count; i++)
        suggestion_offer(&meant, there.names.items[i]);
    diag_fail(diag, DIAG_CONFIG, "there is no %s/%s%s%s; looked in", kind, name, ending,
              suggestion_question(&meant, ""));
    for (size_t i = 0; i < folders->count; i++)
        append(diag, i == 0 ? " " : ", ", folders->paths[i]);
    if (there.names.count > 0)
        append(diag, "; all are listed by glint --list ", kind);
}

const char *document_find(const char *own, const char *kind, const char *name, const char *ending,
                          struct arena *arena, struct diag *diag)
{
    struct data_folders folders;
    if (document_is_path(name))
        return arena_text(arena, name, strlen(name));
    if (data_folder_list(own, kind, &folders, arena, diag) != 0)
        return NULL;
    for (size_t i = 0; i < folders.count; i++) {
        const char *path = arena_format(arena, "%s%s%s", folders.paths[i], name, ending);
        if (access(path, F_OK) == 0)
            return path;
    }
    refuse_name(kind, name, ending, &folders, arena, diag);
    return NULL;
}

const char *document_find_file(const char *own, const char *kind, const char *name,
                               const char *ending, struct arena *arena, struct diag *diag)
{
    if (strcmp(name, "-") == 0) {
        diag_fail(diag, DIAG_CONFIG, "\"-\" is standard input; expected a name in %s/, or a path",
                  kind);
        return NULL;
    }
    const char *path = document_find(own, kind, name, ending, arena, diag);
    if (path == NULL || !document_is_plain(name) || !path_is_special(path))
        return path;
    diag_fail(diag, DIAG_CONFIG, "%s: not a regular file", path);
    return NULL;
}

/* Frees the tree, and returns it as a line of JSON; NULL for NULL. */
static const char *print(json_t *tree, struct arena *arena)
{
    char *printed = json_dumps(tree, JSON_COMPACT | JSON_ENCODE_ANY);
    const char *line = printed != NULL ? arena_text(arena, printed, strlen(printed)) : NULL;
    free(printed);
    json_decref(tree);
    return line;
}

const char *document_line(const char *path, const struct text *bytes, const char *kind,
                          struct arena *arena, struct diag *diag)
{
    json_error_t error;
    json_t *tree = json_loadb(bytes->bytes, bytes->length, JSON_REJECT_DUPLICATES, &error);
    if (tree == NULL) {
        diag_fail(diag, DIAG_CONFIG, "%d: %s", error.line, error.text);
        bool named = file_format_explain(kind, bytes->bytes, bytes->length, diag);
        diag_prefix(diag, named ? "%s: " : "%s:", path);
        return NULL;
    }
    return print(tree, arena);
}

int document_take(const char *path, const char *line, const struct record *record, void *base,
                  struct arena *arena, struct diag *diag)
{
    memset(base, 0, record->size);
    if (record_read(line, strlen(line), record, base, arena, NULL, diag) == 0)
        return 0;
    diag->code = DIAG_CONFIG;
    file_format_explain(record->name, line, strlen(line), diag);
    return diag_prefix(diag, "%s: ", path);
}

int document_parse(const char *path, const struct text *bytes, const struct record *record,
                   void *base, struct arena *arena, struct diag *diag)
{
    const char *line = document_line(path, bytes, record->name, arena, diag);
    return line != NULL ? document_take(path, line, record, base, arena, diag) : -1;
}

int document_bytes(const char *path, struct text *text, struct diag *diag)
{
    struct input *input = input_open(path, diag);
    int result = input != NULL ? input_all(input, DOCUMENT_SIZE, text, diag) : -1;
    input_close(input);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", path);
}

/* ---- documents that extend others ---- */

const char *document_base(const char *line, struct arena *arena, struct diag *diag)
{
    /* Most documents extend none: they need not be read a second time to say so. */
    if (strstr(line, "\"extends\"") == NULL)
        return NULL;
    json_t *tree = json_loads(line, 0, NULL);
    json_t *base = json_object_get(tree, "extends");
    const char *name = json_string_value(base);
    if (name != NULL)
        name = arena_text(arena, name, strlen(name));
    else if (base != NULL)
        diag_fail(diag, DIAG_CONFIG, "extends: expected the name or the path of a document");
    json_decref(tree);
    return name;
}

/* The item of this name; NULL if there is none, or if the items are no objects with names. */
static json_t *find_item(json_t *list, const char *name)
{
    size_t i;
    json_t *item;
    json_array_foreach(list, i, item)
    {
        const char *own = json_string_value(json_object_get(item, "name"));
        if (own != NULL && strcmp(own, name) == 0)
            return item;
    }
    return NULL;
}

static bool has_names(json_t *list)
{
    size_t i;
    json_t *item;
    json_array_foreach(list, i, item)
    {
        if (!json_is_string(json_object_get(item, "name")))
            return false;
    }
    return json_array_size(list) > 0;
}

static void extend_object(json_t *base, json_t *own);

static void extend_list(json_t *base, json_t *own)
{
    size_t i;
    json_t *item;
    json_array_foreach(own, i, item)
    {
        json_t *there = find_item(base, json_string_value(json_object_get(item, "name")));
        if (there != NULL)
            extend_object(there, item);
        else
            json_array_append(base, item);
    }
}

static void extend_object(json_t *base, json_t *own)
{
    const char *key;
    json_t *value;
    json_object_foreach(own, key, value)
    {
        json_t *there = json_object_get(base, key);
        if (json_is_null(value))
            json_object_del(base, key);
        else if (json_is_object(there) && json_is_object(value))
            extend_object(there, value);
        else if (has_names(there) && has_names(value))
            extend_list(there, value);
        else
            json_object_set(base, key, value);
    }
}

const char *document_extended(const char *base, const char *own, struct arena *arena)
{
    json_t *tree = json_loads(base, 0, NULL), *changes = json_loads(own, 0, NULL);
    extend_object(tree, changes);
    json_object_del(tree, "extends");
    json_decref(changes);
    return print(tree, arena);
}

static bool is_among(const char *const *names, const char *name)
{
    while (*names != NULL && strcmp(*names, name) != 0)
        names++;
    return *names != NULL;
}

static void move(json_t *tree, const char *const *names, const char *folder)
{
    size_t i;
    const char *key;
    json_t *part;
    json_array_foreach(tree, i, part)
    {
        move(part, names, folder);
    }
    json_object_foreach(tree, key, part)
    {
        const char *path = json_string_value(part);
        if (path == NULL)
            move(part, names, folder);
        else if (is_among(names, key) && path[0] != '/')
            json_object_set_new(tree, key, json_sprintf("%s%s", folder, path));
    }
}

const char *document_moved(const char *line, const char *const *names, const char *folder,
                           struct arena *arena)
{
    json_t *tree = json_loads(line, 0, NULL);
    move(tree, names, folder);
    return print(tree, arena);
}
