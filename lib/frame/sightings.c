#include "frame/sightings.h"

#include <stdlib.h>

#include "frame/frame_order.h"

static const char *const levels[] = {"v0-40", "v40-60", "v60-80", "v80-100", NULL};

#define OPTIONAL_COUNT(member, help) OPTIONAL_INTEGER(struct sighting, member, 0, 1e12, help)

static const struct field sighting_fields[] = {
    {FIELD_NAME_OF(struct sighting, sensor, "name in the suite")},
    {FIELD_NAME_OF(struct sighting, object, "id of the object")},
    {OPTIONAL_COUNT(reflectors, "reflectors of it that the sensor looked for")},
    {OPTIONAL_COUNT(in_range, "of these, those that send towards the sensor and are in range")},
    {OPTIONAL_COUNT(in_view, "of these, those in the field of view")},
    {OPTIONAL_REAL(struct sighting, blocked_share, 0, 1, "share of these that a body hides")},
    {OPTIONAL_CHOICE(struct sighting, visibility, levels,
                     "share that is not hidden, in the levels of nuScenes; absent: none in view"),
     .absent = 4},
    {OPTIONAL_COUNT(detections, "targets with an echo of it, where it is")},
    {OPTIONAL_COUNT(merged, "of the detections, those with an echo of something else")},
    {OPTIONAL_COUNT(ghosts, "targets with an echo of it by way of a mirror")},
    {0},
};

const struct record sighting_record = {FIELD_TABLE(struct sighting, sighting_fields, "sighting",
                                                   "How much of an object a sensor sees.")};

void sightings_judge(struct sighting *sighting)
{
    double in_view = (double)sighting->in_view;
    double share = (in_view - (double)sighting->blocked) / in_view;
    bool seen = sighting->in_view > 0;
    sighting->blocked_share = seen ? (double)sighting->blocked / in_view : 0;
    sighting->visibility = seen ? (share >= 0.4) + (share >= 0.6) + (share >= 0.8) : 4;
}

static struct sighting *find(const struct frame *frame, const char *sensor, const char *object)
{
    const struct sighting wanted = {.sensor = sensor, .object = object};
    return bsearch(&wanted, frame->visibility.items, frame->visibility.count, sizeof wanted,
                   frame_order_sightings);
}

/* Counts a target once for each object and kind, however many contributors there are. */
static void count_target(struct frame *frame, const struct target *target, size_t number)
{
    const struct contributor *from = target->contributors.items;
    bool merged = false;
    for (size_t i = 1; i < target->contributors.count; i++)
        merged = merged || !frame_same_object(&from[i].id, &from[0].id);
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct echo_id *id = &from[i].id;
        struct sighting *sighting = find(frame, target->sensor, id->object);
        if (sighting == NULL)
            continue;
        if (frame_shows_object(id->path) && sighting->last_detection != number) {
            sighting->last_detection = number;
            sighting->detections++;
            sighting->merged += merged;
        } else if (id->mirror != NULL && sighting->last_ghost != number) {
            sighting->last_ghost = number;
            sighting->ghosts++;
        }
    }
}

void sightings_count_targets(struct frame *frame)
{
    if (frame->visibility.count == 0)
        return;
    frame_alter(frame, PART_VISIBILITY);
    for (size_t i = 0; i < frame->visibility.count; i++) {
        struct sighting *sighting = &frame->visibility.items[i];
        sighting->detections = sighting->merged = sighting->ghosts = 0;
        sighting->last_detection = sighting->last_ghost = 0;
    }
    for (size_t i = 0; i < frame->targets.count; i++)
        count_target(frame, &frame->targets.items[i], i + 1);
}
