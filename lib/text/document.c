#include "text/document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>

#include "text/input.h"
#include "text/record_text.h"

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

const char *document_find(const char *kind, const char *name, const char *ending,
                          struct arena *arena, struct diag *diag)
{
    if (strpbrk(name, "/.") != NULL || strcmp(name, "-") == 0)
        return arena_text(arena, name, strlen(name));
    const char *given = getenv("GLINT_DATA");
    const char *beside = document_own_folder(arena);
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

bool document_is_plain(const char *name)
{
    return strchr(name, '/') == NULL;
}

bool document_is_regular(const char *path)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode);
}

const char *document_find_file(const char *kind, const char *name, const char *ending,
                               struct arena *arena, struct diag *diag)
{
    if (strcmp(name, "-") == 0) {
        diag_fail(diag, DIAG_CONFIG, "\"-\" is standard input; expected a name in %s/, or a path",
                  kind);
        return NULL;
    }
    const char *path = document_find(kind, name, ending, arena, diag);
    if (path == NULL || !document_is_plain(name) || document_is_regular(path))
        return path;
    diag_fail(diag, DIAG_CONFIG, "%s: not a regular file", path);
    return NULL;
}

/* jansson checks the text and says in which line it is wrong. What it read is written as one line,
 * for the reader of records. */
int document_parse(const char *path, const struct text *text, const struct record *record,
                   void *base, struct arena *arena, struct diag *diag)
{
    json_error_t error;
    json_t *tree = json_loadb(text->bytes, text->length, JSON_REJECT_DUPLICATES, &error);
    if (tree == NULL)
        return diag_fail(diag, DIAG_CONFIG, "%s:%d: %s", path, error.line, error.text);
    char *line = json_dumps(tree, JSON_COMPACT);
    memset(base, 0, record->size);
    int result = record_text_read(line, strlen(line), record, base, arena, NULL, diag);
    free(line);
    json_decref(tree);
    if (result == 0)
        return 0;
    diag->code = DIAG_CONFIG;
    return diag_prefix(diag, "%s: ", path);
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
