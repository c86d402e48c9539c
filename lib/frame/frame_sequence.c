#include "frame/frame_sequence.h"

static struct scene_progress *progress_of(struct frame_sequence *completeness, const char *name,
                                          struct arena *arena)
{
    uint32_t number = intern_word(&completeness->names, name, arena);
    if (number == completeness->scenes.count)
        *list_add(&completeness->scenes, arena) = (struct scene_progress){-1, false};
    return &completeness->scenes.items[number];
}

int frame_sequence_follow(struct frame_sequence *completeness, const struct frame *frame,
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

int frame_sequence_end(const struct frame_sequence *completeness, struct diag *diag)
{
    for (size_t i = 0; i < completeness->scenes.count; i++)
        if (!completeness->scenes.items[i].closed)
            return diag_fail(diag, DIAG_DATA, "scene \"%s\" ends before its last frame",
                             intern_text(&completeness->names, (uint32_t)i));
    return 0;
}
