#include "frame/draw_address.h"

#include "base/hash.h"

static uint64_t hash_echo_id(struct echo_id id)
{
    uint64_t hash = hash_text(hash_text(HASH_START, id.object), id.reflector);
    hash = hash_bytes(hash, &(char){(char)id.path}, 1);
    if (id.mirror != NULL)
        hash = hash_text(hash, id.mirror);
    for (uint64_t rest = (uint64_t)id.number; rest > 0; rest >>= 8)
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

struct random_address draw_address_in(struct random_address scan, struct echo_id id)
{
    scan.item = hash_echo_id(id);
    return scan;
}

struct random_address draw_address_of(const struct frame *frame, const char *sensor,
                                      struct echo_id id)
{
    return draw_address_in(draw_address_of_scan(frame, sensor), id);
}
