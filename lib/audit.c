#include "audit.h"

#include <stdint.h>
#include <string.h>

#include "frame_order.h"
#include "sort.h"

#define LOST SIZE_MAX

/* One place where an echo ended: a target, by its number, or lost. */
struct ending {
    const char *sensor;
    struct subject subject;
    size_t place;
};

static int compare_echoes(const struct ending *a, const struct ending *b)
{
    int order = strcmp(a->sensor, b->sensor);
    return order != 0 ? order : frame_order_subjects(a->subject, b->subject);
}

static int compare_endings(const void *left, const void *right)
{
    const struct ending *a = left, *b = right;
    int order = compare_echoes(a, b);
    return order != 0 ? order : (a->place > b->place) - (a->place < b->place);
}

static size_t collect(const struct frame *frame, struct ending *endings)
{
    size_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        for (size_t j = 0; j < target->contributors.count; j++, count++) {
            const struct contributor *from = &target->contributors.items[j];
            if (endings != NULL)
                endings[count] = (struct ending){target->sensor, SUBJECT_OF(from), i};
        }
    }
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        for (size_t j = 0; j < group->echoes.count; j++, count++) {
            const struct lost_echo *from = &group->echoes.items[j];
            if (endings != NULL)
                endings[count] = (struct ending){group->sensor, SUBJECT_OF(from), LOST};
        }
    }
    return count;
}

/* An echo that feeds several targets is one entry; twice in one target, or lost as well, it is one
 * too many. The endings are sorted; one of each echo moves to the front. */
static int drop_repeats(struct ending *endings, size_t *count, struct diag *diag)
{
    size_t kept = 0, place = 0;
    for (size_t i = 0; i < *count; i++) {
        bool repeated = kept > 0 && compare_echoes(&endings[kept - 1], &endings[i]) == 0;
        if (repeated && (endings[i].place == place || endings[i].place == LOST))
            return diag_fail(diag, DIAG_INTERNAL,
                             "account: sensor \"%s\", object \"%s\", reflector \"%s\" has two "
                             "entries",
                             endings[i].sensor, endings[i].subject.object,
                             endings[i].subject.reflector);
        place = endings[i].place;
        if (!repeated)
            endings[kept++] = endings[i];
    }
    *count = kept;
    return 0;
}

static int64_t endings_of(const struct ending *endings, size_t count, const char *sensor)
{
    int64_t number = 0;
    for (size_t i = 0; i < count; i++)
        if (strcmp(endings[i].sensor, sensor) == 0)
            number++;
    return number;
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

int audit_frame(const struct frame *frame, struct diag *diag)
{
    size_t count = collect(frame, NULL);
    struct ending *endings = arena_get(frame->arena, (count + 1) * sizeof *endings);
    collect(frame, endings);
    sort_items(endings, count, sizeof *endings, compare_endings, frame->arena);
    if (drop_repeats(endings, &count, diag) != 0)
        return -1;
    size_t covered = 0;
    for (size_t i = 0; i < frame->counts.count; i++) {
        const struct count *counted = &frame->counts.items[i];
        int64_t due = counted->pairs + made_indirectly(counted);
        int64_t entries = endings_of(endings, count, counted->sensor);
        if (entries != due)
            return diag_fail(diag, DIAG_INTERNAL,
                             "account: sensor \"%s\" has %lld entries; %lld are due",
                             counted->sensor, (long long)entries, (long long)due);
        covered += (size_t)entries;
    }
    if (covered != count)
        return diag_fail(diag, DIAG_INTERNAL, "account: %zu entries of sensors without a count",
                         count - covered);
    return 0;
}
