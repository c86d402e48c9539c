#include "run/extraction.h"

#include "frame/frame_order.h"

/* An object of size zero takes its class's default size. */
static void complete_size(struct object *object, const struct vehicle *vehicle)
{
    if (object->length_m == 0)
        object->length_m = vehicle->length_m;
    if (object->width_m == 0)
        object->width_m = vehicle->width_m;
    if (object->height_m == 0)
        object->height_m = vehicle->height_m;
}

/* The vehicle's set of reflectors in the frame, made for the first object of its class. */
static struct reflector_set *set_of(struct frame *frame, const struct vehicle *vehicle,
                                    extraction_describe *describe, const void *state)
{
    for (size_t i = 0; i < frame->reflectors.count; i++)
        if (frame->reflectors.items[i].model == vehicle->reflectors.model)
            return &frame->reflectors.items[i];
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = vehicle->reflectors;
    if (describe != NULL)
        describe(state, vehicle, set, frame->arena);
    return set;
}

int extraction_step(struct frame *frame, struct runner *runner, extraction_describe *describe,
                    const void *state)
{
    struct object *const *object = frame_order_objects(frame);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct vehicle *vehicle = runner_vehicle(runner, object[i]->class);
        if (vehicle == NULL)
            return diag_prefix(runner_diag(runner),
                               "objects[%zu].class: ", (size_t)(object[i] - frame->objects.items));
        complete_size(object[i], vehicle);
        if (frame_same_name(object[i]->id, frame->ego))
            continue;
        struct reflector_set *set = set_of(frame, vehicle, describe, state);
        *list_add(&set->objects, frame->arena) = object[i]->id;
    }
    return 0;
}
