#include "audit.h"

#include <stdlib.h>
#include <string.h>

/* One place where an echo ended. */
struct ending {
    const char *sensor, *object, *reflector;
    enum path path;
};

static int compare_endings(const void *left, const void *right)
{
    const struct ending *a = left, *b = right;
    int order = strcmp(a->sensor, b->sensor);
    if (order == 0)
        order = (a->path > b->path) - (a->path < b->path);
    if (order == 0)
        order = strcmp(a->object, b->object);
    return order != 0 ? order : strcmp(a->reflector, b->reflector);
}

static size_t collect(const struct frame *frame, struct ending *endings)
{
    size_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        for (size_t j = 0; j < target->contributors.count; j++) {
            const struct contributor *from = &target->contributors.items[j];
            if (endings != NULL)
                endings[count] =
                    (struct ending){target->sensor, from->object, from->reflector, from->path};
            count++;
        }
    }
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        for (size_t j = 0; j < group->echoes.count; j++) {
            const struct lost_echo *from = &group->echoes.items[j];
            if (endings != NULL)
                endings[count] =
                    (struct ending){group->sensor, from->object, from->reflector, from->path};
            count++;
        }
    }
    return count;
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
    qsort(endings, count, sizeof *endings, compare_endings);
    for (size_t i = 1; i < count; i++)
        if (compare_endings(&endings[i - 1], &endings[i]) == 0)
            return diag_fail(diag, DIAG_INTERNAL,
                             "account: sensor \"%s\", object \"%s\", reflector \"%s\" has two "
                             "entries",
                             endings[i].sensor, endings[i].object, endings[i].reflector);
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
