#include "scan_point.h"
#include "base/elementary.h"

double scan_point_azimuth_rad(const struct target *target)
{
    if ((target->present & VALUE_ELEVATION) == 0)
        return target->azimuth_rad;
    struct vec2 place_m = frame_target_place(target);
    return elementary_atan2(place_m.y, place_m.x);
}

struct scan_point scan_point_of(struct trace *trace, const struct target *target)
{
    const struct contributor *from = frame_strongest(target);
    struct scan_point point = {.place_m = frame_target_place(target),
                               .path = PATH_FALSE_ALARM,
                               .contributors = (uint32_t)target->contributors.count};
    if ((target->present & VALUE_ELEVATION) != 0)
        point.up_m = target->range_m * elementary_sin(target->elevation_rad);
    if (from == NULL)
        return point;
    point.path = from->id.path;
    if (frame_object_of(trace->frame, &from->id) != NULL)
        point.object = trace_object(trace, from->id.object);
    return point;
}
