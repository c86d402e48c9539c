/* Extraction of a contour model: objects get closely spaced scatterers along their outline, which
 * share the cross section of their class (MODEL 2.7). */
#include "run/extraction.h"

struct extract_contour {
    struct extraction extraction; /* first: its options are the stage's */
    struct surface surface;       /* in place of what documents state */
};

static struct surface surface_of(const struct extract_contour *extract,
                                 const struct vehicle *vehicle)
{
    struct surface surface =
        reflector_models_surface(&reflector_models_usual_surface, &vehicle->surface);
    return reflector_models_surface(&surface, &extract->surface);
}

static void describe(const void *state, const struct vehicle *vehicle, struct reflector_set *set,
                     struct arena *arena)
{
    struct surface surface = surface_of(state, vehicle);
    struct vec2 size_m = {vehicle->length_m, vehicle->width_m};
    if (vehicle->contour.given != 0)
        reflector_models_of_contour(&vehicle->contour, &surface, size_m, set, arena);
}

static bool describe_body(void *state, const struct vehicle *vehicle, const struct frame *frame,
                          const struct object *object, struct reflector_set *set)
{
    const struct extract_contour *extract = state;
    if (!reflector_models_differs(&vehicle->surface) &&
        !reflector_models_differs(&extract->surface))
        return false;
    struct surface surface = surface_of(extract, vehicle);
    return extraction_describe_surface(state, &surface, vehicle, frame, object, set);
}

static int extract_contour_start(void *state, struct runner *runner)
{
    const struct extract_contour *extract = state;
    const struct surface *surface = &extract->surface;
    if ((surface->full_rad >= 0) != (surface->zero_rad >= 0))
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--full-rad and --zero-rad: one is missing; expected both or none");
    if (surface->zero_rad < surface->full_rad)
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--zero-rad: %g is less than --full-rad, %g rad", surface->zero_rad,
                         surface->full_rad);
    return extraction_start(state, runner);
}

static int extract_contour_step(void *state, struct frame *frame, struct runner *runner)
{
    return extraction_step(state, frame, runner, describe, describe_body);
}

static const struct field extract_contour_options[] = {
    EXTRACTION_OPTIONS,
    {OPTIONAL_RECORD(struct extract_contour, surface, &surface_record, "of all contours")},
    {0},
};

const struct stage stage_extract_contour = {
    .name = "extract-contour",
    .summary = "Write the outline of every object as closely spaced scatterers.",
    .details =
        "Stands in for glint-extract. A document may have a contour: the mean cross section of "
        "its class from ahead, from behind, from the side and at 45 degrees. Such a class becomes "
        "four rows of equal scatterers, one row on each side. A scatterer has the power of its "
        "piece of the side and is seen from outside. The powers of all scatterers add up to the "
        "cross section of the class, whatever the spacing. All other classes keep the reflectors "
        "of their document.\n\n"
        "Powers add up where phases are random: use a sensor whose cell_phase is random, or "
        "by_path (each scatterer then has a constant phase of its own besides that of its path, "
        "as a rough surface has). With in_phase, amplitudes add up instead, and the closer the "
        "scatterers are, the stronger the contour gets, without end. If the effect rows is "
        "switched off, no scatterer is seen.",
    .options = STAGE_OPTIONS(struct extract_contour, extract_contour_options),
    .reads = PART_OBJECTS,
    .writes = PART_REFLECTORS | PART_VEHICLES,
    .start = extract_contour_start,
    .step = extract_contour_step,
    .locate_fault = extraction_locate_fault,
    .release = extraction_release,
};
