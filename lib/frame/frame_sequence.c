#include "frame/frame_sequence.h"

#include <inttypes.h>

/* Two numbers that tell one thing from another, without padding. */
struct pair {
    uint64_t first, second;
};

static uint32_t scene_of(struct frame_sequence *sequence, const struct frame *frame,
                         struct frame_place place, struct arena *arena)
{
    uint32_t name = intern_word(&sequence->names, frame->scene, arena);
    struct pair key = {name, frame->seed};
    uint32_t number = intern_number(&sequence->keys, &key, sizeof key, arena);
    if (number == sequence->scenes.count)
        *list_add(&sequence->scenes, arena) = (struct scene_progress){
            intern_text(&sequence->names, name), frame->seed, -1, false, place};
    return number;
}

/* Puts the frame's number and scene in front of a message about it. */
static int refuse(const struct frame *frame, struct diag *diag)
{
    return diag_prefix(diag, "frame: %" PRId64 " of scene \"%s\" with seed %" PRIu64 " ",
                       frame->frame, frame->scene, frame->seed);
}

/* Notes a frame of a scene, which must come behind the scene's latest one. */
static int ascend(struct scene_progress *scene, const struct frame *frame, struct diag *diag)
{
    if (frame->frame > scene->frame) {
        scene->frame = frame->frame;
        return 0;
    }
    diag_fail(diag, DIAG_DATA, "comes behind frame %" PRId64 "; that scene began at %s:%zu",
              scene->frame, scene->begin.file, scene->begin.line);
    return refuse(frame, diag);
}

int frame_sequence_ascend(struct frame_sequence *sequence, const struct frame *frame,
                          struct frame_place place, struct arena *arena, struct diag *diag)
{
    uint32_t scene = scene_of(sequence, frame, place, arena);
    return ascend(&sequence->scenes.items[scene], frame, diag);
}

int frame_sequence_follow(struct frame_sequence *sequence, const struct frame *frame,
                          struct frame_place place, struct arena *arena, struct diag *diag)
{
    uint32_t number = scene_of(sequence, frame, place, arena);
    struct scene_progress *scene = &sequence->scenes.items[number];
    bool closed = frame->frame > scene->frame && scene->closed;
    if (closed)
        diag_fail(diag, DIAG_DATA, "comes after its last one");
    else if (frame->frame > scene->frame + 1)
        diag_fail(diag, DIAG_DATA, "is out of order; expected %" PRId64, scene->frame + 1);
    if (closed || frame->frame > scene->frame + 1)
        return refuse(frame, diag);
    scene->closed = frame->last;
    return ascend(scene, frame, diag);
}

int frame_sequence_once(struct frame_sequence *sequence, const struct frame *frame,
                        struct frame_place place, struct arena *arena, struct diag *diag)
{
    struct pair key = {scene_of(sequence, frame, place, arena), (uint64_t)frame->frame};
    uint32_t number = intern_number(&sequence->frames, &key, sizeof key, arena);
    if (number == sequence->places.count) {
        *list_add(&sequence->places, arena) = place;
        return 0;
    }
    struct frame_place first = sequence->places.items[number];
    diag_fail(diag, DIAG_DATA, "stands at %s:%zu already", first.file, first.line);
    return refuse(frame, diag);
}

int frame_sequence_one_seed(const struct frame_sequence *sequence, struct diag *diag)
{
    if (sequence->names.list.count == sequence->scenes.count)
        return 0;
    const struct scene_progress *scene = &sequence->scenes.items[sequence->scenes.count - 1];
    return diag_fail(diag, DIAG_DATA,
                     "seed: %" PRIu64 " of scene \"%s\", which came with another seed before",
                     scene->seed, scene->name);
}

int frame_sequence_end(const struct frame_sequence *sequence, struct diag *diag)
{
    if (sequence->scenes.count == 0)
        return diag_fail(diag, DIAG_DATA, "no frame at all; expected whole scenes");
    for (size_t i = 0; i < sequence->scenes.count; i++) {
        const struct scene_progress *scene = &sequence->scenes.items[i];
        if (!scene->closed)
            return diag_fail(diag, DIAG_DATA,
                             "scene \"%s\" with seed %" PRIu64 " ends before its last frame",
                             scene->name, scene->seed);
    }
    return 0;
}
