/* Extraction of a contour model: objects get closely spaced scatterers along their outline, which
 * share the cross section of their class (MODEL 2.7). */
#include "run/extraction.h"

struct extract_contour {
    struct extraction extraction; /* first: its options are the stage's */
    double spacing_m;
};

static void describe(const void *state, const struct vehicle *vehicle, struct reflector_set *set,
                     struct arena *arena)
{
    const struct extract_contour *extract = state;
    if (vehicle->contour.given != 0)
        reflector_models_of_contour(&vehicle->contour, vehicle->length_m, vehicle->width_m,
                                    extract->spacing_m, set, arena);
}

static int extract_contour_step(void *state, struct frame *frame, struct runner *runner)
{
    return extraction_step(state, frame, runner, describe);
}

static const struct field extract_contour_options[] = {
    EXTRACTION_OPTIONS,
    {OPTIONAL_REAL(struct extract_contour, spacing_m, 0.02, 100,
                   "distance from one scatterer to the next, at most; absent: 0.1 m"),
     .absent = 0.1},
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
    .start = extraction_start,
    .step = extract_contour_step,
};
