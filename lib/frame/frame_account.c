#include "frame/frame_account.h"

#include <stdint.h>
#include <string.h>

#include "base/hash.h"
#include "frame/frame_order.h"

#define LOST SIZE_MAX

/* One place where an echo ended: a target, by its number, or lost. */
struct outcome {
    const char *sensor;
    struct echo_id id;
    size_t place;
};

/* Endings are told apart by a hash table, one of each echo, so that the audit's time grows as the
 * frame does. */
struct account_check {
    struct outcome *outcomes;
    size_t count;
    struct outcome **slots;
    size_t slot_count;             /* a power of two */
    const struct outcome *doubled; /* the first in canonical order */
    struct {
        const char *text;
        uint64_t hash;
    } object; /* the last one: echoes of an object stand together */
};

static bool same_echo(const struct outcome *a, const struct outcome *b)
{
    return frame_same_name(a->sensor, b->sensor) && frame_order_echo_ids(a->id, b->id) == 0;
}

static bool stands_before(const struct outcome *a, const struct outcome *b)
{
    int order = strcmp(a->sensor, b->sensor);
    return order != 0 ? order < 0 : frame_order_echo_ids(a->id, b->id) < 0;
}

static struct outcome **slot_of(struct account_check *audit, const struct outcome *outcome)
{
    const struct echo_id *id = &outcome->id;
    if (audit->object.text != id->object) {
        audit->object.text = id->object;
        audit->object.hash = hash_for_table(HASH_START, id->object);
    }
    uint64_t hash = hash_for_table(audit->object.hash, id->reflector);
    if (id->mirror != NULL)
        hash = hash_for_table(hash, id->mirror);
    hash += (uint64_t)id->path + 31 * (uint64_t)id->number;
    for (;; hash++) {
        struct outcome **slot = &audit->slots[hash & (audit->slot_count - 1)];
        if (*slot == NULL || same_echo(*slot, outcome))
            return slot;
    }
}

/* An echo that feeds several targets is one entry; twice in one target, or lost as well, it is one
 * too many. Targets come first, in their order. True if the echo has not been seen before. */
static bool note(struct account_check *audit, struct outcome outcome)
{
    struct outcome **slot = slot_of(audit, &outcome);
    if (*slot == NULL) {
        audit->outcomes[audit->count] = outcome;
        *slot = &audit->outcomes[audit->count++];
        return true;
    }
    if (((*slot)->place == outcome.place || outcome.place == LOST) &&
        (audit->doubled == NULL || stands_before(*slot, audit->doubled)))
        audit->doubled = *slot;
    (*slot)->place = outcome.place;
    return false;
}

static size_t count_outcomes(const struct frame *frame)
{
    size_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++)
        count += frame->targets.items[i].contributors.count;
    for (size_t i = 0; i < frame->lost.count; i++)
        count += frame->lost.items[i].echoes.count;
    return count;
}

static struct account_check begin(const struct frame *frame)
{
    size_t count = count_outcomes(frame);
    struct account_check audit = {.slot_count = 1};
    while (audit.slot_count < 2 * count + 1)
        audit.slot_count *= 2;
    audit.outcomes = arena_room(frame->arena, count * sizeof *audit.outcomes);
    audit.slots = arena_get(frame->arena, audit.slot_count * sizeof(struct outcome *));
    return audit;
}

/* Adds entries of a sensor to its own, or to those of sensors without a count, which come last. */
static void add_entries(const struct frame *frame, const char *sensor, int64_t added,
                        int64_t *entries)
{
    size_t i = 0;
    while (i < frame->counts.count && !frame_same_name(frame->counts.items[i].sensor, sensor))
        i++;
    entries[i] += added;
}

static void collect(const struct frame *frame, struct account_check *audit, int64_t *entries)
{
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        int64_t added = 0;
        for (size_t j = 0; j < target->contributors.count; j++) {
            const struct contributor *from = &target->contributors.items[j];
            added += note(audit, (struct outcome){target->sensor, from->id, i});
        }
        add_entries(frame, target->sensor, added, entries);
    }
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        int64_t added = 0;
        for (size_t j = 0; j < group->echoes.count; j++) {
            const struct lost_echo *from = &group->echoes.items[j];
            added += note(audit, (struct outcome){group->sensor, from->id, LOST});
        }
        add_entries(frame, group->sensor, added, entries);
    }
}

/* Echoes beyond the direct ones: those are covered by the pairs. */
static int64_t made_indirectly(const struct count *count)
{
    int64_t made = 0;
    for (size_t i = 0; i < count->paths.count; i++)
        if (count->paths.items[i].path != PATH_DIRECT)
            made += count->paths.items[i].echoes;
    return made;
}

static int compare_with_counts(const struct frame *frame, const int64_t *entries, struct diag *diag)
{
    for (size_t i = 0; i < frame->counts.count; i++) {
        const struct count *counted = &frame->counts.items[i];
        int64_t due = counted->pairs + made_indirectly(counted);
        if (entries[i] != due)
            return diag_fail(diag, DIAG_INTERNAL,
                             "account: sensor \"%s\" has %lld entries; %lld are due",
                             counted->sensor, (long long)entries[i], (long long)due);
    }
    if (entries[frame->counts.count] != 0)
        return diag_fail(diag, DIAG_INTERNAL, "account: %lld entries of sensors without a count",
                         (long long)entries[frame->counts.count]);
    return 0;
}

int frame_account_check(const struct frame *frame, struct diag *diag)
{
    struct account_check audit = begin(frame);
    int64_t *entries = arena_get(frame->arena, (frame->counts.count + 1) * sizeof *entries);
    collect(frame, &audit, entries);
    if (audit.doubled != NULL)
        return diag_fail(diag, DIAG_INTERNAL,
                         "account: sensor \"%s\", object \"%s\", reflector \"%s\" has two "
                         "entries",
                         audit.doubled->sensor, audit.doubled->id.object,
                         audit.doubled->id.reflector);
    return compare_with_counts(frame, entries, diag);
}
