#include "text/field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"

const struct field field_none[] = {{0}};

const char *field_unit(const char *name)
{
    /* Longer endings first: "_mps2" also ends in "s2" of nothing, "_mps" in "_s" of nothing. */
    static const char *const units[][2] = {
        {"_mps2", "m/s²"}, {"_radps", "rad/s"}, {"_mmph", "mm/h"}, {"_gpm3", "g/m³"},
        {"_hzps", "Hz/s"}, {"_dbm", "dBm"},     {"_mps", "m/s"},   {"_rad", "rad"},
        {"_hz", "Hz"},     {"_db", "dB"},       {"_m", "m"},       {"_s", "s"},
    };
    size_t length = strlen(name);
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        size_t outcome = strlen(units[i][0]);
        if (length > outcome && strcmp(name + length - outcome, units[i][0]) == 0)
            return units[i][1];
    }
    return "";
}

static bool is_word(const char *word, const char *text, size_t length)
{
    return length > 0 && word[0] == text[0] && strncmp(word, text, length) == 0 &&
           word[length] == '\0';
}

const struct field *field_find(const struct record *record, const char *name, size_t length,
                               size_t hint)
{
    const struct field *fields = record->fields;
    if (fields[hint].name != NULL && is_word(fields[hint].name, name, length))
        return &fields[hint];
    for (const struct field *field = fields; field->name != NULL; field++)
        if (is_word(field->name, name, length))
            return field;
    return NULL;
}

static void *member(const struct field *field, void *base)
{
    return (char *)base + field->offset;
}

static const void *member_of(const struct field *field, const void *base)
{
    return (const char *)base + field->offset;
}

/* memcpy, because the table does not know the C type that the compiler gave the member. */
#define LOAD(type, field, base)                                                                    \
    (*(type *)memcpy(&(type){0}, member_of((field), (base)), sizeof(type)))

#define STORE(type, field, base, value)                                                            \
    memcpy(member((field), (base)), &(type){(value)}, sizeof(type))

static void set_all_absent(const struct record *record, void *base)
{
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (field->absent != 0 || field->kind == FIELD_RECORD)
            field_set_absent(field, base);
}

void field_set_absent(const struct field *field, void *base)
{
    if (field->kind == FIELD_RECORD)
        set_all_absent(field->record, member(field, base));
    else if (field->absent == 0)
        return;
    else if (field->kind == FIELD_REAL)
        STORE(double, field, base, field->absent);
    else if (field->kind == FIELD_INTEGER)
        STORE(int64_t, field, base, (int64_t)field->absent);
    else if (field->kind == FIELD_SEED || field->kind == FIELD_SET)
        STORE(uint64_t, field, base, (uint64_t)field->absent);
    else if (field->kind == FIELD_CHOICE)
        STORE(int, field, base, (int)field->absent);
}

void field_clear(const struct record *record, void *base)
{
    memset(base, 0, record->size);
    set_all_absent(record, base);
}

/* "1e6" for 1e+06; whole numbers in full. */
static const char *show(double bound, char *text, size_t size)
{
    bool whole = fabs(bound) >= 1e6 && fabs(bound) <= 0x1p53 && fmod(bound, 1e6) != 0;
    snprintf(text, size, whole ? "%.16g" : "%g", bound);
    char *plus = strstr(text, "e+");
    if (plus != NULL) {
        char *digits = plus + 2;
        digits += strspn(digits, "0");
        memmove(plus + 1, digits, strlen(digits) + 1);
    }
    return text;
}

static int out_of_bounds(const struct field *field, double value, struct diag *diag)
{
    char digits[NUMBER_SIZE + 1];
    digits[isfinite(value) ? number_write(value, digits) : 0] = '\0';
    if (!isfinite(value))
        snprintf(digits, sizeof digits, "%g", value);
    const char *unit = field_unit(field->name);
    char low[NUMBER_SIZE], high[NUMBER_SIZE];
    return diag_fail(diag, DIAG_DATA, "%s: %s is outside [%s, %s]%s%s", field->name, digits,
                     show(field->low, low, sizeof low), show(field->high, high, sizeof high),
                     *unit ? " " : "", unit);
}

int field_set_number(const struct field *field, void *base, double value, struct diag *diag)
{
    if (field->kind != FIELD_REAL && field->kind != FIELD_INTEGER)
        return field_wrong_kind(field, "a number", diag);
    if (!(value >= field->low && value <= field->high))
        return out_of_bounds(field, value, diag);
    if (field->kind == FIELD_REAL) {
        STORE(double, field, base, value);
        return 0;
    }
    if (value != floor(value))
        return diag_fail(diag, DIAG_DATA, "%s: %.17g is not a whole number", field->name, value);
    STORE(int64_t, field, base, (int64_t)value);
    return 0;
}

/* The number of the choice of that name, or -1 after a message. */
static int choice_of(const struct field *field, const char *text, size_t length, struct diag *diag)
{
    for (int i = 0; field->choices[i] != NULL; i++)
        if (is_word(field->choices[i], text, length))
            return i;
    char expected[1024];
    field_expectation(field, expected, sizeof expected);
    return diag_fail(diag, DIAG_DATA, "%s: \"%.*s\" is unknown; expected %s", field->name,
                     (int)(length < 80 ? length : 80), text, expected);
}

static int set_choice(const struct field *field, void *base, const char *text, size_t length,
                      struct diag *diag)
{
    int choice = choice_of(field, text, length, diag);
    if (choice < 0)
        return -1;
    STORE(int, field, base, choice);
    return 0;
}

int field_add_to_set(const struct field *field, void *base, const char *text, size_t length,
                     struct diag *diag)
{
    int choice = choice_of(field, text, length, diag);
    if (choice < 0)
        return -1;
    uint64_t set = LOAD(uint64_t, field, base), bit = UINT64_C(1) << choice;
    if ((set & bit) != 0)
        return diag_fail(diag, DIAG_DATA, "%s: \"%s\" stands twice", field->name,
                         field->choices[choice]);
    STORE(uint64_t, field, base, set | bit);
    return 0;
}

static int set_seed(const struct field *field, void *base, const char *text, size_t length,
                    struct diag *diag)
{
    uint64_t seed = 0;
    bool good = length > 0 && length <= 20;
    for (size_t i = 0; i < length && good; i++) {
        uint64_t digit = (uint64_t)(text[i] - '0');
        good = text[i] >= '0' && text[i] <= '9' && seed <= (UINT64_MAX - digit) / 10;
        seed = 10 * seed + digit;
    }
    if (!good)
        return diag_fail(diag, DIAG_DATA,
                         "%s: \"%.*s\" is no seed; expected decimal digits up to %llu", field->name,
                         (int)(length < 80 ? length : 80), text, (unsigned long long)UINT64_MAX);
    STORE(uint64_t, field, base, seed);
    return 0;
}

static int check_name(const struct field *field, const char *text, size_t length, struct diag *diag)
{
    if (length == 0 || length > FIELD_NAME_SIZE)
        return diag_fail(diag, DIAG_DATA, "%s: a name of %zu bytes; expected 1 to %d", field->name,
                         length, FIELD_NAME_SIZE);
    if (text_plain(text, length) == length)
        return 0;
    for (size_t i = 0; i < length;) {
        unsigned char byte = (unsigned char)text[i];
        if (byte < 0x20 || byte == 0x7f)
            return diag_fail(diag, DIAG_DATA, "%s: control character 0x%02x in a name", field->name,
                             byte);
        size_t step = byte < 0x80 ? 1 : text_utf8(text + i, length - i);
        if (step == 0)
            return diag_fail(diag, DIAG_DATA, "%s: byte 0x%02x in a name is not UTF-8", field->name,
                             byte);
        i += step;
    }
    return 0;
}

static int set_name(const struct field *field, void *base, const char *text, size_t length,
                    struct arena *arena, struct diag *diag)
{
    if (check_name(field, text, length, diag) != 0)
        return -1;
    const char *copy = arena_text(arena, text, length);
    STORE(const char *, field, base, copy);
    return 0;
}

int field_set_text(const struct field *field, void *base, const char *text, size_t length,
                   struct arena *arena, struct diag *diag)
{
    switch (field->kind) {
    case FIELD_NAME:
        return set_name(field, base, text, length, arena, diag);
    case FIELD_CHOICE:
        return set_choice(field, base, text, length, diag);
    case FIELD_SEED:
        return set_seed(field, base, text, length, diag);
    default:
        return field_wrong_kind(field, "a string", diag);
    }
}

int field_read_number(const char *text, size_t length, double *value)
{
    /* number_read takes whatever from_chars takes, so words like "inf" must not get that far. */
    bool plausible = length > 0 && strspn(text, "+-.0123456789eE") >= length;
    return plausible && number_read(text, text + length, value) ? 0 : -1;
}

static unsigned sections_of(const struct record *record, const void *base)
{
    unsigned present;
    memcpy(&present, (const char *)base + record->present_offset, sizeof present);
    return present;
}

/* Minus zero is not zero: readers tell them apart. */
static inline bool differs(double value, double absent)
{
    return value != absent || signbit(value) != signbit(absent);
}

static bool any_present(const struct record *record, const void *base);

bool field_present(const struct record *record, const struct field *field, const void *base)
{
    if (field->section != 0)
        return (sections_of(record, base) & field->section) != 0;
    if (!field->optional)
        return true;
    switch (field->kind) {
    case FIELD_REAL:
        return differs(LOAD(double, field, base), field->absent);
    case FIELD_INTEGER:
        return LOAD(int64_t, field, base) != (int64_t)field->absent;
    case FIELD_SEED:
    case FIELD_SET:
        return LOAD(uint64_t, field, base) != (uint64_t)field->absent;
    case FIELD_CHOICE:
        return LOAD(int, field, base) != (int)field->absent;
    case FIELD_FLAG:
        return LOAD(bool, field, base);
    case FIELD_NAME:
    case FIELD_RAW:
        return LOAD(const char *, field, base) != NULL;
    case FIELD_NAMES:
    case FIELD_LIST:
        return field_list(field, base).count > 0;
    case FIELD_RECORD:
        return any_present(field->record, member_of(field, base));
    case FIELD_NOTES:
        return false;
    }
    return true;
}

/* Of sections only, which are told by one look at their bits, or of plain members only. */
static bool any_present(const struct record *record, const void *base)
{
    if (record->fields[0].section != 0)
        return sections_of(record, base) != 0;
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (field_present(record, field, base))
            return true;
    return false;
}

void field_mark_present(const struct record *record, const struct field *field, void *base)
{
    if (field->section == 0)
        return;
    unsigned present = sections_of(record, base) | field->section;
    memcpy((char *)base + record->present_offset, &present, sizeof present);
}

int field_require(const struct record *record, uint64_t seen, struct diag *diag)
{
    for (size_t i = 0; record->fields[i].name != NULL; i++) {
        const struct field *field = &record->fields[i];
        if (field->optional || field->section != 0 || (seen >> i & 1) != 0)
            continue;
        char expected[512];
        field_expectation(field, expected, sizeof expected);
        return diag_fail(diag, DIAG_DATA, "%s: missing; expected %s", field->name, expected);
    }
    return 0;
}

void field_expectation(const struct field *field, char *text, size_t size)
{
    const char *unit = field_unit(field->name);
    char low[NUMBER_SIZE], high[NUMBER_SIZE];
    switch (field->kind) {
    case FIELD_REAL:
    case FIELD_INTEGER:
        snprintf(text, size, "%s in [%s, %s]%s%s",
                 field->kind == FIELD_REAL ? "a number" : "a whole number",
                 show(field->low, low, sizeof low), show(field->high, high, sizeof high),
                 *unit ? " " : "", unit);
        return;
    case FIELD_CHOICE:
    case FIELD_SET: {
        size_t used = (size_t)snprintf(
            text, size, field->kind == FIELD_CHOICE ? "one of" : "an array of names among");
        for (int i = 0; field->choices[i] != NULL && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : " ",
                                     field->choices[i]);
        return;
    }
    default: {
        static const char *const kinds[] = {
            [FIELD_FLAG] = "true or false",      [FIELD_NAME] = "a name",
            [FIELD_SEED] = "a string of digits", [FIELD_NAMES] = "an array of names",
            [FIELD_RECORD] = "an object",        [FIELD_LIST] = "an array of objects",
            [FIELD_RAW] = "any JSON value",      [FIELD_NOTES] = "an object of strings",
        };
        snprintf(text, size, "%s", kinds[field->kind]);
    }
    }
}

int field_wrong_kind(const struct field *field, const char *kind, struct diag *diag)
{
    char expected[512];
    field_expectation(field, expected, sizeof expected);
    return diag_fail(diag, DIAG_DATA, "%s: %s; expected %s", field->name, kind, expected);
}

int field_unknown(const struct record *record, const char *name, size_t length, struct diag *diag)
{
    char known[1536] = "";
    size_t used = 0;
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (used < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                                     field == record->fields ? "" : ", ", field->name);
    return diag_fail(diag, DIAG_DATA, "%.*s: unknown key; expected one of %s",
                     (int)(length < 80 ? length : 80), name, known);
}

int field_twice(const struct field *field, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA, "%s: the key stands twice", field->name);
}

/* The walk that says what is out of bounds. */
static int walk(const struct record *record, const void *base, struct diag *diag);

static int check_list(const struct field *field, const void *base, struct diag *diag)
{
    struct field_list list = field_list(field, base);
    for (size_t i = 0; i < list.count; i++) {
        const void *item = (const char *)list.items + i * field->record->size;
        if (walk(field->record, item, diag) != 0)
            return diag_prefix(diag, "%s[%zu].", field->name, i);
    }
    return 0;
}

static int check_names(const struct field *field, const void *base, struct diag *diag)
{
    struct field_list list = field_list(field, base);
    const char *const *names = list.items;
    for (size_t i = 0; i < list.count; i++) {
        char path[FIELD_PATH_SIZE];
        snprintf(path, sizeof path, "%s[%zu]", field->name, i);
        const struct field item = {.name = path};
        if (check_name(&item, names[i], strlen(names[i]), diag) != 0)
            return -1;
    }
    return 0;
}

static int check_member(const struct field *field, const void *base, struct diag *diag)
{
    double value;
    const char *name;
    switch (field->kind) {
    case FIELD_REAL:
        value = LOAD(double, field, base);
        return value >= field->low && value <= field->high ? 0 : out_of_bounds(field, value, diag);
    case FIELD_INTEGER:
        value = (double)LOAD(int64_t, field, base);
        return value >= field->low && value <= field->high ? 0 : out_of_bounds(field, value, diag);
    case FIELD_NAME:
        name = LOAD(const char *, field, base);
        return name != NULL ? check_name(field, name, strlen(name), diag)
                            : diag_fail(diag, DIAG_DATA, "%s: missing", field->name);
    case FIELD_NAMES:
        return check_names(field, base, diag);
    case FIELD_RECORD:
        if (walk(field->record, member_of(field, base), diag) != 0)
            return diag_prefix(diag, "%s.", field->name);
        return 0;
    case FIELD_LIST:
        return check_list(field, base, diag);
    default:
        return 0;
    }
}

static int walk(const struct record *record, const void *base, struct diag *diag)
{
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (field_present(record, field, base) && check_member(field, base, diag) != 0)
            return -1;
    return 0;
}

/* The look that says whether anything is: at one member of all items of a list after the other. */
struct items {
    const char *first;
    size_t size, count; /* size bytes from one to the next */
};

static bool records_good(const struct record *record, const struct items *items, unsigned sections,
                         struct field_names *names);

static bool reals_good(const struct record *record, const struct field *field,
                       const struct items *items, struct field_names *names)
{
    (void)record;
    (void)names;
    const char *item = items->first;
    const double low = field->low, high = field->high;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        double value = LOAD(double, field, item);
        if (!(value >= low && value <= high) && (!field->optional || differs(value, field->absent)))
            return false;
    }
    return true;
}

static bool integers_good(const struct record *record, const struct field *field,
                          const struct items *items, struct field_names *names)
{
    (void)names;
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        double value = (double)LOAD(int64_t, field, item);
        if (!(value >= field->low && value <= field->high) && field_present(record, field, item))
            return false;
    }
    return true;
}

/* Short names of printable ASCII, which nearly all are, are seen to be good byte by byte. */
static bool is_name(const char *text)
{
    enum { SHORT = 64 };
    size_t length = 0;
    while (length < SHORT && text[length] >= ' ' && text[length] <= '~')
        length++;
    if (length > 0 && text[length] == '\0')
        return true;
    length = strlen(text);
    struct diag ignored = {0};
    return check_name(&(struct field){.name = ""}, text, length, &ignored) == 0;
}

static bool names_good(const struct record *record, const struct field *field,
                       const struct items *items, struct field_names *names)
{
    (void)record;
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        const char *name = LOAD(const char *, field, item);
        uintptr_t address = (uintptr_t)name;
        const char **known = &names->good[(address >> 4 ^ address >> 11) % FIELD_NAMES_KEPT];
        if (name == NULL ? !field->optional : *known != name && !is_name(name))
            return false;
        *known = name;
    }
    return true;
}

static bool lists_good(const struct record *record, const struct field *field,
                       const struct items *items, struct field_names *names)
{
    static const struct field name = {.kind = FIELD_NAME};
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        struct field_list list = field_list(field, item);
        struct items own = {list.items, sizeof(const char *), list.count};
        if (field->kind == FIELD_LIST)
            own.size = field->record->size;
        if (list.count > 0 &&
            !(field->kind == FIELD_NAMES ? names_good(record, &name, &own, names)
                                         : records_good(field->record, &own, ~0U, names)))
            return false;
    }
    return true;
}

static bool embedded_good(const struct record *record, const struct field *field,
                          const struct items *items, struct field_names *names)
{
    (void)record;
    const struct items embedded = {items->first + field->offset, items->size, items->count};
    return records_good(field->record, &embedded, ~0U, names);
}

static bool members_good(const struct record *record, const struct field *field,
                         const struct items *items, struct field_names *names)
{
    static bool (*const looks[])(const struct record *, const struct field *, const struct items *,
                                 struct field_names *) = {
        [FIELD_REAL] = reals_good,  [FIELD_INTEGER] = integers_good, [FIELD_NAME] = names_good,
        [FIELD_NAMES] = lists_good, [FIELD_RECORD] = embedded_good,  [FIELD_LIST] = lists_good,
        [FIELD_NOTES] = NULL,
    };
    return looks[field->kind] == NULL || looks[field->kind](record, field, items, names);
}

/* Of a section only the items that have it. */
static bool section_good(const struct record *record, const struct field *field,
                         const struct items *items, struct field_names *names)
{
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size)
        if ((sections_of(record, item) & field->section) != 0 &&
            !members_good(record, field, &(struct items){item, items->size, 1}, names))
            return false;
    return true;
}

/* The sections that any of the items has. */
static unsigned sections_among(const struct record *record, const struct items *items)
{
    unsigned sections = 0;
    for (size_t i = 0; i < items->count; i++)
        sections |= sections_of(record, items->first + i * items->size);
    return sections;
}

static bool records_good(const struct record *record, const struct items *items, unsigned sections,
                         struct field_names *names)
{
    if (record->fields[0].section != 0 && sections_among(record, items) == 0)
        return true;
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if (field->section == 0
                ? !members_good(record, field, items, names)
                : (field->section & sections) != 0 && !section_good(record, field, items, names))
            return false;
    }
    return true;
}

bool field_in_bounds(const struct record *record, const void *first, size_t count,
                     unsigned sections, struct field_names *names)
{
    return records_good(record, &(struct items){first, record->size, count}, sections, names);
}

int field_check(const struct record *record, const void *base, struct diag *diag)
{
    return field_in_bounds(record, base, 1, ~0U, &(struct field_names){0})
               ? 0
               : walk(record, base, diag);
}

/* The layout of every LIST_OF, whatever its items. */
struct untyped_list {
    void *items;
    size_t count, room;
};

struct field_list field_list(const struct field *field, const void *base)
{
    struct untyped_list list = LOAD(struct untyped_list, field, base);
    return (struct field_list){list.items, list.count};
}

bool field_unchanged(const struct record *record, const struct field *field, const void *base)
{
    const void *document;
    memcpy(&document, (const char *)base + record->document_offset, sizeof document);
    if (document == NULL)
        return false;
    struct field_list list = field_list(field, base), read = field_list(field, document);
    return list.items == read.items && list.count == read.count;
}

void *field_list_extend(const struct field *field, void *base, struct arena *arena)
{
    size_t size = field->kind == FIELD_NAMES ? sizeof(const char *) : field->record->size;
    struct untyped_list list = LOAD(struct untyped_list, field, base);
    list.items = list_room(arena, list.items, list.count, &list.room, size);
    char *item = (char *)list.items + list.count * size;
    list.count++;
    memcpy(member(field, base), &list, sizeof list);
    return item;
}

void *field_list_add(const struct field *field, void *base, struct arena *arena)
{
    void *item = field_list_extend(field, base, arena);
    if (field->kind == FIELD_LIST)
        field_clear(field->record, item);
    return item;
}
