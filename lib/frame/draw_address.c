#include "draw_address.h"

#include "hash.h"

static uint64_t hash_subject(struct subject subject)
{
    uint64_t hash = hash_text(hash_text(HASH_START, subject.object), subject.reflector);
    hash = hash_bytes(hash, &(char){(char)subject.path}, 1);
    if (subject.mirror != NULL)
        hash = hash_text(hash, subject.mirror);
    for (uint64_t rest = (uint64_t)subject.number; rest > 0; rest >>= 8)
        hash = hash_bytes(hash, &(char){(char)rest}, 1);
    return hash;
}

struct random_address draw_address_of_scan(const struct frame *frame, const char *sensor)
{
    return (struct random_address){
        .seed = frame->seed,
        .scene = hash_text(HASH_START, frame->scene),
        .frame = (uint64_t)frame->frame,
        .sensor = hash_text(HASH_START, sensor),
    };
}

struct random_address draw_address_in(struct random_address scan, struct subject subject)
{
    scan.subject = hash_subject(subject);
    return scan;
}

struct random_address draw_address_of(const struct frame *frame, const char *sensor,
                                 struct subject subject)
{
    return draw_address_in(draw_address_of_scan(frame, sensor), subject);
}
