#include "documents/vehicle.h"

#include <stdio.h>

#include "base/hash.h"
#include "text/document.h"

static const struct field vehicle_fields[] = {
    {FIELD_NAME_OF(struct vehicle, origin, "who made this, and from what")},
    {FIELD_REAL_IN(struct vehicle, length_m, 0.01, 1e4, "of objects without one of their own")},
    {FIELD_REAL_IN(struct vehicle, width_m, 0.01, 1e4, "of objects without one of their own")},
    {FIELD_REAL_IN(struct vehicle, height_m, 0.01, 1e3, "of objects without one of their own")},
    {OPTIONAL_REAL(struct vehicle, rear_axle_x_m, -1e3, 1e3,
                   "from the centre of the box; absent: 5/18 of the length behind it")},
    {OPTIONAL_RECORD(struct vehicle, level, &class_level_record,
                     "how its bodies' levels vary, where not as the sensor has it")},
    {FIELD_RECORD_OF(struct vehicle, reflectors, &reflector_model_record,
                     "reflection centres of the class")},
    {OPTIONAL_CHOICE(struct vehicle, sensing_target, reflector_models_3gpp_names,
                     "sensing target of 3GPP TR 38.901, for glint-extract-3gpp")},
    {OPTIONAL_RECORD(struct vehicle, contour, &contour_record, "for glint-extract-contour")},
    {OPTIONAL_RECORD(struct vehicle, surface, &surface_record, "of the contour's scatterers")},
    {OPTIONAL_REAL(struct vehicle, cell_max_m, 0.01, 100,
                   "coarsest range cell that its reflectors are made for; absent: any")},
    {.name = "sources",
     .kind = FIELD_NOTES,
     .optional = true,
     .help = "where each figure comes from"},
    {0},
};

const struct record vehicle_record = {
    FIELD_TABLE(struct vehicle, vehicle_fields, "vehicle",
                "A class of road users or things: default size and reflection centres.")};

static int check_visibility(const char *list, size_t index, double full_rad, double zero_rad,
                            struct diag *diag)
{
    if (zero_rad < full_rad)
        return diag_fail(diag, DIAG_CONFIG, "%s[%zu].zero_rad: %g is less than full_rad, %g rad",
                         list, index, zero_rad, full_rad);
    return 0;
}

/* Names are unique, zero_rad is at least full_rad, and a mirror has one law of reflection. */
static int check_reflectors(const struct reflector_set *set, struct arena *arena, struct diag *diag)
{
    const char *twice = reflectors_name_twice(set, arena);
    if (twice != NULL)
        return diag_fail(diag, DIAG_CONFIG, "the name \"%s\" stands twice", twice);
    for (size_t i = 0; i < set->points.count; i++)
        if (check_visibility("points", i, set->points.items[i].full_rad,
                             set->points.items[i].zero_rad, diag) != 0)
            return -1;
    for (size_t i = 0; i < set->rows.count; i++)
        if (check_visibility("rows", i, set->rows.items[i].full_rad, set->rows.items[i].zero_rad,
                             diag) != 0)
            return -1;
    size_t unclear = reflectors_unclear_mirror(set);
    if (unclear < set->mirrors.count)
        return diag_fail(diag, DIAG_CONFIG,
                         "mirrors[%zu]: expected either a material or a reflection", unclear);
    return 0;
}

static int read_vehicle(const char *path, struct vehicle *vehicle, struct arena *arena,
                        struct diag *diag)
{
    struct text bytes = {0};
    int result = document_bytes(path, &bytes, diag);
    if (result == 0)
        result = document_parse(path, &bytes, &vehicle_record, vehicle, arena, diag);
    uint64_t digest = hash_bytes(HASH_START, bytes.bytes, bytes.length);
    snprintf(vehicle->digest, sizeof vehicle->digest, "%016llx", (unsigned long long)digest);
    text_free(&bytes);
    return result;
}

int vehicle_check_class(const char *class, struct diag *diag)
{
    const char *ending = strrchr(class, '.');
    if (document_check_plain(class, diag) != 0)
        return -1;
    return ending == NULL || strcmp(ending, ".json") == 0
               ? 0
               : diag_fail(diag, DIAG_DATA,
                           "\"%s\" is no class; expected a name in data/vehicles, as glint --list "
                           "vehicles lists them, or a file NAME.json",
                           class);
}

const struct vehicle *vehicle_load(const char *class, const char *folder, struct arena *arena,
                                   struct diag *diag)
{
    if (vehicle_check_class(class, diag) != 0)
        return NULL;
    const char *path = document_find_file(folder, "vehicles", class, ".json", arena, diag);
    struct vehicle *vehicle = arena_get(arena, sizeof *vehicle);
    if (path == NULL || read_vehicle(path, vehicle, arena, diag) != 0)
        return NULL;
    vehicle->reflectors.model = arena_text(arena, class, strlen(class));
    if (check_reflectors(&vehicle->reflectors, arena, diag) != 0) {
        diag_prefix(diag, "%s: reflectors: ", path);
        return NULL;
    }
    if (reflector_models_check_contour(&vehicle->contour, diag) != 0) {
        diag_prefix(diag, "%s: contour.", path);
        return NULL;
    }
    if (reflector_models_check_surface(&vehicle->surface, &vehicle->contour, diag) != 0) {
        diag_prefix(diag, "%s: ", path);
        return NULL;
    }
    vehicle->reflectors.document = &vehicle->reflectors;
    vehicle->reflectors.shape = reflectors_shape(&vehicle->reflectors, arena);
    return vehicle;
}

int vehicle_check_frame(const struct vehicle *vehicle, const struct frame *frame, struct diag *diag)
{
    struct document_span documents = frame_documents_of(frame, vehicle->reflectors.model);
    for (size_t i = 0; i < documents.count; i++) {
        const struct class_document *used = &documents.items[i];
        if (strcmp(used->digest, vehicle->digest) != 0)
            return diag_fail(diag, DIAG_CONFIG,
                             "vehicles[%zu].digest: the class \"%s\" was extracted from a document "
                             "%s, the one found now is %s; name its set with --vehicles",
                             (size_t)(used - frame->vehicles.items), used->class, used->digest,
                             vehicle->digest);
    }
    return 0;
}
