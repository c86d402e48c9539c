#include "compare.h"

#include <string.h>

static const char *draw_address_of(const struct field *field, const void *base)
{
    return (const char *)base + field->offset;
}

static bool same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

/* The text at the place of a name: items of lists have no type that the compiler knows, so they are
 * copied. */
static const char *text_at(const void *place)
{
    const char *text;
    memcpy(&text, place, sizeof text);
    return text;
}

static int compare_records(const struct record *record, const void *a, const void *b,
                           struct diag *diag);

static int compare_lists(const struct field *field, const void *a, const void *b, struct diag *diag)
{
    struct field_list left = field_list(field, a), right = field_list(field, b);
    size_t size = field->kind == FIELD_NAMES ? sizeof(const char *) : field->record->size;
    size_t count = left.count < right.count ? left.count : right.count;
    for (size_t i = 0; i < count; i++) {
        const char *one = (const char *)left.items + i * size;
        const char *other = (const char *)right.items + i * size;
        if (field->kind == FIELD_NAMES) {
            if (!same_text(text_at(one), text_at(other)))
                return diag_fail(diag, DIAG_DATA, "%s[%zu]", field->name, i);
        } else if (compare_records(field->record, one, other, diag) != 0) {
            return diag_prefix(diag, "%s[%zu].", field->name, i);
        }
    }
    return left.count == right.count ? 0
                                     : diag_fail(diag, DIAG_DATA, "%s: %zu and %zu", field->name,
                                                 left.count, right.count);
}

static size_t size_of(enum field_kind kind)
{
    return kind == FIELD_FLAG ? sizeof(bool) : kind == FIELD_CHOICE ? sizeof(int) : sizeof(double);
}

static int compare_members(const struct field *field, const void *a, const void *b,
                           struct diag *diag)
{
    const char *left = draw_address_of(field, a), *right = draw_address_of(field, b);
    switch (field->kind) {
    case FIELD_NAME:
    case FIELD_RAW:
        if (same_text(text_at(left), text_at(right)))
            return 0;
        break;
    case FIELD_NAMES:
    case FIELD_LIST:
        return compare_lists(field, a, b, diag);
    case FIELD_RECORD:
        return compare_records(field->record, left, right, diag) == 0
                   ? 0
                   : diag_prefix(diag, "%s.", field->name);
    case FIELD_NOTES:
        return 0;
    default:
        if (memcmp(left, right, size_of(field->kind)) == 0)
            return 0;
    }
    return diag_fail(diag, DIAG_DATA, "%s", field->name);
}

static int compare_records(const struct record *record, const void *a, const void *b,
                           struct diag *diag)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if (field->group != 0 && field_present(record, field, a) != field_present(record, field, b))
            return diag_fail(diag, DIAG_DATA, "%s: only one has it", field->name);
        if (compare_members(field, a, b, diag) != 0)
            return -1;
    }
    return 0;
}

static const struct field *part(const char *name)
{
    return field_find(&frame_record, name, strlen(name));
}

int compare_bits(const struct frame *all, const struct frame *chosen, bool account,
                 struct diag *diag)
{
    unsigned both = account ? PART_TARGETS | PART_LOST : PART_TARGETS;
    if ((all->present & chosen->present & both) != both)
        return diag_fail(diag, DIAG_DATA, "targets or lost: missing");
    int result = compare_members(part("targets"), all, chosen, diag);
    if (result == 0 && account)
        result = compare_members(part("lost"), all, chosen, diag);
    return result;
}
