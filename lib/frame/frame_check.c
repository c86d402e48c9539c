#include "frame/frame_check.h"

#include "base/hash.h"
#include "base/intern.h"
#include "frame/frame_order.h"
#include "text/document.h"
#include "text/record_write.h"

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
        if (own && record_write_check(&lost_group_record, group, ~0U, diag) != 0)
            return diag_prefix(diag, "lost[%zu].", i);
    }
    return 0;
}

int frame_check_part(struct frame *frame, struct frame_part part, struct diag *diag)
{
    unsigned whole = part.sections & ~(unsigned)SECTION_LOST;
    if (record_write_check(&frame_record, frame, whole, diag) != 0 ||
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
            ? record_write_check(record, entry, ~0U, diag)
            : diag_fail(diag, DIAG_DATA, "amplitude: %g; expected a finite number", amplitude);
    return result == 0 ? 0 : diag_prefix(diag, "object \"%s\", seen by \"%s\": ", object, sensor);
}

int frame_check_object(const struct object *object, struct diag *diag)
{
    if (document_check_plain(object->class, diag) != 0)
        return diag_prefix(diag, "class: ");
    return record_write_check(&object_record, object, ~0U, diag);
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
    return result != 0 ? -1 : record_write_check(&frame_record, frame, SECTION_COUNTS, diag);
}

/* The place of an echo that is in no target. */
#define LOST SIZE_MAX

/* One entry of an echo: in the target, cell or list of echoes of this number, or LOST. */
struct outcome {
    const char *sensor;
    struct echo_id id;
    size_t place;
};

/* A hash table finds the entries of an echo, so that the time of the check is linear in the size of
 * the frame. */
struct account_check {
    const struct frame *frame;
    struct outcome *outcomes; /* of each echo the entry that was noted last */
    uint32_t count;
    struct hash_table numbers;     /* of outcomes */
    const struct outcome *doubled; /* of the echoes with two entries the first in canonical order */
    struct {
        const char *text;
        uint64_t hash;
    } object;              /* cache of the last hash, as echoes of one object stand together */
    struct intern sensors; /* those with counts first, in their order */
    /* By path, of each sensor with counts; the last numbers are those of the others. */
    int64_t (*entries)[PATH_COUNT];
    struct {
        const char *text;
        uint32_t number;
    } sensor; /* cache of the last number */
};

static bool is_echo(const void *outcomes, uint32_t number, const void *wanted)
{
    const struct outcome *a = (const struct outcome *)outcomes + number, *b = wanted;
    return frame_same_name(a->sensor, b->sensor) && frame_order_echo_ids(a->id, b->id) == 0;
}

static bool stands_before(const struct outcome *a, const struct outcome *b)
{
    int order = strcmp(a->sensor, b->sensor);
    return order != 0 ? order < 0 : frame_order_echo_ids(a->id, b->id) < 0;
}

static uint64_t hash_name(uint64_t hash, const char *name)
{
    return hash_table_hash(hash, name, strlen(name));
}

static uint32_t sensor_number(struct account_check *check, const char *sensor, struct arena *arena)
{
    if (check->sensor.text != sensor) {
        check->sensor.text = sensor;
        check->sensor.number = intern_word(&check->sensors, sensor, arena);
    }
    return check->sensor.number;
}

/* The sensor is the one whose number was asked for last. */
static uint64_t hash_of(struct account_check *check, const struct echo_id *id)
{
    if (check->object.text != id->object) {
        check->object.text = id->object;
        check->object.hash = hash_name(0, id->object);
    }
    uint64_t hash = hash_name(check->object.hash, id->reflector);
    if (id->mirror != NULL)
        hash = hash_name(hash, id->mirror);
    return hash_table_mix(hash, (uint64_t)id->path << 56 ^ (uint64_t)check->sensor.number << 32 ^
                                    (uint64_t)id->number);
}

/* Notes an entry; those of targets, in their order, come before those of lost. Entries of one echo
 * in several targets are one; a second entry in one target, or in lost, is a fault. Returns true
 * for an echo that had no entry before. */
static bool note(struct account_check *check, struct outcome outcome)
{
    uint32_t *slot = hash_table_slot(&check->numbers, hash_of(check, &outcome.id), is_echo,
                                     check->outcomes, &outcome);
    if (*slot == 0) {
        check->outcomes[check->count++] = outcome;
        *slot = check->count;
        return true;
    }
    struct outcome *last = &check->outcomes[*slot - 1];
    if ((last->place == outcome.place || outcome.place == LOST) &&
        (check->doubled == NULL || stands_before(last, check->doubled)))
        check->doubled = last;
    last->place = outcome.place;
    return false;
}

/* The section that says which echoes are not lost. */
static enum section kept_in(const struct frame *frame)
{
    return (frame->present & SECTION_TARGETS) != 0 ? SECTION_TARGETS
           : (frame->present & SECTION_CELLS) != 0 ? SECTION_CELLS
                                                   : SECTION_ECHOES;
}

static size_t count_kept(const struct frame *frame)
{
    size_t count = 0;
    if (kept_in(frame) == SECTION_TARGETS)
        for (size_t i = 0; i < frame->targets.count; i++)
            count += frame->targets.items[i].contributors.count;
    else if (kept_in(frame) == SECTION_CELLS)
        for (size_t i = 0; i < frame->cells.count; i++)
            count += frame->cells.items[i].members.count;
    else
        count = frame->echoes.count;
    return count;
}

static struct account_check begin(const struct frame *frame)
{
    size_t count = count_kept(frame), counted = frame->counts.count;
    for (size_t i = 0; i < frame->lost.count; i++)
        count += frame->lost.items[i].echoes.count;
    struct account_check check = {
        .frame = frame,
        .outcomes = arena_room(frame->arena, count * sizeof(struct outcome)),
        .numbers = hash_table_begin(count, frame->arena),
        .sensors = intern_begin(counted, frame->arena),
        .entries = arena_get(frame->arena, (counted + 1) * sizeof(int64_t[PATH_COUNT])),
    };
    for (size_t i = 0; i < counted; i++)
        sensor_number(&check, frame->counts.items[i].sensor, frame->arena);
    return check;
}

/* The numbers of entries of a sensor with a count, or of all others together. */
static int64_t *entries_of(struct account_check *check, const char *sensor)
{
    const struct frame *frame = check->frame;
    size_t number = sensor_number(check, sensor, frame->arena), counted = frame->counts.count;
    return check->entries[number < counted ? number : counted];
}

static void collect_members(struct account_check *check, const char *sensor, size_t place,
                            const struct contributor *members, size_t count)
{
    int64_t *entries = entries_of(check, sensor);
    for (size_t i = 0; i < count; i++)
        entries[members[i].id.path] += note(check, (struct outcome){sensor, members[i].id, place});
}

static void collect_kept(struct account_check *check)
{
    const struct frame *frame = check->frame;
    const struct target *target = frame->targets.items;
    const struct cell *cell = frame->cells.items;
    const struct echo *echo = frame->echoes.items;
    if (kept_in(frame) == SECTION_TARGETS)
        for (size_t i = 0; i < frame->targets.count; i++)
            collect_members(check, target[i].sensor, i, target[i].contributors.items,
                            target[i].contributors.count);
    else if (kept_in(frame) == SECTION_CELLS)
        for (size_t i = 0; i < frame->cells.count; i++)
            collect_members(check, cell[i].sensor, i, cell[i].members.items, cell[i].members.count);
    else
        for (size_t i = 0; i < frame->echoes.count; i++) {
            int64_t *entries = entries_of(check, echo[i].sensor);
            entries[echo[i].id.path] +=
                note(check, (struct outcome){echo[i].sensor, echo[i].id, 0});
        }
}

static void collect_lost(struct account_check *check)
{
    const struct frame *frame = check->frame;
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        int64_t *entries = entries_of(check, group->sensor);
        for (size_t j = 0; j < group->echoes.count; j++) {
            const struct echo_id *id = &group->echoes.items[j].id;
            entries[id->path] += note(check, (struct outcome){group->sensor, *id, LOST});
        }
    }
}

/* Along the direct path every pair has an entry, whether it made an echo or not. */
static int64_t due_along(enum path path, const struct count *count)
{
    return path == PATH_DIRECT ? count->pairs : frame_counted_echoes(count, path);
}

static int compare(const int64_t *entries, const struct count *counted, struct diag *diag)
{
    for (enum path path = 0; path < PATH_COUNT; path++) {
        int64_t due = due_along(path, counted);
        if (entries[path] != due)
            return diag_fail(
                diag, DIAG_DATA, "account: sensor \"%s\" has %lld entries of path %s; %lld are due",
                counted->sensor, (long long)entries[path], frame_paths[path], (long long)due);
    }
    return 0;
}

static int compare_with_counts(const struct account_check *check, struct diag *diag)
{
    const struct frame *frame = check->frame;
    int64_t others = 0;
    for (size_t i = 0; i < frame->counts.count; i++)
        if (compare(check->entries[i], &frame->counts.items[i], diag) != 0)
            return -1;
    for (enum path path = 0; path < PATH_COUNT; path++)
        others += check->entries[frame->counts.count][path];
    return others == 0
               ? 0
               : diag_fail(diag, DIAG_DATA, "account: %lld entries of sensors without a count",
                           (long long)others);
}

int frame_check_account(const struct frame *frame, struct diag *diag)
{
    struct account_check check = begin(frame);
    collect_kept(&check);
    collect_lost(&check);
    if (check.doubled != NULL)
        return diag_fail(diag, DIAG_DATA,
                         "account: sensor \"%s\", object \"%s\", reflector \"%s\" has two "
                         "entries",
                         check.doubled->sensor, check.doubled->id.object,
                         check.doubled->id.reflector);
    return compare_with_counts(&check, diag);
}
