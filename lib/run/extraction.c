#include "run/extraction.h"

#include <assert.h>

#include "base/hash.h"
#include "documents/vehicle_set.h"
#include "frame/frame_order.h"
#include "text/record_write.h"

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

int extraction_locate_fault(void *state, const struct frame *frame, struct runner *runner)
{
    (void)state;
    struct diag *diag = runner_diag(runner);
    for (size_t i = 0; i < frame->reflectors.count; i++) {
        const struct reflector_set *set = &frame->reflectors.items[i];
        if (record_write_check(&reflector_set_record, set, ~0U, diag) != 0)
            return diag_prefix(diag, "class \"%s\": ", set->model);
    }
    return 0;
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

/* An object of size zero takes its class's default size: true if it did. */
static bool complete_size(struct object *object, const struct vehicle *vehicle)
{
    if (object->length_m != 0 && object->width_m != 0 && object->height_m != 0)
        return false;
    if (object->length_m == 0)
        object->length_m = vehicle->length_m;
    if (object->width_m == 0)
        object->width_m = vehicle->width_m;
    if (object->height_m == 0)
        object->height_m = vehicle->height_m;
    return true;
}

/* A class among the objects of a frame. */
struct extracted_class {
    const char *name;
    const struct vehicle *vehicle;
    bool noted;    /* did the frame name its document before? */
    size_t shared; /* number in the frame, from 1, of the set that its objects share; 0: none yet */
};

/* All classes of a frame, each looked up once. */
struct extracted_classes {
    struct hash_table numbers; /* by name */
    LIST_OF(struct extracted_class) list;
};

static bool is_named(const void *classes, uint32_t number, const void *name)
{
    const struct extracted_class *list = classes;
    assert(list != NULL);
    return frame_same_name(list[number].name, name);
}

/* A frame that was extracted before keeps to the documents that it names. */
static int find_class(struct extracted_class *class, const char *folder, const struct frame *frame,
                      struct runner *runner)
{
    struct document_span before = frame_documents_of(frame, class->name);
    class->noted = before.count > 0;
    class->vehicle =
        runner_vehicle(runner, folder, class->name, class->noted ? before.items->digest : NULL);
    return class->vehicle != NULL ? 0 : -1;
}

/* The class of the object; NULL after a message. */
static struct extracted_class *class_of(struct extracted_classes *classes,
                                        const struct object *object, const char *folder,
                                        const struct frame *frame, struct runner *runner)
{
    uint64_t hash = hash_table_hash(0, object->class, strlen(object->class));
    uint32_t *slot =
        hash_table_slot(&classes->numbers, hash, is_named, classes->list.items, object->class);
    if (*slot > 0)
        return &classes->list.items[*slot - 1];
    struct extracted_class *class = list_add(&classes->list, frame->arena);
    *slot = (uint32_t)classes->list.count;
    class->name = object->class;
    return find_class(class, folder, frame, runner) == 0 ? class : NULL;
}

/* Names in the frame the document of each class. One that it named before must be the same. */
static int note_documents(struct frame *frame, const struct extracted_classes *classes,
                          struct diag *diag)
{
    for (size_t i = 0; i < classes->list.count; i++) {
        const struct vehicle *vehicle = classes->list.items[i].vehicle;
        if (vehicle_check_frame(vehicle, frame, diag) != 0)
            return -1;
        if (!classes->list.items[i].noted)
            *list_add(&frame->vehicles, frame->arena) =
                (struct class_document){.class = vehicle->reflectors.model,
                                        .digest = vehicle->digest,
                                        .rear_axle_x_m = vehicle->rear_axle_x_m,
                                        .level = vehicle->level,
                                        .cell_max_m = vehicle->cell_max_m};
    }
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

/* The set of reflectors that the objects of a class share, made for the first of them. */
static struct reflector_set *shared_set(struct frame *frame, struct extracted_class *class,
                                        extraction_describe *describe,
                                        const struct extraction *extraction)
{
    if (class->shared > 0)
        return &frame->reflectors.items[class->shared - 1];
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    class->shared = frame->reflectors.count;
    *set = class->vehicle->reflectors;
    if (describe != NULL)
        describe(extraction, class->vehicle, set, frame->arena);
    return set;
}

int extraction_step(struct extraction *extraction, struct frame *frame, struct runner *runner,
                    extraction_describe *describe, extraction_describe_body *describe_body)
{
    struct object *const *object = frame_order_objects(frame);
    struct extracted_classes classes = {hash_table_begin(frame->objects.count, frame->arena), {0}};
    bool completes = false;
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct extracted_class *class =
            class_of(&classes, object[i], extraction->folder, frame, runner);
        if (class == NULL)
            return diag_prefix(runner_diag(runner),
                               "objects[%zu].class: ", (size_t)(object[i] - frame->objects.items));
        completes |= complete_size(object[i], class->vehicle);
        if (frame_same_name(object[i]->id, frame->ego))
            continue;
        struct reflector_set *set =
            own_set(frame, object[i], class->vehicle, describe_body, extraction);
        if (set == NULL)
            set = shared_set(frame, class, describe, extraction);
        *list_add(&set->objects, frame->arena) = object[i]->id;
    }
    if (completes)
        frame_alter(frame, PART_OBJECTS);
    return note_documents(frame, &classes, runner_diag(runner));
}
