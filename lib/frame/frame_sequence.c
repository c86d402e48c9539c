#include "frame/frame_sequence.h"

static struct scene_progress *progress_of(struct frame_sequence *sequence, const char *name,
                                          struct arena *arena)
{
    uint32_t number = intern_word(&sequence->names, name, arena);
    if (number == sequence->scenes.count)
        *list_add(&sequence->scenes, arena) = (struct scene_progress){-1, false};
    return &sequence->scenes.items[number];
}

int frame_sequence_follow(struct frame_sequence *sequence, const struct frame *frame,
                          struct arena *arena, struct diag *diag)
{
    struct scene_progress *scene = progress_of(sequence, frame->scene, arena);
    if (scene->closed || frame->frame != scene->frame + 1)
        return diag_fail(diag, DIAG_DATA, "frame: %lld of scene \"%s\" %s", (long long)frame->frame,
                         frame->scene,
                         scene->closed ? "comes after its last one" : "is out of order");
    scene->frame = frame->frame;
    scene->closed = frame->last;
    return 0;
}

int frame_sequence_end(const struct frame_sequence *sequence, struct diag *diag)
{
    if (sequence->scenes.count == 0)
        return diag_fail(diag, DIAG_DATA, "no frame at all; expected whole scenes");
    for (size_t i = 0; i < sequence->scenes.count; i++)
        if (!sequence->scenes.items[i].closed)
            return diag_fail(diag, DIAG_DATA, "scene \"%s\" ends before its last frame",
                             intern_text(&sequence->names, (uint32_t)i));
    return 0;
}
