#include "frame/frame_check.h"

#include "frame/frame_order.h"
#include "text/document.h"
#include "text/field_check.h"

static int check_objects(struct frame *frame, struct diag *diag)
{
    struct object *const *object = frame_order_objects(frame);
    for (size_t i = 1; i < frame->objects.count; i++)
        if (frame_same_name(object[i - 1]->id, object[i]->id))
            return diag_fail(diag, DIAG_DATA, "objects: the id \"%s\" stands twice", object[i]->id);
    if (frame_object(frame, frame->ego) == NULL)
        return diag_fail(diag, DIAG_DATA, "ego: \"%s\" is not among the objects", frame->ego);
    for (size_t i = 0; i < frame->objects.count; i++)
        if (document_check_plain(frame->objects.items[i].class, diag) != 0)
            return diag_prefix(diag, "objects[%zu].class: ", i);
    return 0;
}

static const char *object_listed_twice(const struct reflector_set *set)
{
    for (size_t i = 1; i < set->objects.count; i++)
        if (frame_same_name(set->objects.items[i - 1], set->objects.items[i]))
            return set->objects.items[i];
    return NULL;
}

static int check_sets(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        const struct reflector_set *set = &frame->reflectors.items[i];
        const char *twice =
            reflectors_unchanged(set) ? NULL : reflectors_name_twice(set, frame->arena);
        if (twice == NULL)
            twice = object_listed_twice(set);
        if (twice != NULL)
            return diag_fail(diag, DIAG_DATA, "reflectors[%zu]: \"%s\" stands twice", i, twice);
        size_t unclear = reflectors_unclear_mirror(set);
        if (unclear < set->mirrors.count)
            return diag_fail(diag, DIAG_DATA,
                             "reflectors[%zu].mirrors[%zu]: expected either a material or a "
                             "reflection",
                             i, unclear);
    }
    return 0;
}

static int check_views(const struct frame *frame, struct diag *diag)
{
    const struct sensor_view *view = frame->sensors.list.items;
    if (frame->sensors.suite != NULL && document_check_plain(frame->sensors.suite, diag) != 0)
        return diag_prefix(diag, "sensors.suite: ");
    for (size_t i = 1; i < frame->sensors.list.count; i++)
        if (frame_same_name(view[i - 1].name, view[i].name))
            return diag_fail(diag, DIAG_DATA, "sensors.list: \"%s\" stands twice", view[i].name);
    return 0;
}

/* The sensors that a section names must be in the suite. Each struct begins with the sensor's name.
 */
static int check_listed(const struct frame *frame, const char *section, const void *items,
                        size_t count, size_t size, struct diag *diag)
{
    for (size_t i = 0; i < count; i++) {
        const void *item = (const char *)items + i * size;
        const char *sensor = *(const char *const *)item;
        if (frame_view(frame, sensor) == NULL)
            return diag_fail(diag, DIAG_DATA, "%s[%zu].sensor: \"%s\" is not in sensors.list",
                             section, i, sensor);
    }
    return 0;
}

static int check_echoes(const struct frame *frame, struct diag *diag)
{
    const struct echo *echo = frame->echoes.items;
    for (size_t i = 0; i < frame->echoes.count; i++) {
        if (i > 0 && frame_order_echoes(&echo[i - 1], &echo[i]) == 0)
            return diag_fail(diag, DIAG_DATA,
                             "echoes: sensor \"%s\", object \"%s\", reflector \"%s\" stands twice",
                             echo[i].sensor, echo[i].id.object, echo[i].id.reflector);
        if (echo[i].id.path == PATH_FALSE_ALARM)
            return diag_fail(diag, DIAG_DATA,
                             "echoes[%zu].path: false_alarm; expected the path of a wave", i);
    }
    return check_listed(frame, "echoes", echo, frame->echoes.count, sizeof *echo, diag);
}

static int check_cells(const struct frame *frame, struct diag *diag)
{
    const struct cell *cell = frame->cells.items;
    for (size_t i = 0; i < frame->cells.count; i++) {
        if (cell[i].members.count == 0)
            return diag_fail(diag, DIAG_DATA, "cells[%zu].members: empty; expected the leader", i);
        if (i > 0 && frame_order_cells(&cell[i - 1], &cell[i]) == 0)
            return diag_fail(diag, DIAG_DATA,
                             "cells: sensor \"%s\" has two led by object \"%s\", reflector \"%s\"",
                             cell[i].sensor, cell[i].members.items[0].id.object,
                             cell[i].members.items[0].id.reflector);
    }
    return check_listed(frame, "cells", cell, frame->cells.count, sizeof *cell, diag);
}

static int check_targets(const struct frame *frame, struct diag *diag)
{
    const struct target *target = frame->targets.items;
    for (size_t i = 0; i < frame->targets.count; i++)
        if (target[i].contributors.count == 0)
            return diag_fail(diag, DIAG_DATA, "targets[%zu].contributors: empty; expected a label",
                             i);
    return check_listed(frame, "targets", target, frame->targets.count, sizeof *target, diag);
}

static int check_lost(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->lost.count; i++) {
        const char *reason = frame->lost.items[i].reason;
        if (reason[strspn(reason, "abcdefghijklmnopqrstuvwxyz_")] != '\0')
            return diag_fail(diag, DIAG_DATA,
                             "lost[%zu].reason: \"%s\" is no reason; expected letters a to z and _",
                             i, reason);
    }
    return 0;
}

/* Echoes, cells and targets name sensors, so that new sensors need a check of these sections too.
 */
static int check_sections(struct frame *frame, unsigned sections, struct diag *diag)
{
    if ((sections & SECTION_SENSORS) != 0)
        sections |= SECTION_ECHOES | SECTION_CELLS | SECTION_TARGETS | SECTION_VISIBILITY;
    if ((sections & frame->present & SECTION_OBJECTS) != 0 && check_objects(frame, diag) != 0)
        return -1;
    bool good = ((sections & SECTION_REFLECTORS) == 0 || check_sets(frame, diag) == 0) &&
                ((sections & SECTION_SENSORS) == 0 || check_views(frame, diag) == 0) &&
                ((sections & SECTION_VISIBILITY) == 0 ||
                 check_listed(frame, "visibility", frame->visibility.items, frame->visibility.count,
                              sizeof *frame->visibility.items, diag) == 0) &&
                ((sections & SECTION_LOST) == 0 || check_lost(frame, diag) == 0) &&
                ((sections & SECTION_ECHOES) == 0 || check_echoes(frame, diag) == 0) &&
                ((sections & SECTION_CELLS) == 0 || check_cells(frame, diag) == 0) &&
                ((sections & SECTION_TARGETS) == 0 || check_targets(frame, diag) == 0);
    return good ? 0 : -1;
}

int frame_check(struct frame *frame, struct diag *diag)
{
    return check_sections(frame, ~0U, diag);
}

static int check_lost_members(const struct frame *frame, const char *stage, struct diag *diag)
{
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        bool own = stage == NULL || frame_same_name(group->stage, stage);
        if (own && field_check(&lost_group_record, group, diag) != 0)
            return diag_prefix(diag, "lost[%zu].", i);
    }
    return 0;
}

int frame_check_part(struct frame *frame, struct frame_part part, struct diag *diag)
{
    unsigned whole = part.sections & ~(unsigned)SECTION_LOST;
    if (field_check_sections(&frame_record, frame, whole, diag) != 0 ||
        ((part.sections & SECTION_LOST) != 0 && check_lost_members(frame, part.stage, diag) != 0))
        return -1;
    return check_sections(frame, part.sections, diag);
}

/* An entry's own values. An amplitude beyond the doubles is told before the angle it spoils. */
static int check_entry(const struct record *record, const void *entry, double amplitude,
                       const char *sensor, const char *object, struct diag *diag)
{
    int result =
        isfinite(amplitude)
            ? field_check(record, entry, diag)
            : diag_fail(diag, DIAG_DATA, "amplitude: %g; expected a finite number", amplitude);
    return result == 0 ? 0 : diag_prefix(diag, "object \"%s\", seen by \"%s\": ", object, sensor);
}

int frame_check_object(const struct object *object, struct diag *diag)
{
    if (document_check_plain(object->class, diag) != 0)
        return diag_prefix(diag, "class: ");
    return field_check(&object_record, object, diag);
}

int frame_check_extremes(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++)
        if (frame_check_object(&frame->objects.items[i], diag) != 0)
            return diag_prefix(diag, "object \"%s\": ", frame->objects.items[i].id);
    int result = 0;
    for (size_t i = 0; i < frame->echoes.count && result == 0; i++) {
        const struct echo *echo = &frame->echoes.items[i];
        result = check_entry(&echo_record, echo, 0, echo->sensor, echo->id.object, diag);
    }
    for (size_t i = 0; i < frame->cells.count && result == 0; i++) {
        const struct cell *cell = &frame->cells.items[i];
        if (cell->members.count > 0)
            result = check_entry(&cell_record, cell, cell->amplitude, cell->sensor,
                                 cell->members.items[0].id.object, diag);
    }
    for (size_t i = 0; i < frame->targets.count && result == 0; i++) {
        const struct target *target = &frame->targets.items[i];
        if (target->contributors.count > 0)
            result = check_entry(&target_record, target, target->cell_amplitude, target->sensor,
                                 target->contributors.items[0].id.object, diag);
    }
    return result != 0 ? -1 : field_check_sections(&frame_record, frame, SECTION_COUNTS, diag);
}
