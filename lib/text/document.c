#include "text/document.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>

#include "base/sort.h"
#include "base/suggestion.h"
#include "text/file_format.h"
#include "text/input.h"
#include "text/record_text.h"

void document_guard_memory(void)
{
    json_set_alloc_funcs(memory_get, free);
}

const char *document_own_folder(struct arena *arena)
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

int document_check_folder(const char *named_by, const char *folder, struct diag *diag)
{
    struct stat status;
    if (stat(folder, &status) == 0 && S_ISDIR(status.st_mode))
        return 0;
    return diag_fail(diag, DIAG_CONFIG, "%s: \"%s\" is no folder", named_by, folder);
}

/* Where documents of a kind may lie, the first place first; all end with a slash. */
struct folders {
    const char *paths[5];
    size_t count;
};

/* own is the user's folder of this kind of documents, or NULL. */
static int find_folders(const char *kind, const char *own, struct folders *folders,
                        struct arena *arena, struct diag *diag)
{
    const char *given = getenv("GLINT_DATA"), *beside = document_own_folder(arena);
    const char *checkout = strcmp(kind, "pipelines") == 0 ? "../../" : "../../data/";
    *folders = (struct folders){0};
    if (own != NULL)
        folders->paths[folders->count++] = arena_format(arena, "%s/", own);
    if (given != NULL && *given != '\0') {
        if (document_check_folder("GLINT_DATA", given, diag) != 0)
            return -1;
        folders->paths[folders->count++] = arena_format(arena, "%s/%s/", given, kind);
    }
    if (*beside != '\0') {
        folders->paths[folders->count++] =
            arena_format(arena, "%s../share/glint/%s/", beside, kind);
        folders->paths[folders->count++] = arena_format(arena, "%s%s%s/", beside, checkout, kind);
    }
    folders->paths[folders->count++] = arena_format(arena, "data/%s/", kind);
    return 0;
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

static void list_names(const struct folders *folders, const char *ending,
                       struct document_names *list, struct arena *arena)
{
    *list = (struct document_names){0};
    for (size_t i = 0; i < folders->count; i++)
        list_folder(folders->paths[i], ending, list, arena);
    sort_list(&list->names, compare_names, arena);
    size_t kept = 0;
    for (size_t i = 0; i < list->names.count; i++)
        if (kept == 0 || strcmp(list->names.items[kept - 1], list->names.items[i]) != 0)
            list->names.items[kept++] = list->names.items[i];
    list->names.count = kept;
}

int document_list(const char *kind, const char *ending, struct document_names *list,
                  struct arena *arena, struct diag *diag)
{
    struct folders folders;
    if (find_folders(kind, NULL, &folders, arena, diag) != 0)
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

/* Says what was meant, where it was looked for, and what is there instead. */
static void refuse_name(const char *kind, const char *name, const char *ending,
                        const struct folders *folders, struct arena *arena, struct diag *diag)
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
    for (size_t i = 0; i < there.names.count; i++)
        append(diag, i == 0 ? "; there are " : ", ", there.names.items[i]);
}

static const char *find_in(const char *own, const char *kind, const char *name, const char *ending,
                           struct arena *arena, struct diag *diag)
{
    struct folders folders;
    if (strpbrk(name, "/.") != NULL || strcmp(name, "-") == 0)
        return arena_text(arena, name, strlen(name));
    if (find_folders(kind, own, &folders, arena, diag) != 0)
        return NULL;
    for (size_t i = 0; i < folders.count; i++) {
        const char *path = arena_format(arena, "%s%s%s", folders.paths[i], name, ending);
        if (access(path, F_OK) == 0)
            return path;
    }
    refuse_name(kind, name, ending, &folders, arena, diag);
    return NULL;
}

const char *document_find(const char *kind, const char *name, const char *ending,
                          struct arena *arena, struct diag *diag)
{
    return find_in(NULL, kind, name, ending, arena, diag);
}

bool document_is_regular(const char *path)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode);
}

const char *document_find_file(const char *own, const char *kind, const char *name,
                               const char *ending, struct arena *arena, struct diag *diag)
{
    if (strcmp(name, "-") == 0) {
        diag_fail(diag, DIAG_CONFIG, "\"-\" is standard input; expected a name in %s/, or a path",
                  kind);
        return NULL;
    }
    const char *path = find_in(own, kind, name, ending, arena, diag);
    if (path == NULL || !document_is_plain(name) || document_is_regular(path))
        return path;
    diag_fail(diag, DIAG_CONFIG, "%s: not a regular file", path);
    return NULL;
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
    char *printed = json_dumps(tree, JSON_COMPACT);
    const char *line = arena_text(arena, printed, strlen(printed));
    free(printed);
    json_decref(tree);
    return line;
}

int document_take(const char *path, const char *line, const struct record *record, void *base,
                  struct arena *arena, struct diag *diag)
{
    memset(base, 0, record->size);
    if (record_text_read(line, strlen(line), record, base, arena, NULL, diag) == 0)
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
