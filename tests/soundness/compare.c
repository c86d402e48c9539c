#include "compare.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "frame/frame_order.h"

static const char *draw_address_of(const struct field *field, const void *base)
{
    return (const char *)base + field->offset;
}

static bool same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

/* Pointers in lists and names have no type that the table knows. */
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
        if (field->section != 0 &&
            field_present(record, field, a) != field_present(record, field, b))
            return diag_fail(diag, DIAG_DATA, "%s: only one has it", field->name);
        if (compare_members(field, a, b, diag) != 0)
            return -1;
    }
    return 0;
}

static const struct field *section(const char *name)
{
    return field_find(&frame_record, name, strlen(name), 0);
}

int compare_bits(const struct frame *all, const struct frame *chosen, struct diag *diag)
{
    unsigned both = SECTION_TARGETS | SECTION_LOST;
    if ((all->present & chosen->present & both) != both)
        return diag_fail(diag, DIAG_DATA, "targets or lost: missing");
    int result = compare_members(section("targets"), all, chosen, diag);
    return result == 0 ? compare_members(section("lost"), all, chosen, diag) : result;
}

static int compare_values(const char *name, double all, double chosen, double most,
                          struct diag *diag)
{
    return fabs(all - chosen) <= most
               ? 0
               : diag_fail(diag, DIAG_DATA, "%s: %.17g and %.17g", name, all, chosen);
}

static double change_db(double a, double b)
{
    return a == b ? 0 : fabs(20 * log10(a / b));
}

static double superposed(const struct cell *cell)
{
    return elementary_hypot(cell->sum_re, cell->sum_im);
}

static bool same_echo_id(const struct contributor *a, const struct contributor *b)
{
    return frame_order_echo_ids(a->id, b->id) == 0;
}

static double weight_of(const struct cell *cell, const struct contributor *member)
{
    for (size_t i = 0; i < cell->members.count; i++)
        if (same_echo_id(&cell->members.items[i], member))
            return cell->members.items[i].weight;
    return 0;
}

/* Members that only one cell has weigh nothing in the other. */
static int compare_weights(const struct cell *all, const struct cell *chosen, double most,
                           struct diag *diag)
{
    for (size_t i = 0; i < all->members.count + chosen->members.count; i++) {
        const struct contributor *member = i < all->members.count
                                               ? &all->members.items[i]
                                               : &chosen->members.items[i - all->members.count];
        if (compare_values("weight", weight_of(all, member), weight_of(chosen, member), most,
                           diag) != 0)
            return diag_prefix(diag, "%s.%s.", member->id.object, member->id.reflector);
    }
    return 0;
}

static int compare_cells(const struct cell *all, const struct cell *chosen,
                         const struct tolerance *tolerance, struct diag *diag)
{
    if (strcmp(all->sensor, chosen->sensor) != 0 ||
        !same_echo_id(all->members.items, chosen->members.items))
        return diag_fail(diag, DIAG_DATA, "leader");
    double share = 1 - pow(10, -tolerance->amplitude_db / 20);
    if (compare_values("range_m", all->range_m, chosen->range_m, tolerance->range_m, diag) != 0 ||
        compare_values("azimuth_rad", all->azimuth_rad, chosen->azimuth_rad, tolerance->azimuth_rad,
                       diag) != 0 ||
        compare_values("range_rate_mps", all->range_rate_mps, chosen->range_rate_mps,
                       tolerance->range_rate_mps, diag) != 0 ||
        compare_values("amplitude changes in dB", change_db(all->amplitude, chosen->amplitude), 0,
                       tolerance->amplitude_db, diag) != 0 ||
        compare_values("superposed amplitude changes in dB",
                       change_db(superposed(all), superposed(chosen)), 0, tolerance->amplitude_db,
                       diag) != 0)
        return -1;
    return compare_weights(all, chosen, share, diag);
}

static const struct target *target_of(const struct frame *frame, const struct cell *cell)
{
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (same_echo_id(target->contributors.items, cell->members.items) &&
            strcmp(target->sensor, cell->sensor) == 0)
            return target;
    }
    return NULL;
}

static int compare_noise(const struct frame *all, const struct frame *chosen, size_t number,
                         struct diag *diag)
{
    struct diag differ = {0};
    const struct cell *one = &all->cells.items[number], *other = &chosen->cells.items[number];
    if (compare_records(section("cells")->record, one, other, &differ) != 0)
        return 0;
    const struct target *left = target_of(all, one), *right = target_of(chosen, other);
    if (left == NULL || right == NULL ||
        compare_records(section("targets")->record, left, right, diag) == 0)
        return 0;
    return diag_prefix(diag, "noise on the same cell: ");
}

int compare_within(const struct frame *all, const struct frame *chosen,
                   const struct tolerance *tolerance, struct diag *diag)
{
    if (all->cells.count != chosen->cells.count)
        return diag_fail(diag, DIAG_DATA, "cells: %zu and %zu", all->cells.count,
                         chosen->cells.count);
    for (size_t i = 0; i < all->cells.count; i++)
        if (compare_cells(&all->cells.items[i], &chosen->cells.items[i], tolerance, diag) != 0 ||
            compare_noise(all, chosen, i, diag) != 0)
            return diag_prefix(diag, "cells[%zu].", i);
    return 0;
}
