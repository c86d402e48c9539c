#include "text/record_read.h"

#include <stdio.h>

#include "base/intern.h"
#include "base/number.h"
#include "text/json_scan.h"

/* Fewer bytes than an object takes in a line, so that names have room. */
enum { BYTES_PER_NAME = 128 };

struct reader {
    struct json_scan scan;
    struct intern names;
    struct list_cache *cache; /* or NULL */
};

static inline int read_member(struct reader *reader, const struct field *field, void *base);
static int read_record(struct reader *reader, const struct record *record, void *base);

/* A message begins with a member's name, or with ": " if it is about the text between members. */
static int unexpected(struct json_scan *scan, const char *what)
{
    json_scan_unexpected(scan, what);
    return diag_prefix(scan->diag, ": ");
}

/* Refuses a value of the wrong kind, or a character that begins no value. */
static int refuse_value(struct json_scan *scan, const struct field *field)
{
    char first = json_scan_peek(scan);
    if (first != '\0' && strchr("\"{[tfn-0123456789", first) != NULL)
        return field_refuse(field, json_scan_kind(scan), scan->diag);
    json_scan_unexpected(scan, "a value");
    return diag_prefix(scan->diag, "%s: ", field->name);
}

/* Stores a name; equal names of a line are one pointer. */
static void keep_name(struct reader *reader, const struct field *field, const char *text,
                      size_t length, void *base)
{
    uint32_t number = intern_number(&reader->names, text, length, reader->scan.arena);
    const char *kept = intern_text(&reader->names, number);
    FIELD_STORE(const char *, field, base, kept);
}

/* Reads a name of plain characters, which needs no check; returns false for any other. */
static bool take_name(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    const char *text = scan->at + 1;
    if (scan->at == scan->end || *scan->at != '"')
        return false;
    size_t length = text_plain(text, (size_t)(scan->end - text));
    if (length == 0 || length > FIELD_NAME_SIZE || text + length == scan->end ||
        text[length] != '"')
        return false;
    scan->at += length + 2;
    keep_name(reader, field, text, length, base);
    return true;
}

/* Reads a whole number as a name: 7 is the name "7". */
static int read_numbered(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    const char *text = scan->at;
    double value;
    if (json_scan_number(scan, &value) != 0)
        return diag_prefix(scan->diag, "%s: ", field->name);
    size_t length = (size_t)(scan->at - text);
    if (memchr(text, '.', length) || memchr(text, 'e', length) || memchr(text, 'E', length))
        return diag_fail(scan->diag, DIAG_DATA, "%s: %.*s is no whole number", field->name,
                         (int)length, text);
    keep_name(reader, field, text, length, base);
    return 0;
}

static int read_choice(struct json_scan *scan, const struct field *field, void *base, size_t index)
{
    struct json_string name;
    if (json_scan_peek(scan) != '"')
        return diag_fail(scan->diag, DIAG_DATA, "%s[%zu]: %s; expected a name", field->name, index,
                         json_scan_kind(scan));
    if (json_scan_string(scan, &name) != 0)
        return diag_prefix(scan->diag, "%s[%zu]: ", field->name, index);
    return field_add_to_set(field, base, name.text, name.length, scan->diag);
}

/* Adds an item to a list of records or names. It begins with the name that it may inherit. */
static void *add_item(const struct field *field, void *base, struct arena *arena)
{
    char *item = field_list_add(field, base, arena);
    const struct field *inherited = field->kind == FIELD_LIST ? field->record->inherited : NULL;
    if (inherited != NULL && field_list(field, base).count > 1)
        FIELD_STORE(const char *, inherited, item,
                    FIELD_LOAD(const char *, inherited, item - field->record->size));
    return item;
}

/* An item is read like a member without a name. */
static int read_list(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    const struct field item = {.name = "",
                               .kind = field->kind == FIELD_LIST ? FIELD_RECORD : FIELD_NAME,
                               .record = field->record};
    if (!json_scan_take(scan, '['))
        return refuse_value(scan, field);
    if (field->kind == FIELD_SET)
        FIELD_STORE(uint64_t, field, base, 0);
    if (json_scan_take(scan, ']'))
        return 0;
    size_t i = 0;
    do {
        if (field->kind == FIELD_SET) {
            if (read_choice(scan, field, base, i) != 0)
                return -1;
        } else if (read_member(reader, &item, add_item(field, base, scan->arena)) != 0) {
            return diag_prefix(scan->diag, "%s[%zu]", field->name, i);
        }
        i++;
    } while (json_scan_take(scan, ','));
    if (json_scan_take(scan, ']'))
        return 0;
    json_scan_unexpected(scan, "',' or ']'");
    return diag_prefix(scan->diag, "%s: ", field->name);
}

/* Takes a list that an earlier line had from the cache. Any other list is read into the memory of
 * the cache, with names of its own. */
static int read_steady(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    struct list_cache *cache = reader->cache;
    const struct list_cache_entry *list =
        list_cache_find(cache, field->record, scan->at, scan->end);
    if (list != NULL) {
        scan->at += list->read.length;
        memcpy((char *)base + field->offset, &list->items, sizeof list->items);
        return 0;
    }
    if (list_cache_full(cache))
        return read_list(reader, field, base);
    struct reader apart = {.scan = {scan->at, scan->end, &cache->arena, scan->diag}};
    if (read_list(&apart, field, base) != 0)
        return -1;
    list_cache_keep(cache, field, base, scan->at, (size_t)(apart.scan.at - scan->at));
    scan->at = apart.scan.at;
    return 0;
}

static int read_raw(struct json_scan *scan, const struct field *field, void *base)
{
    struct json_string bytes;
    if (json_scan_value(scan, &bytes) != 0)
        return diag_prefix(scan->diag, "%s: ", field->name);
    if (bytes.length > FIELD_RAW_SIZE)
        return diag_fail(scan->diag, DIAG_DATA, "%s: %zu bytes; expected at most %d", field->name,
                         bytes.length, FIELD_RAW_SIZE);
    const char *copy = arena_text(scan->arena, bytes.text, bytes.length);
    FIELD_STORE(const char *, field, base, copy);
    return 0;
}

static int read_number(struct json_scan *scan, const struct field *field, void *base)
{
    double number;
    if (json_scan_number(scan, &number) != 0)
        return diag_prefix(scan->diag, "%s: ", field->name);
    return field_set_number(field, base, number, scan->diag);
}

/* Reads a number that number_take can read, if it is in bounds; otherwise returns false. */
static bool take_real(struct json_scan *scan, const struct field *field, void *base)
{
    double number;
    const char *end = number_take(scan->at, scan->end, &number);
    if (end == NULL || !(number >= field->low && number <= field->high))
        return false;
    scan->at = end;
    FIELD_STORE(double, field, base, field_kept(field, number));
    return true;
}

static int read_text(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    struct json_string string;
    if (json_scan_string(scan, &string) != 0)
        return diag_prefix(scan->diag, "%s: ", field->name);
    if (field_set_text(field, base, string.text, string.length, scan->arena, scan->diag) != 0)
        return -1;
    if (field->kind == FIELD_NAME)
        keep_name(reader, field, string.text, string.length, base);
    return 0;
}

static int read_flag(struct json_scan *scan, const struct field *field, void *base)
{
    bool flag;
    if (json_scan_flag(scan, &flag) != 0)
        return diag_prefix(scan->diag, "%s: ", field->name);
    FIELD_STORE(bool, field, base, flag);
    return 0;
}

/* Checks that the value is an object of strings, and keeps nothing of it. */
static int read_notes(struct json_scan *scan, const struct field *field)
{
    struct json_string key, note;
    json_scan_take(scan, '{');
    if (json_scan_take(scan, '}'))
        return 0;
    do {
        if (json_scan_string(scan, &key) != 0)
            return diag_prefix(scan->diag, "%s: ", field->name);
        if (!json_scan_take(scan, ':'))
            return refuse_value(scan, field);
        if (json_scan_peek(scan) != '"')
            return diag_fail(scan->diag, DIAG_DATA, "%s.%.*s: %s; expected a string", field->name,
                             (int)key.length, key.text, json_scan_kind(scan));
        if (json_scan_string(scan, &note) != 0)
            return diag_prefix(scan->diag, "%s: ", field->name);
    } while (json_scan_take(scan, ','));
    return json_scan_take(scan, '}') ? 0 : refuse_value(scan, field);
}

static int read_object(struct reader *reader, const struct field *field, void *base)
{
    struct diag *diag = reader->scan.diag;
    if (read_record(reader, field->record, (char *)base + field->offset) == 0)
        return 0;
    return diag_prefix(diag, "%s%s", field->name, diag->text[0] == ':' ? "" : ".");
}

static int read_value(struct reader *reader, const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    char first = json_scan_peek(scan);
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        if (first == '-' || (first >= '0' && first <= '9'))
            return read_number(scan, field, base);
        break;
    case FIELD_FLAG:
        if (first == 't' || first == 'f')
            return read_flag(scan, field, base);
        break;
    case FIELD_NAME:
        if (field->or_number && (first == '-' || (first >= '0' && first <= '9')))
            return read_numbered(reader, field, base);
        /* fall through */
    case FIELD_CHOICE:
    case FIELD_SEED:
        if (first == '"')
            return read_text(reader, field, base);
        break;
    case FIELD_SET:
    case FIELD_NAMES:
    case FIELD_LIST:
        return field->steady && reader->cache != NULL ? read_steady(reader, field, base)
                                                      : read_list(reader, field, base);
    case FIELD_RECORD:
        if (first == '{')
            return read_object(reader, field, base);
        break;
    case FIELD_RAW:
        return read_raw(scan, field, base);
    case FIELD_NOTES:
        if (first == '{')
            return read_notes(scan, field);
        break;
    }
    return refuse_value(scan, field);
}

/* Reads a number or a name as most are; false for any other value. */
static inline bool take_value(struct reader *reader, const struct field *field, void *base)
{
    return (field->kind == FIELD_REAL && take_real(&reader->scan, field, base)) ||
           (field->kind == FIELD_NAME && take_name(reader, field, base));
}

/* Most members are numbers, names and records: these are tried first. */
static inline int read_member(struct reader *reader, const struct field *field, void *base)
{
    if (take_value(reader, field, base))
        return 0;
    if (field->kind == FIELD_RECORD && json_scan_peek(&reader->scan) == '{')
        return read_object(reader, field, base);
    return read_value(reader, field, base);
}

/* True if the line goes on with this member's key and colon in the writer's spelling. At least
 * FIELD_KEY_SIZE bytes must lie ahead. */
static bool key_is_next(const char *at, const struct field *field)
{
    const char *key = field->key + 1;
    size_t length = field->key_length - 1u;
    uint64_t difference = text_word(at) ^ text_word(key);
    if (length < 8)
        return difference << (64 - 8 * length) == 0;
    for (size_t i = 8; difference == 0 && i + 8 < length; i += 8)
        difference = text_word(at + i) ^ text_word(key + i);
    return difference == 0 && text_word(at + length - 8) == text_word(key + length - 8);
}

/* Reads the next key if it is the key of one of these members in the writer's spelling; returns
 * this member, or NULL. */
static const struct field *take_key(struct json_scan *scan, const struct field *field)
{
    if (scan->end - scan->at < FIELD_KEY_SIZE)
        return NULL;
    while (field->name != NULL && !key_is_next(scan->at, field))
        field++;
    if (field->name == NULL)
        return NULL;
    scan->at += field->key_length - 1;
    return field;
}

/* Reads the key and the colon of any member, in any spelling; NULL after a message. */
static const struct field *read_key(struct json_scan *scan, const struct record *record,
                                    const bool *seen)
{
    struct json_string key;
    const struct field *field = NULL;
    if (json_scan_string(scan, &key) != 0) {
        diag_prefix(scan->diag, ": ");
        return NULL;
    }
    field = field_find(record, key.text, key.length);
    if (field == NULL)
        field_unknown(record, key.text, key.length, scan->diag);
    else if (seen[field - record->fields])
        field_twice(field, scan->diag);
    else if (!json_scan_take(scan, ':'))
        unexpected(scan, "':'");
    else
        return field;
    return NULL;
}

static void note_line(const struct record *record, void *base, struct field_line line)
{
    memcpy((char *)base + record->line_offset, &line, sizeof line);
}

/* Reads a member of a struct that keeps its line, or leaves it unread. */
static int read_with_text(struct reader *reader, const struct record *record,
                          const struct field *field, void *base)
{
    struct json_scan *scan = &reader->scan;
    struct field_line line = field_line(record, base);
    json_scan_peek(scan);
    const char *begin = scan->at;
    if ((line.unread & field->group) == 0 || !json_scan_skip_flat(scan)) {
        if (!take_value(reader, field, base) && read_value(reader, field, base) != 0)
            return -1;
        line.unread &= ~field->group;
        note_line(record, base, line);
    }
    line.texts[field - record->fields] = (struct field_text){begin, (size_t)(scan->at - begin)};
    return 0;
}

static int read_members(struct reader *reader, const struct record *record, void *base, bool *seen)
{
    struct json_scan *scan = &reader->scan;
    const struct field *next = record->fields;
    bool keeps_line = field_line(record, base).texts != NULL;
    do {
        const struct field *field = take_key(scan, next);
        if (field == NULL)
            field = read_key(scan, record, seen);
        if (field == NULL)
            return -1;
        size_t number = (size_t)(field - record->fields);
        if (seen[number])
            return field_twice(field, scan->diag);
        seen[number] = true;
        next = field + 1;
        int result = keeps_line ? read_with_text(reader, record, field, base)
                                : read_member(reader, field, base);
        if (result != 0)
            return -1;
        if (field->group != 0)
            field_mark_present(record, field, base);
    } while (json_scan_take(scan, ','));
    return json_scan_take(scan, '}') ? 0 : unexpected(scan, "',' or '}'");
}

static bool inherits(const struct record *record, const struct field *field, const void *base)
{
    return field == record->inherited && FIELD_LOAD(const char *, field, base) != NULL;
}

/* True if a member that a line does not have is required: by itself, or by others of its group. */
static bool is_missing(const struct record *record, const struct field *field, const void *base)
{
    if (field->group != 0)
        return (field_groups(record, base) & field->group) != 0;
    return !field->optional && !inherits(record, field, base);
}

/* Reads an object into a struct that is zeroed, but for a name that it may inherit. */
static int read_record(struct reader *reader, const struct record *record, void *base)
{
    struct json_scan *scan = &reader->scan;
    bool seen[FIELD_MOST] = {false};
    json_scan_take(scan, '{');
    if (!json_scan_take(scan, '}') && read_members(reader, record, base, seen) != 0)
        return -1;
    const bool *known = seen;
    for (const struct field *field = record->fields; field->name != NULL; field++, known++) {
        if (*known)
            continue;
        if (is_missing(record, field, base))
            return field_refuse(field, "missing", scan->diag);
        if (field->optional && field_absent_differs(field))
            field_set_absent(field, base);
    }
    return 0;
}

static int no_record(struct json_scan *scan, const struct record *record)
{
    char expected[64];
    bool several = record->name[strlen(record->name) - 1] == 's'; /* tracks */
    snprintf(expected, sizeof expected, "%s%s", several ? "" : "a ", record->name);
    return scan->at == scan->end
               ? diag_fail(scan->diag, DIAG_DATA, "an empty line; expected %s", expected)
               : json_scan_unexpected(scan, expected);
}

int record_read(const char *line, size_t length, const struct record *record, void *base,
                struct arena *arena, struct list_cache *cache, struct diag *diag)
{
    struct reader reader = {
        {line, line + length, arena, diag}, intern_begin(length / BYTES_PER_NAME, arena), cache};
    struct json_scan *scan = &reader.scan;
    if (json_scan_peek(scan) != '{')
        return no_record(scan, record);
    if (read_record(&reader, record, base) != 0) {
        if (diag->text[0] == ':')
            memmove(diag->text, diag->text + 2, sizeof diag->text - 2);
        return -1;
    }
    json_scan_peek(scan);
    return scan->at == scan->end ? 0 : json_scan_unexpected(scan, "the end of the line");
}

int record_read_left(const struct record *record, unsigned groups, void *base, struct arena *arena,
                     struct list_cache *cache, struct diag *diag)
{
    struct field_line line = field_line(record, base);
    groups &= line.unread;
    line.unread &= ~groups;
    note_line(record, base, line);
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if ((groups & field->group) == 0)
            continue;
        struct field_text text = line.texts[field - record->fields];
        struct reader reader = {{text.bytes, text.bytes + text.length, arena, diag},
                                intern_begin(text.length / BYTES_PER_NAME, arena),
                                cache};
        if (read_with_text(&reader, record, field, base) != 0)
            return -1;
    }
    return 0;
}
