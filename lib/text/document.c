#include "text/document.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>

#include "base/hash.h"
#include "base/number.h"
#include "base/sort.h"
#include "base/suggestion.h"
#include "text/file_format.h"
#include "text/input.h"
#include "text/json_scan.h"
#include "text/path.h"
#include "text/record_read.h"

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

/* Folders of documents of a kind, in the order of search; all end with a slash. */
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

/* Names a similar document, the folders searched, and the command that lists all documents. */
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
    if (there.names.count > 0)
        append(diag, "; all are listed by glint --list ", kind);
}

const char *document_find(const char *own, const char *kind, const char *name, const char *ending,
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

/* ---- distributions ---- */

#define LAW(names, laws)                                                                           \
    "{\"description\": \"" names "\", \"type\": \"object\", \"minProperties\": 1, "                \
    "\"maxProperties\": 1, \"additionalProperties\": false, \"properties\": {\n      "             \
    "\"choice\": {\"type\": \"array\", \"minItems\": 1}" laws "}}"
#define PAIR                                                                                       \
    "{\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 2, \"maxItems\": 2}"
const char document_drawn_schema[] =
    ",\n  \"$defs\": {\n    \"drawn\": " LAW("choice", "") ",\n    \"drawn_number\": " LAW(
        "uniform, normal or choice", ", \"uniform\": " PAIR ", \"normal\": " PAIR) "\n  }";

struct variation {
    struct json_scan scan;
    struct random_address address;
    struct text path;  /* of the value that is being read */
    struct text drawn; /* the line so far */
};

static int draw_value(struct variation *variation);

/* Draws a value, and then cuts the path to its length outside of this value. */
static int draw_part(struct variation *variation, size_t outside)
{
    int result = draw_value(variation);
    variation->path.length = outside;
    return result;
}

/* Reads the key of a member, copies it, and adds it to the path. */
static int copy_key(struct variation *variation)
{
    struct json_string key;
    if (json_scan_string(&variation->scan, &key) != 0)
        return -1;
    text_add_json(&variation->drawn, key.text, key.length);
    text_add(&variation->drawn, ":", 1);
    json_scan_take(&variation->scan, ':');
    text_format(&variation->path, "%s%.*s", variation->path.length > 0 ? "." : "", (int)key.length,
                key.text);
    return 0;
}

/* Draws the values within an array or an object, which ends with this character. */
static int draw_within(struct variation *variation, char end)
{
    struct json_scan *scan = &variation->scan;
    size_t outside = variation->path.length;
    text_add(&variation->drawn, scan->at++, 1);
    for (size_t i = 0; !json_scan_take(scan, end); i++) {
        if (json_scan_take(scan, ','))
            text_add(&variation->drawn, ",", 1);
        if (end == ']')
            text_format(&variation->path, "[%zu]", i);
        else if (copy_key(variation) != 0)
            return -1;
        if (draw_part(variation, outside) != 0)
            return -1;
    }
    text_add(&variation->drawn, &end, 1);
    return 0;
}

/* Reads an array of two numbers; false if it is something else. */
static bool read_pair(struct json_scan values, double pair[2])
{
    struct diag unread = {0};
    values.diag = &unread;
    return json_scan_take(&values, '[') && json_scan_number(&values, &pair[0]) == 0 &&
           json_scan_take(&values, ',') && json_scan_number(&values, &pair[1]) == 0 &&
           json_scan_take(&values, ']') && fabs(pair[0]) < 1e300 && fabs(pair[1]) < 1e300;
}

static void add_number(struct variation *variation, double value)
{
    struct text *drawn = &variation->drawn;
    drawn->length += number_write(value, text_room(drawn, NUMBER_SIZE));
}

/* Each law draws one value: returns 1, or 0 if its values are not as expected, or -1 after a
 * message. */
static int draw_uniform(struct variation *variation, struct json_scan values)
{
    double pair[2];
    if (!read_pair(values, pair) || pair[0] > pair[1])
        return 0;
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    add_number(variation, random_sequence_between(&sequence, pair[0], pair[1]));
    return 1;
}

static int draw_normal(struct variation *variation, struct json_scan values)
{
    double pair[2], gaussian[2];
    if (!read_pair(values, pair) || pair[1] < 0)
        return 0;
    random_gaussian_pair(&variation->address, RANDOM_VARIATION, 0, gaussian);
    add_number(variation, pair[0] + pair[1] * gaussian[0]);
    return 1;
}

static int draw_choice(struct variation *variation, struct json_scan values)
{
    struct json_scan begin = values;
    struct json_string item;
    int64_t count = 0;
    if (!json_scan_take(&values, '[') || json_scan_peek(&values) == ']')
        return 0;
    do {
        json_scan_value(&values, &item);
        count++;
    } while (json_scan_take(&values, ','));
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    int64_t chosen = random_sequence_whole(&sequence, 0, count - 1);
    json_scan_take(&begin, '[');
    for (int64_t i = 0; i < chosen; i++) {
        json_scan_value(&begin, &item);
        json_scan_take(&begin, ',');
    }
    struct json_scan behind = variation->scan;
    variation->scan = begin;
    size_t outside = variation->path.length;
    text_format(&variation->path, ".choice[%d]", (int)chosen);
    int result = draw_part(variation, outside);
    variation->scan = behind;
    return result == 0 ? 1 : -1;
}

static const struct law {
    const char *name, *expected;
    int (*draw)(struct variation *variation, struct json_scan values);
} laws[] = {
    {"uniform", "[low, high], numbers, low not above high", draw_uniform},
    {"normal", "[mean, sd], numbers, sd not below 0", draw_normal},
    {"choice", "an array of one value or more", draw_choice},
};

/* The law that an object names by its first member; NULL if it is no distribution. The cursor of
 * the scan, a copy, is then at the values of the law. */
static const struct law *find_law(struct json_scan *scan)
{
    struct json_string key;
    if (!json_scan_take(scan, '{') || json_scan_peek(scan) != '"' ||
        json_scan_string(scan, &key) != 0 || !json_scan_take(scan, ':'))
        return NULL;
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
        if (text_is(key.text, key.length, laws[i].name))
            return &laws[i];
    return NULL;
}

static int draw_law(struct variation *variation, const struct law *law, struct json_scan values)
{
    struct json_scan *scan = &variation->scan;
    struct json_string whole, bytes;
    json_scan_value(scan, &whole);
    variation->address.item = hash_bytes(HASH_START, variation->path.bytes, variation->path.length);
    struct json_scan behind = values;
    json_scan_value(&behind, &bytes);
    int result = json_scan_take(&behind, '}') ? law->draw(variation, values) : 0;
    if (result != 0)
        return result > 0 ? 0 : -1;
    return diag_fail(scan->diag, DIAG_CONFIG, "%.*s: %.*s; expected {\"%s\": %s}",
                     (int)variation->path.length, variation->path.bytes,
                     whole.length < 200 ? (int)whole.length : 200, whole.text, law->name,
                     law->expected);
}

static int draw_value(struct variation *variation)
{
    struct json_scan *scan = &variation->scan, values = *scan;
    struct json_string bytes;
    const struct law *law = find_law(&values);
    if (law != NULL)
        return draw_law(variation, law, values);
    if (json_scan_peek(scan) == '{' || *scan->at == '[')
        return draw_within(variation, *scan->at == '{' ? '}' : ']');
    if (json_scan_value(scan, &bytes) != 0)
        return -1;
    text_add(&variation->drawn, bytes.text, bytes.length);
    return 0;
}

const char *document_draw(const char *line, struct random_address address, struct arena *arena,
                          struct diag *diag)
{
    struct variation variation = {{line, line + strlen(line), arena, diag}, .address = address};
    int result = draw_value(&variation);
    const char *drawn =
        result == 0 ? arena_text(arena, variation.drawn.bytes, variation.drawn.length) : NULL;
    text_free(&variation.path);
    text_free(&variation.drawn);
    return drawn;
}
