#include "run/extraction.h"

#include "documents/vehicle_set.h"
#include "frame/frame_order.h"

static const struct field extraction_fields[] = {EXTRACTION_OPTIONS, {0}};

const struct record extraction_record = {
    .name = "extract", .size = sizeof(struct extraction), .fields = extraction_fields};

int extraction_start(void *state, struct runner *runner)
{
    struct extraction *extraction = state;
    return vehicle_set_folder("--vehicles", extraction->vehicles, &extraction->folder,
                              runner_arena(runner), runner_diag(runner));
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

/* A frame that was extracted before keeps to its documents. */
static int note_document(struct frame *frame, const struct vehicle *vehicle, struct diag *diag)
{
    const char *class = vehicle->reflectors.model;
    for (size_t i = 0; i < frame->vehicles.count; i++)
        if (frame_same_name(frame->vehicles.items[i].class, class))
            return frame->vehicles.items[i].digest == vehicle->digest
                       ? 0
                       : vehicle_check_frame(vehicle, frame, diag);
    *list_add(&frame->vehicles, frame->arena) =
        (struct class_document){.class = class,
                                .digest = vehicle->digest,
                                .rear_axle_x_m = vehicle->rear_axle_x_m,
                                .level = vehicle->level};
    return 0;
}

/* The vehicle's set of reflectors in the frame, made for the first object of its class. */
static struct reflector_set *set_of(struct frame *frame, const struct vehicle *vehicle,
                                    extraction_describe *describe,
                                    const struct extraction *extraction)
{
    for (size_t i = 0; i < frame->reflectors.count; i++)
        if (frame->reflectors.items[i].model == vehicle->reflectors.model)
            return &frame->reflectors.items[i];
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = vehicle->reflectors;
    if (describe != NULL)
        describe(extraction, vehicle, set, frame->arena);
    return set;
}

int extraction_step(const struct extraction *extraction, struct frame *frame, struct runner *runner,
                    extraction_describe *describe)
{
    struct object *const *object = frame_order_objects(frame);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct vehicle *vehicle =
            runner_vehicle(runner, extraction->folder, object[i]->class);
        if (vehicle == NULL)
            return diag_prefix(runner_diag(runner),
                               "objects[%zu].class: ", (size_t)(object[i] - frame->objects.items));
        if (note_document(frame, vehicle, runner_diag(runner)) != 0)
            return -1;
        complete_size(object[i], vehicle);
        if (frame_same_name(object[i]->id, frame->ego))
            continue;
        struct reflector_set *set = set_of(frame, vehicle, describe, extraction);
        *list_add(&set->objects, frame->arena) = object[i]->id;
    }
    return 0;
}
