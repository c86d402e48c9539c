#include "frame/frame_check.h"

#include "base/hash.h"
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

/* Names of strips without ids are unique by their numbers. */
static int check_roadside(const struct frame *frame, struct diag *diag)
{
    const struct roadside_strip *strips = frame->roadside.items;
    size_t named = 0;
    while (named < frame->roadside.count && strips[named].id == NULL)
        named++;
    if (named == frame->roadside.count)
        return 0;
    const char *twice = roadside_name_twice(strips, frame->roadside.count, frame->arena);
    return twice == NULL
               ? 0
               : diag_fail(diag, DIAG_DATA, "roadside: the name \"%s\" stands twice", twice);
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
    struct list_cache *cache = frame->list_cache;
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        struct reflector_set *set = &frame->reflectors.items[i];
        bool checked =
            reflectors_unchanged(set) || (cache != NULL && reflectors_recall(set, cache));
        const char *twice = checked ? NULL : reflectors_name_twice(set, frame->arena);
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
        if (!checked && cache != NULL)
            reflectors_keep(set, cache);
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

/* The sensors that a part names must be in the suite. Each struct begins with a sensor's name. */
static int check_listed(const struct frame *frame, const char *part, const void *items,
                        size_t count, size_t size, struct diag *diag)
{
    const char *listed = NULL; /* the sensor before: neighbours often share one */
    for (size_t i = 0; i < count; i++) {
        const void *item = (const char *)items + i * size;
        const char *sensor = *(const char *const *)item;
        if (sensor == listed)
            continue;
        if (frame_view(frame, sensor) == NULL)
            return diag_fail(diag, DIAG_DATA, "%s[%zu].sensor: \"%s\" is not in sensors.list", part,
                             i, sensor);
        listed = sensor;
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

/* Echoes, cells and targets name sensors, so that new sensors need a check of these parts too. */
int frame_check(struct frame *frame, unsigned parts, struct diag *diag)
{
    if ((parts & PART_SENSORS) != 0)
        parts |= PART_ECHOES | PART_CELLS | PART_TARGETS | PART_VISIBILITY;
    parts &= ~frame->line.unread;
    if ((parts & frame->present & PART_OBJECTS) != 0 && check_objects(frame, diag) != 0)
        return -1;
    bool good = ((parts & (PART_OBJECTS | PART_HEADER)) == 0 || check_roadside(frame, diag) == 0) &&
                ((parts & PART_REFLECTORS) == 0 || check_sets(frame, diag) == 0) &&
                ((parts & PART_SENSORS) == 0 || check_views(frame, diag) == 0) &&
                ((parts & PART_VISIBILITY) == 0 ||
                 check_listed(frame, "visibility", frame->visibility.items, frame->visibility.count,
                              sizeof *frame->visibility.items, diag) == 0) &&
                ((parts & PART_LOST) == 0 || check_lost(frame, diag) == 0) &&
                ((parts & PART_ECHOES) == 0 || check_echoes(frame, diag) == 0) &&
                ((parts & PART_CELLS) == 0 || check_cells(frame, diag) == 0) &&
                ((parts & PART_TARGETS) == 0 || check_targets(frame, diag) == 0);
    return good ? 0 : -1;
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

int frame_check_parts(struct frame *frame, struct frame_parts written, struct diag *diag)
{
    unsigned whole = written.parts & ~(unsigned)PART_LOST;
    if (frame->roadside.count > 0 || frame->conditions.interferers.count > 0)
        whole |= PART_HEADER;
    if (record_write_check(&frame_record, frame, whole, diag) != 0 ||
        ((written.parts & PART_LOST) != 0 && check_lost_members(frame, written.stage, diag) != 0))
        return -1;
    return frame_check(frame, written.parts, diag);
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
    return result != 0 ? -1
                       : record_write_check(&frame_record, frame, PART_COUNTS | PART_HEADER, diag);
}

/* The place of an echo that is in no target. */
#define LOST SIZE_MAX

/* One entry of an echo: in the target, cell or list of echoes of this number, or LOST. */
struct entry {
    const char *sensor;
    const struct echo_id *id;
    size_t place;
};

struct account {
    LIST_OF(struct entry) entries;
};

static void add_members(struct account *account, const char *sensor, size_t place,
                        const struct contributor *members, size_t count, struct arena *arena)
{
    for (size_t i = 0; i < count; i++)
        *list_add(&account->entries, arena) = (struct entry){sensor, &members[i].id, place};
}

/* Takes the echoes that are not lost from the targets, else from the cells, else as they are. */
static struct account account_of(const struct frame *frame)
{
    struct account account = {0};
    const struct target *target = frame->targets.items;
    const struct cell *cell = frame->cells.items;
    const struct echo *echo = frame->echoes.items;
    if ((frame->present & PART_TARGETS) != 0)
        for (size_t i = 0; i < frame->targets.count; i++)
            add_members(&account, target[i].sensor, i, target[i].contributors.items,
                        target[i].contributors.count, frame->arena);
    else if ((frame->present & PART_CELLS) != 0)
        for (size_t i = 0; i < frame->cells.count; i++)
            add_members(&account, cell[i].sensor, i, cell[i].members.items, cell[i].members.count,
                        frame->arena);
    else
        for (size_t i = 0; i < frame->echoes.count; i++)
            *list_add(&account.entries, frame->arena) =
                (struct entry){echo[i].sensor, &echo[i].id, 0};
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        for (size_t j = 0; j < group->echoes.count; j++)
            *list_add(&account.entries, frame->arena) =
                (struct entry){group->sensor, &group->echoes.items[j].id, LOST};
    }
    return account;
}

static int compare_entries(const struct entry *a, const struct entry *b)
{
    int order = frame_order_names(&a->sensor, &b->sensor);
    return order != 0 ? order : frame_order_echo_ids(a->id, b->id);
}

static bool is_echo(const void *entries, uint32_t number, const void *wanted)
{
    return compare_entries((const struct entry *)entries + number, wanted) == 0;
}

static uint64_t hash_name(uint64_t hash, const char *name)
{
    return name == NULL ? hash : hash_table_hash(hash, name, strlen(name));
}

static uint64_t hash_of(const struct entry *entry)
{
    const struct echo_id *id = entry->id;
    uint64_t hash = hash_name(hash_name(hash_name(0, entry->sensor), id->object), id->reflector);
    return hash_table_mix(hash_name(hash, id->mirror),
                          (uint64_t)id->path << 56 ^ (uint64_t)id->number);
}

/* Keeps one entry of each echo, in time linear in their number. An echo may be in several targets;
 * a second entry in one target, or in lost, is a fault. The message names the first faulty echo in
 * canonical order. */
static int join_entries(struct account *account, struct arena *arena, struct diag *diag)
{
    struct entry *entries = account->entries.items, doubled = {0};
    struct hash_table numbers = hash_table_begin(account->entries.count, arena);
    uint32_t kept = 0;
    for (size_t i = 0; i < account->entries.count; i++) {
        struct entry entry = entries[i];
        uint32_t *slot = hash_table_slot(&numbers, hash_of(&entry), is_echo, entries, &entry);
        struct entry *same = *slot > 0 ? &entries[*slot - 1] : &entries[kept];
        bool fault = *slot > 0 && (same->place == entry.place || entry.place == LOST);
        if (fault && (doubled.id == NULL || compare_entries(&entry, &doubled) < 0))
            doubled = entry;
        if (*slot == 0)
            *slot = ++kept;
        *same = entry;
    }
    account->entries.count = kept;
    return doubled.id == NULL
               ? 0
               : diag_fail(
                     diag, DIAG_DATA,
                     "account: sensor \"%s\", object \"%s\", reflector \"%s\" has two entries",
                     doubled.sensor, doubled.id->object, doubled.id->reflector);
}

/* Along the direct path every pair has an entry, whether it made an echo or not. */
static int compare(const int64_t *entries, const struct count *counted, struct diag *diag)
{
    for (enum path path = 0; path < PATH_COUNT; path++) {
        int64_t due = path == PATH_DIRECT ? counted->pairs : frame_counted_echoes(counted, path);
        if (entries[path] != due)
            return diag_fail(
                diag, DIAG_DATA, "account: sensor \"%s\" has %lld entries of path %s; %lld are due",
                counted->sensor, (long long)entries[path], frame_paths[path], (long long)due);
    }
    return 0;
}

/* The index of the sensor's count; the number of counts if there is none. guess is tried first. */
static size_t count_of(const struct frame *frame, const char *sensor, size_t guess)
{
    const struct count *counts = frame->counts.items;
    if (guess < frame->counts.count && frame_same_name(counts[guess].sensor, sensor))
        return guess;
    size_t i = 0;
    while (i < frame->counts.count && !frame_same_name(counts[i].sensor, sensor))
        i++;
    return i;
}

int frame_check_account(const struct frame *frame, struct diag *diag)
{
    struct account account = account_of(frame);
    size_t counted = frame->counts.count, at = 0;
    int64_t(*found)[PATH_COUNT] = arena_get(frame->arena, (counted + 1) * sizeof *found);
    int64_t others = 0;
    if (join_entries(&account, frame->arena, diag) != 0)
        return -1;
    for (size_t i = 0; i < account.entries.count; i++) {
        const struct entry *entry = &account.entries.items[i];
        at = count_of(frame, entry->sensor, at);
        found[at][entry->id->path]++;
        others += at == counted;
    }
    for (size_t i = 0; i < counted; i++)
        if (compare(found[i], &frame->counts.items[i], diag) != 0)
            return -1;
    return others == 0
               ? 0
               : diag_fail(diag, DIAG_DATA, "account: %lld entries of sensors without a count",
                           (long long)others);
}
