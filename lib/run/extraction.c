#include "run/extraction.h"

#include "base/hash.h"
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

void extraction_release(void *state)
{
    struct extraction *extraction = state;
    arena_free(&extraction->surfaces.arena);
}

/* Forgets the surfaces of another scene. */
static void enter_scene(struct extraction_surfaces *known, const struct random_address *scene)
{
    if (known->scene.seed == scene->seed && known->scene.scene == scene->scene)
        return;
    arena_clear(&known->arena);
    *known = (struct extraction_surfaces){.scene = *scene, .arena = known->arena};
}

/* The surface of the body that was drawn before, or NULL. */
static const struct extraction_surface *known_surface(struct extraction_surfaces *known,
                                                      const char *id)
{
    for (size_t i = 0; i < known->bodies.count; i++) {
        size_t at = (known->next + i) % known->bodies.count;
        if (!frame_same_name(known->bodies.items[at].id, id))
            continue;
        known->next = at + 1;
        return &known->bodies.items[at];
    }
    return NULL;
}

static void draw_surface(const struct surface *surface, const struct vehicle *vehicle,
                         struct random_address body, const struct object *object,
                         struct reflector_set *set, struct arena *arena)
{
    struct vec2 usual_m = {vehicle->length_m, vehicle->width_m};
    struct vec2 size_m = {object->length_m, object->width_m};
    body.item = hash_text(HASH_START, object->id);
    *set = vehicle->reflectors;
    reflector_models_of_surface(&vehicle->contour, surface, usual_m, size_m, object->height_m,
                                &body, set, arena);
}

static bool is_of(const struct extraction_surface *drawn, const struct vehicle *vehicle,
                  const struct object *object)
{
    struct vec2 size_m = {object->length_m, object->width_m};
    return drawn->vehicle == vehicle && vec2_same(drawn->size_m, size_m) &&
           drawn->height_m == object->height_m;
}

bool extraction_describe_surface(struct extraction *extraction, const struct surface *surface,
                                 const struct vehicle *vehicle, const struct frame *frame,
                                 const struct object *object, struct reflector_set *set)
{
    if (vehicle->contour.given == 0 || !reflector_models_differs(surface))
        return false;
    struct extraction_surfaces *known = &extraction->surfaces;
    struct random_address scene = frame_draw_address_of_scene(frame);
    enter_scene(known, &scene);
    const struct extraction_surface *drawn = known_surface(known, object->id);
    if (drawn != NULL && is_of(drawn, vehicle, object)) {
        *set = drawn->set;
    } else if (drawn != NULL) {
        draw_surface(surface, vehicle, scene, object, set, frame->arena);
    } else {
        draw_surface(surface, vehicle, scene, object, set, &known->arena);
        *list_add(&known->bodies, &known->arena) = (struct extraction_surface){
            .id = arena_text(&known->arena, object->id, strlen(object->id)),
            .vehicle = vehicle,
            .size_m = {object->length_m, object->width_m},
            .height_m = object->height_m,
            .set = *set};
    }
    return true;
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

/* The document of the class that the frame was extracted with before; NULL: none. */
static const struct class_document *noted_document(const struct frame *frame, const char *class)
{
    for (size_t i = 0; i < frame->vehicles.count; i++)
        if (frame_same_name(frame->vehicles.items[i].class, class))
            return &frame->vehicles.items[i];
    return NULL;
}

/* A frame that was extracted before keeps to the documents that it notes. */
static int note_document(struct frame *frame, const struct class_document *noted,
                         const struct vehicle *vehicle, struct diag *diag)
{
    if (noted != NULL)
        return noted->digest == vehicle->digest ? 0 : vehicle_check_frame(vehicle, frame, diag);
    *list_add(&frame->vehicles, frame->arena) =
        (struct class_document){.class = vehicle->reflectors.model,
                                .digest = vehicle->digest,
                                .rear_axle_x_m = vehicle->rear_axle_x_m,
                                .level = vehicle->level,
                                .cell_max_m = vehicle->cell_max_m};
    return 0;
}

/* A new set of this object alone, or NULL if those of its class share one. */
static struct reflector_set *own_set(struct frame *frame, const struct object *object,
                                     const struct vehicle *vehicle,
                                     extraction_describe_body *describe_body,
                                     struct extraction *extraction)
{
    struct reflector_set own;
    if (describe_body == NULL || !describe_body(extraction, vehicle, frame, object, &own))
        return NULL;
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = own;
    return set;
}

/* The vehicle's set of reflectors in the frame, made for the first object of its class. */
static struct reflector_set *shared_set(struct frame *frame, const struct vehicle *vehicle,
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

int extraction_step(struct extraction *extraction, struct frame *frame, struct runner *runner,
                    extraction_describe *describe, extraction_describe_body *describe_body)
{
    struct object *const *object = frame_order_objects(frame);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct class_document *noted = noted_document(frame, object[i]->class);
        const struct vehicle *vehicle = runner_vehicle(runner, extraction->folder, object[i]->class,
                                                       noted != NULL ? noted->digest : NULL);
        if (vehicle == NULL)
            return diag_prefix(runner_diag(runner),
                               "objects[%zu].class: ", (size_t)(object[i] - frame->objects.items));
        if (note_document(frame, noted, vehicle, runner_diag(runner)) != 0)
            return -1;
        complete_size(object[i], vehicle);
        if (frame_same_name(object[i]->id, frame->ego))
            continue;
        struct reflector_set *set = own_set(frame, object[i], vehicle, describe_body, extraction);
        if (set == NULL)
            set = shared_set(frame, vehicle, describe, extraction);
        *list_add(&set->objects, frame->arena) = object[i]->id;
    }
    return 0;
}
