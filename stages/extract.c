/* Vehicle model extraction: objects become reflection centres (MODEL 2). */
#include <string.h>

#include "stage.h"

static struct reflector_set *set_of(struct frame *frame, const struct vehicle *vehicle)
{
    for (size_t i = 0; i < frame->reflectors.count; i++)
        if (frame->reflectors.items[i].model == vehicle->reflectors.model)
            return &frame->reflectors.items[i];
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = vehicle->reflectors;
    return set;
}

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

static int extract_step(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct object *object = &frame->objects.items[i];
        const struct vehicle *vehicle = runner_vehicle(runner, object->class);
        if (vehicle == NULL)
            return diag_prefix(runner_diag(runner), "objects[%zu].class: ", i);
        complete_size(object, vehicle);
        if (strcmp(object->id, frame->ego) != 0)
            *list_add(&set_of(frame, vehicle)->worn_by, frame->arena) = object->id;
    }
    return 0;
}

const struct stage stage_extract = {
    .name = "extract",
    .summary = "Write the reflection centres of every object's class.",
    .details = "The class of an object names a document in data/vehicles/. An object of size zero\n"
               "takes the default size of its class. The ego does not reflect.",
    .options = &stage_no_options,
    .reads = SECTION_OBJECTS,
    .writes = SECTION_OBJECTS | SECTION_REFLECTORS,
    .step = extract_step,
};
