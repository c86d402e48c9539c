#include "completeness.h"

#include <string.h>

#include "hash.h"

/* The slot of that scene: its own, or the empty one where it belongs. */
static size_t *slot_of(const struct completeness *completeness, const char *name)
{
    size_t mask = completeness->slot_count - 1;
    size_t at = (size_t)hash_text(HASH_START, name) & mask;
    while (completeness->slots[at] != 0 &&
           strcmp(completeness->scenes.items[completeness->slots[at] - 1].name, name) != 0)
        at = (at + 1) & mask;
    return &completeness->slots[at];
}

static void make_room(struct completeness *completeness, struct arena *arena)
{
    if (2 * (completeness->scenes.count + 1) <= completeness->slot_count)
        return;
    completeness->slot_count = completeness->slot_count == 0 ? 16 : 2 * completeness->slot_count;
    completeness->slots = arena_get(arena, completeness->slot_count * sizeof(size_t));
    for (size_t i = 0; i < completeness->scenes.count; i++)
        *slot_of(completeness, completeness->scenes.items[i].name) = i + 1;
}

static struct scene_progress *progress_of(struct completeness *completeness, const char *name,
                                          struct arena *arena)
{
    make_room(completeness, arena);
    size_t *slot = slot_of(completeness, name);
    if (*slot == 0) {
        *list_add(&completeness->scenes, arena) =
            (struct scene_progress){arena_text(arena, name, strlen(name)), -1, false};
        *slot = completeness->scenes.count;
    }
    return &completeness->scenes.items[*slot - 1];
}

int completeness_follow(struct completeness *completeness, const struct frame *frame,
                        struct arena *arena, struct diag *diag)
{
    struct scene_progress *scene = progress_of(completeness, frame->scene, arena);
    if (scene->closed || frame->frame != scene->frame + 1)
        return diag_fail(diag, DIAG_DATA, "frame: %lld of scene \"%s\" %s", (long long)frame->frame,
                         frame->scene,
                         scene->closed ? "comes after its last one" : "is out of order");
    scene->frame = frame->frame;
    scene->closed = frame->last;
    return 0;
}

int completeness_end(const struct completeness *completeness, struct diag *diag)
{
    for (size_t i = 0; i < completeness->scenes.count; i++)
        if (!completeness->scenes.items[i].closed)
            return diag_fail(diag, DIAG_DATA, "scene \"%s\" ends before its last frame",
                             completeness->scenes.items[i].name);
    return 0;
}
