#include "text/field_check.h"

/* Structs at equal distances, size bytes from one to the next: list items, or structs embedded in
 * them. at is set to the index of the first faulty one. */
struct items {
    const char *first;
    size_t size, count;
    size_t at;
};

static int check_records(const struct record *record, struct items *items, unsigned sections,
                         struct diag *diag);

/* True if all values of a member are in bounds, as nearly always. */
static bool reals_inside(const struct field *field, const struct items *items)
{
    const double low = field->low, high = field->high;
    const char *item = items->first, *end = item + items->count * items->size;
    for (; item < end; item += items->size) {
        double value = FIELD_LOAD(double, field, item);
        if (!(value >= low && value <= high))
            return false;
    }
    return true;
}

static int check_numbers(const struct record *record, const struct field *field,
                         struct items *items, struct diag *diag)
{
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        double value = field->kind == FIELD_REAL ? FIELD_LOAD(double, field, item)
                                                 : (double)FIELD_LOAD(int64_t, field, item);
        if ((value >= field->low && value <= field->high) || !field_present(record, field, item))
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

/* Skips a name that is the same pointer as the one before, as neighbours often have. */
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

/* Skips a list that is still a document's: it was checked when the document was read. */
static int check_lists(const struct record *record, const struct field *field, struct items *items,
                       struct diag *diag)
{
    static const struct field name = {.name = "", .kind = FIELD_NAME};
    const char *item = items->first;
    for (size_t i = 0; i < items->count; i++, item += items->size) {
        struct field_list list = field_list(field, item);
        struct items own = {.first = list.items, .count = list.count};
        if (!field_present(record, field, item) ||
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

/* Checks an embedded struct of all items at once; one that is a section item by item, because not
 * every item need have it. */
static int check_embedded(const struct record *record, const struct field *field,
                          struct items *items, struct diag *diag)
{
    size_t step = field->section == 0 ? items->count : 1;
    for (size_t i = 0; i < items->count; i += step) {
        const char *item = items->first + i * items->size;
        struct items embedded = {item + field->offset, items->size, step, 0};
        if ((field->section != 0 && !field_present(record, field, item)) ||
            check_records(field->record, &embedded, ~0U, diag) == 0)
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
        return reals_inside(field, items) ? 0 : check_numbers(record, field, items, diag);
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

/* The sections that at least one of the items has. */
static unsigned sections_among(const struct record *record, const struct items *items)
{
    unsigned sections = 0;
    for (size_t i = 0; i < items->count; i++)
        sections |= field_sections(record, items->first + i * items->size);
    return sections;
}

static int check_records(const struct record *record, struct items *items, unsigned sections,
                         struct diag *diag)
{
    bool sectioned = record->fields[0].section != 0;
    if (items->count == 0 || (sectioned && sections_among(record, items) == 0))
        return 0;
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        bool wanted = field->section == 0 || (field->section & sections) != 0;
        if (wanted && check_member(record, field, items, diag) != 0)
            return -1;
    }
    return 0;
}

int field_check_sections(const struct record *record, const void *base, unsigned sections,
                         struct diag *diag)
{
    return check_records(record, &(struct items){base, record->size, 1, 0}, sections, diag);
}

int field_check(const struct record *record, const void *base, struct diag *diag)
{
    return field_check_sections(record, base, ~0U, diag);
}
