#include "text/record_write.h"

#include "base/number.h"

/* Structs at equal distances, size bytes from one to the next: list items, or structs embedded in
 * them. at is set to the index of the first faulty one. */
struct items {
    const char *first;
    size_t size, count;
    size_t at;
};

static int check_records(const struct record *record, struct items *items, unsigned groups,
                         struct diag *diag);

/* True if all values of a member are in bounds, as nearly always. There is at least one item. */
static inline bool reals_inside(const struct field *field, const char *item, const char *end,
                                size_t size)
{
    const double low = field->low, high = field->high;
    do {
        double value = FIELD_LOAD(double, field, item);
        if (!(value >= low && value <= high))
            return false;
        item += size;
    } while (item < end);
    return true;
}

/* Is this optional number absent? Bit by bit, because an absent 0 has one sign. */
static bool is_absent(const struct field *field, double value)
{
    return field->optional && field->group == 0 && number_bits(value) == number_bits(field->absent);
}

static int check_numbers(const struct record *record, const struct field *field,
                         struct items *items, struct diag *diag)
{
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        double value = field->kind == FIELD_REAL ? FIELD_LOAD(double, field, item)
                                                 : (double)FIELD_LOAD(int64_t, field, item);
        if ((value >= field->low && value <= field->high) || is_absent(field, value) ||
            !field_present(record, field, item))
            continue;
        items->at = i;
        return field_out_of_bounds(field, value, diag);
    }
    return 0;
}

/* True for a name of printable ASCII, as nearly all are. */
static bool is_plain_name(const char *text)
{
    const char *end = text;
    while (*end >= ' ' && *end <= '~')
        end++;
    return *end == '\0' && end > text && end - text <= FIELD_NAME_SIZE;
}

/* Skips a name that is the same pointer as the name before: neighbours often share one. */
static int check_names(const struct record *record, const struct field *field, struct items *items,
                       struct diag *diag)
{
    const char *item = items->first, *good = NULL;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        const char *name = FIELD_LOAD(const char *, field, item);
        if (name == NULL ? field->optional : name == good)
            continue;
        items->at = i;
        if (name == NULL)
            return diag_fail(diag, DIAG_DATA, "%s: missing", field->name);
        if (!is_plain_name(name) && field_present(record, field, item) &&
            field_require_name(field, name, strlen(name), diag) != 0)
            return -1;
        good = name;
    }
    return 0;
}

/* Skips a list of a document: it was checked when the document was read. */
static int check_lists(const struct record *record, const struct field *field, struct items *items,
                       struct diag *diag)
{
    static const struct field name = {.name = "", .kind = FIELD_NAME};
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        struct field_list list = field_list(field, item);
        struct items own = {.first = list.items, .count = list.count};
        if (list.count == 0 || !field_present(record, field, item) ||
            (field->steady && field_unchanged(record, field, item)))
            continue;
        items->at = i;
        if (field->kind == FIELD_NAMES) {
            own.size = sizeof(const char *);
            if (check_names(record, &name, &own, diag) != 0)
                return diag_prefix(diag, "%s[%zu]", field->name, own.at);
        } else {
            own.size = field->record->size;
            if (check_records(field->record, &own, ~0U, diag) != 0)
                return diag_prefix(diag, "%s[%zu].", field->name, own.at);
        }
    }
    return 0;
}

/* Checks an embedded struct of all items at once. If it is in a group, it is checked item by item,
 * because some items may lack it. */
static int check_embedded(const struct record *record, const struct field *field,
                          struct items *items, struct diag *diag)
{
    size_t step = field->group == 0 ? items->count : 1;
    for (size_t i = 0; i < items->count; i += step) {
        const char *item = items->first + i * items->size;
        struct items embedded = {item + field->offset, items->size, step, 0};
        if (field->group != 0 && !field_present(record, field, item))
            continue;
        if (check_records(field->record, &embedded, ~0U, diag) == 0)
            continue;
        items->at = i + embedded.at;
        return diag_prefix(diag, "%s.", field->name);
    }
    return 0;
}

static int check_member(const struct record *record, const struct field *field, struct items *items,
                        struct diag *diag)
{
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        return check_numbers(record, field, items, diag);
    case FIELD_NAME:
        return check_names(record, field, items, diag);
    case FIELD_NAMES:
    case FIELD_LIST:
        return check_lists(record, field, items, diag);
    case FIELD_RECORD:
        return check_embedded(record, field, items, diag);
    default: /* all values of other kinds can be written and read back */
        return 0;
    }
}

/* The groups that at least one of the items has. */
static unsigned groups_among(const struct record *record, const struct items *items)
{
    unsigned groups = 0;
    for (size_t i = 0; i < items->count; i++)
        groups |= field_groups(record, items->first + i * items->size);
    return groups;
}

static int check_records(const struct record *record, struct items *items, unsigned groups,
                         struct diag *diag)
{
    const char *const first = items->first, *const end = first + items->count * items->size;
    const size_t size = items->size;
    const bool ungrouped = (groups & FIELD_UNGROUPED) != 0;
    bool grouped = record->fields[0].group != 0;
    if (items->count == 0 || (grouped && groups_among(record, items) == 0))
        return 0;
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        bool wanted = field->group != 0 ? (field->group & groups) != 0 : ungrouped;
        if (!wanted)
            continue;
        if (field->kind == FIELD_REAL && reals_inside(field, first, end, size))
            continue;
        if (check_member(record, field, items, diag) != 0)
            return -1;
    }
    return 0;
}

int record_write_check(const struct record *record, const void *base, unsigned groups,
                       struct diag *diag)
{
    return check_records(record, &(struct items){base, record->size, 1, 0}, groups, diag);
}

/* The writer's place in a text; the text's length is set at the end. */
struct writer {
    struct text *text;
    char *at, *end;
    struct list_cache *cache; /* or NULL */
};

/* Room for a key, a number and the brackets around them; and for a record of as many numbers as it
 * may have, so that none of them needs to look for room. */
enum { MEMBER_ROOM = FIELD_KEY_SIZE + NUMBER_SIZE + 8, RECORD_ROOM = FIELD_MOST * MEMBER_ROOM };

/* Kept out of make_room, which would otherwise save registers for every member. */
__attribute__((noinline)) static void grow(struct writer *writer, size_t size)
{
    struct text *text = writer->text;
    text->length = (size_t)(writer->at - text->bytes);
    writer->at = text_room(text, size);
    writer->end = text->bytes + text->room;
}

static void make_room(struct writer *writer, size_t size)
{
    if ((size_t)(writer->end - writer->at) < size)
        grow(writer, size);
}

static void write_record(const struct record *record, const struct field *first, const void *base,
                         struct writer *writer);

static void write_text(struct field_text text, struct writer *writer)
{
    make_room(writer, text.length + MEMBER_ROOM);
    memcpy(writer->at, text.bytes, text.length);
    writer->at += text.length;
}

static void write_word(const char *word, struct writer *writer)
{
    size_t length = strlen(word);
    make_room(writer, length + MEMBER_ROOM);
    memcpy(writer->at, word, length);
    writer->at += length;
}

static inline void write_name(const char *name, struct writer *writer)
{
    size_t length = strlen(name);
    make_room(writer, text_json_size(length) + MEMBER_ROOM);
    writer->at = text_put_json(writer->at, name, length);
}

/* A choice is a word of the program's own, far shorter than RECORD_ROOM. */
static void write_choice(const char *choice, struct writer *writer)
{
    make_room(writer, RECORD_ROOM);
    *writer->at = '"';
    writer->at = stpcpy(writer->at + 1, choice);
    *writer->at++ = '"';
}

/* The first member of a list's item that is written: an inherited name is not. */
static const struct field *first_of_item(const struct record *record, const char *item, bool begins)
{
    const struct field *name = record->inherited;
    if (name == NULL || begins)
        return record->fields;
    const char *own = FIELD_LOAD(const char *, name, item);
    const char *before = FIELD_LOAD(const char *, name, item - record->size);
    return own == before || strcmp(own, before) == 0 ? record->fields + 1 : record->fields;
}

static void write_list(const struct field *field, const void *base, struct writer *writer)
{
    struct field_list list = field_list(field, base);
    *writer->at++ = '[';
    for (size_t i = 0; i < list.count; i++) {
        if (i > 0)
            *writer->at++ = ',';
        if (field->kind == FIELD_NAMES) {
            write_name(((const char *const *)list.items)[i], writer);
            continue;
        }
        const char *item = (const char *)list.items + i * field->record->size;
        write_record(field->record, first_of_item(field->record, item, i == 0), item, writer);
    }
    *writer->at++ = ']';
}

/* Writes a list from the text that the cache has of it, if an earlier line had the same list. */
static void write_steady(const struct record *record, const struct field *field, const void *base,
                         struct writer *writer)
{
    struct list_cache_entry *list = list_cache_of(writer->cache, record, field, base);
    if (list == NULL) {
        write_list(field, base, writer);
    } else if (list->written.bytes == NULL) {
        size_t begin = (size_t)(writer->at - writer->text->bytes);
        write_list(field, base, writer);
        const char *text = writer->text->bytes + begin;
        list_cache_keep_written(writer->cache, list, text, (size_t)(writer->at - text));
    } else {
        write_text(list->written, writer);
    }
}

static void write_set(const struct field *field, uint64_t set, struct writer *writer)
{
    *writer->at++ = '[';
    for (uint64_t rest = set; rest != 0; rest &= rest - 1) {
        write_choice(field->choices[__builtin_ctzll(rest)], writer);
        *writer->at++ = ',';
    }
    writer->at -= set != 0; /* the last comma */
    *writer->at++ = ']';
}

static void write_whole(int64_t value, struct writer *writer)
{
    *writer->at = '-';
    writer->at += value < 0;
    writer->at += number_write_whole(value < 0 ? 0 - (uint64_t)value : (uint64_t)value, writer->at);
}

static void write_seed(uint64_t seed, struct writer *writer)
{
    *writer->at++ = '"';
    writer->at += number_write_whole(seed, writer->at);
    *writer->at++ = '"';
}

/* Writes a member that may be of any length. */
static void write_member(const struct record *record, const struct field *field, const void *base,
                         struct writer *writer)
{
    switch (field->kind) {
    case FIELD_INTEGER:
        write_whole(FIELD_LOAD(int64_t, field, base), writer);
        break;
    case FIELD_SEED:
        write_seed(FIELD_LOAD(uint64_t, field, base), writer);
        break;
    case FIELD_SET:
        write_set(field, FIELD_LOAD(uint64_t, field, base), writer);
        break;
    case FIELD_FLAG:
        write_word(FIELD_LOAD(bool, field, base) ? "true" : "false", writer);
        break;
    case FIELD_NAME:
        write_name(FIELD_LOAD(const char *, field, base), writer);
        break;
    case FIELD_RAW:
        write_word(FIELD_LOAD(const char *, field, base), writer);
        break;
    case FIELD_CHOICE:
        write_choice(field->choices[FIELD_LOAD(int, field, base)], writer);
        break;
    case FIELD_RECORD:
        write_record(field->record, field->record->fields, (const char *)base + field->offset,
                     writer);
        break;
    case FIELD_LIST:
    case FIELD_NAMES:
        if (field->steady && writer->cache != NULL)
            write_steady(record, field, base, writer);
        else
            write_list(field, base, writer);
        break;
    case FIELD_REAL:
    case FIELD_NOTES:
        break;
    }
    make_room(writer, RECORD_ROOM);
}

/* Writes all members that are present, from the first on. */
static void write_record(const struct record *record, const struct field *first, const void *base,
                         struct writer *writer)
{
    char separator = '{';
    make_room(writer, RECORD_ROOM);
    for (const struct field *field = first; field->name != NULL; field++) {
        if (field->optional && !field_present(record, field, base))
            continue;
        memcpy(writer->at, field->key, FIELD_KEY_SIZE);
        *writer->at = separator;
        writer->at += field->key_length;
        separator = ',';
        if (field->kind == FIELD_REAL) /* as most are */
            writer->at += number_write(FIELD_LOAD(double, field, base), writer->at);
        else
            write_member(record, field, base, writer);
    }
    if (separator == '{')
        *writer->at++ = '{';
    *writer->at++ = '}';
}

/* Writes a member as a record of its own, {"x":1}, with the separator in place of the braces. */
static void write_alone(const struct record *record, const struct field *field, const void *base,
                        char separator, struct writer *writer)
{
    const struct field fields[] = {*field, {0}};
    struct record alone = *record;
    alone.fields = fields;
    size_t begin = (size_t)(writer->at - writer->text->bytes);
    write_record(&alone, fields, base, writer);
    writer->text->bytes[begin] = separator;
    writer->at--;
}

/* Writes a struct that was read from a line. */
static void write_as_read(const struct record *record, const void *base, struct field_line line,
                          struct writer *writer)
{
    char separator = '{';
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        struct field_text text = line.texts[field - record->fields];
        unsigned group = field->group != 0 ? field->group : FIELD_UNGROUPED;
        bool same = text.bytes != NULL && (line.same & group) != 0;
        if (!same && !field_present(record, field, base))
            continue;
        if (same) {
            make_room(writer, MEMBER_ROOM);
            memcpy(writer->at, field->key, FIELD_KEY_SIZE);
            *writer->at = separator;
            writer->at += field->key_length;
            write_text(text, writer);
        } else {
            write_alone(record, field, base, separator, writer);
        }
        separator = ',';
    }
    *writer->at++ = '}';
}

void record_write(const struct record *record, const void *base, struct list_cache *cache,
                  struct text *text)
{
    char *at = text_room(text, RECORD_ROOM);
    struct writer writer = {text, at, text->bytes + text->room, cache};
    struct field_line line = field_line(record, base);
    if (line.texts != NULL)
        write_as_read(record, base, line, &writer);
    else
        write_record(record, record->fields, base, &writer);
    *writer.at++ = '\n';
    text->length = (size_t)(writer.at - text->bytes);
}
