#include "trace.h"
#include "base/elementary.h"
#include "frame/frame_order.h"

uint64_t trace_ns(const struct trace *trace, double time_s)
{
    double shifted_s = time_s + trace->shift_s, whole_s = floor(shifted_s);
    return (uint64_t)whole_s * TRACE_SECOND_NS + (uint64_t)round((shifted_s - whole_s) * 1e9);
}

uint32_t trace_object(struct trace *trace, const char *id)
{
    return intern_word(&trace->objects, id, trace->arena) + 1;
}

/* The shift that brings all scans of the first frame to begin_s or later, 0 if none is needed. A
 * frame at 0 s has scans from before 0, as old as its radars' latency. */
static double first_shift_s(const struct trace *trace, const struct frame *frame)
{
    double age_s = 0;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        age_s = elementary_max(age_s, frame->sensors.list.items[i].age_s);
    double shift_s = trace->begin_s + age_s;
    return frame->time_s >= 0 && frame->time_s < shift_s ? shift_s : 0;
}

static int check_times(struct trace *trace, const struct frame *frame, bool first,
                       struct diag *diag)
{
    double last_s = frame->time_s + trace->shift_s, first_s = last_s;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured)
            first_s = elementary_min(first_s, last_s - frame->sensors.list.items[i].age_s);
    if (first_s < 0 || last_s > trace->end_s)
        return diag_fail(diag, DIAG_DATA,
                         "time_s: a measurement at %.12g s; expected one in [0, %.12g] s: "
                         "--shift-s is added to all times",
                         first_s < 0 ? first_s : last_s, trace->end_s);
    uint64_t before_ns = trace->time_ns;
    trace->time_ns = trace_ns(trace, frame->time_s);
    if (!first && trace->time_ns <= before_ns)
        return diag_fail(diag, DIAG_DATA, "time_s: %.12g after %.12g; expected ascending times",
                         frame->time_s, (double)before_ns / 1e9 - trace->shift_s);
    return 0;
}

static int check_objects(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        if (object->length_m == 0 || object->width_m == 0 || object->height_m == 0)
            return diag_fail(diag, DIAG_DATA,
                             "objects: \"%s\" has no length, width or height; expected "
                             "glint-extract before this one",
                             object->id);
    }
    return 0;
}

static int check_scans(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->targets.count; i++) {
        const char *sensor = frame->targets.items[i].sensor;
        if (!frame_view(frame, sensor)->measured)
            return diag_fail(diag, DIAG_DATA,
                             "targets[%zu].sensor: \"%s\" has no scan in this frame; expected one "
                             "that is measured in sensors.list",
                             i, sensor);
    }
    return 0;
}

int trace_take(struct trace *trace, struct frame *frame, struct diag *diag)
{
    bool first = trace->scene == NULL;
    if (first && isinf(trace->shift_s))
        trace->shift_s = first_shift_s(trace, frame);
    if (first) {
        trace->scene = arena_text(trace->arena, frame->scene, strlen(frame->scene));
        trace->seed = frame->seed;
    }
    if (strcmp(trace->scene, frame->scene) != 0 || trace->seed != frame->seed)
        return diag_fail(diag, DIAG_DATA,
                         "scene: \"%s\" after \"%s\"; expected one scene of one seed", frame->scene,
                         trace->scene);
    if (!frame_carries(frame, CARRY_QUALITY))
        return diag_fail(diag, DIAG_DATA,
                         "quality: missing; expected --sections quality at glint-noise or before, "
                         "for errors, rcs, snr and existence");
    frame_order_objects(frame);
    trace->frame = frame;
    if (check_times(trace, frame, first, diag) != 0 || check_objects(frame, diag) != 0)
        return -1;
    return check_scans(frame, diag);
}
