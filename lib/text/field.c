#include "text/field.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "base/number.h"
#include "base/suggestion.h"
#include "base/text.h"

const struct field field_none[] = {{0}};

const char *field_unit(const char *name)
{
    /* Longer endings come first, because "_mps" also ends in "_s". */
    static const char *const units[][2] = {
        {"_mps2", "m/s²"}, {"_radps", "rad/s"}, {"_mmph", "mm/h"}, {"_gpm3", "g/m³"},
        {"_hzps", "Hz/s"}, {"_dbsm", "dBsm"},   {"_dbm", "dBm"},   {"_mps", "m/s"},
        {"_rad", "rad"},   {"_hz", "Hz"},       {"_db", "dB"},     {"_m", "m"},
        {"_s", "s"},
    };
    size_t length = strlen(name);
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        size_t ending = strlen(units[i][0]);
        if (length > ending && strcmp(name + length - ending, units[i][0]) == 0)
            return units[i][1];
    }
    return "";
}

const struct field *field_find(const struct record *record, const char *name, size_t length)
{
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (text_is(name, length, field->name))
            return field;
    return NULL;
}

static void set_all_absent(const struct record *record, void *base)
{
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (field_absent_differs(field))
            field_set_absent(field, base);
}

void field_set_absent(const struct field *field, void *base)
{
    if (field->kind == FIELD_RECORD)
        set_all_absent(field->record, (char *)base + field->offset);
    else if (field->absent == 0)
        return;
    else if (field->kind == FIELD_REAL)
        FIELD_STORE(double, field, base, field->absent);
    else if (field->kind == FIELD_INTEGER)
        FIELD_STORE(int64_t, field, base, (int64_t)field->absent);
    else if (field->kind == FIELD_SEED || field->kind == FIELD_SET)
        FIELD_STORE(uint64_t, field, base, (uint64_t)field->absent);
    else if (field->kind == FIELD_CHOICE)
        FIELD_STORE(int, field, base, (int)field->absent);
}

void field_clear(const struct record *record, void *base)
{
    memset(base, 0, record->size);
    set_all_absent(record, base);
}

/* Writes 1e+06 as "1e6", 1e-06 as "1e-6", and whole numbers in full. */
static const char *show(double bound, char *text, size_t size)
{
    bool whole = fabs(bound) >= 1e6 && fabs(bound) <= 0x1p53 && fmod(bound, 1e6) != 0;
    snprintf(text, size, whole ? "%.16g" : "%g", bound);
    char *exponent = strchr(text, 'e');
    if (exponent != NULL) {
        char *place = exponent + 1 + (exponent[1] == '-'), *digits = place + strspn(place, "+0");
        memmove(place, digits, strlen(digits) + 1);
    }
    return text;
}

int field_out_of_bounds(const struct field *field, double value, struct diag *diag)
{
    char digits[NUMBER_SIZE + 1];
    digits[isfinite(value) ? number_write(value, digits) : 0] = '\0';
    if (!isfinite(value))
        snprintf(digits, sizeof digits, "%g", value);
    const char *unit = field_unit(field->name);
    char low[NUMBER_SIZE], high[NUMBER_SIZE];
    return diag_fail(diag, DIAG_DATA, "%s: %s is outside [%s, %s]%s%s%s", field->name, digits,
                     show(field->low, low, sizeof low), show(field->high, high, sizeof high),
                     *unit ? " " : "", unit,
                     field->beyond != NULL && value > field->high ? field->beyond : "");
}

int field_set_number(const struct field *field, void *base, double value, struct diag *diag)
{
    if (field->kind != FIELD_REAL && field->kind != FIELD_INTEGER)
        return field_refuse(field, "a number", diag);
    if (!(value >= field->low && value <= field->high))
        return field_out_of_bounds(field, value, diag);
    if (field->kind == FIELD_REAL) {
        FIELD_STORE(double, field, base, field_kept(field, value));
        return 0;
    }
    if (value != floor(value))
        return diag_fail(diag, DIAG_DATA, "%s: %.17g is not a whole number", field->name, value);
    FIELD_STORE(int64_t, field, base, (int64_t)value);
    return 0;
}

/* The index of the choice of that name, or -1 after a message. */
static int choice_of(const struct field *field, const char *text, size_t length, struct diag *diag)
{
    struct suggestion meant;
    int choice = suggestion_find(field->choices, text, length, &meant);
    if (choice >= 0)
        return choice;
    char expected[1024];
    field_expectation(field, expected, sizeof expected);
    return diag_fail(diag, DIAG_DATA, "%s: \"%.*s\" is unknown%s; expected %s", field->name,
                     (int)(length < 80 ? length : 80), text, suggestion_question(&meant, ""),
                     expected);
}

static int set_choice(const struct field *field, void *base, const char *text, size_t length,
                      struct diag *diag)
{
    int choice = choice_of(field, text, length, diag);
    if (choice < 0)
        return -1;
    FIELD_STORE(int, field, base, choice);
    return 0;
}

int field_add_to_set(const struct field *field, void *base, const char *text, size_t length,
                     struct diag *diag)
{
    assert(field->kind == FIELD_SET);
    int choice = choice_of(field, text, length, diag);
    if (choice < 0)
        return -1;
    uint64_t set = FIELD_LOAD(uint64_t, field, base), bit = UINT64_C(1) << choice;
    if ((set & bit) != 0)
        return diag_fail(diag, DIAG_DATA, "%s: \"%s\" stands twice", field->name,
                         field->choices[choice]);
    FIELD_STORE(uint64_t, field, base, set | bit);
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
    FIELD_STORE(uint64_t, field, base, seed);
    return 0;
}

int field_require_name(const struct field *field, const char *text, size_t length,
                       struct diag *diag)
{
    double most = field->high > 0 ? field->high : FIELD_NAME_SIZE;
    if (length == 0 || (double)length > most)
        return diag_fail(diag, DIAG_DATA, "%s: a name of %zu bytes; expected 1 to %.0f",
                         field->name, length, most);
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
    if (field_require_name(field, text, length, diag) != 0)
        return -1;
    const char *copy = arena_text(arena, text, length);
    FIELD_STORE(const char *, field, base, copy);
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
        return field_refuse(field, "a string", diag);
    }
}

int field_read_number(const char *text, size_t length, double *value)
{
    return number_read(text, text + length, value) ? 0 : -1;
}

static bool any_present(const struct record *record, const void *base);

bool field_differs(const struct field *field, const void *base)
{
    switch (field->kind) {
    case FIELD_REAL: /* bit by bit, because readers distinguish minus zero from zero */
        return FIELD_LOAD(uint64_t, field, base) != number_bits(field->absent);
    case FIELD_INTEGER:
        return FIELD_LOAD(int64_t, field, base) != (int64_t)field->absent;
    case FIELD_SEED:
    case FIELD_SET:
        return FIELD_LOAD(uint64_t, field, base) != (uint64_t)field->absent;
    case FIELD_CHOICE:
        return FIELD_LOAD(int, field, base) != (int)field->absent;
    case FIELD_FLAG:
        return FIELD_LOAD(bool, field, base);
    case FIELD_NAME:
    case FIELD_RAW:
        return FIELD_LOAD(const char *, field, base) != NULL;
    case FIELD_NAMES:
    case FIELD_LIST:
        return field_list(field, base).count > 0;
    case FIELD_RECORD:
        return any_present(field->record, (const char *)base + field->offset);
    case FIELD_NOTES:
        return false;
    }
    return true;
}

/* True if any member is present. Members are all in groups, whose bits tell it at once, or none
 * is. Kept out of field_differs, which would otherwise save registers for every member. */
__attribute__((noinline)) static bool any_present(const struct record *record, const void *base)
{
    if (record->fields[0].group != 0)
        return field_groups(record, base) != 0;
    for (const struct field *field = record->fields; field->name != NULL; field++)
        if (field_present(record, field, base))
            return true;
    return false;
}

static bool same_text(const char *one, const char *other)
{
    return one == other || (one != NULL && other != NULL && strcmp(one, other) == 0);
}

static bool same_names(struct field_list one, struct field_list other)
{
    const char *const *names = one.items, *const *others = other.items;
    if (one.count != other.count)
        return false;
    for (size_t i = 0; i < one.count; i++)
        if (!same_text(names[i], others[i]))
            return false;
    return true;
}

static bool same_lists(const struct record *record, struct field_list one, struct field_list other)
{
    const char *items = one.items, *others = other.items;
    if (one.count != other.count)
        return false;
    for (size_t at = 0; at < one.count * record->size; at += record->size)
        if (!field_same(record, items + at, others + at))
            return false;
    return true;
}

static bool same_member(const struct field *field, const void *one, const void *other)
{
    switch (field->kind) {
    case FIELD_REAL: /* bit by bit, as minus zero has another text than zero */
    case FIELD_INTEGER:
    case FIELD_SEED:
    case FIELD_SET:
        return FIELD_LOAD(uint64_t, field, one) == FIELD_LOAD(uint64_t, field, other);
    case FIELD_FLAG:
        return FIELD_LOAD(bool, field, one) == FIELD_LOAD(bool, field, other);
    case FIELD_CHOICE:
        return FIELD_LOAD(int, field, one) == FIELD_LOAD(int, field, other);
    case FIELD_NAME:
    case FIELD_RAW:
        return same_text(FIELD_LOAD(const char *, field, one),
                         FIELD_LOAD(const char *, field, other));
    case FIELD_RECORD:
        return field_same(field->record, (const char *)one + field->offset,
                          (const char *)other + field->offset);
    case FIELD_NAMES:
        return same_names(field_list(field, one), field_list(field, other));
    case FIELD_LIST:
        return same_lists(field->record, field_list(field, one), field_list(field, other));
    case FIELD_NOTES:
        break;
    }
    return true;
}

bool field_same(const struct record *record, const void *one, const void *other)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        bool present = field_present(record, field, one);
        if (present != field_present(record, field, other))
            return false;
        if (present && !same_member(field, one, other))
            return false;
    }
    return true;
}

void field_mark_present(const struct record *record, const struct field *field, void *base)
{
    if (field->group == 0)
        return;
    unsigned present = field_groups(record, base) | field->group;
    memcpy((char *)base + record->present_offset, &present, sizeof present);
}

double field_number(const struct field *field, const void *base)
{
    switch (field->kind) {
    case FIELD_REAL:
        return FIELD_LOAD(double, field, base);
    case FIELD_INTEGER:
        return (double)FIELD_LOAD(int64_t, field, base);
    case FIELD_CHOICE:
        return FIELD_LOAD(int, field, base);
    case FIELD_FLAG:
        return FIELD_LOAD(bool, field, base);
    default:
        return 0;
    }
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

int field_refuse(const struct field *field, const char *found, struct diag *diag)
{
    char expected[512];
    field_expectation(field, expected, sizeof expected);
    return diag_fail(diag, DIAG_DATA, "%s: %s; expected %s", field->name, found, expected);
}

const struct field_gone *field_find_gone(const struct record *record, const char *name,
                                         size_t length)
{
    const struct field_gone *gone = record->gone;
    if (gone == NULL)
        return NULL;
    for (; gone->name != NULL; gone++)
        if (strlen(gone->name) == length && memcmp(gone->name, name, length) == 0)
            return gone;
    return NULL;
}

int field_unknown(const struct record *record, const char *name, size_t length, struct diag *diag)
{
    const struct field_gone *gone = field_find_gone(record, name, length);
    if (gone != NULL)
        return diag_fail(diag, DIAG_DATA, "%s: %s", gone->name, gone->instead);
    char known[1536] = "";
    size_t used = 0;
    struct suggestion meant = suggestion_begin(name, length);
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        suggestion_offer(&meant, field->name);
        if (used < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                                     field == record->fields ? "" : ", ", field->name);
    }
    return diag_fail(diag, DIAG_DATA, "%.*s: unknown key%s; expected one of %s",
                     (int)(length < 80 ? length : 80), name, suggestion_question(&meant, ""),
                     known);
}

int field_twice(const struct field *field, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA, "%s: the key stands twice", field->name);
}

void *field_list_add(const struct field *field, void *base, struct arena *arena)
{
    assert(field->kind == FIELD_NAMES || field->kind == FIELD_LIST);
    size_t size = field->kind == FIELD_NAMES ? sizeof(const char *) : field->record->size;
    struct field_list list = field_list(field, base);
    list.items = list_room(arena, list.items, list.count, &list.room, size);
    char *item = (char *)list.items + list.count * size;
    list.count++;
    memcpy((char *)base + field->offset, &list, sizeof list);
    return item;
}
