#include "run/frame_sample.h"

#include <assert.h>
#include <inttypes.h>

#include "base/random.h"
#include "frame/frame_text.h"

/* Which of `choices` places: drawn for a stretch of this length, at this place among those of its
 * length. */
static int64_t draw(int64_t stretch, int64_t length, int64_t choices)
{
    double uniform[4];
    struct random_address address = {.frame = (uint64_t)stretch, .item = (uint64_t)length};
    random_uniform(&address, RANDOM_SAMPLE, 0, uniform);
    return (int64_t)(uniform[0] * (double)choices);
}

/* True if the frame is the one of its stretch. A stretch keeps what one of its halves keeps, so a
 * frame that is left out stays out when the stretches grow. */
static bool is_kept(int64_t place, int64_t stride)
{
    for (int64_t half = 1; half < stride; half *= 2)
        if (draw(place / half / 2, 2 * half, 2) != place / half % 2)
            return false;
    return true;
}

static void lengthen_stretches(struct frame_sample *sample)
{
    sample->stride *= 2;
    size_t kept = 0;
    for (size_t i = 0; i < sample->list.count; i++)
        if (is_kept(sample->list.items[i].place, sample->stride))
            sample->list.items[kept++] = sample->list.items[i];
    sample->list.count = kept;
}

/* Frames of one name and different seeds are of different scenes. */
static size_t scene_of(struct frame_sample *sample, const struct frame *frame)
{
    struct text key = {0};
    text_format(&key, "%" PRIu64 " %s", frame->seed, frame->scene);
    size_t number = intern_number(&sample->names, key.bytes, key.length, sample->arena);
    text_free(&key);
    return number;
}

int frame_sample_add(struct frame_sample *sample, const struct frame *frame, struct diag *diag)
{
    assert(sample->most >= 1);
    if (sample->seen == 0)
        sample->stride = 1;
    int64_t place = sample->seen++;
    if (!is_kept(place, sample->stride))
        return 0;
    struct frame bare = *frame;
    struct text line = {0};
    frame_drop(&bare, ~(unsigned)(PART_OBJECTS | PART_VEHICLES | PART_REFLECTORS));
    bare.sections = CARRY_BY_DEFAULT;
    frame_alter(&bare, PART_HEADER);
    int result = frame_text_write(&bare, &line, diag);
    if (result == 0)
        *list_add(&sample->list, sample->arena) = (struct sampled_frame){
            .line = arena_text(sample->arena, line.bytes, line.length - 1),
            .length = line.length - 1,
            .seed = frame->seed,
            .frame = frame->frame,
            .place = place,
            .scene = scene_of(sample, frame),
        };
    text_free(&line);
    while ((int64_t)sample->list.count / 2 >= sample->most)
        lengthen_stretches(sample);
    return result;
}

void frame_sample_thin(struct frame_sample *sample, int64_t most)
{
    assert(most >= 1);
    struct sampled_frame *frames = sample->list.items;
    int64_t count = (int64_t)sample->list.count;
    if (most >= count)
        return;
    for (int64_t i = 0; i < most; i++) {
        int64_t first = i * count / most, end = (i + 1) * count / most;
        frames[i] = frames[first + draw(i, most, end - first)];
    }
    sample->list.count = (size_t)most;
}
