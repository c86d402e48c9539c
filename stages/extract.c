/* Extraction of the vehicle model: objects get the reflection centres of their classes (MODEL 2).
 */
#include "run/extraction.h"

static bool describe_body(void *state, const struct vehicle *vehicle, const struct frame *frame,
                          const struct object *object, struct reflector_set *set)
{
    if (!reflector_models_differs(&vehicle->surface))
        return false;
    struct surface surface =
        reflector_models_surface(&reflector_models_usual_surface, &vehicle->surface);
    return extraction_describe_surface(state, &surface, vehicle, frame, object, set);
}

static int extract_step(void *state, struct frame *frame, struct runner *runner)
{
    return extraction_step(state, frame, runner, NULL, describe_body);
}

const struct stage stage_extract = {
    .name = "extract",
    .summary = "Write the reflection centres of every object's class.",
    .details =
        "The class of an object names a document in data/vehicles/. An object of size zero\n"
        "takes the default size of its class. The ego does not reflect. If the document has a\n"
        "surface, every object has scatterers of its own along its outline.",
    .options = &extraction_record,
    .reads = PART_OBJECTS,
    .writes = PART_REFLECTORS | PART_VEHICLES,
    .start = extraction_start,
    .step = extract_step,
    .locate_fault = extraction_locate_fault,
    .release = extraction_release,
};
